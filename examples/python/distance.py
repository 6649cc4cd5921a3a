"""Distances from one vertex, from several, from a point in space; early stop; which source is nearest."""

from shapes import torus

import brushfire as bf

mesh = bf.Mesh(*torus())
print(mesh, "|", mesh.report)

d = mesh.distance(0, method="exact")
print(f"farthest from vertex 0: vertex {d.argmax()} at {d.max():.4f}")

d, source = mesh.distance([0, 900], offset=[0.0, 0.5], method="exact", return_source=True)
print(f"vertex 0 is nearest for {(source == 0).sum()} vertices, vertex 900 (starting at 0.5) for {(source == 1).sum()}")

d = mesh.distance(bf.at([3.0, 0.1, 0.2]), radius=1.0, method="exact")
print(f"{(d <= 1).sum()} vertices lie within 1.0 of that position's nearest surface point")

a, b = mesh.distance(0, targets=[900, bf.Point(17, (0.2, 0.3, 0.5))], method="exact")
print(f"two targets: {a:.4f} and {b:.4f}")

for method in bf.methods():
    error = mesh.distance(0, method=method) - mesh.distance(0, method="exact")
    print(f"{method:20s} largest error {abs(error).max():.4f}")
