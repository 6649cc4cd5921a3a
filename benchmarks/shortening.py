#!/usr/bin/env python3
"""Paths and loops pulled straight, beside the edge flips of potpourri3d (geometry-central): lengths, ends, time.

    build/venv/bin/python benchmarks/shortening.py [--runs N] MESH ...

Both start from the same ways along edges, through the same random vertices; they take turns, and what is timed is the
processor's time in this process. Loops that can be pulled together end in a point here; there they go on for ever, which
is why a limit is set, and are left out of the lengths.

Of every one that ends longer here: whether both go the same way around the handles (homology.py), and whether theirs is
another locally shortest curve, which pulling it straight leaves as long as it is. Both are then right answers: a class has
many, and which one is reached depends on the order in which corners are pulled.
"""

import argparse
import time
from types import SimpleNamespace

import numpy as np
import potpourri3d

import brushfire as bf
import brushfire.compat.potpourri3d as ours
from homology import Homology

SAME = 1e-9  # relative; what rounding makes of two sums of a thousand lengths
LIMIT = 20_000  # flips of theirs


def length(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def timed(call, *arguments):
    begin = time.process_time()
    try:
        points = np.asarray(call(*arguments))
    except (RuntimeError, ValueError):
        points = None
    return points, time.process_time() - begin


def on_surface(mesh: bf.Mesh, positions: np.ndarray, closed: bool):
    """Their curve as points of faces: each lies on an edge or is a vertex."""
    points, _ = mesh.nearest(positions[:-1] if closed else positions)
    weights = np.array(points.weights)
    weights[weights < SAME] = 0
    return SimpleNamespace(points=bf.Points(points.face, weights / weights.sum(axis=1, keepdims=True)), closed=closed)


def explained(mesh: bf.Mesh, homology: Homology | None, here: np.ndarray, there: np.ndarray, closed: bool) -> str:
    mine, theirs = on_surface(mesh, here, closed), on_surface(mesh, there, closed)
    same = "of a surface that is not closed"
    if homology is not None:
        equal = np.allclose(homology.numbers(mine), homology.numbers(theirs), atol=1e-6)
        same = "the same way around the handles" if equal else "another way around the handles"
    left = mesh.shorten(theirs.points, closed=closed).length / length(there) - 1
    return f"{same}; theirs is {'locally shortest, too' if abs(left) <= SAME else f'not locally shortest: {left:.1e}'}"


def measure(name: str, runs: int, seed: int) -> bool:
    mesh = bf.read(name)
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    random = np.random.default_rng(seed)
    here, there = ours.EdgeFlipGeodesicSolver(vertices, faces), potpourri3d.EdgeFlipGeodesicSolver(vertices, faces)
    counts = dict.fromkeys(("shorter", "same", "longer", "failed here", "failed there", "to a point"), 0)
    spent, ratios = np.zeros(2), []
    try:
        homology = Homology(mesh)
    except ValueError:
        homology = None
    for run in range(runs):
        stops = [int(v) for v in random.choice(len(vertices), 2 + run % 4, replace=False)]
        if loop := run % 2 == 0:
            stops += [] if len(stops) > 2 else [int(v) for v in random.choice(len(vertices), 1)]
            if len(set(stops)) < 3:
                continue
            a, t = timed(here.find_geodesic_loop, stops), timed(there.find_geodesic_loop, stops, LIMIT)
        else:
            a, t = timed(here.find_geodesic_path_poly, stops), timed(there.find_geodesic_path_poly, stops)
        if a[0] is None or t[0] is None:
            counts["failed here" if a[0] is None else "failed there"] += 1
            continue
        if length(a[0]) == 0:
            counts["to a point"] += 1
            continue
        spent += a[1], t[1]
        la, lt = length(a[0]), length(t[0])
        ratios.append(la / lt)
        counts["same" if abs(la - lt) <= SAME * lt else "shorter" if la < lt else "longer"] += 1
        if la > lt * (1 + SAME):
            print(f"  run {run}, {stops}: {la / lt - 1:.1e} longer, {explained(mesh, homology, a[0], t[0], loop)}")
    together = ", ".join(f"{counts[key]} {key}" for key in counts)
    print(
        f"{name}, seed {seed}, {runs} runs: {together}; lengths by theirs: mean {np.mean(ratios):.6f}, most "
        f"{max(ratios):.6f}; {1e3 * spent[0] / len(ratios):.2f} ms each, theirs {1e3 * spent[1] / len(ratios):.2f} ms",
        flush=True,
    )
    return counts["failed here"] == 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--runs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    return 0 if all([measure(name, arguments.runs, arguments.seed) for name in arguments.meshes]) else 1


if __name__ == "__main__":
    raise SystemExit(main())
