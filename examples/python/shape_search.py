"""Shapes found by their Reeb graphs: poses of one kind are more alike than kinds."""

import numpy as np
from shapes import torus

import brushfire as bf


def tube(wobble, knobs, n=40, sides=14):
    """A closed tube around the z axis with bulges, bent by `wobble`."""
    t = np.linspace(0, 1, n + 1)[1:-1]
    radius = 0.35 * np.sqrt(np.sin(np.pi * t)) * (1 + 0.6 * np.sin(knobs * np.pi * t) ** 2)
    angle = 2 * np.pi * np.arange(sides) / sides
    middle = np.column_stack([wobble * np.sin(3 * t), 0.5 * wobble * np.cos(4 * t), 3 * t])
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    V = [
        middle[0] - [0, 0, 0.1],
        *(middle[:, None] + radius[:, None, None] * ring).reshape(-1, 3),
        middle[-1] + [0, 0, 0.1],
    ]
    k = np.arange(sides)
    F = [[0, 1 + (i + 1) % sides, 1 + i] for i in k]
    for r in range(n - 2):
        a, b = 1 + r * sides + k, 1 + r * sides + (k + 1) % sides
        F += np.concatenate([np.column_stack([a, b, b + sides]), np.column_stack([a, b + sides, a + sides])]).tolist()
    top = 1 + (n - 1) * sides
    F += [[top, top - sides + i, top - sides + (i + 1) % sides] for i in k]
    return bf.Mesh(np.array(V), F)


collection = {
    f"{name}, pose {i}": tube(w, k)
    for name, k in (("caterpillar", 4), ("peanut", 2))
    for i, w in enumerate((0, 0.3, 0.6))
}
collection["ring"] = bf.Mesh(*torus(40, 20))
graphs = {name: bf.reeb_graph(mesh, 5, samples=80) for name, mesh in collection.items()}
for name, graph in graphs.items():
    ranked = sorted(((graph.similarity(g), other) for other, g in graphs.items() if other != name), reverse=True)
    near = "; ".join(f"{other} ({s:.2f})" for s, other in ranked[:2])
    print(f"{name}: {graph.loops} loop(s); nearest {near}")
