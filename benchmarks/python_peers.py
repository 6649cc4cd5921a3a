"""Measures the Python package against the packages that it stands beside, and writes docs/python-peers.md.

    python benchmarks/python_peers.py [fields] [local] [pairs] [threads] [overhead] [-o docs/python-peers.md]

Run it where brushfire, benchmarks/requirements.txt, pyvista, scipy, nibabel and nilearn are installed; without a name it
measures everything. Results are kept in build/python-peers/, so that parts can be measured one after the other.
Times are processor time of one thread, medians of interleaved rounds where a round is short. Connectome Workbench
(Debian: connectome-workbench) is measured where wb_command is installed; the overhead over C++ where time_solver is
built (cmake --build --preset benchmark --target time_solver).
"""

import argparse
import importlib.util
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import brushfire as bf
from python_peers_page import FIELDS, OURS, page

HERE = Path(__file__).resolve().parent
KEPT = HERE.parent / "build" / "python-peers"
SHARED = Path(os.environ.get("BRUSHFIRE_SHARED_DIR", HERE.parent.parent / "shared"))
TIME_SOLVER = HERE.parent / "build" / "benchmark" / "benchmarks" / "time_solver"

RADII = {10242: (4.0, 8.0, 20.0), 32492: (2.0, 4.0, 8.0, 12.0)}  # by vertices; mm


# ---- meshes


def subdivided(V, F):
    """Every face in four, at the middles of its edges."""
    edges, inverse = np.unique(np.sort(F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    middle = len(V) + inverse.reshape(-1, 3)
    (a, b, c), (ab, bc, ca) = F.T, middle.T
    corners = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.vstack([V, V[edges].mean(axis=1)]), np.vstack([np.column_stack(t) for t in corners]).astype(np.int32)


def field_meshes():
    bunny, armadillo = (bf.read(SHARED / "meshes" / name) for name in ("stanford-bunny.ply", "armadillo.ply"))
    V, F = np.array(bunny.vertices), np.array(bunny.faces)
    yield "stanford-bunny", V, F
    yield "armadillo", np.array(armadillo.vertices), np.array(armadillo.faces)
    yield "stanford-bunny, subdivided twice", *subdivided(*subdivided(V, F))


def icosphere(n):
    """A sphere of 10 n^2 + 2 vertices: the faces of an icosahedron, each in n^2."""
    g = (1 + 5**0.5) / 2
    V = np.array([[0, s, t * g] for s in (-1, 1) for t in (-1, 1)], dtype=float)
    V = np.vstack([V, V[:, [1, 2, 0]], V[:, [2, 0, 1]]])
    near = np.linalg.norm(V[:, None] - V, axis=2) < 2.1
    triples = [(a, b, c) for a in range(12) for b in range(12) for c in range(12) if a < b and a < c and b != c]
    F = [t for t in triples if near[t[0], t[1]] and near[t[1], t[2]] and near[t[2], t[0]]]
    F = [(a, b, c) for a, b, c in F if np.dot(np.cross(V[a], V[b]), V[c]) > 0]
    number, positions, faces = {}, [], []
    for a, b, c in F:

        def at(i, j, a=a, b=b, c=c):
            key = tuple(sorted((v, w) for v, w in ((a, n - i - j), (b, i), (c, j)) if w))
            if key not in number:
                number[key] = len(positions)
                positions.append(((n - i - j) * V[a] + i * V[b] + j * V[c]) / n)
            return number[key]

        for i in range(n):
            for j in range(n - i):
                faces.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j < n - 1:
                    faces.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    P = np.array(positions)
    return P / np.linalg.norm(P, axis=1, keepdims=True), np.array(faces, dtype=np.int32)


def cortex_meshes():
    """The left pial surface of fsaverage5 as nilearn ships it, and the same on a sphere of 32492 vertices (fs_LR's
    32k): each of them carried over by the registered spheres."""
    import nibabel

    folder = Path(importlib.util.find_spec("nilearn").submodule_search_locations[0]) / "datasets/data/fsaverage5"
    pial, sphere = (nibabel.load(folder / f"{name}_left.gii.gz") for name in ("pial", "sphere"))
    V, F = pial.agg_data("pointset").astype(float), pial.agg_data("triangle").astype(np.int32)
    yield "fsaverage5, 10k", V, F
    S = sphere.agg_data("pointset").astype(float)
    P, Q = icosphere(57)
    points, _ = bf.Mesh(S / np.linalg.norm(S, axis=1, keepdims=True), F).nearest(P)
    yield "fsaverage5 on 32k", np.einsum("ki,kij->kj", points.weights, V[F[points.face]]), Q


# ---- measuring


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


def rounds_of(command, rounds, patience):
    """What a program that answers every line with one of JSON says; None where it takes longer than `patience`."""
    try:
        ended = subprocess.run(
            command, check=False, input="\n" * rounds, capture_output=True, text=True, timeout=patience
        )
    except subprocess.TimeoutExpired:
        return None
    if ended.returncode != 0:
        print(ended.stderr[-500:], file=sys.stderr)
        return None
    lines = [json.loads(line) for line in ended.stdout.splitlines() if line.startswith("{")]
    return {key: statistics.median(line[key] for line in lines) for key in lines[0]}


def fields(arguments):
    results = []
    for name, V, F in field_meshes():
        exact = bf.Mesh(V, F).distance(0, method="exact")
        with tempfile.TemporaryDirectory() as folder:
            v, f, d = (str(Path(folder) / n) for n in "vfd")
            V.astype("<f8").tofile(v)
            F.astype("<i4").tofile(f)
            for peer in FIELDS:
                rounds = 1 if len(V) > 100_000 else arguments.rounds
                command = [sys.executable, str(HERE / "peer.py"), v, f, "0", peer, d]
                times = rounds_of(command, rounds, arguments.patience)
                row = {"mesh": name, "vertices": len(V), "peer": peer, "patience": arguments.patience}
                if times:
                    field = np.fromfile(d)
                    there = (exact > 0) & np.isfinite(exact)
                    error = np.abs(field[there] - exact[there]) / exact[there]
                    row |= times | {"mean": float(error.mean()), "max": float(error.max())}
                results.append(row)
                print(row, flush=True)
    return results


def local(arguments):
    import gdist

    results = []
    for name, V, F in cortex_meshes():
        mesh = bf.Mesh(V, F)
        for radius in RADII[len(V)]:
            row = {"mesh": name, "vertices": len(V), "radius": radius}
            found = {}

            def theirs(V=V, F=F, radius=radius, found=found):
                found["theirs"] = gdist.local_gdist_matrix(V, F, max_distance=radius)

            row["gdist"] = seconds(theirs)
            calls = {
                n: lambda o=o, mesh=mesh, radius=radius: mesh.distances_within(radius, threads=1, **o)
                for n, o in OURS.items()
            }
            row |= interleaved(calls, arguments.rounds)
            ours = mesh.distances_within(radius, method="exact", dtype=np.float64)
            common = found["theirs"].multiply(ours > 0)
            row["entries"] = ours.nnz / len(V)
            row["difference"] = float(abs(common - ours.multiply(found["theirs"] > 0)).max())
            results.append(row)
            print(row, flush=True)
    return results


def pairs(arguments):
    import gdist

    results = []
    for name, V, F in cortex_meshes():
        mesh = bf.Mesh(V, F)
        chosen = np.linspace(0, len(V) - 1, arguments.rows).astype(np.int32)
        few = chosen[:: len(chosen) // 3][:3]
        calls = {n: lambda o=o, mesh=mesh, c=chosen: mesh.distance_matrix(c, threads=1, **o) for n, o in OURS.items()}
        times = interleaved(calls, 1)
        row = {"mesh": name, "vertices": len(V), "rows": len(chosen)}
        row |= {n: len(chosen) / t for n, t in times.items()}
        row["gdist"] = len(few) / seconds(
            lambda V=V, F=F, few=few: [gdist.compute_gdist(V, F, few[[k]]) for k in range(3)]
        )
        if shutil.which("wb_command"):
            row["workbench"] = workbench(V, F, chosen)
        results.append(row)
        print(row, flush=True)
    return results


def workbench(V, F, chosen):
    """Rows per second of wb_command -surface-geodesic-distance-all-to-all for these rows; and its error."""
    import nibabel

    def save(path, *arrays):
        image = nibabel.gifti.GiftiImage(darrays=list(arrays))
        image.meta["AnatomicalStructurePrimary"] = "CortexLeft"
        nibabel.save(image, path)

    with tempfile.TemporaryDirectory() as folder:
        surface, roi, out = (str(Path(folder) / n) for n in ("mesh.surf.gii", "roi.func.gii", "d.dconn.nii"))
        points = nibabel.gifti.GiftiDataArray(V.astype(np.float32), intent="NIFTI_INTENT_POINTSET")
        points.meta["AnatomicalStructurePrimary"] = "CortexLeft"
        save(surface, points, nibabel.gifti.GiftiDataArray(F.astype(np.int32), intent="NIFTI_INTENT_TRIANGLE"))
        mask = np.zeros(len(V), dtype=np.float32)
        mask[chosen] = 1
        save(roi, nibabel.gifti.GiftiDataArray(mask, intent="NIFTI_INTENT_NONE"))
        command = ["wb_command", "-surface-geodesic-distance-all-to-all", surface, out, "-roi", roi]
        before = os.times()
        subprocess.run(
            command, check=True, capture_output=True, env={"OMP_NUM_THREADS": "1", "PATH": os.environ["PATH"]}
        )
        after = os.times()
        took = after.children_user + after.children_system - before.children_user - before.children_system
        theirs = np.asarray(nibabel.load(out).dataobj)
        exact = bf.Mesh(V, F).distance_matrix(chosen, chosen, method="exact", dtype=np.float64)
        error = np.abs(theirs - exact)[exact > 0] / exact[exact > 0]
        return {"rows per second": len(chosen) / took, "mean": float(error.mean()), "max": float(error.max())}


def threads(arguments):
    """The same matrices on one and two threads: wall time, and processor time of both together."""
    results = []
    for name, V, F in cortex_meshes():
        mesh = bf.Mesh(V, F)
        chosen = np.linspace(0, len(V) - 1, arguments.rows).astype(np.int32)
        work = {
            "dense, tolerance 1e-3": lambda t, m=mesh, c=chosen: m.distance_matrix(c, threads=t),
            "dense, novotni-klein": lambda t, m=mesh, c=chosen: m.distance_matrix(c, threads=t, method="novotni-klein"),
            "within 8 mm, exact": lambda t, m=mesh: m.distances_within(8, threads=t, method="exact"),
            "within 8 mm, novotni-klein": lambda t, m=mesh: m.distances_within(8, threads=t, method="novotni-klein"),
        }
        for what, call in work.items():
            measured = {1: [], 2: []}
            for _ in range(arguments.rounds):
                for count in (1, 2):
                    wall, processor = time.perf_counter(), time.process_time()
                    call(count)
                    measured[count].append((time.perf_counter() - wall, time.process_time() - processor))
            wall = [a[0] / b[0] for a, b in zip(measured[1], measured[2], strict=True)]
            more = [b[1] / a[1] for a, b in zip(measured[1], measured[2], strict=True)]
            results.append({"mesh": name, "what": what, "wall": max(wall), "work": statistics.median(more)})
            print(results[-1], flush=True)
    return results


def overhead(arguments):
    """Through Python and in C++ on the bunny, in turns, in seconds."""
    if not TIME_SOLVER.exists():
        return []
    _, V, F = next(field_meshes())
    results = []
    with tempfile.TemporaryDirectory() as folder:
        v, f = (str(Path(folder) / n) for n in "vf")
        V.astype("<f8").tofile(v)
        F.astype("<i4").tofile(f)
        for method in ("windows", "novotni-klein:float32"):
            names = {"windows": "brushfire", "novotni-klein:float32": "brushfire-nk-float"}
            commands = [
                [str(TIME_SOLVER), v, f, "0", method],
                [sys.executable, str(HERE / "peer.py"), v, f, "0", names[method]],
            ]
            rounds = [[rounds_of(c, 3, arguments.patience) for c in commands] for _ in range(arguments.rounds)]
            row = {"method": method}
            for key in ("first_s", "solve_s"):
                row[key] = [statistics.median(r[k][key] for r in rounds) for k in (0, 1)]
                row[key].append(statistics.median(r[1][key] / r[0][key] for r in rounds))
            results.append(row)
            print(row, flush=True)
    return results


PARTS = {"fields": fields, "local": local, "pairs": pairs, "threads": threads, "overhead": overhead}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], help="what to measure; everything if none is named")
    parser.add_argument("-o", "--output", default=HERE.parent / "docs" / "python-peers.md")
    parser.add_argument("--rows", type=int, default=200, help="of the full matrix")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--patience", type=float, default=120, help="seconds that a peer has for all rounds on a mesh")
    arguments = parser.parse_args()
    KEPT.mkdir(parents=True, exist_ok=True)
    for name in arguments.parts or PARTS:
        (KEPT / f"{name}.json").write_text(json.dumps(PARTS[name](arguments), indent=1))
    kept = {n: json.loads((KEPT / f"{n}.json").read_text()) for n in PARTS if (KEPT / f"{n}.json").exists()}
    Path(arguments.output).write_text(page(kept))


if __name__ == "__main__":
    main()
