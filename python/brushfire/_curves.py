"""Curves on a mesh: shortest, shortened and straightest paths, and directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Ints, Labels, number, radius_of
from brushfire._errors import BrushfireError
from brushfire._places import Places, Points
from brushfire._sources import Sources, sources_of, without_points
from brushfire._surface import Surface


@dataclass(frozen=True, eq=False)
class Path:
    """A polyline on the surface; straight between consecutive points, which share a face.

    ``points``: its nodes as :class:`Points`; none where there is no path. ``positions``: the same in coordinates, (k, 3);
    (0, 3) for a mesh from lengths. ``length``: in the mesh's units, +inf where there is no path. ``closed``: whether it
    goes on from its last point to its first.
    """

    points: Points
    positions: Floats
    length: float
    closed: bool = False
    _mesh: _core.Mesh | None = field(default=None, repr=False, compare=False)

    def __repr__(self) -> str:
        return f"Path({len(self.points)} points, length {self.length:.6g}{', closed' if self.closed else ''})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Path):
            return NotImplemented
        return self.points == other.points and self.length == other.length and self.closed == other.closed

    def __hash__(self) -> int:
        return hash((len(self.points), self.length, self.closed))

    def __reduce__(self) -> tuple[type[Path], tuple[Any, ...]]:
        return Path, (self.points, self.positions, self.length, self.closed)


@dataclass(frozen=True)
class LogMap:
    """Polar coordinates of every vertex around a source.

    ``radius`` (vertex_count,): the exact distance. ``angle`` (vertex_count,): the direction in which the shortest path
    leaves the source, NaN where there is none. ``total_angle``: the full turn at the source. ``uv`` (vertex_count, 2):
    the same in Cartesian coordinates, NaN where there are none: u along the direction that was asked for (or the first
    edge), v counter-clockwise of it; what is all around a vertex is stretched to 2 pi. ``vertices``: None, or with
    ``sparse=True`` the numbers of those that are reached, (k,), of which the arrays speak then.
    """

    radius: Floats
    angle: Floats
    total_angle: float
    uv: Floats
    vertices: Labels | None = None
    _mesh: _core.Mesh | None = field(default=None, repr=False, compare=False)

    def __reduce__(self) -> tuple[type[LogMap], tuple[Any, ...]]:
        return LogMap, (self.radius, self.angle, self.total_angle, self.uv, self.vertices)

    def __repr__(self) -> str:
        return f"LogMap({np.isfinite(self.radius).sum()} of {len(self.radius)} vertices reached)"


def path_of(mesh: Surface, arrays: _core.PathArrays) -> Path:
    face, weights, length, closed = arrays
    if mesh._mesh.has_positions:
        positions = mesh._mesh.positions(face.astype(np.int64), weights)
    else:
        positions = np.zeros((0, 3))
    return Path(Points(face, weights), positions, length, closed, mesh._mesh)


def _joined(mesh: Surface, places: Sequence[Any], what: str) -> tuple[Ints, Floats]:
    """Index and weights of all of them, one after the other."""
    arrays = [mesh._arrays(place, what) for place in places]
    if not arrays:
        raise BrushfireError(f"{what}: at least one place is needed")
    index = np.concatenate([a.index for a in arrays])
    weights = np.concatenate([np.zeros((len(a.index), 3)) if a.weights is None else a.weights for a in arrays])
    return index, weights


def path(mesh: Surface, *places: Places, closed: bool = False, tighten: bool = False, radius: float = np.inf) -> Path:
    """The shortest path from a place to the next, exactly: ``path(a, b)``, or through all that are given.

    :param places: vertices, points, or lists of them, in order.
    :param closed: also from the last back to the first.
    :param tighten: pull the path straight afterwards where it bends at the places between: see :meth:`shorten`.
    :param radius: a path that is longer is none.
    :return: a :class:`Path`, from the first place to the last; without points and of length +inf where there is none.
    :raises BrushfireError: for no places, and for places in no face.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> path = mesh.path(1, 3)
    >>> path.length, path.positions.round(6).tolist()
    (5.0, [[3.0, 0.0, 0.0], [1.5, 2.0, 0.0], [0.0, 4.0, 0.0]])
    >>> mesh.path(1, 0, 3).length, mesh.path(1, 0, 3, tighten=True).length
    (7.0, 5.0)
    """
    index, weights = _joined(mesh, places, "places")
    return path_of(mesh, _core.path(mesh._run(), index, weights, bool(closed), bool(tighten), radius_of(radius)))


def paths(
    mesh: Surface, sources: Sources, targets: Places, *, offset: npt.ArrayLike = 0.0, radius: float = np.inf
) -> tuple[list[Path], Any]:
    """The shortest path to every target from the source that is nearest to it, all off one exact field.

    :param sources, offset: as for :meth:`distance`.
    :param targets: vertices or points.
    :param radius: where the distance is greater there is no path.
    :return: one :class:`Path` per target, from source to target, and the position in ``sources`` of each one's
        source, int32 (targets,), -1 where none reaches.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> paths, source = mesh.paths([0, 1], [3, 2])
    >>> [p.length for p in paths], source.tolist()
    ([4.0, 4.0], [0, 1])
    """
    start, end = sources_of(mesh, sources, offset), mesh._arrays(targets, "targets")
    source, found = _core.paths(
        mesh._run(),
        start,
        end.index,
        end.weights,
        radius_of(radius),
    )
    return [path_of(mesh, p) for p in found], source


def edge_path(mesh: Surface, sources: Places, target: int, *, offset: npt.ArrayLike = 0.0) -> Path:
    """The shortest path along edges from the nearest of the sources to a vertex: what method ``"dijkstra"`` measures.

    :param sources, offset: as for :meth:`distance`.
    :raises BrushfireIndexError: for a target that does not exist.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> path = mesh.edge_path(1, 3)
    >>> path.length, path.positions.tolist()
    (7.0, [[3.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
    """
    start, end = sources_of(mesh, sources, offset), mesh._arrays(target, "target")
    if end.index.shape != (1,) or end.weights is not None and end.weights.any():
        raise BrushfireError("target: a single vertex is needed")
    return path_of(mesh, _core.edge_path(mesh._run(), start, int(end.index[0])))


def shorten(mesh: Surface, path: Path | Points | Sequence[Places], *, closed: bool | None = None) -> Path:
    """A polyline pulled straight like a rubber band: the shortest path that it can be moved into on the surface.

    It keeps its way around handles and holes, so it need not be the shortest of all. The ends stay where they are; a
    closed one is held nowhere, and one that can be pulled together becomes a single point of length 0.

    :param path: a :class:`Path`, or points of which consecutive ones share a face.
    :param closed: whether it goes on from the last point to the first; that of the path if not given.
    :raises BrushfireError: for consecutive points that share no face, and for none at all.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.shorten([1, 2, 3]).length
    5.0
    """
    index, weights, is_closed = _polyline(mesh, path, closed)
    return path_of(mesh, _core.shorten(mesh._space, index, weights, is_closed))


def length_of(mesh: Surface, path: Path | Points | Sequence[Places], *, closed: bool | None = None) -> float:
    """The length of a polyline whose consecutive points share a face, in the mesh's units.

    :param path, closed: as for :meth:`shorten`.
    :raises BrushfireError: for consecutive points that share no face.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.length_of([0, 1, 2]), mesh.length_of([0, 1, 2], closed=True)
    (7.0, 12.0)
    """
    index, weights, is_closed = _polyline(mesh, path, closed)
    return _core.length_of(mesh._mesh, index, weights, is_closed)


def _polyline(mesh: Surface, path: Any, closed: bool | None) -> tuple[Ints, Floats | None, bool]:
    if isinstance(path, Path):
        closed = path.closed if closed is None else closed
        if len(path.points) == 0:
            raise BrushfireError(f"path: {without_points(path)}")
        path = path.points
    arrays = mesh._arrays(path, "path")
    return arrays.index, arrays.weights, bool(closed)


def trace(mesh: Surface, start: Places, direction: npt.ArrayLike, length: float) -> tuple[Path, str]:
    """Straight on from a point, for a length: the straightest geodesic, which is the exponential map.

    :param direction: an angle (radians, counter-clockwise from the face's first edge, or at a vertex from the edge of
        its first face), or a vector in space, (3,), which is projected onto the surface.
    :return: the path, and how it ended: ``"length"``, ``"boundary"`` or ``"non-manifold"``.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> path, end = mesh.trace(0, [1, 1, 0], 2.0)
    >>> path.positions[-1].round(6).tolist(), end
    ([1.414214, 1.414214, 0.0], 'length')
    """
    arrays = mesh._arrays(start, "start")
    vector = _arrays.floats(direction, "direction")
    angle, along = (float(vector), None) if vector.ndim == 0 else (0.0, vector)
    if along is not None and along.shape != (3,):
        raise BrushfireError(f"direction: an angle or shape (3,) is needed, not {along.shape}")
    walked, end = _core.trace(mesh._space, arrays.index, arrays.weights, angle, along, number(length, "length"))
    return path_of(mesh, walked), end


def angle_of(mesh: Surface, place: Places, direction: npt.ArrayLike) -> tuple[float, float]:
    """A direction in space as an angle at a place, as :meth:`trace` and :meth:`log_map` count it.

    :param direction: (3,), projected onto the surface; not 0.
    :return: the angle, and the full turn at the place: 2 pi inside a face, the sum of the angles at a vertex.
    :raises BrushfireError: for a mesh from lengths, and for a direction of length 0.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> [round(a, 6) for a in mesh.angle_of(0, [1, 1, 0])]
    [0.785398, 1.570796]
    """
    arrays = mesh._arrays(place, "place")
    vector = _arrays.floats(direction, "direction")
    if vector.shape != (3,):
        raise BrushfireError(f"direction: shape (3,) is needed, not {vector.shape}")
    return _core.angle_of(mesh._space, arrays.index, arrays.weights, vector.reshape(1, 3))


def log_map(
    mesh: Surface,
    source: Places,
    radius: float = np.inf,
    *,
    direction: npt.ArrayLike | None = None,
    sparse: bool = False,
) -> LogMap:
    """Polar coordinates around a source: exact distance, and the direction of the shortest path.

    :param radius: what is farther reads +inf and NaN.
    :param direction: where angle 0 points, in space, (3,), laid onto the surface; angles then run counter-clockwise.
        Without one they are as :meth:`trace` counts them.
    :param sparse: only of the vertices that are reached: see :class:`LogMap`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> polar = mesh.log_map(0)
    >>> polar.radius.round(3).tolist(), (polar.angle / polar.total_angle).round(3).tolist()
    ([0.0, 1.0, 1.414, 1.0], [0.0, 0.0, 0.5, 1.0])
    >>> (mesh.log_map(0, direction=[0, 1, 0]).uv.round(3) + 0.0).tolist()
    [[0.0, 0.0], [0.0, -1.0], [1.0, -1.0], [1.0, 0.0]]
    """
    arrays = mesh._arrays(source, "source")
    limit = radius_of(radius)
    along = None if direction is None else _arrays.floats(direction, "direction")
    if along is not None and along.shape != (3,):
        raise BrushfireError(f"direction: shape (3,) is needed, not {along.shape}")
    vertices, r, angle, total, uv = _core.log_map(
        mesh._run(), arrays.index, arrays.weights, limit, None if along is None else along.reshape(1, 3)
    )
    if sparse:
        return LogMap(r, angle, total, uv, vertices, mesh._mesh)
    every = np.full((2, mesh._mesh.vertex_count), ((np.inf,), (np.nan,)))
    every[:, vertices] = r, angle
    flat = np.full((mesh._mesh.vertex_count, 2), np.nan)
    flat[vertices] = uv
    return LogMap(every[0], every[1], total, flat, None, mesh._mesh)
