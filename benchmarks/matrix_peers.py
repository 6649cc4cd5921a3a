"""Rows a second of full distance matrices of a cortex, and how wrong they are, beside Connectome Workbench and gdist.

    python benchmarks/matrix_peers.py PROGRAM [--rounds 3] [--rows 300] [--divided]

PROGRAM is the brushfire command; numpy, nibabel, nilearn (whose fsaverage5 is the mesh: 10,242 vertices, or 40,962 with
every face in four) and tvb-gdist are needed, wb_command (Debian's connectome-workbench) is measured where it is
installed. Our matrix is written to a .npy file as a user's would be, reading the mesh and set-up included; of the larger
mesh an eighth of its rows. Workbench writes --rows rows into its own format, gdist computes three. Processor time of one
thread, medians of rounds that each run all of them; errors relative to exact rows, over the same pairs. Prints Markdown.
"""

import argparse
import importlib.util
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import nibabel
import numpy as np

METHODS = ("carried-source", "novotni-klein")
LARGE = 20_000  # vertices


def cortex(divided):
    """The left pial surface of fsaverage5 as nilearn ships it."""
    folder = Path(importlib.util.find_spec("nilearn").submodule_search_locations[0]) / "datasets/data/fsaverage5"
    pial = nibabel.load(folder / "pial_left.gii.gz")
    V, F = pial.agg_data("pointset").astype(float), pial.agg_data("triangle").astype(np.int32)
    if not divided:
        return V, F
    edges, inverse = np.unique(np.sort(F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    (a, b, c), (ab, bc, ca) = F.T, (len(V) + inverse.reshape(-1, 3)).T
    corners = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.vstack([V, V[edges].mean(axis=1)]), np.vstack([np.column_stack(t) for t in corners]).astype(np.int32)


def save(path, *arrays):
    image = nibabel.gifti.GiftiImage(darrays=list(arrays))
    image.meta["AnatomicalStructurePrimary"] = "CortexLeft"
    nibabel.save(image, path)


def seconds(command, **environment):
    """Processor time of a command and of all it starts."""
    before = os.times()
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, **environment})
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


class Bench:
    """A cortex in files, and the rows that errors are told of."""

    def __init__(self, program, folder, mesh, count):
        self.program, self.folder, (self.V, self.F) = program, Path(folder), mesh
        self.surface, self.roi = (str(self.folder / name) for name in ("mesh.surf.gii", "roi.func.gii"))
        points = nibabel.gifti.GiftiDataArray(self.V.astype(np.float32), intent="NIFTI_INTENT_POINTSET")
        points.meta["AnatomicalStructurePrimary"] = "CortexLeft"
        save(self.surface, points, nibabel.gifti.GiftiDataArray(self.F, intent="NIFTI_INTENT_TRIANGLE"))
        self.chosen = np.linspace(0, len(self.V) - 1, count).astype(np.int32)
        mask = np.zeros(len(self.V), dtype=np.float32)
        mask[self.chosen] = 1
        save(self.roi, nibabel.gifti.GiftiDataArray(mask, intent="NIFTI_INTENT_NONE"))
        self.exact = self.some_rows("exact", "--dtype", "float64")

    def matrix(self, method, *options):
        output = self.folder / f"{method}.npy"
        command = [self.program, "matrix", self.surface, "--method", method, "-o", output, "--quiet", *options]
        return [str(word) for word in command], output

    def some_rows(self, method, *options):
        listed = ",".join(map(str, self.chosen))
        command, output = self.matrix(method, "--rows", listed, "--columns", listed, *options)
        subprocess.run(command, check=True, capture_output=True)
        rows = np.load(output)
        output.unlink()
        return rows

    def ours(self, method):
        parts = 8 if len(self.V) > LARGE else 1
        command, output = self.matrix(method, "--threads", "1", *(("--shard", f"1/{parts}") if parts > 1 else ()))
        took = seconds(command)
        written = output if parts == 1 else next(self.folder.glob(f"{method}.*of*.npy"))
        rows = len(np.load(written, mmap_mode="r"))
        for file in self.folder.glob(f"{method}.*npy*"):
            file.unlink()
        return rows / took

    def workbench(self):
        out = str(self.folder / "d.dconn.nii")
        command = ["wb_command", "-surface-geodesic-distance-all-to-all", self.surface, out, "-roi", self.roi]
        took = seconds(command, OMP_NUM_THREADS="1")
        return len(self.chosen) / took, np.asarray(nibabel.load(out).dataobj)

    def gdist(self):
        few = ",".join(map(str, self.chosen[:: len(self.chosen) // 3][:3]))
        return 3 / seconds([sys.executable, "-c", GDIST, self.surface, few])

    def error(self, found):
        relative = np.abs(found - self.exact)[self.exact > 0] / self.exact[self.exact > 0]
        return float(relative.mean()), float(relative.max())


GDIST = """
import sys, gdist, nibabel, numpy as np
V, F = (nibabel.load(sys.argv[1]).agg_data(kind) for kind in ("pointset", "triangle"))
for source in sys.argv[2].split(","):
    gdist.compute_gdist(V.astype(float), F.astype(np.int32), np.array([int(source)], np.int32))
"""


def measure(bench, rounds):
    """Of each program: rows a second, how many times as many ours are, mean and largest error."""
    rates, wrong = {}, {}
    for method in METHODS:
        wrong[method] = bench.error(bench.some_rows(method))
    for _ in range(rounds):
        for method in METHODS:
            rates.setdefault(method, []).append(bench.ours(method))
        if shutil.which("wb_command"):
            rate, found = bench.workbench()
            rates.setdefault("Connectome Workbench", []).append(rate)
            wrong["Connectome Workbench"] = bench.error(found)
        rates.setdefault("gdist (exact)", []).append(bench.gdist())
    for name, found in rates.items():
        ratio = statistics.median(a / b for a, b in zip(rates[METHODS[0]], found, strict=True))
        yield name, statistics.median(found), ratio, *wrong.get(name, (0.0, 0.0))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--rows", type=int, default=300, help="of Connectome Workbench, and for the errors")
    parser.add_argument("--divided", action="store_true", help="the mesh of 40,962 vertices")
    given = parser.parse_args()
    if not shutil.which("wb_command"):
        print("(wb_command is not installed: Connectome Workbench is left out)", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(given.program, folder, cortex(given.divided), given.rows)
        print(f"| {len(bench.V)} vertices | rows/s | carried-source by this | mean error | largest |")
        print("|---|--:|--:|--:|--:|")
        for program, rate, ratio, mean, most in measure(bench, given.rounds):
            print(f"| {program} | {rate:,.4g} | x{ratio:,.4g} | {100 * mean:.2g} % | {100 * most:.2g} % |", flush=True)


if __name__ == "__main__":
    main()
