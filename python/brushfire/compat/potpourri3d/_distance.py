"""Distances from vertices, and from points of curves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._heat import HeatSolver, SignedHeatSolver
from brushfire._mesh import Mesh
from brushfire._solver import Solver
from brushfire.compat._exact import METHOD, indices
from brushfire.compat.potpourri3d._elements import Element, Elements


class MeshHeatMethodDistanceSolver:
    """Distances from vertices, again and again on one mesh.

    :param t_coef, use_robust: of the heat method: how long heat spreads, in squared mean edge lengths, and whether on the
        intrinsic Delaunay triangulation (of the tufted cover).
    :param method: ``"exact"``, for which these have nothing to control, or ``"heat"``.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.MeshHeatMethodDistanceSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> solver.compute_distance(1).tolist()
    [3.0, 0.0, 4.0, 5.0]
    >>> solver.compute_distance_multisource([1, 2]).tolist()
    [3.0, 0.0, 0.0, 3.0]
    """

    def __init__(
        self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0, use_robust: bool = True, *, method: str = METHOD
    ) -> None:
        mesh = Mesh(V, F)
        if method not in (METHOD, "heat"):
            raise BrushfireError(f"method: {METHOD!r} or 'heat', not {method!r}")
        self._mesh = mesh
        self._heat = HeatSolver(mesh, time_factor=t_coef, delaunay=use_robust) if method == "heat" else None
        self._solver = None if self._heat else Solver(mesh)

    def compute_distance(self, v_ind: int) -> Floats:
        return self.compute_distance_multisource([int(v_ind)])

    def compute_distance_multisource(self, v_inds: npt.ArrayLike) -> Floats:
        sources = indices(v_inds, self._mesh.vertex_count, "v_inds")
        if self._solver is None:
            assert self._heat is not None
            return self._heat.distance(sources)
        return self._solver.distance(sources, method=METHOD)


def compute_distance(V: npt.ArrayLike, F: npt.ArrayLike, v_ind: int) -> Floats:
    """Distances from one vertex."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance(v_ind)


def compute_distance_multisource(V: npt.ArrayLike, F: npt.ArrayLike, v_inds: npt.ArrayLike) -> Floats:
    """Distances from the nearest of several vertices."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance_multisource(v_inds)


class MeshFastMarchingDistanceSolver:
    """Distances from points given as (element, coordinates): a vertex and [], an edge and [t], a face and [b0, b1(, b2)].

    Edges are numbered as in the original, in the order in which the faces name them first; t runs along that direction.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.MeshFastMarchingDistanceSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> solver.compute_distance([[(1, [0.5])]]).round(3).tolist()
    [3.606, 2.0, 2.0, 3.606]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike) -> None:
        self._solver = Solver(Mesh(V, F))
        self._elements = Elements(self._solver.mesh)
        self._signed: SignedHeatSolver | None = None

    def compute_distance(
        self,
        curves: Sequence[Sequence[Element]],
        distances: Sequence[Sequence[float]] = (),
        sign: bool = False,
    ) -> Floats:
        """Distances from all points of all curves; ``distances`` are the values that the points start with.

        With ``sign`` the curves have two sides: negative on their left. The sizes are exact, the signs by heat.
        """
        points = [point for curve in curves for point in self._elements.points(curve)]
        offsets = np.array([value for curve in distances for value in curve], dtype=np.float64)
        values = self._solver.distance(points, offset=offsets if len(offsets) else 0.0, method=METHOD)
        if not sign:
            return values
        if self._signed is None:
            self._signed = SignedHeatSolver(self._solver.mesh)
        sides = self._signed.distance([self._elements.points(curve) for curve in curves], constraint="none")
        return np.where(sides < 0, -values, values)
