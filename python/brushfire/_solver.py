"""Solver: a workspace that is kept between calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _core, _curves, _distance, _fields
from brushfire._arrays import radius_of
from brushfire._matrices import sparse_matrix
from brushfire._matrix_arrays import float_type
from brushfire._options import Tolerance, options
from brushfire._places import PlaceArrays, Places
from brushfire._progress import Progress, shown

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

    from brushfire._mesh import Mesh


class Solver:
    """Everything that reads a field, again and again on one mesh: what has to be built for that is built once.

    :param mesh: of which; ``solver.mesh`` from then on.
    :param method, tolerance, bound, precision: as for :meth:`Mesh.distance`: what calls take that say none of them. With
        a method its workspace is built at once, else by the first call.

    Distances, paths, logarithmic maps, curved isolines and sparse rows share the workspace. What is limited to a radius
    or to targets then costs what it reaches, however large the mesh is: :meth:`distances_within`, :meth:`path`,
    :meth:`paths`, and :meth:`log_map` with ``sparse=True``; what gives an array of all vertices costs that array.

    Safe to share between threads, which then wait for each other; give every thread a solver of its own where they
    should not.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> solver = mesh.solver("dijkstra")
    >>> [solver.distance(v).max().item() for v in range(4)]
    [5.0, 7.0, 5.0, 7.0]
    >>> solver.path(1, 3).length, solver.log_map(0, 3.5, sparse=True).vertices.tolist()
    (5.0, [0, 1])
    """

    def __init__(
        self,
        mesh: Mesh,
        method: str | None = None,
        *,
        tolerance: Tolerance | None = None,
        bound: str | None = None,
        precision: str | None = None,
    ) -> None:
        self.mesh = mesh
        self._mesh = mesh._mesh
        self._solver = _core.Solver(mesh._space)
        self._defaults = (method, tolerance, bound, precision)
        chosen = options(method, tolerance, np.inf, bound, precision)
        if "method" in chosen:
            self._solver.set_up(chosen)

    def distances_within(
        self,
        radius: float,
        rows: Places,
        *,
        method: str | None = None,
        tolerance: Tolerance | None = None,
        bound: str | None = None,
        precision: str | None = None,
        dtype: npt.DTypeLike = np.float32,
        progress: Progress = None,
    ) -> csr_matrix:
        """Rows of :meth:`Mesh.distances_within`, computed one after the other: for few of them at a time.

        :param radius, rows, method, tolerance, bound, precision, dtype, progress: as there; many rows are faster there.

        >>> import brushfire as bf
        >>> solver = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]]).solver()
        >>> solver.distances_within(3.5, 1, method="dijkstra").toarray().tolist()
        [[3.0, 0.0, 0.0, 0.0]]
        """
        row = self._arrays(rows, "rows")
        chosen = options(*self._or_defaults(method, tolerance, bound, precision, limit=np.inf))
        wanted = float_type(dtype)
        limit = radius_of(radius)
        with shown(progress, "rows") as report:
            data, indices, starts = _core.sparse_rows(self._solver, limit, row.index, row.weights, chosen, report)
        return sparse_matrix(data.astype(wanted, copy=False), indices, starts, self._mesh.vertex_count)

    def _or_defaults(
        self, method: Any, tolerance: Any, bound: Any, precision: Any, *, limit: Any
    ) -> tuple[Any, Any, Any, Any, Any]:
        """As options() takes them, with what the solver was made with where a call says none of them."""
        if method is None and tolerance is None and bound is None:
            method, tolerance, bound, usual = self._defaults
            precision = usual if precision is None else precision
        return method, tolerance, limit, bound, precision

    distance = _distance.distance
    path, paths, edge_path = _curves.path, _curves.paths, _curves.edge_path
    shorten, length_of = _curves.shorten, _curves.length_of
    trace, angle_of, log_map = _curves.trace, _curves.angle_of, _curves.log_map
    isolines, curved_isolines = _fields.isolines, _fields.curved_isolines
    gradient, steepest_descent, vertex_areas = _fields.gradient, _fields.steepest_descent, _fields.vertex_areas

    @property
    def _space(self) -> _core.Space:
        return self.mesh._space

    def _run(self) -> _core.Solver:
        return self._solver

    def _arrays(self, places: Any, what: str) -> PlaceArrays:
        return self.mesh._arrays(places, what)

    def __repr__(self) -> str:
        return f"Solver({self.mesh!r})"

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return _solver, (self.mesh, *self._defaults)


def _solver(mesh: Mesh, method: Any, tolerance: Any, bound: Any, precision: Any) -> Solver:
    """One that was pickled."""
    return Solver(mesh, method, tolerance=tolerance, bound=bound, precision=precision)
