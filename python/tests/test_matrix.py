"""Distance matrices: dense, sparse, on disk."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import assert_same, grid

scipy_sparse = pytest.importorskip("scipy.sparse")


def test_rows_are_single_runs_whatever_the_threads(bumpy, method):
    expected = np.array([bumpy.distance(v, method=method) for v in range(bumpy.vertex_count)])
    for threads in (1, 2, 5, 0):
        assert np.array_equal(bumpy.distance_matrix(method=method, dtype=float, threads=threads), expected)
    assert np.array_equal(bumpy.distance_matrix(method=method), expected.astype(np.float32))


def test_selections_and_out(bumpy):
    full = bumpy.distance_matrix(method="dijkstra", dtype=float)
    rows, columns = [3, 3, 99], [0, 50]
    assert np.array_equal(bumpy.distance_matrix(rows, columns, method="dijkstra", dtype=float), full[rows][:, columns])
    out = np.full((3, 2), -1.0)
    assert bumpy.distance_matrix(rows, columns, method="dijkstra", out=out) is out
    assert np.array_equal(out, full[rows][:, columns])
    assert bumpy.distance_matrix([], columns).shape == (0, 2)
    mask = np.arange(bumpy.vertex_count) % 7 == 0
    assert np.array_equal(bumpy.distance_matrix(mask, mask, method="dijkstra", dtype=float), full[mask][:, mask])


def test_wrong_out_is_refused(bumpy):
    n = bumpy.vertex_count
    read_only = np.zeros((n, n))
    read_only.flags.writeable = False
    for out in (np.zeros((n, n - 1)), np.zeros((n, n), order="F"), np.zeros((n, n), dtype=int), read_only):
        with pytest.raises(bf.BrushfireError):
            bumpy.distance_matrix(out=out)
    with pytest.raises(TypeError):
        bumpy.distance_matrix(out=[[0.0]])


def test_sparse_holds_what_is_within_the_radius(bumpy, method):
    near = bumpy.distances_within(3.0, method=method, dtype=float)
    assert isinstance(near, scipy_sparse.csr_matrix)
    assert near.indices.dtype == near.indptr.dtype == np.int32
    for v in range(bumpy.vertex_count):
        row = bumpy.distance(v, method=method)
        assert np.array_equal(near[v].indices, np.flatnonzero(row <= 3))
        assert_same(near[v].data, row[row <= 3], method)
    assert near.dtype == np.float64
    part = bumpy.distances_within(3.0, [4, 9], method=method)
    assert part.dtype == np.float32
    assert (part != near[[4, 9]].astype(np.float32)).nnz == 0


def test_what_does_not_fit_is_refused_with_the_figures():
    mesh = bf.Mesh(np.zeros((3_000_000, 3)), [[0, 1, 2]])
    with pytest.raises(bf.BrushfireError, match="3000000 x 3000000 float32 matrix needs 36 TB") as error:
        mesh.distance_matrix()
    assert error.value.code == "too_large"
    with pytest.raises(bf.BrushfireError, match="smaller radius") as error:
        bf.Mesh(*grid(40)).distances_within(100, method="dijkstra", memory_limit=1_000_000)
    assert error.value.code == "too_large"


def test_written_to_disk_it_is_the_matrix_and_goes_on_after_an_interruption(bumpy, tmp_path):
    path = tmp_path / "d.npy"
    calls = 0

    def stop(share: float) -> None:
        nonlocal calls
        calls += 1
        if share < 1:
            raise KeyboardInterrupt

    mesh = bf.Mesh(*grid(60))
    with pytest.raises(KeyboardInterrupt):
        mesh.write_distance_matrix(path, method="dijkstra", threads=1, progress=stop)
    assert not path.exists()
    assert calls == 1
    mesh.write_distance_matrix(path, method="dijkstra")
    d = np.load(path, mmap_mode="r")
    assert d.dtype == np.float32
    assert np.array_equal(d[::100], mesh.distance_matrix(range(0, 3600, 100), method="dijkstra"))
    assert [p.name for p in tmp_path.iterdir()] == ["d.npy"]
    bumpy.write_distance_matrix(str(path), [1], [2, 3], method="dijkstra", dtype=float)
    assert np.array_equal(np.load(path), bumpy.distance_matrix([1], [2, 3], method="dijkstra", dtype=float))
    with pytest.raises(bf.BrushfireError) as error:
        bumpy.write_distance_matrix(tmp_path / "no" / "d.npy")
    assert error.value.code == "file_not_writable"
