"""Vectors, values and signed distances carried by heat, on triangles and on polygons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._heat import SignedHeatSolver, VectorHeatSolver
from brushfire._mesh import Mesh
from brushfire._solver import Solver
from brushfire.compat._exact import METHOD, indices
from brushfire.compat.potpourri3d._elements import Element, Elements
from brushfire.compat.potpourri3d._operators import validate_mesh

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

_STRATEGIES = {"VectorHeat": "vector-heat", "AffineLocal": "affine-local", "AffineAdaptive": "affine-adaptive"}
_CONSTRAINTS = {"none": "none", "zeroset": "zero-set", "multiple": "multiple"}


def _constraint(name: str) -> str:
    if name.lower() not in _CONSTRAINTS:
        raise BrushfireError(f"level_set_constraint: 'ZeroSet', 'Multiple' or 'None', not {name!r}")
    return _CONSTRAINTS[name.lower()]


class _Carrier:
    """What triangle and polygon meshes share."""

    _mesh: Mesh
    _heat: VectorHeatSolver

    def extend_scalar(self, v_inds: npt.ArrayLike, values: npt.ArrayLike) -> Floats:
        """The value of the nearest of the vertices, (vertices,)."""
        return self._heat.extend(indices(v_inds, self._mesh.vertex_count, "v_inds"), values)

    def get_tangent_frames(self) -> tuple[Floats, Floats, Floats]:
        """Unit vectors x, y and normal at every vertex, (vertices, 3) each."""
        return self._heat.tangent_frames()

    def transport_tangent_vectors(self, v_inds: npt.ArrayLike, vectors: npt.ArrayLike) -> Floats:
        """The vector of the nearest of the vertices, carried along, (vertices, 2)."""
        return self._heat.transport(indices(v_inds, self._mesh.vertex_count, "v_inds"), vectors)


class MeshVectorHeatSolver(_Carrier):
    """See :class:`brushfire.VectorHeatSolver`.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.MeshVectorHeatSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> solver.transport_tangent_vector(1, [6, 6]).shape, solver.compute_log_map(1).shape
    ((4, 2), (4, 2))
    """

    def __init__(
        self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0, use_intrinsic_delaunay: bool = True
    ) -> None:
        self._mesh = Mesh(V, F)
        self._heat = VectorHeatSolver(self._mesh, time_factor=t_coef, delaunay=use_intrinsic_delaunay)

    def get_connection_laplacian(self) -> csc_matrix:
        """Complex and Hermitian, (vertices, vertices)."""
        return self._heat.connection_laplacian()

    def transport_tangent_vector(self, v_ind: int, vector: npt.ArrayLike) -> Floats:
        """One vertex's vector carried over the surface, (vertices, 2)."""
        return self.transport_tangent_vectors([v_ind], np.asarray(vector, dtype=np.float64).reshape(1, -1))

    def compute_log_map(self, v_ind: int, strategy: str = "AffineLocal") -> Floats:
        """Where every vertex lies as seen from one, (vertices, 2).

        :param strategy: ``"VectorHeat"``, ``"AffineLocal"`` or ``"AffineAdaptive"``.
        """
        if strategy not in _STRATEGIES:
            raise BrushfireError(f"strategy: {', '.join(map(repr, _STRATEGIES))} are possible, not {strategy!r}")
        [vertex] = indices([v_ind], self._mesh.vertex_count, "v_ind").tolist()
        return self._heat.log_map(vertex, _STRATEGIES[strategy])


class MeshSignedHeatSolver:
    """See :class:`brushfire.SignedHeatSolver`; as in the original, positive on the left of curves.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> V = [[x, y, 0] for y in range(3) for x in range(3)]
    >>> F = [f for a in (0, 1, 3, 4) for f in [(a, a + 1, a + 4), (a, a + 4, a + 3)]]
    >>> pp3d.MeshSignedHeatSolver(V, F).compute_distance([[(3, []), (4, []), (5, [])]]).round(1)[[1, 4, 7]].tolist()
    [-1.0, 0.0, 1.0]
    """

    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0) -> None:
        mesh = Mesh(V, F)
        self._elements = Elements(mesh)
        self._heat = SignedHeatSolver(mesh, time_factor=t_coef)

    def compute_distance(
        self,
        curves: Sequence[Sequence[Element]],
        curve_signs: Sequence[bool] = (),
        points: Sequence[Element] = (),
        preserve_source_normals: bool = False,
        level_set_constraint: str = "ZeroSet",
        soft_level_set_weight: float = -1,
    ) -> Floats:
        """(vertices,).

        :param curves: lists of (element, coordinates).
        :param curve_signs: of each curve whether it has sides; all have where nothing is said.
        :param points: sources without a direction.
        """
        flags = [bool(one) for one in curve_signs][: len(curves)]
        flags += [True] * (len(curves) - len(flags))
        distance = self._heat.distance(
            [self._elements.points(curve) for curve in curves],
            is_signed=flags,
            points=self._elements.points(points) if len(points) else None,
            constraint=_constraint(level_set_constraint),
            soft_weight=max(float(soft_level_set_weight), 0.0),
            preserve_normals=bool(preserve_source_normals),
        )
        return -distance if any(flags) else distance


class PolygonMeshHeatSolver(_Carrier):
    """Distances, values and vectors on a mesh of polygons, which are cut into triangles.

    :param F: lists of vertex numbers, or an array (faces, corners).

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> solver = pp3d.PolygonMeshHeatSolver([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2, 3]])
    >>> solver.compute_distance([1]).tolist()
    [3.0, 0.0, 4.0, 5.0]
    """

    def __init__(self, V: npt.ArrayLike, F: Any, t_coef: float = 1.0) -> None:
        validate_mesh(V, F, test_indices=True)
        self._mesh = Mesh(V, triangulated(V, F))
        self._solver = Solver(self._mesh)
        self._t_coef = t_coef
        self._carrier: VectorHeatSolver | None = None
        self._signed: SignedHeatSolver | None = None

    @property
    def _heat(self) -> VectorHeatSolver:  # type: ignore[override]
        if self._carrier is None:
            self._carrier = VectorHeatSolver(self._mesh, time_factor=self._t_coef)
        return self._carrier

    def compute_distance(self, v_inds: npt.ArrayLike) -> Floats:
        """Exact distances from the nearest of the vertices, (vertices,)."""
        return self._solver.distance(indices(v_inds, self._mesh.vertex_count, "v_inds"), method=METHOD)

    def compute_signed_distance(self, curves: Sequence[Sequence[int]], level_set_constraint: str = "ZeroSet") -> Floats:
        """From curves along edges and through polygons, as lists of vertices; positive on their left."""
        if self._signed is None:
            self._signed = SignedHeatSolver(self._mesh, time_factor=self._t_coef)
        # Two corners of one polygon need not share a triangle.
        lines = [
            self._solver.edge_path(a, b).points for curve in curves for a, b in zip(curve, curve[1:], strict=False)
        ]
        return -self._signed.distance(lines, constraint=_constraint(level_set_constraint))


def triangulated(V: npt.ArrayLike, F: Any) -> npt.NDArray[np.int64]:
    """Triangles of polygons, by the rules of the file readers."""
    from brushfire._io import read

    sizes = {len(polygon) for polygon in F}
    if sizes <= {3}:
        return np.asarray(F, dtype=np.int64).reshape(-1, 3)
    positions = np.asarray(V, dtype=np.float64).tolist()
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in positions]
    lines += ["f " + " ".join(str(int(v) + 1) for v in polygon) for polygon in F]
    return read("\n".join([*lines, ""]).encode(), format="obj").faces.astype(np.int64)
