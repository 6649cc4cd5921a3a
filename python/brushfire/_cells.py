"""Cells and centres of a mesh, its parcels, its boundaries, and smoothing along it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Labels, number, whole
from brushfire._curves import OnMesh, Path
from brushfire._errors import BrushfireError, BrushfireIndexError
from brushfire._options import Options, Tolerance, options, thread_count
from brushfire._places import Places, Points
from brushfire._progress import Progress, shown
from brushfire._sources import Curve, Sources, sources_of
from brushfire._weighted import Weighing, chosen_in

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

_MOST = int(np.iinfo(np.int32).max)
_FWHM_PER_SIGMA = 2.3548200450309493


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


@dataclass(frozen=True)
class Boundary:
    """A curve along edges of one face: ``vertices`` (k,) in order, ``length``, and whether it is ``closed`` (the last
    vertex is joined to the first, which is not repeated)."""

    vertices: Labels
    length: float
    closed: bool

    def __repr__(self) -> str:
        return f"Boundary({len(self.vertices)} vertices, length {self.length:.6g}{', closed' if self.closed else ''})"


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


class Cells(OnMesh):
    """The cells and centres of a Mesh."""

    def boundaries(self) -> list[Boundary]:
        """The boundary of the mesh as curves, longest first.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.boundaries()
        [Boundary(4 vertices, length 14, closed)]
        """
        return [Boundary(*curve) for curve in _core.boundaries(self._mesh)]

    def curve_along(self, vertices: npt.ArrayLike, *, closed: bool = False) -> Path:
        """The curve along edges through these vertices, each joined to the next by an edge.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.curve_along([0, 1, 2], closed=True).length
        12.0
        """
        chain = _arrays.integers(vertices, "vertices").reshape(-1)
        return self._path(_core.curve_along(self._mesh, chain, bool(closed)))

    def project_curve(self, xyz: npt.ArrayLike, *, closed: bool = False) -> tuple[Path, float]:
        """A polyline in space put onto the surface: nearest points, and shortest paths between them.

        :param xyz: (k, 3).
        :return: the curve, and how far the polyline is from the surface at most.
        :raises BrushfireError: for places between which no way leads.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> curve, gap = mesh.project_curve([[0, 0, 1], [3, 0, 2]])
        >>> round(curve.length, 9), gap
        (3.0, 2.0)
        """
        path, gap, _ = _core.project_curve(self._space, _arrays.triples(xyz, "xyz"), bool(closed))
        return self._path(path), gap

    def region(self, *, vertices: npt.ArrayLike | None = None, faces: npt.ArrayLike | None = None) -> Curve:
        """A region as a source: distances are 0 at all of its vertices and along its border, and outside from there on.

        :param vertices: numbers, or a mask with one bool per vertex (``labels == 3``): these, and the edges and faces
            between them; or
        :param faces: numbers, or a mask with one bool per face.
        :raises BrushfireError: for an empty region.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.distance(mesh.region(vertices=[0, 1])).round(9).tolist()
        [0.0, 0.0, 4.0, 4.0]
        >>> mesh.distance(mesh.region(faces=[0])).round(9).tolist()
        [0.0, 0.0, 0.0, 2.4]
        """
        if (vertices is None) == (faces is None):
            raise BrushfireError("region: one of vertices and faces is needed")
        if faces is not None:
            face, weights, starts = _core.region_of_faces(
                self._mesh, _arrays.numbers(faces, self._mesh.face_count, "faces")
            )
        else:
            inside = np.zeros(self._mesh.vertex_count, dtype=np.uint8)
            chosen = _arrays.numbers(vertices, self._mesh.vertex_count, "vertices")
            if chosen.size and (chosen.min() < 0 or chosen.max() >= len(inside)):
                bad = chosen[(chosen < 0) | (chosen >= len(inside))][0]
                raise BrushfireIndexError(f"vertices: there is no vertex {bad}, the mesh has {len(inside)}")
            inside[chosen] = 1
            face, weights, starts = _core.region_of_vertices(self._mesh, inside)
        return Curve(Points(face, weights), starts=starts)

    def nearest_sources(
        self,
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
        start = sources_of(self, sources, offset)
        space, chosen = chosen_in(self, weights, method, tolerance, radius, bound, precision, threads)
        with shown(progress, "nearest sources") as report:
            return _core.nearest_sources(space, start, whole(count, "count", _MOST), chosen, report)

    def extent(
        self, *, within: float = 1e-9, most_runs: int = 0, threads: int = 1, progress: Progress = None
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
                self._space,
                number(within, "within"),
                whole(most_runs, "most_runs", _MOST),
                thread_count(threads),
                report,
            )
        return Extent(**found)

    def eccentricity(
        self,
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
        return self._measured(_core.eccentricities, places, chosen, threads, progress, "eccentricity")

    def average_distance(
        self,
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
        return self._measured(_core.average_distances, places, chosen, threads, progress, "average distance")

    def discs(
        self,
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
        index, weights = self._given(places)
        chosen = options(method, tolerance, radius, bound, precision)
        with shown(progress, "discs") as report:
            found = _core.discs(
                self._space, number(share, "share"), index, weights, chosen, thread_count(threads), report
            )
        return Discs(*found)

    def karcher_mean(self, places: Places, weights: npt.ArrayLike | None = None, *, tolerance: float = 1e-6) -> Mean:
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
        arrays = self._arrays(places, "places")
        given = np.zeros(0) if weights is None else _arrays.floats(weights, "weights").reshape(-1)
        limit = number(tolerance, "tolerance")
        face, barycentric, deviation, converged = _core.karcher_mean(
            self._space, arrays.index, arrays.weights, given, limit
        )
        return Mean(Points(face, barycentric), deviation, converged)

    def centroidal_voronoi(
        self,
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
            arrays = self._arrays(sites, "sites")
            index, weights = arrays.index, arrays.weights
        amount = np.zeros(0) if density is None else _arrays.floats(density, "density").reshape(-1)
        with shown(progress, "cells") as report:
            face, barycentric, distance, nearest, energy = _core.centroidal_voronoi(
                self._space,
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
        self,
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
        if len(keys) != self._mesh.vertex_count:
            raise BrushfireError(f"labels: one per vertex is needed, {self._mesh.vertex_count}, not {len(keys)}")
        keys[np.isin(keys, _arrays.integers(ignore, "ignore"))] = -1
        space, chosen = chosen_in(self, weights, method, tolerance, radius, bound, precision)
        with shown(progress, "parcels") as report:
            label, between, sizes, centroids = _core.parcels(
                space, keys, str(distance), 0, chosen, thread_count(threads), report
            )
        return Parcels(label, between, sizes, centroids if len(centroids) else None)

    def smoothing_kernel(
        self,
        *,
        sigma: float | None = None,
        fwhm: float | None = None,
        method: str | None = None,
        tolerance: Tolerance | None = None,
        bound: str | None = None,
        precision: str | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> csr_matrix:
        """A Gaussian of the distance along the surface, by area, every row summing to 1: a scipy.sparse matrix.

        :param sigma: its standard deviation; or
        :param fwhm: its full width at half maximum. It ends at 4 sigma.

        ``kernel @ values`` smooths any number of columns; :meth:`smooth` does so for one and minds NaN.
        """
        from scipy.sparse import csr_matrix

        chosen = options(method, tolerance, np.inf, bound, precision)
        value, column, starts = self._kernel(sigma, fwhm, chosen, threads, progress)
        return csr_matrix((value, column, starts), shape=(len(starts) - 1, self._mesh.vertex_count))

    def smooth(
        self,
        values: npt.ArrayLike,
        *,
        sigma: float | None = None,
        fwhm: float | None = None,
        method: str | None = None,
        tolerance: Tolerance | None = None,
        bound: str | None = None,
        precision: str | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Floats:
        """Values smoothed along the surface, within walls: (vertex_count,) or (vertex_count, k), as given.

        :param values: NaN does not count, and stays; so does what is in no open face.
        :param sigma, fwhm, method, tolerance, bound, precision, threads, progress: as for :meth:`smoothing_kernel`.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.smooth([1, 1, 1, 5], sigma=0.5).round(3).tolist()
        [1.0, 1.0, 1.0, 5.0]
        """
        array = _arrays.floats(values, "values")
        if array.ndim not in (1, 2) or array.shape[0] != self._mesh.vertex_count:
            raise BrushfireError(f"values: one row per vertex is needed, {self._mesh.vertex_count}, not {array.shape}")
        chosen = options(method, tolerance, np.inf, bound, precision)
        value, column, starts = self._kernel(sigma, fwhm, chosen, threads, progress)
        columns = array.reshape(len(array), -1)
        there = ~np.isnan(columns)
        rows = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
        result = columns.copy()
        for k in range(columns.shape[1]):
            known = there[:, k]
            weight = np.bincount(rows, value * known[column], minlength=len(columns))
            total = np.bincount(rows, value * np.where(known, columns[:, k], 0)[column], minlength=len(columns))
            smooth = known & (weight > 0)
            result[smooth, k] = total[smooth] / weight[smooth]
        return result.reshape(array.shape)

    def _kernel(
        self, sigma: Any, fwhm: Any, chosen: Options, threads: Any, progress: Progress
    ) -> tuple[Floats, Labels, npt.NDArray[np.int64]]:
        if (sigma is None) == (fwhm is None):
            raise BrushfireError("how wide? one of sigma and fwhm is needed")
        width = number(sigma, "sigma") if sigma is not None else number(fwhm, "fwhm") / _FWHM_PER_SIGMA
        with shown(progress, "smooth") as report:
            return _core.smoothing_kernel(self._space, width, chosen, thread_count(threads), report)

    def _given(self, places: Places | None) -> tuple[Any, Any]:
        if places is None:
            return None, None
        arrays = self._arrays(places, "places")
        return arrays.index, arrays.weights

    def _measured(
        self, measure: Any, places: Any, chosen: Options, threads: Any, progress: Progress, what: str
    ) -> Floats:
        index, weights = self._given(places)
        with shown(progress, what) as report:
            found: Floats = measure(self._space, index, weights, chosen, thread_count(threads), report)
        return found
