"""The drawings of the site: draw(folder). What they show is computed by the library or measured (docs/measured/)."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from svg import Chart, Drawing

import brushfire as bf

MEASURED = Path(__file__).parents[2] / "docs/measured"


def draw(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, figure in FIGURES.items():
        drawing, about = figure()
        drawing.save(folder / f"{name}.svg", about)


def floor(low: tuple[float, float], high: tuple[float, float]) -> tuple[bf.Mesh, np.ndarray]:
    """The rectangle [0, 3] x [0, 2] less the one from low to high, and its vertices' places."""
    n = 20  # cells to a unit
    x, y = np.meshgrid(np.arange(3 * n + 1) / n, np.arange(2 * n + 1) / n, indexing="ij")
    V = np.stack([x.ravel(), y.ravel()], axis=-1)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(3 * n), np.arange(2 * n), indexing="ij"))
    a, b, c, d = (
        i * (2 * n + 1) + j,
        (i + 1) * (2 * n + 1) + j,
        (i + 1) * (2 * n + 1) + j + 1,
        i * (2 * n + 1) + j + 1,
    )
    F = np.concatenate([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)])
    middle = V[F].mean(axis=1)
    inside = np.all((middle > low) & (middle < high), axis=1)
    return bf.Mesh(V, F[~inside]), V


def plan(low: tuple[float, float], high: tuple[float, float]) -> Drawing:
    drawing = Drawing((0, 0), (3, 2))
    drawing.line([(0, 0), (3, 0), (3, 2), (0, 2)], closed=True)
    drawing.area([low, (high[0], low[1]), high, (low[0], high[1])], "face")
    return drawing


def whole(path: bf.Path) -> np.ndarray:
    """Its points in the plane; those of a closed one end where they begin."""
    points = path.positions[:, :2]
    return np.concatenate([points, points[:1]]) if path.closed else points


def saddle_vertex() -> tuple[Drawing, str]:
    low, high = (1.2, 0.0), (1.4, 1.2)
    mesh, _ = floor(low, high)
    source = np.array([0.5, 0.5])
    drawing = plan(low, high)
    place = bf.at([*source, 0])
    drawing.area([(1.2, 1.2), (1.2 + 0.8, 2.0), (3, 2), (3, 0), (1.4, 0), (1.4, 1.2)], "coolfill")
    for line in mesh.curved_isolines(place, every=0.2, chord_error=1e-3):
        points = whole(line.line)
        behind = np.abs(line.level - np.hypot(*(points - source).T)) > 1e-6
        # A node where a line goes from light to shadow belongs to both pieces.
        cuts = np.flatnonzero(np.diff(behind)) + 1
        for piece in np.split(np.arange(len(points)), cuts):
            shown = range(max(piece[0] - 1, 0), piece[-1] + 1)
            drawing.line(points[shown], "cool" if behind[piece[-1]] else "thin", width=1.2)
    for target in ((2.0, 0.5), (2.6, 1.0), (2.7, 1.85)):
        path = mesh.path(place, bf.at([*target, 0]))
        drawing.line(path.positions[:, :2], "hot", width=2)
        drawing.dot(target, "dot", radius=3)
    drawing.dot(source)
    drawing.text(source, "source", anchor="middle", shift=(0, -18))
    drawing.dot((1.2, 1.2), "dot")
    drawing.text((1.2, 1.2), "pseudo-source", anchor="end", shift=(-6, 8))
    return drawing, "Shortest paths bend at a corner of a wall; behind it isolines are circles around the corner"


def cut_locus() -> tuple[Drawing, str]:
    low, high = (1.1, 0.6), (1.5, 1.5)
    mesh, V = floor(low, high)
    source = np.array([0.4, 1.0])
    place = bf.at([*source, 0])
    drawing = plan(low, high)
    for line in mesh.curved_isolines(place, every=0.2, chord_error=1e-3):
        drawing.line(whole(line.line), "thin", width=1)
    # Where the way around one side is as long as that around the other.
    middle = V[mesh.faces].mean(axis=1)
    over = mesh.walled(faces=np.flatnonzero((middle[:, 1] < low[1]) & (abs(middle[:, 0] - 1.3) < 0.1))).distance(
        place, method="exact"
    )
    under = mesh.walled(faces=np.flatnonzero((middle[:, 1] > high[1]) & (abs(middle[:, 0] - 1.3) < 0.1))).distance(
        place, method="exact"
    )
    behind = (V[:, 0] >= high[0]) & np.isfinite(over) & np.isfinite(under)
    difference = np.full(len(V), np.inf)
    difference[behind] = over[behind] - under[behind]
    for line in mesh.isolines(difference, levels=[0.0]):
        drawing.line(line.line.positions[:, :2], "cool", width=3)
        end = line.line.positions[np.argmax(line.line.positions[:, 0]), :2]
        on = line.line.positions[np.argmin(abs(line.line.positions[:, 0] - 2.6)), :2]
    drawing.text(end, "cut locus", anchor="end", shift=(-8, 10))
    for side in (2e-3, -2e-3):
        path = mesh.path(place, bf.at([on[0], on[1] + side, 0]))
        drawing.line(path.positions[:, :2], "hot", width=2)
    drawing.dot(source)
    drawing.text(source, "source", anchor="middle", shift=(0, -18))
    drawing.dot(on, "dot")
    return drawing, "Behind a hole lies a curve of points with two shortest paths"


def windows() -> tuple[Drawing, str]:
    """A strip of faces laid flat, and the light of one source through it."""
    drawing = Drawing((-0.1, -0.15), (3.3, 1.75))
    a, b, c, d, e = (np.array(p) for p in ((0, 0.8), (0.9, 0.1), (1.0, 1.5), (2.0, 0.05), (2.3, 1.65)))
    f = np.array((3.2, 0.95))
    for face in ((a, b, c), (b, d, c), (c, d, e), (d, f, e)):
        drawing.area(face, "face")

    def crossing(through: np.ndarray, p: np.ndarray, q: np.ndarray) -> np.ndarray:
        _s, t = np.linalg.solve(np.stack([through - a, p - q], axis=1), p - a)
        return p + t * (q - p)

    low, high = b + 0.32 * (c - b), b + 0.72 * (c - b)
    ends = [crossing(low, d, e), crossing(high, d, e)]
    drawing.area([a, ends[0], ends[1]], "lit")
    drawing.line([a, ends[0]], "hot", width=1)
    drawing.line([a, ends[1]], "hot", width=1)
    for p, q in ((b, c), (c, d), (d, e)):
        drawing.line([crossing(low, p, q), crossing(high, p, q)], "hot", width=5)
    drawing.dot(a)
    drawing.text(a, "source", anchor="middle", shift=(0, 12))
    drawing.text((low + high) / 2, "window", anchor="start", shift=(8, -4))
    drawing.text(crossing((low + high) / 2, c, d), "its child", anchor="start", shift=(12, -4))
    return drawing, "Faces laid flat: the light of a source passes edges in intervals, the windows"


def sphere_chord() -> tuple[Drawing, str]:
    drawing = Drawing((-1.15, -0.12), (1.15, 1.15), width=520)
    angle = np.linspace(0, np.pi, 181)
    drawing.line(np.stack([np.cos(angle), np.sin(angle)], axis=-1), "cool", width=2)
    nodes = np.linspace(0, np.pi, 6)
    chord = np.stack([np.cos(nodes), np.sin(nodes)], axis=-1)
    drawing.line(chord, "hot", width=2)
    for p in chord:
        drawing.dot(p, "dot", radius=3.5)
    drawing.text((0, 0.62), "edges: shorter than the arc", anchor="middle", size=13)
    drawing.text((0, 0.48), "by a share of (edge length)\u00b2", anchor="middle", size=13)
    return (
        drawing,
        "A polygon in a circle is shorter than the circle by a share that falls with the square of the edge length",
    )


def error_and_bound() -> tuple[Drawing, str]:
    rows = json.loads((MEASURED / "methods.json").read_text())["tolerances"]
    chart = Chart((2e-5, 2e-2), (1e-6, 3e-2), ("tolerance asked for", "relative error"))
    for key, kind, dashed in (("bound", "line", True), ("largest", "hot", False), ("mean", "cool", False)):
        points = [(row["tolerance"], row[key]) for row in rows if row[key] > 1e-7]
        chart.line(points, kind, width=2, dashed=dashed)
        chart.text(
            points[-1],
            {"bound": "proven bound", "largest": "largest error", "mean": "mean error"}[key],
            anchor="end",
            shift=(-12, 4),
        )
    return chart, "Errors and proven bounds of windows against the tolerance"


def smooth_orders() -> tuple[Drawing, str]:
    surfaces = json.loads((MEASURED / "smooth.json").read_text())["surfaces"]
    chart = Chart(
        (3e-3, 0.3), (2e-6, 0.4), ("mean edge length / size", "mean relative error against the smooth surface")
    )
    for surface in (surfaces["sphere"], surfaces["torus"]):
        for method, kind in (("exact", "hot"), ("novotni-klein", "cool"), ("dijkstra", "thin")):
            points = [(row["edge"], row["methods"][method]["mean"]) for row in surface["sizes"]]
            points = [p for p in points if p[1] > 2e-6]
            if len(points) > 1:
                chart.line(points, kind, width=2, dashed=surface["dashed"])
    first = surfaces["sphere"]["sizes"][-1]
    for method in ("exact", "novotni-klein", "dijkstra"):
        chart.text((first["edge"], first["methods"][method]["mean"]), method, anchor="end", shift=(-8, -4))
    return chart, "Errors against smooth surfaces fall with the edge length, by methods"


FIGURES = {
    "saddle-vertex": saddle_vertex,
    "cut-locus": cut_locus,
    "windows": windows,
    "sphere-chord": sphere_chord,
    "error-and-bound": error_and_bound,
    "smooth-orders": smooth_orders,
}
