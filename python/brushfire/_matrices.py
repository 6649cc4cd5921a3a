"""Distance matrices: dense, sparse, into arrays of other libraries, into a file."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import path_text, radius_of, whole
from brushfire._errors import BrushfireError
from brushfire._matrix_arrays import as_type, check_out, fits_core, float_type, memory_of, new_matrix
from brushfire._options import Options, Tolerance, thread_count
from brushfire._places import PlaceArrays, Places
from brushfire._progress import Progress, Reporter, shown
from brushfire._weighted import Weighing, chosen_in

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

    from brushfire._mesh import Mesh

Symmetric = Literal["mean", "min"]

_BLOCK_BYTES = 1 << 26
_SYMMETRIC_BLOCK = 1024
_MOST_ROWS = 2**62


def distance_matrix(
    mesh: Mesh,
    rows: Places | None = None,
    columns: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    radius: float = np.inf,
    precision: str | None = None,
    dtype: npt.DTypeLike = np.float32,
    out: Any = None,
    symmetric: Symmetric | None = None,
    weights: Weighing | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Any:
    """Distances from every row's place to every column's place.

    :param rows: places: vertices, points or a mask; all vertices if none are given.
    :param columns: likewise.
    :param method, tolerance, bound, precision: as for :meth:`distance`.
    :param radius: what is farther reads +inf.
    :param weights: what going costs, in place of distances: :meth:`weighted`, or one number per face.
    :param dtype: float32 (rounded from float64, 7 digits), float64, or float16 (3 digits, up to 65504: what does not
        fit is an error).
    :param out: of shape (rows, columns), to be filled instead of a new array, its dtype is what counts: a
        C-contiguous, writable numpy array (a ``numpy.memmap`` for instance) or torch tensor of the CPU; or a zarr array
        or another one that takes ``out[i:j] = rows``, which gets a block of rows at a time.
    :param symmetric: where rows and columns are the same places: ``"mean"`` or ``"min"`` of both directions, which
        approximate methods and rounding leave a little apart. ``scipy.spatial.distance.squareform`` takes the result.
    :param threads: 0 means one per processor. The numbers are the same to the bit for any number of threads.
    :return: (rows, columns). Rows and columns of vertices in no face are +inf throughout.
    :raises BrushfireError: code ``too_large`` before anything is computed where the result does not fit into memory.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.distance_matrix([0, 1], method="dijkstra").tolist()
    [[0.0, 3.0, 5.0, 4.0], [3.0, 0.0, 4.0, 7.0]]
    """
    row, column = _optional(mesh, rows, "rows"), _optional(mesh, columns, "columns")
    if symmetric is not None:
        _check_symmetric(symmetric, row, column)
    shape = (_count(mesh, row), _count(mesh, column))
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision)
    team = thread_count(threads)
    result = new_matrix(shape, dtype) if out is None else out
    array = memory_of(result)
    check_out(array, shape)
    with shown(progress, "matrix") as report:
        if 0 in shape:
            pass
        elif fits_core(array):
            _fill(space, array, row, column, chosen, team, report)
        else:
            _fill_by_blocks(space, array, row, column, chosen, team, report)
    if symmetric is not None:
        _symmetrize(array, symmetric)
    return result


def _fill(
    space: _core.Space,
    array: npt.NDArray[Any],
    row: PlaceArrays | None,
    column: PlaceArrays | None,
    chosen: Options,
    threads: int,
    report: Reporter | None,
) -> None:
    _core.fill_matrix(space, array, *_pair(row), *_pair(column), chosen, threads, report)


def _fill_by_blocks(
    space: _core.Space,
    array: Any,
    row: PlaceArrays | None,
    column: PlaceArrays | None,
    chosen: Options,
    threads: int,
    report: Reporter | None,
) -> None:
    """What the core does not write to itself: rows by blocks of its chunks, in the type that is wanted."""
    rows, columns = array.shape
    wanted = np.dtype(array.dtype)
    single = wanted != np.float64
    chunk = getattr(array, "chunks", None) or (1,)
    step = max(1, _BLOCK_BYTES // max(1, columns * (4 if single else 8)) // chunk[0]) * chunk[0]
    for begin in range(0, rows, step):
        end = min(rows, begin + step)
        block = np.empty((end - begin, columns), dtype=np.float32 if single else np.float64)
        _fill(space, block, _some(row, begin, end), column, chosen, threads, _part(report, begin, end, rows))
        array[begin:end] = as_type(block, wanted)


def _some(row: PlaceArrays | None, begin: int, end: int) -> PlaceArrays:
    if row is None:
        return PlaceArrays(np.arange(begin, end), None)
    return PlaceArrays(row.index[begin:end], None if row.weights is None else row.weights[begin:end])


def distances_within(
    mesh: Mesh,
    radius: float,
    rows: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    dtype: npt.DTypeLike = np.float32,
    symmetric: Symmetric | None = None,
    weights: Weighing | None = None,
    threads: int = 0,
    memory_limit: int = 0,
    progress: Progress = None,
) -> csr_matrix:
    """All distances up to a radius, as a ``scipy.sparse.csr_matrix`` of shape (rows, vertex_count).

    A row costs what it reaches, whatever the size of the mesh. A place's distance to itself is a stored zero: what is
    not stored is farther than the radius. Columns ascend within a row. Rows of ``carried-source`` in single precision are
    computed in groups: they differ from :meth:`distance` by as much as that differs from the truth.

    :param radius: finite, >= 0.
    :param rows: vertices, points or a mask; all vertices if none are given.
    :param method, tolerance, bound, precision: as for :meth:`distance`.
    :param symmetric: for all vertices as rows: ``"mean"`` or ``"min"`` of both directions, of the one that is within
        the radius where the other is not.
    :param memory_limit: bytes that the result may take; 0 means what the machine has left.
    :param weights: what going costs, in place of distances: :meth:`weighted`, or one number per face.
    :raises BrushfireError: code ``too_large`` where the result will not fit.
    :raises ImportError: where scipy is not installed.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> near = mesh.distances_within(3.5, method="dijkstra")
    >>> near.nnz, near[0].indices.tolist(), near[0].data.tolist()
    (8, [0, 1], [0.0, 3.0])
    """
    row = _optional(mesh, rows, "rows")
    if symmetric is not None:
        _check_symmetric(symmetric, row, None)
    compute = _core.sparse_float32 if float_type(dtype) == np.float32 else _core.sparse_float64
    most = whole(memory_limit, "memory_limit", np.iinfo(np.int64).max)
    _scipy_sparse()  # before anything is computed
    space, chosen = chosen_in(mesh, weights, method, tolerance, np.inf, bound, precision)
    limit, team = radius_of(radius), thread_count(threads)
    with shown(progress, "rows") as report:
        data, indices, starts = compute(space, limit, *_pair(row), chosen, team, most, report)
    if symmetric is not None:
        data, indices, starts = _symmetric_rows(data, indices, starts, symmetric)
    return sparse_matrix(data, indices, starts, mesh._mesh.vertex_count)


def write_distance_matrix(
    mesh: Mesh,
    path: str | os.PathLike[str],
    rows: Places | None = None,
    columns: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    radius: float = np.inf,
    precision: str | None = None,
    dtype: npt.DTypeLike = np.float32,
    weights: Weighing | None = None,
    symmetric: Symmetric | None = None,
    shard: tuple[int, int] | None = None,
    nearest: int = 0,
    chunk_rows: int = 0,
    zarr_format: int = 3,
    threads: int = 0,
    progress: Progress = None,
) -> str:
    """``distance_matrix()`` into a .npy file or a .zarr store, a row at a time, for what is larger than memory.

    It is a job: interrupted or killed, it goes on where it stopped when it is called again with the same arguments;
    a second process that makes the same call helps. Rows of another matrix that was begun at this path are refused
    and not discarded. Until it is complete, what is there stands in ``path + ".part"`` (of .zarr in its folder) and
    ``path + ".part.rows"``. Open it with ``numpy.load(path, mmap_mode="r")``, ``zarr.open(path)["distance"]`` or
    ``xarray.open_zarr(path).distance``.

    :param weights: what going costs, in place of distances: :meth:`weighted`, or one number per face.
    :param symmetric: ``"mean"`` or ``"min"`` of both directions, for rows and columns that are the same places.
    :param shard: (3, 16) is the third of sixteen parts of the rows: in a .npy file of its own for
        :func:`merge_shards`; those of a .zarr store write into it together.
    :param nearest: not 0: of every row only so many columns, the nearest ones, from near to far, and which they are in a
        second file of int32: ``d.index.npy`` beside ``d.npy``. What is not reached comes last. Sorted rows with indices
        are what ``brainsmash.mapgen.Sampled(x, D, index)`` takes. Where the columns are all vertices, a row costs what
        it has to reach.
    :param chunk_rows: rows of a chunk of .zarr; 0 means as many as take 16 MB.
    :param zarr_format: 3 or 2.
    :return: where it is: ``path``, or the file of the shard.
    :raises BrushfireError: code ``file_not_writable``, also where the disk has not enough room left.

    >>> import brushfire as bf, numpy as np, tempfile, os
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = mesh.write_distance_matrix(os.path.join(folder, "d.npy"), [1], method="dijkstra")
    ...     np.load(os.path.join(folder, "d.npy")).tolist()
    [[3.0, 0.0, 4.0, 7.0]]
    """
    row, column = _optional(mesh, rows, "rows"), _optional(mesh, columns, "columns")
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision)
    single = bool(float_type(dtype) == np.float32)
    team = thread_count(threads)
    part, parts = (1, 1) if shard is None else (whole(n, "shard", _MOST_ROWS) for n in shard)
    with shown(progress, "matrix") as report:
        return _core.write_matrix(
            space, path_text(path), single, *_pair(row), *_pair(column), chosen, team, _symmetry(symmetric),
            whole(chunk_rows, "chunk_rows", _MOST_ROWS), whole(zarr_format, "zarr_format", 3), part, parts,
            whole(nearest, "nearest", _MOST_ROWS), report
        )  # fmt: skip


def _optional(mesh: Mesh, places: Any, what: str) -> PlaceArrays | None:
    """None for all vertices."""
    return None if places is None else mesh._arrays(places, what)


def _count(mesh: Mesh, places: PlaceArrays | None) -> int:
    return mesh._mesh.vertex_count if places is None else len(places.index)


def merge_shards(
    shards: Iterable[str | os.PathLike[str]],
    output: str | os.PathLike[str],
    *,
    symmetric: Symmetric | None = None,
    nearest: int = 0,
    chunk_rows: int = 0,
    zarr_format: int = 3,
) -> None:
    """The shards that ``write_distance_matrix(shard=)`` wrote, as one matrix: .npy or .zarr.

    It has the bytes of one that was computed at once. Shards of different matrices and missing ones are refused.
    The other arguments are those of ``write_distance_matrix()``.

    >>> import brushfire as bf, numpy as np, tempfile, os
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "d.npy")
    ...     parts = [mesh.write_distance_matrix(path, method="dijkstra", shard=(i, 2)) for i in (1, 2)]
    ...     bf.merge_shards(parts, path)
    ...     np.load(path)[1].tolist()
    [3.0, 0.0, 4.0, 7.0]
    """
    paths = [path_text(p) for p in shards]
    rows, layout = whole(chunk_rows, "chunk_rows", _MOST_ROWS), whole(zarr_format, "zarr_format", 3)
    kept = whole(nearest, "nearest", _MOST_ROWS)
    _core.merge_shards(paths, path_text(output), _symmetry(symmetric), rows, layout, kept)


def _symmetry(symmetric: Any) -> str:
    if symmetric not in (None, "mean", "min"):
        raise BrushfireError(f"symmetric: 'mean' or 'min' is needed, not {symmetric!r}")
    return symmetric or ""


def _pair(places: PlaceArrays | None) -> tuple[Any, Any]:
    return (None, None) if places is None else (places.index, places.weights)


def _part(report: Reporter | None, begin: int, end: int, rows: int) -> Reporter | None:
    """The share of a block as a share of the whole."""
    if report is None:
        return None
    return lambda share: report((begin + share * (end - begin)) / rows)


def _check_symmetric(symmetric: Any, row: PlaceArrays | None, column: PlaceArrays | None) -> None:
    if symmetric not in ("mean", "min"):
        raise BrushfireError(f"symmetric: 'mean' or 'min' is needed, not {symmetric!r}")
    for a, b in zip(_pair(row), _pair(column), strict=True):
        if not (a is b or (a is not None and b is not None and np.array_equal(a, b))):
            raise BrushfireError("symmetric: rows and columns must be the same places")


def _either_way(a: npt.NDArray[Any], b: npt.NDArray[Any], symmetric: Symmetric) -> npt.NDArray[Any]:
    """The same bits for (a, b) and (b, a); of one number and none, the number."""
    least: npt.NDArray[Any] = np.fmin(a, b)
    if symmetric == "mean":
        mean = a / 2 + b / 2
        return np.where(np.isfinite(mean), mean, least)
    return least


def _symmetrize(array: Any, symmetric: Symmetric) -> None:
    """In place, a pair of blocks at a time."""
    cuts = [slice(b, b + _SYMMETRIC_BLOCK) for b in range(0, array.shape[0], _SYMMETRIC_BLOCK)]
    for i, above in enumerate(cuts):
        for beside in cuts[: i + 1]:
            both = _either_way(np.asarray(array[above, beside]), np.asarray(array[beside, above]).T, symmetric)
            array[above, beside] = both
            array[beside, above] = both.T


def _symmetric_rows(
    data: npt.NDArray[Any], indices: npt.NDArray[Any], starts: npt.NDArray[Any], symmetric: Symmetric
) -> tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any]]:
    """Of a square matrix in compressed rows; the union of what is stored in either direction is stored in both."""
    count = len(starts) - 1
    row = np.repeat(np.arange(count, dtype=np.int64), np.diff(starts))
    here, there = row * count + indices, indices.astype(np.int64) * count + row
    entries = np.union1d(here, there)
    a, b = np.full(len(entries), np.nan, data.dtype), np.full(len(entries), np.nan, data.dtype)
    a[np.searchsorted(entries, here)] = data
    b[np.searchsorted(entries, there)] = data
    starts = np.searchsorted(entries, np.arange(count + 1, dtype=np.int64) * count)
    return _either_way(a, b, symmetric), (entries % max(1, count)).astype(indices.dtype), starts


def _scipy_sparse() -> Any:
    try:
        import scipy.sparse
    except ImportError:
        raise ImportError("a scipy matrix is returned: pip install 'brushfire[sparse]'") from None
    return scipy.sparse


def sparse_matrix(
    data: npt.NDArray[Any], indices: npt.NDArray[Any], starts: npt.NDArray[Any], columns: int
) -> csr_matrix:
    """Compressed rows whose columns ascend. scipy wants one integer type for both: 32 bits where they do."""
    integer = np.int32 if len(data) <= np.iinfo(np.int32).max else np.int64
    pointers, numbers = starts.astype(integer, copy=False), indices.astype(integer, copy=False)
    matrix = _scipy_sparse().csr_matrix((data, numbers, pointers), shape=(len(starts) - 1, columns), copy=False)
    matrix.has_sorted_indices = True
    matrix.has_canonical_format = True
    return matrix
