"""Where on a mesh: vertices by number, points of faces, and arrays of either."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, Ints, floats, integer, integers, number, triples
from brushfire._errors import BrushfireError, BrushfireTypeError


@dataclass(frozen=True)
class Point:
    """A point of the surface: a face and the weights of its three corners, each >= 0, summing to one.

    Weights up to 1e-12 read as 0: a point that near to a vertex is the vertex.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> mesh.position(bf.Point(0, (0.5, 0.25, 0.25))).tolist()
    [0.5, 0.5, 0.0]
    """

    face: int
    weights: tuple[float, float, float]


class Points(NamedTuple):
    """Many points of the surface: ``face`` is an (k,) array of integers, ``weights`` an (k, 3) array of floats.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> mesh.position(bf.Points([0, 0], [[1, 0, 0], [0, 0.5, 0.5]])).tolist()
    [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
    """

    face: npt.ArrayLike
    weights: npt.ArrayLike


@dataclass(frozen=True)
class At:
    """Positions in space that stand for the surface points nearest to them: see :func:`at`."""

    xyz: Floats
    within: float = np.inf


def at(xyz: npt.ArrayLike, *, within: float = np.inf) -> At:
    """Positions in space as sources, targets, rows or columns: each is snapped to the nearest point of the surface.

    :param xyz: (3,) or (k, 3).
    :param within: farther than this from the surface no position may be: a BrushfireError says which one is, and how
        far. Where nothing is said, one that is farther than a tenth of the mesh's size is a :class:`BrushfireWarning`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> mesh.distance(bf.at([1, 0, 0.3], within=0.5), method="exact").round(6).tolist()
    [1.0, 1.0, 2.236068]
    """
    array = floats(xyz, "at")
    limit = number(within, "within")
    if not limit >= 0:
        raise BrushfireError(f"within: a number >= 0 is needed, not {limit}")
    return At(triples(array.reshape(1, 3) if array.shape == (3,) else array, "at"), limit)


@dataclass(frozen=True)
class PlaceArrays:
    """As the core takes it: a vertex where the three weights are 0 (or there are none), else a face and its weights."""

    index: Ints
    weights: Floats | None


Places: TypeAlias = "int | Point | Points | At | PlaceArrays | Sequence[int | Point] | npt.NDArray[np.integer[Any]] | npt.NDArray[np.bool_]"
"""A vertex, a point, several of them, or a mask with one bool per vertex."""


def _points(points: Points, what: str) -> PlaceArrays:
    index = integers(points.face, f"{what}: face")
    weights = triples(points.weights, f"{what}: weights")
    if index.ndim != 1 or len(index) != len(weights):
        raise BrushfireError(f"{what}: {index.size} faces, but {len(weights)} triples of weights")
    if not weights.any(axis=1).all():
        raise BrushfireError(f"{what}: the weights of a point sum to 0, not to 1")
    return PlaceArrays(index, weights)


def _single(item: Any, what: str) -> tuple[int, tuple[float, float, float]]:
    if isinstance(item, Point):
        weights = floats(item.weights, f"{what}: weights")
        if weights.shape != (3,) or not weights.any():
            raise BrushfireError(f"{what}: {item} needs three weights that sum to 1")
        return integer(item.face, f"{what}: face"), (weights[0], weights[1], weights[2])
    if isinstance(item, (bool, np.bool_)):
        raise BrushfireTypeError(f"{what}: a vertex number or a Point is needed, not {item!r}")
    try:
        return operator.index(item), (0.0, 0.0, 0.0)
    except TypeError:
        raise BrushfireTypeError(f"{what}: a vertex number or a Point is needed, not {type(item).__name__}") from None


def _listed(items: Sequence[Any], what: str) -> PlaceArrays:
    pairs = [_single(item, what) for item in items]
    try:
        index = np.array([pair[0] for pair in pairs], dtype=np.int64)
    except OverflowError:
        raise BrushfireError(f"{what}: a number of more than 64 bits", "index_out_of_range") from None
    return PlaceArrays(index, np.array([pair[1] for pair in pairs], dtype=np.float64).reshape(-1, 3))


def is_one(places: Any) -> bool:
    """Whether a single place is meant rather than a list of one."""
    return isinstance(places, Point) or (not isinstance(places, np.ndarray) and hasattr(places, "__index__"))


def place_arrays(places: Any, vertex_count: int, what: str) -> PlaceArrays:
    """Any spelling of places, as arrays."""
    if isinstance(places, PlaceArrays):
        return places
    if isinstance(places, Points):
        return _points(places, what)
    if is_one(places):
        return _listed([places], what)
    if isinstance(places, (list, tuple, range)) and any(isinstance(item, Point) for item in places):
        return _listed(places, what)
    if isinstance(places, np.ndarray) and places.dtype.kind == "O":
        return _listed(places.ravel().tolist(), what)
    array = np.asarray(places)
    if array.dtype == np.bool_:
        if array.shape != (vertex_count,):
            raise BrushfireError(
                f"{what}: a mask needs one bool per vertex, shape ({vertex_count},), not {array.shape}"
            )
        return PlaceArrays(np.flatnonzero(array).astype(np.int64), None)
    if array.dtype.kind == "f" and array.size:
        raise BrushfireTypeError(f"{what}: vertex numbers or Points are needed, not {array.dtype}")
    index = integers(array, what)
    if index.ndim == 0:
        index = index.reshape(1)
    if index.ndim != 1:
        raise BrushfireError(f"{what}: shape (k,) is needed, not {index.shape}")
    return PlaceArrays(index, None)
