"""Distance matrices of a set of meshes, and the geodesic error of a correspondence."""

import tempfile
from pathlib import Path

import numpy as np
from shapes import torus

import brushfire as bf

with tempfile.TemporaryDirectory() as folder:
    files = []
    for k in range(4):
        V, F = torus(24, 12, tube=0.5 + 0.1 * k)
        files.append(Path(folder) / f"pose{k}.ply")
        bf.Mesh(V, F).save(files[-1])
    matrices = bf.distance_matrices(files, out=Path(folder) / "matrices", normalise=True)
    for path in matrices:
        D = np.load(path, mmap_mode="r")
        print(f"{path.name}: {D.shape[0]} x {D.shape[1]} {D.dtype}, diameter {D.max():.3f} sqrt(area)")

# A correspondence that is off by one ring here and there: how far, as shape-matching papers report it.
mesh = bf.Mesh(*torus(24, 12))
truth = np.arange(mesh.vertex_count)
guess = np.where(np.random.default_rng(0).random(len(truth)) < 0.3, (truth + 12) % len(truth), truth)
error = mesh.pair_distances(np.column_stack([guess, truth]), method="exact", normalise=True)
print(f"mean geodesic error {error.mean():.4f}, {np.mean(error < 0.05):.0%} below 0.05")
