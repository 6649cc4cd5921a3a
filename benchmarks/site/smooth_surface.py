"""How far distances on a mesh are from those on the smooth surface that it stands for; for docs/concepts/smooth.md:
build/venv/bin/python benchmarks/site/smooth_surface.py

Sphere and cone have formulas. On the torus every vertex is aimed at along the smooth geodesic: the mesh's own shortest
path gives direction and length to begin with, Newton's method on the geodesic's differential equation the rest.
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import numpy as np
from record import ROOT, errors, save

import brushfire as bf

PROGRAM = ROOT / "build/release/brushfire"
SIZES = (600, 2500, 10000, 40000, 160000)
METHODS = ("exact", "windows", "novotni-klein", "carried-source", "kimmel-sethian", "dijkstra")
STEPS = 200  # of the Runge-Kutta method along a geodesic: its error is below 1e-9
MAJOR, MINOR = 1.0, 0.4


def shape(name: str, vertices: int) -> bf.Mesh:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "mesh.ply"
        subprocess.run([PROGRAM, "shape", name, "-n", str(vertices), "-o", file, "--quiet"], check=True)
        return bf.read(file)


def on_sphere(mesh: bf.Mesh, source: int) -> np.ndarray:
    V = np.array(mesh.vertices)
    return np.arctan2(np.linalg.norm(np.cross(V, V[source]), axis=1), V @ V[source])


def on_cone(mesh: bf.Mesh, source: int) -> np.ndarray:
    """The side of a cone of radius 1 and height 1, unrolled: its full turn is 2 pi / sqrt(2)."""
    V = np.array(mesh.vertices)
    slant = np.sqrt(2.0)
    r = slant * np.hypot(V[:, 0], V[:, 1])
    turn = np.arctan2(V[:, 1], V[:, 0])
    apart = np.abs(turn - turn[source])
    angle = np.minimum(apart, 2 * np.pi - apart) / slant  # less than pi: every shortest path avoids the apex
    return np.sqrt(np.maximum(r**2 + r[source] ** 2 - 2 * r * r[source] * np.cos(angle), 0))


def on_torus(mesh: bf.Mesh, source: int) -> np.ndarray:
    """NaN where Newton's method finds no geodesic near the mesh's own path."""
    V = np.array(mesh.vertices)
    u, v = np.arctan2(V[:, 1], V[:, 0]), np.arctan2(V[:, 2], np.hypot(V[:, 0], V[:, 1]) - MAJOR)
    # In the tangent plane: along the parallel and along the meridian.
    east = np.array([-np.sin(u[source]), np.cos(u[source]), 0])
    polar = mesh.log_map(source, direction=east)
    angle, length = polar.angle * 2 * np.pi / polar.total_angle, polar.radius.copy()
    length[source], angle[source] = 1.0, 0.0

    def end_of(angle: np.ndarray, length: np.ndarray) -> np.ndarray:
        """(u, v) at the end of geodesics from the source."""
        state = np.stack(
            [
                np.full_like(angle, u[source]),
                np.full_like(angle, v[source]),
                np.cos(angle) / (MAJOR + MINOR * np.cos(v[source])),
                np.sin(angle) / MINOR,
            ]
        )

        def slope(s: np.ndarray) -> np.ndarray:
            r = MAJOR + MINOR * np.cos(s[1])
            return np.stack(
                [s[2], s[3], 2 * MINOR * np.sin(s[1]) / r * s[2] * s[3], -np.sin(s[1]) * r / MINOR * s[2] ** 2]
            )

        h = length / STEPS
        for _ in range(STEPS):
            k1 = slope(state)
            k2 = slope(state + h / 2 * k1)
            k3 = slope(state + h / 2 * k2)
            k4 = slope(state + h * k3)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return state[:2]

    def missed(angle: np.ndarray, length: np.ndarray) -> np.ndarray:
        off = end_of(angle, length) - np.stack([u, v])
        off = (off + np.pi) % (2 * np.pi) - np.pi
        return off * np.array([[MAJOR], [MINOR]])

    for _ in range(5):
        now = missed(angle, length)
        turned = (missed(angle + 1e-5, length) - now) / 1e-5
        longer = (missed(angle, length + 1e-5) - now) / 1e-5
        determinant = turned[0] * longer[1] - turned[1] * longer[0]
        with np.errstate(all="ignore"):
            angle = angle - np.clip((now[0] * longer[1] - now[1] * longer[0]) / determinant, -0.3, 0.3)
            length = length - np.clip((turned[0] * now[1] - turned[1] * now[0]) / determinant, -0.3, 0.3)
    found = np.hypot(*missed(angle, length)) < 1e-8
    # Another geodesic than the mesh's path is not the one that is looked for.
    found &= np.abs(length - polar.radius) < 0.1 * polar.radius
    length[source] = 0
    return np.where(found, length, np.nan)


SURFACES = {"sphere": ("sphere", on_sphere), "cone": ("cone", on_cone), "torus": ("torus", on_torus)}


def order(edges: list[float], values: list[float]) -> float:
    """The exponent p of values ~ edges^p, by least squares."""
    return float(np.polyfit(np.log(edges), np.log(values), 1)[0])


def main() -> None:
    measured = {}
    for name, (make, truth_on) in SURFACES.items():
        rows = []
        for size in SIZES if name != "torus" else SIZES[:-1]:
            mesh = shape(make, size)
            source = mesh.vertex_count // 3
            truth = truth_on(mesh, source)
            methods = {m: errors(mesh.distance(source, method=m, precision="float64"), truth) for m in METHODS}
            edge = mesh.report.mean_edge_length
            rows.append(
                {
                    "vertices": mesh.vertex_count,
                    "edge": edge,
                    "compared": float(np.isfinite(truth).mean()),
                    "methods": methods,
                }
            )
        edges = [row["edge"] for row in rows]
        orders = {
            m: {k: order(edges, [row["methods"][m][k] for row in rows]) for k in ("mean", "largest")} for m in METHODS
        }
        measured[name] = {"dashed": name == "torus", "orders": orders, "sizes": rows}
        print(name, {m: round(o["mean"], 2) for m, o in orders.items()}, [round(r["compared"], 3) for r in rows])
    save("smooth", "build/venv/bin/python benchmarks/site/smooth_surface.py", {"surfaces": measured})


if __name__ == "__main__":
    main()
