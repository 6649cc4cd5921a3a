"""Errors and times of every method, for docs/which-method.md: build/venv/bin/python benchmarks/site/methods.py

One source (vertex 0), all vertices, one thread, processor time, against `exact`. On the Stanford bunny, where
`./run demo` has fetched it (demo/bunny.off), and on a folded sphere that every machine can make.
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import numpy as np
from record import ROOT, errors, processor_time, save

import brushfire as bf

PROGRAM = ROOT / "build/release/brushfire"
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5)


def meshes() -> dict[str, bf.Mesh]:
    found = {}
    bunny = ROOT / "demo/bunny.off"
    if bunny.exists():
        found["bunny"] = bf.read(bunny)
    else:
        print("(no demo/bunny.off: ./run demo fetches it)")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "folded.ply"
        subprocess.run([PROGRAM, "shape", "folded-sphere", "-n", "160000", "-o", file, "--quiet"], check=True)
        found["folded-sphere"] = bf.read(file)
    return found


def first_field(mesh: bf.Mesh, method: str) -> float:
    """From arrays to the first field: what is called once pays for the set-up, too."""
    V, F = np.array(mesh.vertices), np.array(mesh.faces)
    return processor_time(lambda: bf.Mesh(V, F).distance(0, method=method), rounds=3)


def of_methods(mesh: bf.Mesh, truth: np.ndarray) -> dict[str, dict[str, float]]:
    rows = {}
    for method in bf.methods():
        solver = mesh.solver(method)
        values = solver.distance(0)
        solve = processor_time(lambda solver=solver: solver.distance(0))
        rows[method] = {
            "solve": solve,
            "solve_per_vertex": solve / mesh.vertex_count,
            "first": first_field(mesh, method),
            **errors(values, truth),
        }
    return rows


def of_tolerances(mesh: bf.Mesh, truth: np.ndarray) -> list[dict[str, float]]:
    rows = []
    for tolerance in TOLERANCES:
        solver = mesh.solver("windows", tolerance=tolerance)
        values, bound = solver.distance(0, return_bound=True)
        proven = np.nanmax(bound[truth > 0] / truth[truth > 0])
        solve = processor_time(lambda solver=solver: solver.distance(0), rounds=3)
        rows.append({"tolerance": tolerance, "bound": float(proven), "solve": solve, **errors(values, truth)})
    return rows


def of_queries(mesh: bf.Mesh) -> dict[str, float]:
    """What is asked most beside a field."""
    far = int(mesh.distance(0).argmax())
    mesh.path(0, far)
    d = mesh.distance(0, method="exact")
    radius = float(d.max()) / 20
    near = mesh.distances_within(radius, np.arange(200))
    return {
        "path": processor_time(lambda: mesh.path(0, far)),
        "isolines": processor_time(lambda: mesh.isolines(d, every=float(d.max()) / 20)),
        "row_within": processor_time(lambda: mesh.distances_within(radius, np.arange(200))) / 200,
        "row_entries": near.nnz / 200,
    }


def saddle_share(mesh: bf.Mesh) -> float:
    """Of all vertices, those whose angles add up to more than 360 degrees."""
    V, F = np.array(mesh.vertices), np.array(mesh.faces)
    total = np.zeros(len(V))
    for k in range(3):
        a, b = V[F[:, (k + 1) % 3]] - V[F[:, k]], V[F[:, (k + 2) % 3]] - V[F[:, k]]
        angle = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1))
        np.add.at(total, F[:, k], angle)
    return float((total > 2 * np.pi + 1e-9).mean())


def main() -> None:
    measured: dict[str, dict] = {"meshes": {}}
    for name, mesh in meshes().items():
        truth = mesh.distance(0, method="exact")
        measured["meshes"][name] = {
            "vertices": mesh.vertex_count,
            "saddles": saddle_share(mesh),
            "methods": of_methods(mesh, truth),
            "queries": of_queries(mesh),
        }
        if name == "folded-sphere":
            measured["tolerances"] = of_tolerances(mesh, truth)
    save("methods", "build/venv/bin/python benchmarks/site/methods.py", measured)


if __name__ == "__main__":
    main()
