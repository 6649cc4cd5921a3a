"""Measures the Python package against the packages that it replaces: matrices, and the overhead over the C++ call.

    python python_peers.py MESH [--radius R] [--rows N] [--rounds N] [--workbench] [--json FILE]

Run it where brushfire and benchmarks/requirements.txt are installed. (Single fields of all peers are measured by
peers.py.) Times are processor time, medians of interleaved rounds; --workbench also runs Connectome Workbench's
all-to-all command (Debian: connectome-workbench), whose distances are those of a graph.
"""

import argparse
import json
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import gdist
import numpy as np

import brushfire as bf
from brushfire.compat import gdist as our_gdist


def seconds(call):
    start = time.process_time()
    call()
    return time.process_time() - start


def interleaved(calls, rounds):
    """Median processor time of each call; every round runs them all."""
    times = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            times[name].append(seconds(call))
    return {name: statistics.median(t) for name, t in times.items()}


def overhead(mesh, V, F, rounds):
    """Set-up and one field through Python."""
    return interleaved(
        {
            "Mesh(V, F)": lambda: bf.Mesh(V, F),
            "distance(0)": lambda: mesh.distance(0),
            "distance(0), solver kept": lambda solver=mesh.solver(): solver.distance(0),
        },
        rounds,
    )


def local_matrix(mesh, V, F, radius, rounds):
    """gdist's own call at the same radius, ours with exact distances, and ours at its fastest; one thread each."""
    theirs = gdist.local_gdist_matrix(V, F, max_distance=radius)
    ours = our_gdist.local_gdist_matrix(V, F, max_distance=radius)
    common = theirs.multiply(ours > 0)
    times = interleaved(
        {
            "gdist": lambda: gdist.local_gdist_matrix(V, F, max_distance=radius),
            "brushfire exact": lambda: mesh.distances_within(radius, method="exact", threads=1),
            "brushfire default": lambda: mesh.distances_within(radius, threads=1),
        },
        rounds,
    )
    return {
        **times,
        "entries gdist": theirs.nnz,
        "entries brushfire": ours.nnz,
        "largest difference": abs(common - ours.multiply(theirs > 0)).max(),
    }


def all_pairs(mesh, V, F, rows, rounds):
    """Rows of the full matrix per second of processor time, one thread."""
    chosen = np.arange(0, mesh.vertex_count, max(1, mesh.vertex_count // rows))[:rows]
    times = interleaved(
        {
            "gdist": lambda: [
                gdist.compute_gdist(V, F, source_indices=np.array([v], dtype=np.int32)) for v in chosen[:3]
            ],
            "brushfire exact": lambda: mesh.distance_matrix(chosen, method="exact", threads=1),
            "brushfire default": lambda: mesh.distance_matrix(chosen, threads=1),
            "brushfire dijkstra": lambda: mesh.distance_matrix(chosen, method="dijkstra", threads=1),
        },
        rounds,
    )
    return {name: (3 if name == "gdist" else len(chosen)) / t for name, t in times.items()}


def two_threads(mesh, rows, rounds):
    """Wall time of one thread over that of two, for the same matrix; 2 on an idle machine of two processors."""
    chosen = np.arange(0, mesh.vertex_count, max(1, mesh.vertex_count // rows))[:rows]
    ratios = []
    for _ in range(rounds):
        times = []
        for threads in (1, 2):
            start = time.perf_counter()
            mesh.distance_matrix(chosen, threads=threads)
            times.append(time.perf_counter() - start)
        ratios.append(times[0] / times[1])
    return {"one thread / two threads": statistics.median(ratios)}


def workbench(V, F):
    """Rows per second of wb_command -surface-geodesic-distance-all-to-all."""
    import nibabel

    if not shutil.which("wb_command"):
        return {"wb_command": None}
    with tempfile.TemporaryDirectory() as folder:
        surface = Path(folder) / "mesh.surf.gii"
        points = nibabel.gifti.GiftiDataArray(V.astype(np.float32), intent="NIFTI_INTENT_POINTSET")
        faces = nibabel.gifti.GiftiDataArray(F.astype(np.int32), intent="NIFTI_INTENT_TRIANGLE")
        points.meta["AnatomicalStructurePrimary"] = "CortexLeft"
        nibabel.save(nibabel.gifti.GiftiImage(darrays=[points, faces]), surface)
        out = Path(folder) / "d.dconn.nii"
        command = ["wb_command", "-surface-geodesic-distance-all-to-all", surface, out]
        before = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True, env={"OMP_NUM_THREADS": "1", "PATH": "/usr/bin"})
        return {"wb_command": len(V) / (time.perf_counter() - before)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--radius", type=float, help="default: five mean edge lengths")
    parser.add_argument("--rows", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--workbench", action="store_true")
    parser.add_argument("--skip-local", action="store_true", help="leave out gdist's local matrix, which takes minutes")
    parser.add_argument("--json")
    arguments = parser.parse_args()

    mesh = bf.read(arguments.mesh)
    V, F = np.array(mesh.vertices), np.array(mesh.faces)
    radius = arguments.radius or 5 * mesh.report.mean_edge_length
    result = {"mesh": arguments.mesh, "vertices": mesh.vertex_count, "radius": radius}
    result["seconds through Python"] = overhead(mesh, V, F, max(5, arguments.rounds))
    result["rows per second"] = all_pairs(mesh, V, F, arguments.rows, arguments.rounds)
    result["threads"] = two_threads(mesh, arguments.rows, arguments.rounds)
    if not arguments.skip_local:
        result["seconds of the local matrix"] = local_matrix(mesh, V, F, radius, 1)
    if arguments.workbench:
        result["rows per second"].update(workbench(V, F))
    text = json.dumps(result, indent=2)
    print(text)
    if arguments.json:
        Path(arguments.json).write_text(text + "\n")


if __name__ == "__main__":
    main()
