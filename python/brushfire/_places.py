"""Where on a mesh: vertices by number, points of faces, and arrays of either."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, Ints, any_array, floats, integer, integers, number, triples, whole_numbers
from brushfire._errors import BrushfireError, BrushfireTypeError
from brushfire._foreign import is_loose, listed


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


class Points(Sequence[Point]):
    """Many points of the surface: a sequence of :class:`Point`, kept as two arrays.

    :param face: (k,) integers.
    :param weights: (k, 3): of the corners of each face.

    What is not so is an error where the points are used. Slices, masks and lists of positions give Points again.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> points = bf.Points([0, 0], [[1, 0, 0], [0, 0.5, 0.5]])
    >>> mesh.position(points).tolist()
    [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
    >>> len(points), points[1], mesh.position(points[1:]).tolist()
    (2, Point(face=0, weights=(0.0, 0.5, 0.5)), [[1.0, 1.0, 0.0]])
    >>> round(mesh.path(*points).length, 6)
    1.414214
    """

    __slots__ = ("_face", "_weights")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, face: npt.ArrayLike, weights: npt.ArrayLike) -> None:
        self._face = any_array(face, "face")
        self._weights = any_array(weights, "weights")

    @property
    def face(self) -> npt.NDArray[Any]:
        """Which face each point lies in, (k,)."""
        return self._face

    @property
    def weights(self) -> npt.NDArray[Any]:
        """The weights of the corners of each point's face, (k, 3)."""
        return self._weights

    def __len__(self) -> int:
        return len(self._face) if self._face.ndim else 0

    @overload
    def __getitem__(self, which: int) -> Point: ...
    @overload
    def __getitem__(self, which: slice | Sequence[int] | npt.NDArray[Any]) -> Points: ...
    def __getitem__(self, which: Any) -> Point | Points:
        if isinstance(which, slice) or not hasattr(which, "__index__") or getattr(which, "ndim", 0) != 0:
            chosen = which if isinstance(which, slice) else any_array(which, "which points")
            return Points(self._face[chosen], self._weights[chosen])
        a, b, c = self._weights[operator.index(which)].tolist()
        return Point(self._face[operator.index(which)].item(), (a, b, c))

    def __iter__(self) -> Iterator[Point]:
        for face, (a, b, c) in zip(self._face.tolist(), self._weights.tolist(), strict=True):
            yield Point(face, (a, b, c))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Points):
            return NotImplemented
        return np.array_equal(self._face, other._face) and np.array_equal(self._weights, other._weights)

    def __repr__(self) -> str:
        return f"Points({len(self)} points)"

    def __reduce__(self) -> tuple[type[Points], tuple[Any, Any]]:
        return Points, (self._face, self._weights)


@dataclass(frozen=True)
class At:
    """Positions in space that stand for the surface points nearest to them: see :func:`at`."""

    xyz: Floats
    snap_within: float = np.inf

    def __repr__(self) -> str:
        return f"At({len(self.xyz)} positions)"


def at(xyz: npt.ArrayLike, *, snap_within: float = np.inf) -> At:
    """Positions in space as sources, targets, rows or columns: each is snapped to the nearest point of the surface.

    :param xyz: (3,) or (k, 3).
    :param snap_within: farther than this from the surface no position may be: a BrushfireError says which one is, and how
        far. Where nothing is said, one that is farther than a tenth of the mesh's size is a :class:`BrushfireWarning`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
    >>> mesh.distance(bf.at([1, 0, 0.3], snap_within=0.5), method="exact").round(6).tolist()
    [1.0, 1.0, 2.236068]
    """
    array = floats(xyz, "at")
    limit = number(snap_within, "snap_within")
    if not limit >= 0:
        raise BrushfireError(f"snap_within: a number >= 0 is needed, not {limit}")
    return At(triples(array.reshape(1, 3) if array.shape == (3,) else array, "at"), limit)


@dataclass(frozen=True)
class PlaceArrays:
    """As the core takes it: a vertex where the three weights are 0 (or there are none), else a face and its weights."""

    index: Ints
    weights: Floats | None


Places: TypeAlias = "int | Point | Points | At | PlaceArrays | Iterable[int | Point] | npt.ArrayLike"
"""A vertex, a point, several of them in whatever holds several, or a mask with one bool per vertex."""


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
    if isinstance(item, (float, np.floating)):
        return int(_vertices_of_floats(np.asarray(item, dtype=np.float64), what)), (0.0, 0.0, 0.0)
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


def _vertices_of_floats(array: npt.NDArray[Any], what: str) -> Ints:
    """Whole numbers that came as floats, out of a file or a table: vertices, but never what could be a position."""
    if array.ndim > 1 or array.shape == (3,):
        raise BrushfireTypeError(
            f"{what}: {array.dtype} of shape {array.shape} could be a position: bf.at(...) says so, integers are vertices"
        )
    if not whole_numbers(array):
        bad = array.ravel()[~(array.ravel() == np.floor(array.ravel())) | ~np.isfinite(array.ravel())]
        raise BrushfireTypeError(f"{what}: vertices are whole numbers, not {bad[0] if bad.size else array.ravel()[0]}")
    return array.astype(np.int64)


def _mask(array: npt.NDArray[Any], vertex_count: int, what: str) -> PlaceArrays:
    if array.shape != (vertex_count,):
        raise BrushfireError(f"{what}: a mask needs one bool per vertex, shape ({vertex_count},), not {array.shape}")
    return PlaceArrays(np.flatnonzero(array).astype(np.int64), None)


def is_one(places: Any) -> bool:
    """Whether a single place is meant rather than a list of one."""
    if isinstance(places, (Point, float, np.floating)):
        return True
    # Arrays of any size have an __index__ in some libraries.
    return not isinstance(places, np.ndarray) and hasattr(places, "__index__") and getattr(places, "ndim", 0) == 0


def place_arrays(places: Any, vertex_count: int, what: str) -> PlaceArrays:
    """Any spelling of places, as arrays."""
    if isinstance(places, PlaceArrays):
        return places
    if isinstance(places, Points):
        return _points(places, what)
    if is_one(places):
        return _listed([places], what)
    if is_loose(places):
        places = listed(places)
    if isinstance(places, (list, tuple, range)) and any(isinstance(item, Point) for item in places):
        return _listed(places, what)
    array = any_array(places, what)
    if array.dtype.kind == "O" and array.ndim:
        return _listed(array.ravel().tolist(), what)
    if array.dtype == np.bool_:
        return _mask(array, vertex_count, what)
    if array.dtype.kind == "f" and array.size:
        array = _vertices_of_floats(array, what)
    index = integers(array, what)
    if index.ndim == 0:
        index = index.reshape(1)
    if index.ndim != 1:
        raise BrushfireError(f"{what}: shape (k,) is needed, not {index.shape}")
    return PlaceArrays(index, None)
