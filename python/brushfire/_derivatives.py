"""Derivatives of distances by the positions of vertices and of sources."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import Floats, Labels, any_array, floats, integer, number, offsets
from brushfire._errors import BrushfireError
from brushfire._options import options
from brushfire._places import Places
from brushfire._progress import Progress, shown

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


@dataclass(frozen=True, eq=False)
class DistanceGradient:
    """How a weighted sum of distances changes.

    ``vertices`` (vertex_count, 3): per unit of length that a vertex moves; a source moves with its face, at a vertex with
    the vertex. ``places`` (sources, 3): per unit of length that a source moves within its face, a vector in the plane of
    the face; NaN for a source at a vertex, where the rate is no linear function of the direction. ``offsets``
    (sources,): per unit of the source's offset.
    """

    vertices: Floats
    places: Floats
    offsets: Floats


@dataclass(frozen=True, eq=False)
class PathLength:
    """How the length of one shortest path changes when vertices move; what
    :meth:`DifferentiableDistance.path_length` returns.

    ``length``: in the mesh's units. ``vertices`` (k,): the ones that it depends on. ``gradient`` (k, 3): per unit of
    length that each moves. ``one_sided``: whether second derivatives depend on the direction, because another path is
    as short (the cut locus), or because this one goes straight on through a vertex that it may pass on either side.
    """

    length: float
    vertices: Labels
    gradient: Floats
    one_sided: bool
    _path: _core.PathLength = field(repr=False)

    def hessian(self) -> Floats:
        """All second derivatives, (3 k, 3 k), symmetric: x, y and z of ``vertices[0]``, then of the next."""
        return self._path.hessian()

    def hessian_times(self, moves: npt.ArrayLike) -> Floats:
        """How the gradient changes while ``vertices`` move by ``moves``, (k, 3): in time that grows with k only."""
        given = floats(moves, "moves")
        if given.shape != self.gradient.shape:
            raise BrushfireError(f"moves: shape {self.gradient.shape} is needed, not {given.shape}")
        return self._path.hessian_times(given)


@dataclass(frozen=True, eq=False)
class DifferentiableDistance:
    """A distance field and its derivatives; what :meth:`Mesh.distance_vjp` returns.

    ``distance`` (vertex_count,): exact. ``source`` (vertex_count,): which source is nearest, -1 where none is.
    """

    distance: Floats
    source: Labels
    _field: _core.TracedField = field(repr=False)
    _tied: dict[float, npt.NDArray[np.bool_]] = field(default_factory=dict, repr=False)

    def vjp(self, upstream: npt.ArrayLike) -> DistanceGradient:
        """The gradient of ``sum(upstream * distance)``, by one backward sweep over the paths.

        :param upstream: (vertex_count,), finite. Vertices that no source reaches count nothing.

        Exact but for rounding. Where several shortest paths lead to a vertex (:meth:`one_sided`) the rate depends on the
        direction, and one path's gradient is given.
        """
        weights = floats(upstream, "upstream")
        if weights.shape != self.distance.shape:
            raise BrushfireError(f"upstream: shape {self.distance.shape} is needed, not {weights.shape}")
        return DistanceGradient(*self._field.gradient(weights))

    def one_sided(self, tie: float = 1e-9) -> npt.NDArray[np.bool_]:
        """Which vertices lie on the cut locus, (vertex_count,): another path, from another direction, is as long.

        :param tie: what "as long" means, as a share of the distance, >= 0.

        Told by the paths of the neighbours; a second path that is no neighbour's (on meshes of a few faces) is missed.
        """
        share = number(tie, "tie")
        if share not in self._tied:
            self._tied[share] = self._field.one_sided(share).astype(bool)
        return self._tied[share].copy()

    def path_length(self, target: int, tie: float = 1e-9) -> PathLength:
        """The length of the shortest path to a vertex, with first and second derivatives by the vertices' positions.

        :param target: a vertex that a source reaches.
        :param tie: as for :meth:`one_sided`.

        Exact: where the path crosses edges is eliminated. A source within a face keeps its weights there; its offset
        is no part of the length.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> path = mesh.distance_vjp(1).path_length(3)
        >>> path.length, path.vertices.tolist()
        (5.0, [0, 1, 2, 3])
        >>> path.hessian_times([[0, 0, 0], [0, 0, 0], [0, 0, 0], [4, 3, 0]])[3].round(12).tolist()  # across: 5 / length
        [0.8, 0.6, 0.0]
        """
        path = self._field.path_length(integer(target, "target"))
        one_sided = path.is_one_sided() or bool(self.one_sided(tie)[target])
        return PathLength(path.length(), path.vertices(), path.gradient(), one_sided, path)


def distance_vjp(
    mesh: Mesh,
    sources: Places,
    *,
    offset: npt.ArrayLike = 0.0,
    radius: float = np.inf,
    threads: int = 1,
    progress: Progress = None,
) -> DifferentiableDistance:
    """Exact distances, and a backward pass through them: as learning and optimisation want it.

    :param sources, offset, radius, threads, progress: as for :meth:`Mesh.distance`. Beyond the radius nothing counts.
    :return: :class:`DifferentiableDistance`: ``distance``, and ``vjp(upstream)``, the gradient of a weighted sum by
        the positions of all vertices, the places of the sources and their offsets.
    :raises BrushfireError: as :meth:`Mesh.distance` does; and, by ``vjp``, for a mesh from lengths.

    ``brushfire.torch`` and ``brushfire.jax`` build on this.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> field = mesh.distance_vjp(1)
    >>> field.distance.tolist()
    [3.0, 0.0, 4.0, 5.0]
    >>> (field.vjp([0, 0, 0, 5]).vertices.round(12) + 0.0).tolist()
    [[0.0, 0.0, 0.0], [3.0, -4.0, 0.0], [0.0, 0.0, 0.0], [-3.0, 4.0, 0.0]]
    """
    start = mesh._arrays(sources, "sources")
    chosen = options("exact", None, radius, threads=threads)
    with shown(progress, "distance") as report:
        found = _core.traced_field(
            mesh._run(), start.index, start.weights, offsets(offset, len(start.index)), chosen, report
        )
    return DifferentiableDistance(*found)


def weighted_places(sources: Any, weights: Any) -> tuple[npt.NDArray[np.int64], Floats | None]:
    """Numbers of vertices; with weights, of faces, and where in them, (k, 3). For the doors of other libraries."""
    index = np.atleast_1d(any_array(sources, "sources"))
    if index.dtype.kind not in "iu" or index.ndim != 1:
        raise BrushfireError("sources: numbers are needed, of vertices, or of faces where weights are given")
    if weights is None:
        return index.astype(np.int64), None
    places = floats(weights, "weights")
    if places.shape != (len(index), 3):
        raise BrushfireError(f"weights: shape ({len(index)}, 3) is needed, not {places.shape}")
    return index.astype(np.int64), places
