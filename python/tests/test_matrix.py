"""Distance matrices: dense, sparse, on disk."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import assert_same, grid

scipy_sparse = pytest.importorskip("scipy.sparse")


def test_rows_are_single_runs_whatever_the_threads(bumpy, method):
    expected = np.array([bumpy.distance(v, method=method) for v in range(bumpy.vertex_count)])
    if method == "carried-source":  # whose rows march in groups: other updates, and as near to the distance
        rows = bumpy.distance_matrix(method=method, dtype=float)
        assert np.allclose(rows, expected, rtol=0.03)
        expected = rows
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
        if method == "carried-source":  # its rows run in groups: not the bits of a single run
            found = near[v].toarray()[0]
            assert np.allclose(found[near[v].indices], row[near[v].indices], rtol=0.02)
            assert (row[np.setdiff1d(np.arange(len(row)), near[v].indices)] > 3 / 1.02).all()
            continue
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


def test_symmetric_is_the_mean_or_the_least_of_both_directions(bumpy):
    squareform = pytest.importorskip("scipy.spatial.distance").squareform
    for arguments in ({"dtype": float}, {"method": "novotni-klein"}, {"method": "novotni-klein", "dtype": float}):
        plain = bumpy.distance_matrix(**arguments)
        assert not np.array_equal(plain, plain.T)
        for symmetric, expected in (("mean", plain / 2 + plain.T / 2), ("min", np.minimum(plain, plain.T))):
            matrix = bumpy.distance_matrix(symmetric=symmetric, **arguments)
            assert np.array_equal(matrix, matrix.T)
            assert np.array_equal(matrix, expected)
            assert matrix.dtype == plain.dtype
            assert len(squareform(matrix)) == bumpy.vertex_count * (bumpy.vertex_count - 1) // 2
    some = [5, 9, 100]
    part = bumpy.distance_matrix(some, some, symmetric="mean", dtype=float)
    assert np.array_equal(part, part.T)
    for arguments in ({"rows": some}, {"rows": some, "columns": [5, 9, 101]}):
        with pytest.raises(bf.BrushfireError, match="same places"):
            bumpy.distance_matrix(**arguments, symmetric="mean")
    with pytest.raises(bf.BrushfireError, match="'mean' or 'min'"):
        bumpy.distance_matrix(symmetric=True)


def test_symmetric_crosses_the_borders_of_its_blocks(monkeypatch):
    from brushfire import _matrices

    mesh = bf.Mesh(*grid(9, 0.5))
    whole = mesh.distance_matrix(symmetric="min", method="novotni-klein")
    monkeypatch.setattr(_matrices, "_SYMMETRIC_BLOCK", 17)
    assert np.array_equal(mesh.distance_matrix(symmetric="min", method="novotni-klein"), whole)


def test_symmetric_sparse_rows_store_the_same_both_ways(bumpy):
    plain = bumpy.distances_within(3.0, method="novotni-klein", dtype=float)
    dense = plain.toarray()
    stored = np.zeros(dense.shape, dtype=bool)
    stored[np.repeat(np.arange(len(dense)), np.diff(plain.indptr)), plain.indices] = True
    apart = np.where(stored, dense, np.inf)
    for symmetric in ("mean", "min"):
        near = bumpy.distances_within(3.0, method="novotni-klein", dtype=float, symmetric=symmetric)
        assert near.nnz == (stored | stored.T).sum() >= plain.nnz
        assert (near != near.T).nnz == 0
        assert (np.diff(near.indices)[np.diff(np.repeat(np.arange(len(dense)), np.diff(near.indptr))) == 0] > 0).all()
        least = np.minimum(apart, apart.T)
        mean = np.where(stored & stored.T, apart / 2 + apart.T / 2, least)
        expected = np.where(np.isinf(least), 0, mean if symmetric == "mean" else least)
        assert np.array_equal(near.toarray(), expected)
    with pytest.raises(bf.BrushfireError, match="same places"):
        bumpy.distances_within(3.0, [0, 1], symmetric="mean")


def test_half_precision_is_rounded_and_never_silently_out_of_range(bumpy):
    exact = bumpy.distance_matrix(method="exact")
    half = bumpy.distance_matrix(method="exact", dtype=np.float16)
    assert half.dtype == np.float16
    assert np.array_equal(half, exact.astype(np.float16))
    islands = bf.Mesh([[0, 0], [1, 0], [0, 1], [5, 5], [6, 5], [5, 6]], [[0, 1, 2], [3, 4, 5]])
    assert np.isinf(islands.distance_matrix(dtype=np.float16)[0, 3])
    for scale in (1e5, 1e-9):
        with pytest.raises(bf.BrushfireError, match="ask for float32"):
            bf.Mesh(bumpy.vertices * scale, bumpy.faces).distance_matrix(dtype=np.float16)
    with pytest.raises(bf.BrushfireError, match="3000000 x 3000000 float16") as error:
        bf.Mesh(np.zeros((3_000_000, 3)), [[0, 1, 2]]).distance_matrix(dtype=np.float16)
    assert error.value.code == "too_large"


class Stored:
    """What zarr, h5py and others have: written to by slices of rows, no memory of its own."""

    def __init__(self, shape, dtype, chunks):
        self.data, self.chunks, self.writes = np.full(shape, -1, dtype), chunks, []

    shape = property(lambda self: self.data.shape)
    dtype = property(lambda self: self.data.dtype)

    def __getitem__(self, where):
        return self.data[where].copy()

    def __setitem__(self, where, values):
        self.writes.append(where)
        self.data[where] = values


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_out_may_be_anything_that_is_written_to_by_rows(bumpy, dtype, monkeypatch):
    from brushfire import _matrices

    n = bumpy.vertex_count
    full = bumpy.distance_matrix(method="dijkstra", dtype=np.float32 if dtype == np.float16 else dtype)
    monkeypatch.setattr(_matrices, "_BLOCK_BYTES", 20 * n * 8)
    out = Stored((n, n), dtype, (10, n))
    assert bumpy.distance_matrix(method="dijkstra", out=out) is out
    assert np.array_equal(out.data, full.astype(dtype))
    assert len(out.writes) > 3
    assert all(block.start % 10 == 0 for block in out.writes)
    points = bf.Points([3, 3, 99], [[0.2, 0.3, 0.5]] * 3)
    out = Stored((3, n), dtype, (1, n))
    bumpy.distance_matrix(points, method="exact", out=out)
    assert np.allclose(out.data, bumpy.distance_matrix(points, method="exact", dtype=float), rtol=1e-3)
    out = Stored((n, n), dtype, (7, n))
    bumpy.distance_matrix(method="novotni-klein", out=out, symmetric="mean")
    assert np.array_equal(out.data, out.data.T)
    with pytest.raises(bf.BrushfireError, match="shape"):
        bumpy.distance_matrix(out=Stored((n, n - 1), dtype, (1, 1)))


def test_out_may_be_a_zarr_array(bumpy, tmp_path):
    zarr = pytest.importorskip("zarr")
    n = bumpy.vertex_count
    out = zarr.create_array(tmp_path / "d.zarr", shape=(n, n), chunks=(16, n), dtype="float32")
    bumpy.distance_matrix(method="dijkstra", out=out)
    assert np.array_equal(zarr.open(tmp_path / "d.zarr")[:], bumpy.distance_matrix(method="dijkstra"))


def test_out_may_be_a_tensor(bumpy):
    from test_from_any import Tensor

    n = bumpy.vertex_count
    out = Tensor(np.zeros((n, n), dtype=np.float32))
    assert bumpy.distance_matrix(method="dijkstra", out=out) is out
    assert np.array_equal(out.array, bumpy.distance_matrix(method="dijkstra"))
    torch = pytest.importorskip("torch")
    real = torch.zeros((n, n), dtype=torch.float64)
    bumpy.distance_matrix(method="dijkstra", out=real)
    assert np.array_equal(real.numpy(), bumpy.distance_matrix(method="dijkstra", dtype=float))
