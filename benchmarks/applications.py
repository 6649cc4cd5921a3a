"""Figures and numbers of docs/applications.md: python benchmarks/applications.py SCAN.ply [--figures FOLDER]

SCAN is any mesh of some ten thousand vertices; the figures in the documentation show the Stanford bunny.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

import brushfire as bf

EXAMPLES = Path(__file__).parents[1] / "examples" / "python"
sys.path.insert(0, str(EXAMPLES))
LOOK = {"width": 420, "height": 420, "bar": False}


def disc(mesh, place, radius):
    """The part of a surface within a radius of a vertex."""
    near = mesh.distance(place, radius=radius) < radius
    faces = mesh.faces[near[mesh.faces].all(axis=1)]
    used, faces = np.unique(faces, return_inverse=True)
    return bf.Mesh(mesh.vertices[used], faces.reshape(-1, 3))


def grid_lines(mesh, uv, every):
    return [line for k in (0, 1) for line in mesh.isolines(uv[:, k] - uv[:, k].min(), every=every)]


def draw_flattening(scan, folder):
    size = np.linalg.norm(np.ptp(scan.vertices, axis=0))
    part = disc(scan, int(np.argmax(scan.vertices[:, 2])), size / 5)
    flat, by_heat = bf.flatten(part, 150), bf.flatten(part, 150, method="heat")
    plane = bf.Mesh(flat.uv, flat.mesh.faces)
    every = np.ptp(flat.uv, axis=0).max() / 16
    d = flat.mesh.distance(int(flat.landmarks[0]))
    panels = [
        plane.panel(d, paths=grid_lines(plane, flat.uv, every), title="laid flat; colours: a distance"),
        flat.mesh.panel(d, paths=grid_lines(flat.mesh, flat.uv, every), title="the squares on the scan"),
        flat.mesh.panel(d, paths=grid_lines(flat.mesh, by_heat.uv, every), title="the same by heat's distances"),
    ]
    bf.render(panels, file=folder / "flattening.png", **LOOK)
    matrix = flat.mesh.distance_matrix(flat.landmarks, method="exact", dtype=np.float64)
    for name, found in (("windows", flat), ("heat", by_heat)):
        print(
            f"flattening.png: {part}, distances by {name}: stress against exact ones "
            f"{stress(found.uv, flat.landmarks, matrix):.4f}; {bf.distortion(flat.mesh, found.uv)}"
        )


def stress(uv, landmarks, matrix):
    apart = np.linalg.norm(uv[landmarks][:, None] - uv[None], axis=2)
    return np.sqrt(((apart - matrix) ** 2).sum() / (matrix**2).sum())


def draw_reeb(folder):
    from shape_search import collection

    panels = []
    for name in ("caterpillar, pose 2", "peanut, pose 1", "ring"):
        graph = bf.reeb_graph(collection[name], 3)
        panels.append(collection[name].panel(labels=graph.node % 12, title=f"{name}: {len(graph.interval)} nodes"))
    bf.render(panels, file=folder / "reeb.png", **LOOK)


def draw_gradient(scan, folder):
    field = scan.distance_vjp(0)
    pull = np.linalg.norm(field.vjp(np.ones(scan.vertex_count)).vertices, axis=1)
    panels = [
        scan.panel(field.distance / field.distance.max(), isolines=np.linspace(0, 1, 25), title="distances"),
        scan.panel(np.log10(pull + 1) / np.log10(pull.max() + 1), title="their sum, by vertex (log of the rate)"),
    ]
    bf.render(panels, file=folder / "gradient.png", **LOOK)


def best(function, rounds=5):
    """CPU seconds: what other programs take on the machine does not count."""
    times = []
    for _ in range(rounds):
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def measure_gradient(scan):
    forward = best(lambda: scan.distance(0, method="exact"))
    kept = scan.distance_vjp(0)
    backward = best(lambda: kept.vjp(np.ones(scan.vertex_count)))
    whole = best(lambda: scan.distance_vjp(0).vjp(np.ones(scan.vertex_count)))
    print(
        f"derivatives, {scan}: forward {1e3 * forward:.0f} ms, backward {1e3 * backward:.0f} ms "
        f"({backward / forward:.1f} times), both {1e3 * whole:.0f} ms"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scan", type=Path)
    parser.add_argument("--figures", type=Path)
    given = parser.parse_args()
    scan = bf.read(given.scan)
    measure_gradient(scan)
    if given.figures:
        draw_flattening(scan, given.figures)
        draw_gradient(scan, given.figures)
        draw_reeb(given.figures)
