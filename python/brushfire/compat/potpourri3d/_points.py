"""Point clouds, by way of the triangles around each point."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, floats, triples
from brushfire._errors import BrushfireError
from brushfire._heat import HeatSolver, laplacian
from brushfire._mesh import Mesh
from brushfire.compat._exact import indices

_NEIGHBOURS = 30
_MOST_POINTS = 20_000


class _Neighbourhoods:
    """Of every point its normal, a frame, and the triangles of the Delaunay triangulation of its neighbours around it."""

    def __init__(self, P: npt.ArrayLike) -> None:
        self.points = triples(P, "P")
        count = len(self.points)
        if count > _MOST_POINTS:
            raise BrushfireError(
                f"{count} points: clouds of up to {_MOST_POINTS} are taken; make larger ones a mesh (open3d, pymeshlab, "
                "CGAL reconstruct surfaces) and use the Mesh classes"
            )
        if count < 3:
            raise BrushfireError("three points are needed at least")
        from scipy.spatial import cKDTree

        _, near = cKDTree(self.points).query(self.points, min(_NEIGHBOURS + 1, count))
        local = self.points[near] - self.points[near].mean(axis=1, keepdims=True)
        _, axes = np.linalg.eigh(np.einsum("nki,nkj->nij", local, local))
        normal = axes[:, :, 0]
        largest = np.take_along_axis(normal, np.abs(normal).argmax(axis=1)[:, None], axis=1)
        self.normal = normal * np.sign(largest)
        self.x = axes[:, :, 2]
        self.y = np.cross(self.normal, self.x)
        self.triangles = [self._around(i, near[i]) for i in range(count)]

    def _around(self, point: int, near: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """(k, 3), the point first, counter-clockwise seen against its normal."""
        from scipy.spatial import Delaunay, QhullError

        others = near[near != point][:_NEIGHBOURS]
        numbers = np.concatenate([[point], others])
        away = self.points[numbers] - self.points[point]
        flat = np.stack([away @ self.x[point], away @ self.y[point]], axis=1)
        try:
            simplices = Delaunay(flat).simplices
        except QhullError:  # all on one line
            return np.zeros((0, 3), dtype=np.int64)
        star = simplices[(simplices == 0).any(axis=1)]
        first = (star == 0).argmax(axis=1)
        star = np.take_along_axis(star, (first[:, None] + np.arange(3)) % 3, axis=1)
        a, b = flat[star[:, 1]], flat[star[:, 2]]
        clockwise = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] < 0
        star[clockwise] = star[clockwise][:, [0, 2, 1]]
        return numbers[star]  # type: ignore[no-any-return]

    def mesh(self) -> Mesh:
        """All triangles once."""
        together = np.concatenate(self.triangles)
        _, once = np.unique(np.sort(together, axis=1), axis=0, return_index=True)
        return Mesh(self.points, together[np.sort(once)])


class PointCloudLocalTriangulation:
    """The triangles around each point, of the Delaunay triangulation of its 30 nearest in their mean plane.

    :param with_degeneracy_heuristic: taken; points on one circle are no trouble here.
    """

    def __init__(self, P: npt.ArrayLike, with_degeneracy_heuristic: bool = True) -> None:
        self._triangles = _Neighbourhoods(P).triangles

    def get_local_triangulation(self) -> npt.NDArray[np.int64]:
        """(points, most, 3): the point itself first; -1 where a point has fewer."""
        most = max(len(star) for star in self._triangles)
        all_of_them = np.full((len(self._triangles), most, 3), -1, dtype=np.int64)
        for point, star in enumerate(self._triangles):
            all_of_them[point, : len(star)] = star
        return all_of_them


class PointCloudHeatSolver:
    """Distances, values and vectors on a cloud of up to 20,000 points.

    >>> import brushfire.compat.potpourri3d as pp3d, numpy as np
    >>> P = np.array([[x, y, 0.0] for x in range(9) for y in range(9)])
    >>> d = pp3d.PointCloudHeatSolver(P).compute_distance(0)
    >>> d[0].item(), bool(abs(d[8] - 8) < 0.8)
    (0.0, True)
    """

    def __init__(self, P: npt.ArrayLike, t_coef: float = 1.0) -> None:
        self._around = _Neighbourhoods(P)
        self._mesh = self._around.mesh()
        self._heat = HeatSolver(self._mesh, time_factor=t_coef)
        self._laplacian, self._mass = laplacian(self._mesh)
        self._mass = np.where(self._mass > 0, self._mass, 1.0)
        self._scalar: Callable[[Floats], Floats] | None = None
        self._vector: Callable[[Floats], Floats] | None = None

    def compute_distance(self, p_ind: int) -> Floats:
        return self.compute_distance_multisource([p_ind])

    def compute_distance_multisource(self, p_inds: npt.ArrayLike) -> Floats:
        return self._heat.distance(self._numbers(p_inds))

    def extend_scalar(self, p_inds: npt.ArrayLike, values: npt.ArrayLike) -> Floats:
        """The value of the nearest of the points, (points,)."""
        sources, given = self._numbers(p_inds), floats(values, "values")
        if given.shape != sources.shape:
            raise BrushfireError(f"values: one per point is needed, {sources.size}, not {given.size}")
        low = given.min()
        above = self._spread(sources, given - low)
        all_of_them = self._spread(sources, np.ones(len(sources)))
        with np.errstate(invalid="ignore", divide="ignore"):
            extended: Floats = low + np.clip(above / all_of_them, 0, given.max() - low)
        return extended

    def get_tangent_frames(self) -> tuple[Floats, Floats, Floats]:
        """Unit vectors x, y and normal at every point, (points, 3) each."""
        return self._around.x.copy(), self._around.y.copy(), self._around.normal.copy()

    def transport_tangent_vector(self, p_ind: int, vector: npt.ArrayLike) -> Floats:
        return self.transport_tangent_vectors([p_ind], np.asarray(vector, dtype=np.float64).reshape(1, -1))

    def transport_tangent_vectors(self, p_inds: npt.ArrayLike, vectors: npt.ArrayLike) -> Floats:
        """The vector of the nearest of the points, carried along, (points, 2)."""
        sources, given = self._numbers(p_inds), floats(vectors, "vectors")
        if given.shape != (len(sources), 2):
            raise BrushfireError(f"vectors: shape ({len(sources)}, 2) is needed, not {given.shape}")
        length = np.linalg.norm(given, axis=1)
        unit = np.divide(given, length[:, None], out=np.zeros_like(given), where=length[:, None] > 0)
        return _unit(self._carried(sources, unit)) * self.extend_scalar(sources, length)[:, None]

    def compute_log_map(self, p_ind: int) -> Floats:
        """Where every point lies as seen from one, (points, 2)."""
        [source] = self._numbers([p_ind])
        neighbours = np.unique(np.concatenate([t for t in self._around.triangles[source]] or [np.zeros(0, dtype=int)]))
        neighbours = neighbours[neighbours != source]
        away = self._around.points[neighbours] - self._around.points[source]
        outward = np.stack([(away * axis[neighbours]).sum(axis=1) for axis in (self._around.x, self._around.y)], axis=1)
        radial = _unit(self._carried(neighbours, outward))
        axis = _unit(self._carried(np.array([source]), np.array([[1.0, 0.0]])))
        angle = np.stack([(radial * axis).sum(axis=1), axis[:, 0] * radial[:, 1] - axis[:, 1] * radial[:, 0]], axis=1)
        log = angle * self.compute_distance(int(source))[:, None]
        log[source] = 0
        return log

    def compute_signed_distance(
        self,
        curves: Sequence[Sequence[int]],
        cloud_normals: npt.ArrayLike,
        preserve_source_normals: bool = False,
        level_set_constraint: str = "ZeroSet",
        soft_level_set_weight: float = -1,
    ) -> Floats:
        """From curves as lists of points, positive on their left, seen against the normals.

        ``"ZeroSet"`` and ``"None"`` only; normals are not preserved, and the constraint is not soft.
        """
        if level_set_constraint.lower() not in ("zeroset", "none") or preserve_source_normals or soft_level_set_weight > 0:
            raise BrushfireError("point clouds: level_set_constraint 'ZeroSet' and 'None' only, kept and not softened")
        normals = triples(cloud_normals, "cloud_normals")
        lines = [self._numbers(curve) for curve in curves]
        left = np.zeros((len(self._around.points), 3))
        for line in lines:
            along = np.diff(self._around.points[line], axis=0)
            for ends in (line[:-1], line[1:]):
                np.add.at(left, ends, 0.5 * np.cross(normals[ends], along))
        sources = np.unique(np.concatenate(lines))
        flat = np.stack([(left * axis)[sources].sum(axis=1) for axis in (self._around.x, self._around.y)], axis=1)
        field = _unit(self._carried(sources, flat))
        x, y = self._around.x, self._around.y
        vectors = np.nan_to_num(field[:, :1] * x + field[:, 1:] * y)
        return self._integrated(vectors, sources, held=level_set_constraint.lower() == "zeroset")

    def _integrated(self, vectors: Floats, sources: npt.NDArray[np.int64], *, held: bool) -> Floats:
        """The values that grow along the vectors, 0 at the sources or in their mean."""
        from scipy.sparse.linalg import spsolve

        entries = self._laplacian.tocoo()
        away = self._around.points[entries.col] - self._around.points[entries.row]
        growth = 0.5 * ((vectors[entries.row] + vectors[entries.col]) * away).sum(axis=1)
        b = np.bincount(entries.row, entries.data * growth, minlength=len(vectors))
        fixed = sources if held else sources[:1]
        free = np.setdiff1d(np.flatnonzero(self._laplacian.diagonal() > 0), fixed)
        values = np.zeros(len(vectors))
        values[free] = spsolve(self._laplacian[free][:, free], b[free])
        centred: Floats = values - values[sources].mean()
        return centred

    def _numbers(self, p_inds: npt.ArrayLike) -> npt.NDArray[np.int64]:
        return indices(p_inds, self._mesh.vertex_count, "p_inds")

    def _spread(self, sources: npt.NDArray[np.int64], values: Floats) -> Floats:
        if self._scalar is None:
            from scipy.sparse import diags
            from scipy.sparse.linalg import splu

            self._scalar = splu((diags(self._mass) + self._heat.time * self._laplacian).tocsc()).solve
        b = np.bincount(sources, values, minlength=len(self._mass)).astype(np.float64)
        return self._scalar(b)

    def _carried(self, sources: npt.NDArray[np.int64], vectors: Floats) -> Floats:
        """Heat of vectors: they turn with the frames along every edge."""
        if self._vector is None:
            from scipy.sparse import coo_matrix
            from scipy.sparse.linalg import splu

            entries = self._laplacian.tocoo()
            turn = self._turns(entries.row, entries.col)
            values = self._heat.time * entries.data[:, None, None] * turn
            row = 2 * entries.row[:, None, None] + np.arange(2)[:, None] + np.zeros((1, 2), dtype=int)
            column = 2 * entries.col[:, None, None] + np.arange(2) + np.zeros((2, 1), dtype=int)
            size = 2 * len(self._mass)
            matrix = coo_matrix((values.ravel(), (row.ravel(), column.ravel())), shape=(size, size)).tolil()
            matrix.setdiag(matrix.diagonal() + np.repeat(self._mass, 2))
            self._vector = splu(matrix.tocsc()).solve
        b = np.zeros((len(self._mass), 2))
        np.add.at(b, sources, vectors)
        return self._vector(b.ravel()).reshape(-1, 2)

    def _turns(self, row: Any, column: Any) -> Floats:
        """From the frame of one point to that of another: the rotation or reflection nearest to the projection."""
        frames = np.stack([self._around.x, self._around.y], axis=2)
        u, _, v = np.linalg.svd(np.einsum("nki,nkj->nij", frames[row], frames[column]))
        turns: Floats = u @ v
        return turns


def _unit(vectors: Floats) -> Floats:
    """NaN for what has no length."""
    with np.errstate(invalid="ignore", divide="ignore"):
        unit: Floats = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return unit
