"""The shortest path between two vertices, and the geodesic that leaves a point in a direction."""

import numpy as np
from shapes import torus

import brushfire as bf

mesh = bf.Mesh(*torus())
path = mesh.path(0, 915)
print(f"length {path.length:.6f}, {len(path.positions)} points")
steps = np.linalg.norm(np.diff(path.positions, axis=0), axis=1)
print(f"sum of its pieces {steps.sum():.6f}, distance field {mesh.distance(0, method='exact')[915]:.6f}")

walk, end = mesh.trace(0, [0, 1, 0.5], 10.0)
print(f"ten units straight on end ({end}) at {walk.positions[-1].round(3).tolist()}")

loose, tight = mesh.path(0, 400, 915), mesh.path(0, 400, 915, tighten=True)
print(f"by way of vertex 400 it is {loose.length:.4f}, pulled straight {tight.length:.4f}")
