"""One base mesh traced on two surfaces, and a morph through it."""

import numpy as np

import brushfire as bf


def ball(shape, n=12):
    """The sides of a cube, n x n squares each, pushed onto a star-shaped surface."""
    u, v = (
        a.ravel()
        for a in np.meshgrid(
            np.tan(np.linspace(-1, 1, n + 1) * np.pi / 4), np.tan(np.linspace(-1, 1, n + 1) * np.pi / 4)
        )
    )
    one = np.ones_like(u)
    sides = [
        np.column_stack(c) for c in ((one, u, v), (-one, v, u), (v, one, u), (u, -one, v), (u, v, one), (v, u, -one))
    ]
    points, index = np.unique(np.round(np.concatenate(sides), 12), axis=0, return_inverse=True)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = [index.ravel()[s * (n + 1) ** 2 + np.column_stack([a, a + 1, a + n + 2, a + n + 1])] for s in range(6)]
    q = np.concatenate(quads)
    direction = points / np.linalg.norm(points, axis=1)[:, None]
    return bf.Mesh(direction * shape(direction)[:, None], np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]]]))


pear = ball(lambda d: 1 + 0.35 * d[:, 2] + 0.1 * d[:, 0] ** 2)
star = ball(lambda d: 0.8 + 0.6 * np.abs(d).max(axis=1) ** 6)

# An octahedron over the six ends of the axes.
ends = np.concatenate([np.eye(3), -np.eye(3)])
base = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]]
found = [bf.patches(mesh, [int(np.argmax(mesh.vertices @ e)) for e in ends], base) for mesh in (pear, star)]
for patches in found:
    area = [patches.mesh.cut(faces=np.flatnonzero(patches.patch != k)).mesh.area for k in range(8)]
    print(f"{patches}: areas {min(area):.2f} to {max(area):.2f}, {len(patches.touching)} paths without room")

(V0, F), (V1, same) = (patches.resample(12) for patches in found)
print(f"one connectivity for both: {bool((F == same).all())}, {len(V0)} vertices")
for share in (0, 0.25, 0.5, 0.75, 1):
    mesh = bf.Mesh((1 - share) * V0 + share * V1, F)
    print(f"{share:4.0%} of the way: area {mesh.area:.2f}")
