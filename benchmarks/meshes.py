"""The meshes of the comparisons: out of Debian's package of CGAL's demonstrations, or made here. Nothing else is needed.

A name is that of a mesh in the package (bunny: the Stanford bunny), of a made one (grid100, folded-sphere), with -x10 for
stretched tenfold in x, and -shear for sheared in x by y (an angle of 135 degrees in every triangle of grid100).
"""

import tarfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
ARCHIVES = (ROOT / "demo/data.tar.gz", Path("/usr/share/doc/libcgal-dev/data.tar.gz"),
            Path("/usr/share/doc/libcgal-demo/data.tar.gz"))  # fmt: skip
IN_PACKAGE = {"bunny": "bunny00"}
DEFORMATIONS = {"-x10": np.diag([10.0, 1, 1]), "-shear": np.array([[1, 0, 0], [1, 1, 0], [0, 0, 1.0]])}


def read_off(text):
    """With colours behind the positions, too, which are left out."""
    lines = [line.split("#")[0].split() for line in text.splitlines()]
    (kind, *more), *lines = [words for words in lines if words]
    counts, lines = (more, lines) if more else (lines[0], lines[1:])
    count, faces = int(counts[0]), int(counts[1])
    assert kind in ("OFF", "COFF"), kind
    rows = lines[count : count + faces]
    assert all(row[0] == "3" for row in rows), "triangles only"
    return np.array([row[:3] for row in lines[:count]], float), np.array([row[1:4] for row in rows], int)


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
    for ending, matrix in DEFORMATIONS.items():
        if name.endswith(ending):
            found = arrays(name.removesuffix(ending))
            return found and (found[0] @ matrix, found[1])
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
