"""A surface laid flat for a texture, its distortion, and an image stuck to it at one place."""

import tempfile
from pathlib import Path

import numpy as np
from shapes import torus

import brushfire as bf

mesh = bf.Mesh(*torus(40, 20))
flat = bf.flatten(mesh, landmarks=80)
d = flat.distortion
print(f"a torus, cut open: {mesh.vertex_count} vertices become {flat.mesh.vertex_count}")
print(f"stress {d.stress:.3f}, lengths times {d.min_stretch:.2f} to {d.max_stretch:.2f}, {d.flipped} faces turned over")

# A quarter of its outer side unrolls much better.
V, F = torus(40, 20)
part = (V[F, 0].min(axis=1) > 1.5) & (np.hypot(V[F, 0], V[F, 1]).min(axis=1) > 1.9)
used, faces = np.unique(F[part], return_inverse=True)
quarter = bf.Mesh(V[used], faces.reshape(-1, 3))
flat = bf.flatten(quarter, landmarks=60)
print(f"a part of its outside: stress {flat.distortion.stress:.4f}, {flat.distortion.flipped} faces turned over")

with tempfile.TemporaryDirectory() as folder:
    for name in ("uv.obj", "uv.glb"):
        flat.save(Path(folder) / name)
        print(f"{name}: {(Path(folder) / name).stat().st_size} bytes, {bf.read(Path(folder) / name)}")

# An image 1 x 0.5 around a vertex, its right-hand side towards +y.
place = int(np.argmax(quarter.vertices[:, 0]))
faces, uv = bf.decal(quarter, place, [0, 1, 0], 1.0, 0.5)
print(f"the decal touches {len(faces)} faces; its middle {uv[place].round(3).tolist()}")
