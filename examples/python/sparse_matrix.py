"""All distances up to a radius, as a scipy matrix; all pairs, as a numpy array and as a file."""

import os
import tempfile

import numpy as np
from shapes import torus

import brushfire as bf

mesh = bf.Mesh(*torus())

near = mesh.distances_within(0.5, method="exact")
print(f"{near.shape[0]} rows, {near.nnz / near.shape[0]:.1f} vertices within 0.5 on average")
kernel = near.copy()
kernel.data = np.exp(-((kernel.data / 0.2) ** 2))  # a smoothing kernel by geodesic distance
smooth = kernel @ mesh.vertices / kernel.sum(axis=1)
print(f"smoothing moves vertices by {np.linalg.norm(smooth - mesh.vertices, axis=1).mean():.4f} on average")

landmarks = np.arange(0, mesh.vertex_count, 100)
D = mesh.distance_matrix(landmarks, landmarks, method="exact", dtype=np.float64)
print(f"{D.shape} between landmarks; symmetric to {abs(D - D.T).max():.1e}")

with tempfile.TemporaryDirectory() as folder:
    file = os.path.join(folder, "all.npy")
    mesh.write_distance_matrix(file)  # row by row; called again after an interruption it goes on
    print(f"all pairs on disk: {np.load(file, mmap_mode='r').shape}, {os.path.getsize(file) / 1e6:.0f} MB")
