"""Full distance matrices of a set as large as FAUST: python benchmarks/faust_set.py [--meshes 2] [--full novotni-klein ..]

FAUST is 100 meshes of 6,890 vertices, which may not be passed on; made here are as many poses as wanted of a folded body of
6,890 vertices. Full matrices are written, as a user's would be, by `brushfire.distance_matrices`, and read back; the other
methods and libraries compute some rows. Rows are those of one second of processor time (so that what else the machine does
does not count), errors the mean one as a share of the mean distance. The time for 100 meshes is reckoned from that.
"""

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np

import brushfire as bf

RINGS, SIDES = 123, 56  # 123 * 56 and two ends: 6,890
SET = 100


def body(pose):
    """A closed, folded body around a line that bends otherwise in every pose."""
    dice = np.random.default_rng(pose)
    t = (np.arange(RINGS) + 1) / (RINGS + 1)
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    folds = 1 + 0.25 * np.sin(9 * np.pi * t)[:, None] ** 2 + 0.12 * np.sin(14 * t[:, None]) * np.cos(5 * angle)
    radius = 0.4 * np.sqrt(np.sin(np.pi * t))[:, None] * folds
    bend, phase = dice.uniform(0.1, 0.5, 2), dice.uniform(0, np.pi, 2)

    def line(t):
        return np.column_stack([bend[0] * np.sin(4 * t + phase[0]), bend[1] * np.sin(3 * t + phase[1]), 2 * t])

    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    skin = (line(t)[:, None] + radius[..., None] * ring).reshape(-1, 3)
    vertices = np.concatenate([line(np.zeros(1)) - [0, 0, 0.03], skin, line(np.ones(1)) + [0, 0, 0.03]])
    k = np.arange(SIDES)
    after = (k + 1) % SIDES
    first, last = 1, 1 + (RINGS - 1) * SIDES
    faces = [np.column_stack([0 * k, first + after, first + k])]
    for r in range(RINGS - 1):
        a, b = 1 + r * SIDES + k, 1 + r * SIDES + after
        faces += [np.column_stack([a, b, b + SIDES]), np.column_stack([a, b + SIDES, a + SIDES])]
    faces.append(np.column_stack([0 * k + len(vertices) - 1, last + k, last + after]))
    return bf.Mesh(vertices, np.concatenate(faces))


def timed(function):
    start = time.process_time()
    result = function()
    return result, time.process_time() - start


def told(name, rows, seconds, error):
    hours = SET * 6890 / (rows / seconds) / 3600
    print(f"{name}: {rows / seconds:,.1f} rows a second, mean error {100 * error:.2g} %; {SET} meshes: {hours:,.2f} hours")


def full_matrices(files, method, exact):
    """Written, and read back."""
    with tempfile.TemporaryDirectory() as folder:
        paths, seconds = timed(lambda: bf.distance_matrices(files, out=folder, method=method, threads=1))
        matrices = [np.load(path, mmap_mode="r") for path in paths]
        rows = sum(len(m) for m in matrices)
        error = relative_error(matrices[0][: len(exact)], exact)
    told(f"{len(files)} full matrices, {method}", rows, seconds, error)


def relative_error(rows, exact):
    there = exact > 0
    return np.abs(rows[there] - exact[there]).mean() / exact[there].mean()


def gdist_rows(mesh, count):
    import gdist

    faces = mesh.faces.astype(np.int32)
    ends = np.arange(mesh.vertex_count, dtype=np.int32)
    return np.array([gdist.compute_gdist(mesh.vertices, faces, np.array([s], np.int32), ends) for s in range(count)])


def scipy_rows(mesh, count):
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import dijkstra

    ends = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    length = np.linalg.norm(mesh.vertices[ends[:, 0]] - mesh.vertices[ends[:, 1]], axis=1)
    graph = csr_matrix((length, (ends[:, 0], ends[:, 1])), shape=(mesh.vertex_count,) * 2)
    return dijkstra(graph, directed=True, indices=np.arange(count))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--meshes", type=int, default=2)
    parser.add_argument("--full", nargs="*", default=["novotni-klein"], help="methods that fill whole matrices")
    parser.add_argument("--rows", type=int, default=100, help="of the others")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"pose{k:02d}.ply" for k in range(given.meshes)]
        for k, file in enumerate(files):
            body(k).save(file)
        mesh = bf.read(files[0])
        print(f"{given.meshes} of {SET} poses: {mesh}")
        some = np.arange(given.rows)
        exact, seconds = timed(lambda: mesh.distance_matrix(some, method="exact", threads=1))
        told("exact", given.rows, seconds, 0)
        for method in ("windows", "carried-source", "novotni-klein", "dijkstra"):
            found, seconds = timed(lambda method=method: mesh.distance_matrix(some, method=method, threads=1))
            told(method, given.rows, seconds, relative_error(found, exact))
        few = min(3, given.rows)
        for name, rows, count in (("gdist (exact)", gdist_rows, few), ("scipy's dijkstra", scipy_rows, given.rows)):
            try:
                found, seconds = timed(lambda rows=rows, count=count: rows(mesh, count))
            except ImportError:
                print(f"({name} is not installed)")
            else:
                told(name, count, seconds, relative_error(found, exact[:count]))
        for method in given.full:
            full_matrices(files, method, exact)
