"""The meshes of the comparisons: out of Debian's package of CGAL's demonstrations, or made here. Nothing else is needed.

A name is that of a mesh in the package (bunny: the Stanford bunny), of a made one (grid100, folded-sphere), with -x10 for
stretched tenfold in x, and -shear for sheared until an angle of 135 degrees is in every triangle.
"""

import tarfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
ARCHIVES = (ROOT / "demo/data.tar.gz", Path("/usr/share/doc/libcgal-dev/data.tar.gz"),
            Path("/usr/share/doc/libcgal-demo/data.tar.gz"))  # fmt: skip
IN_PACKAGE = {"bunny": "bunny00"}


def read_off(text):
    words = [word for line in text.splitlines() for word in line.split("#")[0].split()]
    assert words[0] == "OFF"
    count, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    vertices = np.array(numbers[: 3 * count], float).reshape(-1, 3)
    rest = np.array(numbers[3 * count : 3 * count + 4 * faces], int).reshape(-1, 4)
    assert (rest[:, 0] == 3).all(), "triangles only"
    return vertices, rest[:, 1:]


def write_off(file, vertices, faces):
    lines = [f"OFF\n{len(vertices)} {len(faces)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces.tolist()]
    file.write_text("\n".join(lines) + "\n")


def grid(cells):
    """The unit square, each cell cut along the same diagonal."""
    x, y = np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1))
    vertices = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    a, b, c, d = corner, corner + 1, corner + cells + 2, corner + cells + 1
    return vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def sphere(rounds):
    """An icosahedron, split, on the unit sphere, folded like a cortex."""
    g = (1 + 5**0.5) / 2
    v = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
                  [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]], float)  # fmt: skip
    f = np.array([[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
                  [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10],
                  [8, 6, 7], [9, 8, 1]])  # fmt: skip
    for _ in range(rounds):
        edges = np.sort(np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]), axis=1)
        unique, place = np.unique(edges, axis=0, return_inverse=True)
        middle = place.reshape(3, -1).T + len(v)
        v = np.concatenate([v, v[unique].mean(axis=1)])
        (a, b, c), (ab, bc, ca) = f.T, middle.T
        f = np.concatenate([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    v /= np.linalg.norm(v, axis=1)[:, None]
    x, y, z = 9 * v.T
    return v * (1 + 0.12 * np.sin(x) * np.sin(y + 1) * np.sin(z + 2))[:, None], f


def arrays(name):
    """Vertices and faces, or None where the package is not at hand."""
    if name.endswith("-x10"):
        found = arrays(name.removesuffix("-x10"))
        return found and (found[0] * [10, 1, 1], found[1])
    if name == "grid100-shear":
        vertices, faces = grid(100)
        return vertices @ np.array([[1, 0, 0], [1, 1, 0], [0, 0, 1.0]]), faces
    if name == "grid100":
        return grid(100)
    if name == "folded-sphere":
        return sphere(6)
    for archive in ARCHIVES:
        if archive.exists():
            with tarfile.open(archive) as opened:
                member = f"data/meshes/{IN_PACKAGE.get(name, name)}.off"
                if member in opened.getnames():
                    return read_off(opened.extractfile(member).read().decode())
    return None


def find(name, folder):
    """The mesh as a file in that folder, or None."""
    found = arrays(name)
    if found is None:
        return None
    file = Path(folder) / f"{name}.off"
    write_off(file, *found)
    return file
