#!/usr/bin/env python3
"""The heat method beside potpourri3d's (geometry-central): set-up, one field, several at a time; and how far apart both are.

    build/venv/bin/python benchmarks/heat_peers.py MESH ...

Both take turns, and the processor's time in this process is what counts: least of so many rounds, and the middle of the
rounds' quotients. The matrices differ in one thing, which is put right for the comparison of values: theirs have 1e-6
added to their diagonal (of two sheets), ours hold a vertex.
"""

import statistics
import sys
import time

import numpy as np
import potpourri3d

import brushfire as bf

ROUNDS = 5
AT_ONCE = 8


def timed(call):
    begin = time.process_time()
    result = call()
    return result, time.process_time() - begin


def turns(ours, theirs):
    """Milliseconds of both, and theirs in units of ours."""
    pairs = [(timed(ours)[1], timed(theirs)[1]) for _ in range(ROUNDS)]
    a, b = (1e3 * min(column) for column in zip(*pairs, strict=True))
    return a, b, statistics.median(y / x for x, y in pairs)


def row(name: str) -> str:
    mesh = bf.read(name)
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    here, there = bf.HeatSolver(mesh), potpourri3d.MeshHeatMethodDistanceSolver(vertices, faces)
    sources = np.linspace(0, len(vertices) - 1, AT_ONCE).astype(int).tolist()
    setup = turns(
        lambda: bf.HeatSolver(bf.Mesh(vertices, faces)),
        lambda: potpourri3d.MeshHeatMethodDistanceSolver(vertices, faces),
    )
    one = turns(lambda: here.distance(sources[0]), lambda: there.compute_distance(sources[0]))
    several = turns(lambda: here.distances(sources), lambda: [there.compute_distance(v) for v in sources])
    same = bf.HeatSolver(mesh, time=here.time, poisson_shift=0.5e-6).distance(sources[3])
    d = there.compute_distance(sources[3])
    apart = np.abs(same - d).max() / d.max()
    text = [f"{a:.3g}, {b:.3g}, {ratio:.2f}" for a, b, ratio in (setup, one, tuple(x / AT_ONCE for x in several[:2]) + several[2:])]
    return f"| {name.rsplit('/', 1)[-1]} | {len(vertices)} | {' | '.join(text)} | {apart:.1e} |"


def main() -> None:
    print("Milliseconds: ours, theirs, theirs by ours.\n")
    print("| mesh | vertices | set-up | one field | of eight, each | apart |\n|---|---|---|---|---|---|")
    for name in sys.argv[1:]:
        print(row(name), flush=True)


if __name__ == "__main__":
    main()
