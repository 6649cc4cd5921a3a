"""Sets of meshes, and many pairs of one mesh."""

from __future__ import annotations

import os
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, any_array, floating_type, integers
from brushfire._errors import BrushfireError
from brushfire._options import thread_count
from brushfire._progress import Progress, shown
from brushfire._weighted import Weighing, chosen_in

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_BLOCKS_PER_THREAD = 4  # what is left for one thread at the end is a quarter of its share


def _workers(threads: int) -> int:
    return thread_count(threads) or os.cpu_count() or 1


def pair_distances(
    mesh: Mesh,
    pairs: npt.ArrayLike,
    *,
    radius: float = np.inf,
    method: str | None = None,
    tolerance: float | None = None,
    bound: str | None = None,
    precision: str | None = None,
    weights: Weighing | None = None,
    normalise: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Floats:
    """The distance of each of many pairs of vertices: (k,) float64; +inf where nothing leads.

    :param pairs: (k, 2) vertex numbers.
    :param radius: pairs that are farther apart read +inf.
    :param method, tolerance, bound, precision: as for :meth:`distance`. The exact method is symmetric to rounding; the
        others start at whichever side of all pairs has fewer vertices.
    :param weights: what going costs, from the first to the second: :meth:`weighted`, or one number per face.
    :param normalise: in units of the square root of the surface's area, as shape matching reports errors.
    :param threads: 0 means one per processor. The numbers do not depend on it.
    :param progress: as for :meth:`distance`.
    :raises BrushfireError: for an array of another shape, and for vertices that there are not.

    Pairs are grouped by where they start: one run for each such vertex, which stops at the farthest of its ends. The
    geodesic error of a correspondence is one call.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.pair_distances([[0, 2], [1, 3], [0, 1]], method="exact").tolist()
    [5.0, 5.0, 3.0]
    """
    array = any_array(pairs, "pairs")
    if array.size == 0:
        return np.zeros(0)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise BrushfireError(f"pairs: whole numbers of shape (k, 2) are needed, not {array.dtype} {array.shape}")
    start, end = (np.ascontiguousarray(integers(array, "pairs")[:, k]) for k in (0, 1))
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision)
    with shown(progress, "pairs") as report:
        result = _core.pair_distances(space, start, end, chosen, thread_count(threads), report)
    return result / _root_of_area(mesh) if normalise else result


def _root_of_area(mesh: Mesh) -> float:
    root = float(np.sqrt(mesh.area))
    if not 0 < root < np.inf:
        raise BrushfireError("a surface without area has no unit: distances are not normalised")
    return root


def _named_meshes(meshes: Any) -> list[tuple[str, Any]]:
    """Names, and meshes or where they are."""
    if isinstance(meshes, (str, os.PathLike)):
        raise BrushfireError("meshes: several are needed, in a list")
    named = []
    for i, mesh in enumerate(meshes):
        named.append((Path(mesh).stem if isinstance(mesh, (str, os.PathLike)) else f"{i:05d}", mesh))
    names = [name for name, _ in named]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise BrushfireError(f"meshes: two are called {twice!r}: their matrices would have one name")
    return named


def _fill(mesh: Mesh, out: Any, rows: slice, normalise: bool, how: dict[str, Any]) -> None:
    some = np.arange(rows.start, rows.stop)
    if not len(some):
        return
    mesh.distance_matrix(some, out=out[rows], threads=1, **how)
    if normalise:
        out[rows] = out[rows] / np.float64(_root_of_area(mesh))


def distance_matrices(
    meshes: Iterable[Mesh | str | os.PathLike[str]],
    *,
    out: str | os.PathLike[str] | None = None,
    dtype: npt.DTypeLike = np.float32,
    method: str | None = None,
    tolerance: float | None = None,
    precision: str | None = None,
    normalise: bool = False,
    threads: int = 0,
) -> list[npt.NDArray[Any]] | list[Path]:
    """The matrix of all distances of every one of many meshes.

    :param meshes: meshes, or files that are read when their turn comes.
    :param out: a folder that is made where there is none: every matrix becomes ``NAME.npy`` there, by the name of the
        mesh's file or its number, and only those at work are in memory. Else the matrices are returned.
    :param dtype: float32 or float64.
    :param method, tolerance, precision: as for :meth:`Mesh.distance_matrix`.
    :param normalise: in units of the square root of each surface's area.
    :param threads: 0 means one per processor. They share out meshes and blocks of rows, so that neither a set of small
        meshes nor one large one leaves them idle; the numbers are those of :meth:`Mesh.distance_matrix`, to the bit.
    :return: the matrices, (vertex_count, vertex_count) each, or the paths of their files, in order.
    :raises BrushfireError: for two files of one name; for what reading and computing raise. Files that are complete stay.

    >>> import brushfire as bf
    >>> small = bf.Mesh([[0, 0], [3, 0], [0, 4]], [[0, 1, 2]])
    >>> large = bf.Mesh([[0, 0], [6, 0], [0, 8]], [[0, 1, 2]])
    >>> [m[0].tolist() for m in bf.distance_matrices([small, large], method="exact")]
    [[0.0, 3.0, 4.0], [0.0, 6.0, 8.0]]
    """
    wanted = floating_type(dtype)
    named = _named_meshes(meshes)
    team = _workers(threads)
    how = {"method": method, "tolerance": tolerance, "precision": precision}
    blocks = (
        max(1, -(-team * _BLOCKS_PER_THREAD // max(1, len(named)))) if len(named) < team * _BLOCKS_PER_THREAD else 1
    )
    if team == 1:
        blocks = 1
    folder = None if out is None else Path(out)
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)

    from brushfire._io import read  # which needs Mesh

    def begin(name: str, given: Any) -> tuple[Any, Any, Path | None]:
        mesh = given if hasattr(given, "distance_matrix") else read(given)
        shape = (mesh.vertex_count, mesh.vertex_count)
        if folder is None:
            return mesh, np.empty(shape, wanted), None
        part = folder / f"{name}.npy.part"
        return mesh, np.lib.format.open_memmap(part, mode="w+", dtype=wanted, shape=shape), part

    def whole(item: tuple[str, Any]) -> Any:
        mesh, matrix, part = begin(*item)
        count = mesh.vertex_count
        cuts = [count * k // blocks for k in range(blocks + 1)]
        slices = [slice(a, b) for a, b in zip(cuts, cuts[1:], strict=False)]
        if blocks == 1:
            _fill(mesh, matrix, slices[0], normalise, how)
        else:
            list(rows_pool.map(lambda rows: _fill(mesh, matrix, rows, normalise, how), slices))
        if folder is None or part is None:
            return matrix
        matrix.flush()
        done = folder / part.stem
        part.replace(done)
        return done

    # With blocks, meshes wait in one pool while their rows work in the other.
    with ThreadPoolExecutor(team) as rows_pool, ThreadPoolExecutor(team) as pool:
        return list(pool.map(whole, named))
