"""How large a mesh is and where its middle lies, by its own distances."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, number, whole
from brushfire._options import Options, Tolerance, options, thread_count
from brushfire._places import Places, Points
from brushfire._progress import Progress, shown

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


_MOST = int(np.iinfo(np.int32).max)


@dataclass(frozen=True)
class Extent:
    """How large a mesh is by its own distances, between vertices; of the component with the greatest diameter.

    ``diameter_lower`` <= diameter <= ``diameter_upper``, where the lower one is the distance of the vertices ``pair``;
    ``radius_lower`` <= radius <= ``radius_upper``, where the upper one is how far the farthest vertex is from
    ``centre``. ``runs``: exact fields that it took.
    """

    diameter_lower: float
    diameter_upper: float
    pair: tuple[int, int]
    radius_lower: float
    radius_upper: float
    centre: int
    runs: int


class Discs(NamedTuple):
    """Geodesic discs: ``radius``, ``perimeter`` and ``area`` of each, (places,); +inf, 0 and 0 where there is none."""

    radius: Floats
    perimeter: Floats
    area: Floats


class Mean(NamedTuple):
    """Karcher's mean: ``point`` as :class:`Points` of one; ``deviation``, the root of the mean squared distance."""

    point: Points
    deviation: float
    converged: bool


def extent(
    mesh: Mesh, *, within: float = 1e-9, most_runs: int = 0, threads: int = 1, progress: Progress = None
) -> Extent:
    """Diameter, radius and centre, with bounds that hold.

    :param within: how near the bounds come to each other, as a share.
    :param most_runs: exact fields at most, with the bounds reached by then; 0: as many as it takes, which on surfaces
        as round as a sphere is one per vertex.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> e = mesh.extent()
    >>> e.diameter_lower, e.diameter_upper, e.pair, e.radius_upper
    (5.0, 5.0, (0, 2), 5.0)
    """
    with shown(progress, "extent") as report:
        found = _core.extent(
            mesh._space,
            number(within, "within"),
            whole(most_runs, "most_runs", _MOST),
            thread_count(threads),
            report,
        )
    return Extent(**found)


def eccentricity(
    mesh: Mesh,
    places: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    radius: float = np.inf,
    threads: int = 0,
    progress: Progress = None,
) -> Floats:
    """How far the vertex is that is farthest from each place, of those that can be reached: (places,).

    :param places: every vertex if none are given.
    :param method, tolerance, bound, precision, radius, progress: as for :meth:`distance`; one field per place.
    :param threads: that share out the places; 0 means one per processor.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.eccentricity(method="exact").tolist()
    [5.0, 5.0, 5.0, 5.0]
    """
    chosen = options(method, tolerance, radius, bound, precision)
    return _measured(mesh, _core.eccentricities, places, chosen, threads, progress, "eccentricity")


def average_distance(
    mesh: Mesh,
    places: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    radius: float = np.inf,
    threads: int = 0,
    progress: Progress = None,
) -> Floats:
    """The mean distance of the surface from each place, by area: (places,). Arguments as for :meth:`eccentricity`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh.average_distance(1, method="exact").round(6).tolist()
    [3.166667]
    """
    chosen = options(method, tolerance, radius, bound, precision)
    return _measured(mesh, _core.average_distances, places, chosen, threads, progress, "average distance")


def discs(
    mesh: Mesh,
    share: float,
    places: Places | None = None,
    *,
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    radius: float = np.inf,
    threads: int = 0,
    progress: Progress = None,
) -> Discs:
    """The geodesic disc around each place that holds a share of the surface (of the place's component).

    :param share: in (0, 1]: 0.05 is 5 %.
    :param places, method, tolerance, bound, precision, radius, threads, progress: as for :meth:`eccentricity`.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> [float(x.round(6)[0]) for x in mesh.discs(1, 0, method="exact")]
    [5.0, 0.0, 12.0]
    """
    index, weights = _given(mesh, places)
    chosen = options(method, tolerance, radius, bound, precision)
    with shown(progress, "discs") as report:
        found = _core.discs(mesh._space, number(share, "share"), index, weights, chosen, thread_count(threads), report)
    return Discs(*found)


def karcher_mean(mesh: Mesh, places: Places, weights: npt.ArrayLike | None = None, *, tolerance: float = 1e-6) -> Mean:
    """The point with the least weighted sum of squared distances from the places: their mean on the surface.

    :param places: vertices or points.
    :param weights: how much each counts, (k,), >= 0; all alike if not given.
    :param tolerance: stop where the next step is shorter than this share of the mean distance.

    Found by walking down along the mean of the logarithmic map; of points all over a surface a local one.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> mean = mesh.karcher_mean([0, 1, 2, 3])
    >>> (mesh.position(mean.point).round(4) + 0.0).tolist(), round(mean.deviation, 4)
    ([[1.5, 2.0, 0.0]], 2.5)
    """
    arrays = mesh._arrays(places, "places")
    given = np.zeros(0) if weights is None else _arrays.floats(weights, "weights").reshape(-1)
    limit = number(tolerance, "tolerance")
    face, barycentric, deviation, converged = _core.karcher_mean(
        mesh._space, arrays.index, arrays.weights, given, limit
    )
    return Mean(Points(face, barycentric), deviation, converged)


def _given(mesh: Mesh, places: Places | None) -> tuple[Any, Any]:
    if places is None:
        return None, None
    arrays = mesh._arrays(places, "places")
    return arrays.index, arrays.weights


def _measured(
    mesh: Mesh, measure: Any, places: Any, chosen: Options, threads: Any, progress: Progress, what: str
) -> Floats:
    index, weights = _given(mesh, places)
    with shown(progress, what) as report:
        found: Floats = measure(mesh._space, index, weights, chosen, thread_count(threads), report)
    return found
