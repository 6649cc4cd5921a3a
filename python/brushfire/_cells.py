"""Cells of a mesh: the nearest sources, centroidal ones, parcels, and medoids of any distances."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Labels, number, whole
from brushfire._errors import BrushfireError
from brushfire._options import Tolerance, options, thread_count
from brushfire._places import Points
from brushfire._progress import Progress, shown
from brushfire._sources import Sources, sources_of
from brushfire._weighted import Weighing, chosen_in

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_MOST = int(np.iinfo(np.int32).max)
_FWHM_PER_SIGMA = 2.3548200450309493


@dataclass(frozen=True)
class Centroidal:
    """Centroidal Voronoi cells.

    ``sites``: the middle of each, as :class:`Points`. ``distance`` (vertex_count,): exact, from the nearest site.
    ``nearest`` (vertex_count,): its number, -1 for none. ``energy``: before the first round and after each.
    """

    sites: Points
    distance: Floats
    nearest: Labels
    energy: Floats

    def __repr__(self) -> str:
        return f"Centroidal({len(self.sites)} sites, energy {self.energy[-1]:.6g} after {len(self.energy) - 1} rounds)"


@dataclass(frozen=True)
class Medoids:
    """``places`` (count,): which of the rows were chosen. ``nearest`` (n,): which of them is nearest to each row, by its
    position in ``places``. ``cost``: the weighted sum of these distances."""

    places: Labels
    nearest: Labels
    cost: float


@dataclass(frozen=True)
class Parcels:
    """``distance[i, j]`` is that of the parcels of ``labels[i]`` and ``labels[j]``, which ascend. ``sizes``: how many
    vertices each has. ``centroids``: the vertices in their middles where ``distance="centroid"``, None otherwise."""

    labels: npt.NDArray[np.int64]
    distance: Floats
    sizes: Labels
    centroids: Labels | None


def k_medoids(distances: npt.ArrayLike, count: int, weights: npt.ArrayLike | None = None) -> Medoids:
    """The ``count`` rows of a distance matrix with the least sum of distances from all rows to the nearest of them.

    :param distances: (n, n); +inf is farther than everything else together.
    :param weights: how much each row counts, (n,), >= 0; all alike if not given.

    Greedy choice, then exchanges as long as one pays (PAM): a local optimum, and seldom another one than the best.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> found = bf.k_medoids(mesh.distance_matrix(), 2)
    >>> found.places.tolist(), found.nearest.tolist(), found.cost
    ([0, 2], [0, 0, 1, 1], 6.0)
    """
    array = _arrays.floats(distances, "distances")
    if array.ndim != 2 or array.shape[0] != array.shape[1]:
        raise BrushfireError(f"distances: a square matrix is needed, not {array.shape}")
    given = np.zeros(0) if weights is None else _arrays.floats(weights, "weights").reshape(-1)
    flat = np.ascontiguousarray(array).reshape(-1)
    return Medoids(*_core.k_medoids(flat, whole(count, "count", _MOST), given))


def nearest_sources(
    mesh: Mesh,
    sources: Sources,
    count: int,
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
) -> tuple[Floats, Labels]:
    """The ``count`` nearest sources of every vertex.

    :param sources, method, tolerance, bound, precision, threads, offset, radius, progress: as for :meth:`distance`.
    :param weights: what going costs, in place of distances: :meth:`weighted`, or one number per face.
    :return: distances, (vertex_count, count), ascending along each row, +inf for no more; and which source each is of.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> distance, source = mesh.nearest_sources([0, 1, 2], 2, method="exact")
    >>> distance[3].tolist(), source[3].tolist()
    ([3.0, 4.0], [2, 0])
    """
    start = sources_of(mesh, sources, offset)
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision, threads)
    with shown(progress, "nearest sources") as report:
        return _core.nearest_sources(space, start, whole(count, "count", _MOST), chosen, report)


def centroidal_voronoi(
    mesh: Mesh,
    sites: int | Points | Any,
    *,
    rounds: int = 20,
    tolerance: float = 1e-3,
    density: npt.ArrayLike | None = None,
    threads: int = 1,
    progress: Progress = None,
) -> Centroidal:
    """Cells of about one size and shape: sites that are moved to the middles of their cells (Lloyd), exactly.

    :param sites: how many, which begin as farthest points; or an array or :class:`Points` of the first ones.
    :param rounds: at most.
    :param tolerance: stop where a round saves less than this share of the energy.
    :param density: how much of the surface counts at each vertex, (vertex_count,), >= 0.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> found = mesh.centroidal_voronoi(1)
    >>> found.energy[-1] <= found.energy[0]
    np.True_
    """
    index = weights = None
    count = 0
    if isinstance(sites, (int, np.integer)) and not isinstance(sites, bool):
        count = whole(sites, "sites", _MOST)
    else:
        arrays = mesh._arrays(sites, "sites")
        index, weights = arrays.index, arrays.weights
    amount = np.zeros(0) if density is None else _arrays.floats(density, "density").reshape(-1)
    with shown(progress, "cells") as report:
        face, barycentric, distance, nearest, energy = _core.centroidal_voronoi(
            mesh._space,
            count,
            index,
            weights,
            amount,
            whole(rounds, "rounds", _MOST),
            number(tolerance, "tolerance"),
            thread_count(threads),
            report,
        )
    return Centroidal(Points(face, barycentric), distance, nearest, energy)


def parcels(
    mesh: Mesh,
    labels: npt.ArrayLike,
    distance: Literal["min", "hausdorff", "centroid", "mean", "max"] = "min",
    *,
    ignore: npt.ArrayLike = (),
    method: str | None = None,
    tolerance: Tolerance | None = None,
    bound: str | None = None,
    precision: str | None = None,
    radius: float = np.inf,
    threads: int = 0,
    weights: Weighing | None = None,
    progress: Progress = None,
) -> Parcels:
    """Distances between the regions of a labelled surface.

    :param labels: one whole number per vertex, (vertex_count,); vertices below 0 are in no parcel.
    :param distance: ``"min"``, of the nearest two vertices; ``"hausdorff"``, of the vertex of either that is
        farthest from the other parcel; ``"centroid"``, of the vertices in their middles; ``"mean"`` and ``"max"``, over all pairs.
    :param ignore: labels that are no parcel.
    :param weights: what going costs, in place of distances: :meth:`weighted` without a slope, or one number per face.

    ``"min"`` and ``"hausdorff"`` are one run per parcel, ``"mean"`` and ``"max"`` one per vertex; no dense matrix of
    the vertices is kept.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> found = mesh.parcels([1, 1, 7, 7], "min", method="exact")
    >>> found.labels.tolist(), found.distance.tolist()
    ([1, 7], [[0.0, 4.0], [4.0, 0.0]])
    """
    keys = _arrays.integers(labels, "labels").reshape(-1).copy()
    if len(keys) != mesh._mesh.vertex_count:
        raise BrushfireError(f"labels: one per vertex is needed, {mesh._mesh.vertex_count}, not {len(keys)}")
    keys[np.isin(keys, _arrays.integers(ignore, "ignore"))] = -1
    space, chosen = chosen_in(mesh, weights, method, tolerance, radius, bound, precision)
    with shown(progress, "parcels") as report:
        label, between, sizes, centroids = _core.parcels(
            space, keys, str(distance), 0, chosen, thread_count(threads), report
        )
    return Parcels(label, between, sizes, centroids if len(centroids) else None)
