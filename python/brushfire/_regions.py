"""Parts of a mesh: Voronoi cells, farthest-point samples, barriers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Ints, Labels, whole
from brushfire._curves import Path, path_of
from brushfire._errors import BrushfireError
from brushfire._options import Tolerance, options
from brushfire._places import Places, Points
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of
from brushfire._weighted import Weighing, chosen_in

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


class Border(NamedTuple):
    """Where the cells of two sources meet; ``sources``: their positions in the list, the lower first."""

    sources: tuple[int, int]
    line: Path


@dataclass(frozen=True)
class Voronoi:
    """Which source is nearest where.

    ``distance`` (vertex_count,): from the nearest source, +inf where none reaches. ``source`` (vertex_count,): its
    position in the list, -1 for none. ``area`` (sources,): of each cell. ``borders``: where cells meet, ascending.
    ``dual`` (k, 3): three cells that meet in a face, each once: a triangulation of the sources.
    """

    distance: Floats
    source: Labels
    area: Floats
    borders: list[Border]
    dual: Labels

    def __repr__(self) -> str:
        return f"Voronoi({len(self.area)} cells, {len(self.borders)} borders)"


@dataclass(frozen=True)
class Samples:
    """Vertices spread evenly over a mesh.

    ``vertices`` (k,): in the order in which they were taken. ``separation`` (k,): how far each was from those before it,
    +inf for the first. ``distance`` (vertex_count,): from the nearest sample. ``nearest`` (vertex_count,): its place in
    ``vertices``, -1 for none. ``covering_radius``: the greatest distance of a vertex that is in a face.
    """

    vertices: Labels
    separation: Floats
    distance: Floats
    nearest: Labels
    covering_radius: float

    def __repr__(self) -> str:
        return f"Samples({len(self.vertices)} vertices, covering radius {self.covering_radius:.6g})"


@dataclass(frozen=True)
class Cut:
    """A mesh with barriers cut out, and the way back.

    ``mesh``: vertex v of the original is vertex v here; where a barrier parts the faces around a vertex, further copies
    of it follow behind. ``original_vertex`` (mesh.vertex_count,), ``original_face`` (mesh.face_count,): their numbers
    in the original. ``cut_face`` (original faces,): the number of each face here, -1 where it is blocked.
    """

    mesh: Mesh
    original_vertex: Labels
    original_face: Labels
    cut_face: Labels
    _original: Mesh
    _cut: _core.CutMesh

    def __repr__(self) -> str:
        return f"Cut({self._original!r} into {self.mesh!r})"

    def to_original(self, values: npt.ArrayLike) -> Floats:
        """Values per vertex here to values per vertex of the original: the least of the copies'.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> cut = mesh.cut(edges=[(0, 2)])
        >>> cut.to_original(cut.mesh.distance(1, method="exact")).tolist()
        [3.0, 0.0, 4.0, inf]
        """
        array = _arrays.floats(values, "values")
        if array.shape != (self.mesh.vertex_count,):
            raise BrushfireError(f"values: shape ({self.mesh.vertex_count},) is needed, not {array.shape}")
        return self._cut.values_to_original(array)

    def points_to_original(self, points: Places) -> Points:
        """Points here as points of the original mesh.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> cut = mesh.cut(faces=[0])
        >>> cut.points_to_original(bf.Point(0, (0.2, 0.3, 0.5))).face.tolist()
        [1]
        """
        arrays = self.mesh._arrays(points, "points")
        return Points(*self._cut.points_to_original(arrays.index, arrays.weights))

    def points_from_original(self, points: Places) -> tuple[Points, Labels]:
        """Points of the original mesh as points here: one per side of a slit, none in a blocked face.

        :return: the points, and which of the given ones each of them is, (k,).

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> cut = mesh.cut(edges=[(0, 2)])
        >>> points, origin = cut.points_from_original([1, 2])
        >>> origin.tolist()
        [0, 1, 1]
        """
        arrays = self._original._arrays(points, "points")
        face, weights, origin = self._cut.points_from_original(self._original._mesh, arrays.index, arrays.weights)
        return Points(face, weights), origin


def voronoi(
    mesh: Mesh,
    sources: Sources,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    threads: int = 1,
    offset: npt.ArrayLike = 0.0,
    radius: float = np.inf,
    weights: Weighing | None = None,
    progress: Progress = None,
) -> Voronoi:
    """The geodesic Voronoi diagram: which source is nearest where, the borders in between, the area of each cell.

    :param sources, method, tolerance, bound, precision, threads, offset, radius, progress: as for :meth:`distance`.
    :param weights: what going costs, in place of distances: :meth:`weighted`, or one number per face.
    :raises BrushfireError: as :meth:`distance` does.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 2], [0, 2, 3]])
    >>> cells = mesh.voronoi([0, 1], method="exact")
    >>> cells.source.tolist(), cells.area.sum().item(), cells.borders[0].sources
    ([0, 1, 1, 0], 4.0, (0, 1))
    """
    start = sources_of(mesh, sources, offset)
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision, threads)
    with shown(progress, "voronoi") as report:
        found = _core.voronoi(space, start, chosen, report)
    distance, source, area, borders, dual = found
    return Voronoi(distance, source, area, [Border((a, b), path_of(mesh, line)) for a, b, line in borders], dual)


def farthest_points(
    mesh: Mesh,
    count: int,
    first: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    threads: int = 1,
    radius: float = np.inf,
    weights: Weighing | None = None,
    progress: Progress = None,
) -> Samples:
    """Farthest-point sampling: again and again the vertex that is farthest from all samples so far.

    :param count: how many; fewer where every vertex is a sample before.
    :param first: vertices to begin with; the lowest vertex that is in a face if none are given.
    :param method, tolerance, bound, precision, threads, radius, progress: as for :meth:`distance`.
    :param weights: what going costs, in place of distances: :meth:`weighted`, or one number per face.
    :raises BrushfireError: for a first vertex that is in no face or repeats, and for more of them than ``count``.

    Runs are limited to what still matters: all together they cost about log(count) whole fields.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> samples = mesh.farthest_points(3, method="exact")
    >>> samples.vertices.tolist(), samples.separation.tolist(), samples.covering_radius
    ([0, 2, 1], [inf, 5.0, 3.0], 3.0)
    """
    index = np.zeros(0, dtype=np.int64)
    if first is not None:
        arrays = mesh._arrays(first, "first")
        if arrays.weights is not None and arrays.weights.any():
            raise BrushfireError("first: vertices are needed, not points of faces")
        index = arrays.index
    taken = whole(count, "count", np.iinfo(np.int32).max)
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision, threads)
    with shown(progress, "farthest points") as report:
        return Samples(*_core.farthest_points(space, taken, index, chosen, report))


def cut(mesh: Mesh, *, vertices: npt.ArrayLike = (), faces: npt.ArrayLike = (), edges: npt.ArrayLike = ()) -> Cut:
    """The mesh with barriers cut out, through which no distance and no path goes: these and the walls that it has.

    :param vertices: numbers, or a mask with one bool per vertex: nothing passes them, all their faces are blocked.
    :param faces: numbers, or a mask with one bool per face: nothing enters them.
    :param edges: (k, 2) vertex numbers: both sides can be reached, nothing crosses.
    :return: a :class:`Cut`, whose ``mesh`` is the rest.
    :raises BrushfireIndexError: for what does not exist.
    :raises BrushfireError: for two vertices that no edge joins.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.cut(edges=[(0, 2)]).mesh, mesh.cut(faces=[0]).mesh
    (Mesh(6 vertices, 2 faces), Mesh(4 vertices, 1 faces))
    """
    made = _core.cut(mesh._mesh, *with_walls_of(mesh, barriers(mesh, vertices, faces, edges)))
    return Cut(mesh._of(made.mesh), made.original_vertex(), made.original_face(), made.cut_face(), mesh, made)


def with_walls_of(mesh: Mesh, blocked: tuple[Ints, Ints, Ints]) -> tuple[Ints, Ints, Ints]:
    if mesh._walls is None:
        return blocked
    vertices, faces, ends = (np.concatenate(pair) for pair in zip(mesh._walls, blocked, strict=True))
    return vertices, faces, ends


def barriers(mesh: Mesh, vertices: Any, faces: Any, edges: Any) -> tuple[Ints, Ints, Ints]:
    ends = _arrays.integers(edges, "edges")
    if ends.size and (ends.ndim != 2 or ends.shape[1] != 2):
        raise BrushfireError(f"edges: shape (k, 2) is needed, not {ends.shape}")
    return (
        _arrays.numbers(vertices, mesh._mesh.vertex_count, "vertices"),
        _arrays.numbers(faces, mesh._mesh.face_count, "faces"),
        ends.reshape(-1),
    )
