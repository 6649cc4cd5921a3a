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


def picture(u, v):
    """What is stuck on: 0 beyond it, 1 its frame, 2 and 3 a board, 4 an arrow up."""
    x, y = 2 * u - 1, 2 * v - 1
    board = 2 + (np.floor(4 * x) + np.floor(4 * y)).astype(int) % 2
    arrow = ((np.abs(x) < 0.12) & (np.abs(y) < 0.6)) | ((y > 0.15) & (np.abs(x) < 0.75 - y))
    inside = np.where(arrow, 4, np.where(np.maximum(np.abs(x), np.abs(y)) > 0.9, 1, board))
    return np.where((np.abs(x) <= 1) & (np.abs(y) <= 1), inside, 0)


def painted(mesh, faces, uv, pieces):
    """The surface, with the faces that the picture touches cut into pieces^2, and the picture's numbers for vertices."""
    whole = np.delete(mesh.faces, faces, axis=0)
    steps = [(i, j) for i in range(pieces) for j in range(pieces - i)]
    small = [[(i, j), (i + 1, j), (i, j + 1)] for i, j in steps]
    small += [[(i + 1, j), (i + 1, j + 1), (i, j + 1)] for i, j in steps if i + j < pieces - 1]
    weights = np.array([[(pieces - i - j, i, j) for i, j in corners] for corners in small]) / pieces
    cut = mesh.faces[faces]
    points = np.einsum("tkc,fcx->ftkx", weights, mesh.vertices[cut]).reshape(-1, 3)
    middle = np.einsum("tc,fcx->ftx", weights.mean(axis=1), uv[cut]).reshape(-1, 2)
    added = mesh.vertex_count + np.arange(len(points)).reshape(-1, 3)
    labels = np.concatenate([np.zeros(mesh.vertex_count, int), np.repeat(picture(*middle.T), 3)])
    return bf.Mesh(np.concatenate([mesh.vertices, points]), np.concatenate([whole, added])), labels


def draw_decal(scan, folder):
    size = np.linalg.norm(np.ptp(scan.vertices, axis=0))
    flat = bf.Mesh([[x, y, 0] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [[0, 1, 2], [0, 2, 3]])
    sheet, numbers = painted(flat, np.arange(2), (flat.vertices[:, :2] + 1) / 2, 120)
    low, high = scan.vertices.min(axis=0), scan.vertices.max(axis=0)
    flank = low + (high - low) * [0.72, 0.36, 1]
    place = int(np.argmin(np.linalg.norm(scan.vertices - flank, axis=1)))
    panels = [sheet.panel(labels=numbers, title="the picture")]
    for title, right in (("stuck on, upright", [1, 0, 0]), ("the same, turned by 45 degrees", [1, -1, 0])):
        faces, uv = bf.decal(scan, place, right, size / 4)
        mesh, numbers = painted(scan, faces, uv, 6)
        panels.append(mesh.panel(labels=numbers, title=title))
        print(f"decal.png: {title}: {len(faces)} faces, {bf.distortion(*part_of(scan, faces, uv * size / 4))}")
    bf.render(panels, file=folder / "decal.png", **LOOK)


def part_of(mesh, faces, uv):
    used, corners = np.unique(mesh.faces[faces], return_inverse=True)
    return bf.Mesh(mesh.vertices[used], corners.reshape(-1, 3)), uv[used]


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
        draw_decal(scan, given.figures)
        draw_gradient(scan, given.figures)
        draw_reeb(given.figures)
