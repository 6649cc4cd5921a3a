#!/usr/bin/env python3
"""Paths and loops pulled straight, beside the edge flips of potpourri3d (geometry-central): lengths, ends, time.

    build/venv/bin/python benchmarks/shortening.py [--runs N] MESH ...

Both start from the same ways along edges, through the same random vertices; they take turns, and what is timed is the
processor's time in this process. Loops that can be pulled together end in a point here; there they go on for ever, which
is why a limit is set, and are left out of the lengths.
"""

import argparse
import time

import numpy as np
import potpourri3d

import brushfire as bf
import brushfire.compat.potpourri3d as ours

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


def measure(name: str, runs: int, seed: int) -> bool:
    mesh = bf.read(name)
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    random = np.random.default_rng(seed)
    here, there = ours.EdgeFlipGeodesicSolver(vertices, faces), potpourri3d.EdgeFlipGeodesicSolver(vertices, faces)
    counts = dict.fromkeys(("shorter", "same", "longer", "failed here", "failed there", "to a point"), 0)
    spent, ratios = np.zeros(2), []
    for run in range(runs):
        stops = [int(v) for v in random.choice(len(vertices), 2 + run % 4, replace=False)]
        if run % 2:
            a, t = timed(here.find_geodesic_path_poly, stops), timed(there.find_geodesic_path_poly, stops)
        else:
            stops += [] if len(stops) > 2 else [int(v) for v in random.choice(len(vertices), 1)]
            if len(set(stops)) < 3:
                continue
            a, t = timed(here.find_geodesic_loop, stops), timed(there.find_geodesic_loop, stops, LIMIT)
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
