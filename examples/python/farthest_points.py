"""Farthest-point sampling with a loop over distances: each new point is the one that is farthest from all so far."""

import numpy as np
from shapes import torus

import brushfire as bf

mesh = bf.Mesh(*torus())
solver = mesh.solver()
points = [0]
nearest = solver.distance(0)
while len(points) < 20:
    points.append(int(nearest.argmax()))
    # Nothing farther than the present maximum can change: the run stops there.
    nearest = np.minimum(nearest, solver.distance(points[-1], radius=nearest.max()))
print("sample:", points)
print(f"every vertex lies within {nearest.max():.3f} of a sample")

# The library has this as one call, which also says how far apart the samples are.
samples = mesh.farthest_points(20)
print(f"farthest_points() takes {samples.vertices[:4].tolist()} ..., covering radius {samples.covering_radius:.3f}")
