"""Where distances start from: places, and whole curves."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, Ints, floats, integers, offsets
from brushfire._errors import BrushfireError, BrushfireTypeError
from brushfire._foreign import is_loose, listed
from brushfire._places import PlaceArrays, Places, Points, is_one

if TYPE_CHECKING:
    from brushfire._boundaries import Boundary
    from brushfire._curves import Path
    from brushfire._fields import Isoline
    from brushfire._regions import Border


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve on the surface as a source: distances start from all of it, from its true segments and not from samples.

    :param places: in order, each joined to the next by the straight segment within a face that holds both: vertices (by
        edges), points of faces and edges. :meth:`Mesh.path`, :meth:`Mesh.curve_along` and :meth:`Mesh.project_curve` make
        such curves of ends, of vertices and of polylines in space; what they return is a source as it is.
    :param closed: the last place is joined to the first.
    :param offset: values that the front starts with, linear in between: one for each place, or one number. Neighbours
        differ by no more than they are apart.
    :param starts: where in ``places`` pieces begin that are not joined to what stands before them.
    :param inside: faces that belong to the source with all their points: of a region (:meth:`Mesh.region`).

    Among several sources a curve is one, with one number in ``return_source``. What is not on the mesh, or shares no face
    with the next, is an error where the curve is used.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.distance(bf.Curve([0, 1])).round(9).tolist()
    [0.0, 0.0, 4.0, 4.0]
    >>> d, source = mesh.distance([bf.Curve([0, 1], offset=1.0), 2], return_source=True)
    >>> d.round(9).tolist(), source.tolist()
    ([1.0, 1.0, 0.0, 3.0], [0, 0, 1, 1])
    """

    places: Places
    closed: bool = False
    offset: npt.ArrayLike = 0.0
    starts: npt.ArrayLike = (0,)
    inside: npt.ArrayLike = ()

    def __repr__(self) -> str:
        places: Any = self.places
        count = 1 if is_one(places) else len(places) if hasattr(places, "__len__") else "some"
        pieces = np.size(self.starts)
        return f"Curve({count} places{f' in {pieces} pieces' if pieces > 1 else ''}{', closed' if self.closed else ''})"


Sources: TypeAlias = "Places | Curve | Path | Isoline | Border | Boundary | Iterable[Any]"
"""Places, or curves (a :class:`Curve`, :class:`Path`, :class:`Isoline`, :class:`Border`, :class:`Boundary`), or several."""


def without_points(path: Any) -> str:
    """What a path is that has none: for messages."""
    if len(getattr(path, "positions", ())):
        return "a path in space alone: read_lines() with its mesh says where on the surface it lies"
    return "a path without points, where no way leads"


def curve_of(item: Any) -> Curve | None:
    """What of the package's objects is a curve; None for everything else."""
    if isinstance(item, Curve):
        return item
    item = getattr(item, "line", item)  # of an Isoline or a Border
    points, closed = getattr(item, "points", None), getattr(item, "closed", None)
    if isinstance(points, Points) and isinstance(closed, bool):
        if len(points) == 0:
            raise BrushfireError(f"sources: {without_points(item)}")
        return Curve(points, closed)
    vertices = getattr(item, "vertices", None)
    if isinstance(vertices, np.ndarray) and isinstance(closed, bool):  # a Boundary
        return Curve(vertices, closed)
    return None


def sources_of(owner: Any, sources: Any, offset: npt.ArrayLike = 0.0) -> _core.Sources:
    """As the core takes them. ``owner`` is the mesh or solver: its ``_arrays`` reads places."""
    one = curve_of(sources)
    if one is not None:
        return _made(owner, _none(), [(0, one)], offset)
    if is_loose(sources):
        sources = listed(sources)
    if not isinstance(sources, (list, tuple)):
        return _made(owner, owner._arrays(sources, "sources"), [], offset)
    curves = [(i, curve) for i, curve in enumerate(map(curve_of, sources)) if curve is not None]
    if not curves:
        return _made(owner, owner._arrays(sources, "sources"), [], offset)
    numbers = {i for i, _ in curves}
    places = [item for i, item in enumerate(sources) if i not in numbers]
    return _made(owner, _of_singles(owner, places), curves, offset)


def _none() -> PlaceArrays:
    return PlaceArrays(np.zeros(0, dtype=np.int64), None)


def _of_singles(owner: Any, places: list[Any]) -> PlaceArrays:
    """Beside curves every item is one source."""
    if not places:
        return _none()
    arrays = [owner._arrays(place, "sources") for place in places]
    for place, array in zip(places, arrays, strict=True):
        if len(array.index) != 1:
            raise BrushfireTypeError(
                f"sources: beside curves each item is one place, not {type(place).__name__} of {len(array.index)} "
                "(bf.Curve(...) joins places)"
            )
    weights = [np.zeros((1, 3)) if a.weights is None else a.weights for a in arrays]
    return PlaceArrays(np.concatenate([a.index for a in arrays]), np.concatenate(weights))


def _made(owner: Any, places: PlaceArrays, curves: list[tuple[int, Curve]], offset: npt.ArrayLike) -> _core.Sources:
    given = offsets(offset, len(places.index) + len(curves))
    arrays = [(position, *_curve_arrays(owner, curve)) for position, curve in curves]
    return _core.make_sources(owner._mesh, places.index, places.weights, given, arrays)


def _curve_arrays(owner: Any, curve: Curve) -> tuple[Ints, Floats | None, Ints, bool, Floats | None, Ints]:
    places = owner._arrays(curve.places, "Curve: places")
    starts = np.unique(np.asarray(curve.starts, dtype=np.int64).reshape(-1))
    if len(starts) == 0 or starts[0] != 0 or starts[-1] >= max(1, len(places.index)):
        raise BrushfireError(f"Curve: starts run from 0 to less than the number of places, {len(places.index)}")
    value = floats(curve.offset, "Curve: offset")
    inside = integers(curve.inside, "Curve: inside").reshape(-1)
    if value.ndim == 0 and value == 0:
        return places.index, places.weights, starts, bool(curve.closed), None, inside
    each = np.full(len(places.index), value) if value.ndim == 0 else value
    if each.shape != (len(places.index),):
        raise BrushfireError(f"Curve: offset: one per place is needed, shape ({len(places.index)},), not {each.shape}")
    return places.index, places.weights, starts, bool(curve.closed), np.ascontiguousarray(each), inside
