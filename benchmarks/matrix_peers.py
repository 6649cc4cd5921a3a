"""Rows a second of full distance matrices of a cortex, and how wrong they are, beside Connectome Workbench and gdist.

    python benchmarks/matrix_peers.py [--rounds 3] [--rows 500]

Run it where brushfire, tvb-gdist, nibabel, nilearn and numpy are installed (wb_command: Debian's connectome-workbench).
Our rows are written to a .npy file as a user's would be, set-up and all: every row of the smaller mesh, an eighth of the
rows of the larger one. Workbench writes --rows rows of its matrix into its own format, gdist computes three. Processor
time of one thread, medians of rounds that each run all of them; errors relative to exact rows, over the same pairs.
Prints Markdown.
"""

import argparse
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np

import brushfire as bf
from python_peers import cortex_meshes, seconds, workbench

METHODS = ("carried-source", "novotni-klein")


def our_rows(mesh, method):
    """Rows a second."""
    parts = 1 if mesh.vertex_count < 20_000 else 8
    with tempfile.TemporaryDirectory() as folder:
        took = seconds(
            lambda: mesh.write_distance_matrix(Path(folder) / "d.npy", method=method, shard=(1, parts), threads=1)
        )
        written = next(Path(folder).glob("d*.npy"))
        return len(np.load(written, mmap_mode="r")) / took


def gdist_rows(V, F, chosen):
    import gdist

    few = chosen[:: len(chosen) // 3][:3]
    return len(few) / seconds(lambda: [gdist.compute_gdist(V, F, few[[k]]) for k in range(len(few))])


def errors(found, exact):
    relative = np.abs(found - exact)[exact > 0] / exact[exact > 0]
    return float(relative.mean()), float(relative.max())


def measure(V, F, rounds, count):
    """Of each program: rows a second, mean and largest error."""
    mesh = bf.Mesh(V, F)
    chosen = np.linspace(0, len(V) - 1, count).astype(np.int32)
    exact = mesh.distance_matrix(chosen, chosen, method="exact", dtype=np.float64)
    rates, wrong = {}, {"gdist": (0.0, 0.0)}
    for method in METHODS:
        wrong[method] = errors(mesh.distance_matrix(chosen, chosen, method=method), exact)
    for _ in range(rounds):
        for method in METHODS:
            rates.setdefault(method, []).append(our_rows(mesh, method))
        if shutil.which("wb_command"):
            theirs = workbench(V, F, chosen)
            rates.setdefault("Connectome Workbench", []).append(theirs["rows per second"])
            wrong["Connectome Workbench"] = theirs["mean"], theirs["max"]
        rates.setdefault("gdist", []).append(gdist_rows(V, F, chosen))
    ours = rates["carried-source"]
    for name, found in rates.items():
        ratio = statistics.median(a / b for a, b in zip(ours, found, strict=True))
        yield name, statistics.median(found), ratio, *wrong[name]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--rows", type=int, default=500, help="of Connectome Workbench, and for the errors")
    given = parser.parse_args()
    if not shutil.which("wb_command"):
        print("(wb_command is not installed: Connectome Workbench is left out)", file=sys.stderr)
    print("| | rows/s | carried-source's by this | mean error | largest |\n|---|--:|--:|--:|--:|")
    for name, V, F in cortex_meshes():
        print(f"| **{name}**, {len(V)} vertices | | | | |")
        for program, rate, ratio, mean, most in measure(V, F, given.rounds, given.rows):
            print(f"| {program} | {rate:,.4g} | x{ratio:,.4g} | {100 * mean:.2g} % | {100 * most:.2g} % |", flush=True)


if __name__ == "__main__":
    main()
