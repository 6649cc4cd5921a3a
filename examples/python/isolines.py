"""Isolines of a distance field: straight pieces, exact arcs, the gradient across them, and a picture of it all."""

import os
import tempfile

import numpy as np
from shapes import torus

import brushfire as bf

mesh = bf.Mesh(*torus())
d = mesh.distance(0, method="exact")

lines = mesh.isolines(d, every=0.5)
closed = sum(line.line.closed for line in lines)
print(f"{len(lines)} curves at {len({line.level for line in lines})} levels, {closed} of them closed")

# The same levels on the exact field: arcs of circles, followed within the chord error.
arcs = mesh.curved_isolines(0, every=0.5, chord_error=1e-4)
straight, curved = (sum(line.line.length for line in found) for found in (lines, arcs))
print(f"total length {straight:.3f} in straight pieces, {curved:.3f} along the arcs")

slope = np.linalg.norm(mesh.gradient(d), axis=1)
print(f"the distance grows by {np.median(slope):.4f} per unit of length in the median face")

with tempfile.TemporaryDirectory() as folder:
    file = os.path.join(folder, "torus.png")
    image = mesh.render(d, paths=[arcs[0], mesh.path(0, 915)], dots=0, bands=True, isolines=[0.5, 1, 1.5], file=file)
    print(f"picture of {image.shape[1]} x {image.shape[0]} pixels, {os.path.getsize(file) // 1000} kB")
