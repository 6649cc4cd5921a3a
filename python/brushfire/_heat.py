"""The heat method for many right-hand sides, values and vectors carried by heat, signed distances by heat."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, Ints, number, offsets
from brushfire._curves import Path
from brushfire._errors import BrushfireError
from brushfire._mesh import Mesh
from brushfire._places import PlaceArrays, Places

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

_BOUNDARIES = ("neumann", "dirichlet", "averaged")
_STRATEGIES = ("vector-heat", "affine-local", "affine-adaptive")
_CONSTRAINTS = ("none", "zero-set", "multiple")


def _one_of(value: Any, names: Sequence[str], what: str) -> int:
    if value not in names:
        raise BrushfireError(f"{what}: {', '.join(map(repr, names))} are possible, not {value!r}")
    return names.index(value)


def _free_borders(
    mesh: Mesh, time_factor: float, time: float | None, delaunay: bool
) -> tuple[_core.Space, float, float, str, bool, float]:
    """What the core's solvers of vectors and signs take: heat does not leave over borders."""
    chosen = 0.0 if time is None else number(time, "time")
    return mesh._space, number(time_factor, "time_factor"), chosen, "neumann", bool(delaunay), 0.0


def _in_one(arrays: Sequence[PlaceArrays]) -> tuple[Ints, Floats, Ints]:
    """Index and weights of all, one after the other, and where each begins."""
    index = np.concatenate([np.zeros(0, dtype=np.int64), *(a.index for a in arrays)])
    weights = [np.zeros((len(a.index), 3)) if a.weights is None else a.weights for a in arrays]
    starts = np.cumsum([0, *(len(a.index) for a in arrays)], dtype=np.int64)
    return index, np.concatenate([np.zeros((0, 3)), *weights]), starts


def laplacian(mesh: Mesh, *, delaunay: bool = True) -> tuple[csc_matrix, Floats]:
    """The Laplacian of any mesh, and the area of each vertex: cotangents on the intrinsic Delaunay triangulation.

    Borders, non-manifold edges and mirrored faces go by way of the tufted cover, faces without an area are mollified.
    Nothing passes walls: rows are the vertices of ``mesh.cut().mesh``, those of the mesh and then further sides of
    vertices that walls part; ``mesh.cut().original_vertex`` says of which.

    :param delaunay: False: on the faces as they are, whose weights may be negative.
    :return: (rows, rows), symmetric and positive semidefinite, rows summing to 0; (rows,). Without walls there is one
        for every vertex.

    >>> import brushfire as bf
    >>> L, mass = bf.laplacian(bf.Mesh([[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 2], [0, 2, 3]]))
    >>> L.toarray().round(6).tolist()[0], mass.round(6).tolist()
    ([1.0, -0.5, 0.0, -0.5], [1.333333, 0.666667, 1.333333, 0.666667])
    """
    from scipy.sparse import csc_matrix

    row, column, value, mass = _core.laplacian(mesh._space, bool(delaunay))
    return csc_matrix((value, (row, column)), shape=(len(mass), len(mass))), mass


class HeatSolver:
    """Distances by the heat method, for many sets of sources: two linear systems that are factored once.

    What it gives approximates the distance on the smooth surface that the mesh stands for, and has no bound;
    :doc:`/heat` says how near it comes, and when to prefer it. One field at a time is ``mesh.distance(..., method="heat")``.

    :param mesh: of any kind; its walls are borders of what is open.
    :param time_factor: for how long heat spreads, in units of the mean edge length squared, 1e-12 to 1e6; larger ones
        smooth more.
    :param time: the time itself, in the square of the mesh's units, in place of the factor.
    :param boundary: what heat does at borders: ``"neumann"`` none leaves, ``"dirichlet"`` they stay cold and take no
        source, ``"averaged"`` the mean of both.
    :param delaunay: compute on the intrinsic Delaunay triangulation rather than on the faces as they are.
    :param poisson_shift: for comparisons: what other libraries add to the diagonal of their second system (1e-6), which
        flattens far values by some 1e-3.
    :raises BrushfireError: for values out of range, and where the package was built without Eigen.

    >>> import brushfire as bf, numpy as np
    >>> line = np.linspace(0, 1, 21)
    >>> V = [[x, y] for y in line for x in line]
    >>> F = [f for i in range(20) for j in range(20) for a in [21 * i + j] for f in [(a, a + 1, a + 22), (a, a + 22, a + 21)]]
    >>> heat = bf.HeatSolver(bf.Mesh(V, F))
    >>> d = heat.distances([[0], [0, 440]])
    >>> d.shape, d[:, 0].tolist(), d[1, 440].item(), bool(abs(d[0, 20] - 1) < 0.06)
    ((2, 441), [0.0, 0.0], 0.0, True)
    """

    def __init__(
        self,
        mesh: Mesh,
        *,
        time_factor: float = 1.0,
        time: float | None = None,
        boundary: str = "neumann",
        delaunay: bool = True,
        poisson_shift: float = 0.0,
    ) -> None:
        _one_of(boundary, _BOUNDARIES, "boundary")
        self.mesh = mesh
        self._core = _core.HeatSolver(
            mesh._space,
            number(time_factor, "time_factor"),
            0.0 if time is None else number(time, "time"),
            boundary,
            bool(delaunay),
            number(poisson_shift, "poisson_shift"),
        )

    @property
    def time(self) -> float:
        """For how long heat spreads, in the square of the mesh's units."""
        return self._core.time

    @property
    def mean_edge_length(self) -> float:
        """Of the triangulation that is computed on."""
        return self._core.mean_edge_length

    def distance(self, sources: Places, *, offset: npt.ArrayLike = 0.0) -> Floats:
        """From the nearest of the sources to every vertex, (vertex_count,); +inf where nothing leads.

        Every source reads its own value, but for those that another one's front reaches sooner.

        :param sources, offset: as for :meth:`Mesh.distance`.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> bf.HeatSolver(mesh).distance([0, 2], offset=[0, 1])[[0, 2]].tolist()
        [0.0, 1.0]
        """
        arrays = self.mesh._arrays(sources, "sources")
        index, weights, starts = _in_one([arrays])
        return self._core.distances(index, weights, offsets(offset, len(index)), starts)[0]  # type: ignore[no-any-return]

    def distances(self, sets: Iterable[Places]) -> Floats:
        """One row for each set of sources, (sets, vertex_count): several at a time cost a third of one by one.

        :param sets: of each what :meth:`distance` takes.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> bf.HeatSolver(mesh).distances([0, 1, [2, 3]]).shape
        (3, 4)
        """
        index, weights, starts = _in_one([self.mesh._arrays(one, "sources") for one in sets])
        return self._core.distances(index, weights, np.zeros(len(index)), starts)


class VectorHeatSolver:
    """Values, tangent vectors and logarithmic maps carried over a surface by heat.

    Beside :meth:`Mesh.log_map`, which is exact, these are smooth, and blend where a shortest path is not unique. Tangent
    vectors are pairs in the frames of :meth:`tangent_frames`.

    :param mesh: whose faces lie the same way round and whose edges have one or two of them.
    :param time_factor, time, delaunay: as for :class:`HeatSolver`.
    :raises BrushfireError: for other surfaces, values out of range, and where the package was built without Eigen.

    Other components read NaN; within its own everything has a value, however far away. Walls are borders of what is
    open. What has a direction at its own vertex (frames, carried vectors, the Laplacian) is told for every vertex of
    ``mesh.cut().mesh``: those of the mesh, then further sides of vertices that walls part. Of all else a vertex on a
    wall has what its nearer side has.

    >>> import brushfire as bf, numpy as np
    >>> line = np.linspace(0, 1, 11)
    >>> V = [[x, y, 0] for y in line for x in line]
    >>> F = [f for i in range(10) for j in range(10) for a in [11 * i + j] for f in [(a, a + 1, a + 12), (a, a + 12, a + 11)]]
    >>> heat = bf.VectorHeatSolver(bf.Mesh(V, F))
    >>> heat.extend([0, 120], [1, 3]).round(2)[[0, 1, 119, 120]].tolist()
    [1.0, 1.0, 3.0, 3.0]
    >>> x, y, normal = heat.tangent_frames()
    >>> a, b = heat.transport([60], [[0, 2]])[84]
    >>> bool(abs(a * x[84] + b * y[84] - 2 * y[60]).max() < 0.05)
    True
    """

    def __init__(
        self, mesh: Mesh, *, time_factor: float = 1.0, time: float | None = None, delaunay: bool = True
    ) -> None:
        self.mesh = mesh
        self._core = _core.VectorHeatSolver(*_free_borders(mesh, time_factor, time, delaunay))

    @property
    def time(self) -> float:
        """For how long heat spreads, in the square of the mesh's units."""
        return self._core.time

    def tangent_frames(self) -> tuple[Floats, Floats, Floats]:
        """Unit vectors x, y and normal at every vertex, (vertex_count, 3) each; 0 at a vertex in no face.

        Where walls part vertices there are as many rows as in ``mesh.cut().mesh``.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> x, y, normal = bf.VectorHeatSolver(mesh).tangent_frames()
        >>> x[0].tolist(), normal[0].tolist()
        ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0])
        """
        return self._core.tangent_frames()

    def extend(self, vertices: npt.ArrayLike, values: npt.ArrayLike) -> Floats:
        """The value of the nearest of the vertices, blended where several are equally near, (vertex_count,).

        A vertex on a wall feeds all its sides.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> bf.VectorHeatSolver(mesh).extend([0], [7.0]).tolist()
        [7.0, 7.0, 7.0, 7.0]
        """
        return self._core.extend(self._vertices(vertices), _arrays.floats(values, "values").reshape(-1))

    def transport(self, vertices: npt.ArrayLike, vectors: npt.ArrayLike) -> Floats:
        """The vector of the nearest of the vertices, carried along the shortest path, (vertex_count, 2).

        Where walls part vertices there are as many rows as in ``mesh.cut().mesh``.

        :param vectors: (vertices, 2).
        :raises BrushfireError: for a vertex that walls part: its sides have no common frame.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> bf.VectorHeatSolver(mesh).transport([0], [[0, 2]]).shape
        (4, 2)
        """
        array = _arrays.floats(vectors, "vectors")
        _arrays.columns(array, 2, "vectors")
        return self._core.transport(self._vertices(vertices), array)

    def log_map(self, vertex: int, strategy: str = "affine-local") -> Floats:
        """Where every vertex lies as seen from one, in its frame, (vertex_count, 2).

        :param strategy: ``"affine-local"``, ``"affine-adaptive"`` (the most accurate) or ``"vector-heat"``.
        :raises BrushfireError: for a vertex that walls part: its sides have no common frame.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> bf.VectorHeatSolver(mesh).log_map(0)[0].tolist()
        [0.0, 0.0]
        """
        return self._core.log_map(self._vertices([vertex]), _one_of(strategy, _STRATEGIES, "strategy"))

    def connection_laplacian(self) -> csc_matrix:
        """The Laplacian of tangent vectors, complex and Hermitian, (vertex_count, vertex_count).

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> bf.VectorHeatSolver(mesh).connection_laplacian().diagonal().imag.tolist()
        [0.0, 0.0, 0.0, 0.0]
        """
        from scipy.sparse import csc_matrix

        row, column, parts = self._core.connection_laplacian()
        count = int(row.max(initial=-1)) + 1  # the diagonal is stored
        return csc_matrix((parts[:, 0] + 1j * parts[:, 1], (row, column)), shape=(count, count))

    def _vertices(self, vertices: npt.ArrayLike) -> Ints:
        return _arrays.integers(vertices, "vertices").reshape(-1)


class SignedHeatSolver:
    """The distance from curves drawn on a surface, with a sign that says on which side; gaps in curves are closed.

    Walls are borders of what is open: a curve along one runs along both of its sides, what of a curve lies behind one is
    left out, and a vertex on one reads the side whose value is nearest to 0.

    :param mesh, time_factor, time, delaunay: as for :class:`VectorHeatSolver`.

    >>> import brushfire as bf, numpy as np
    >>> line = np.linspace(0, 1, 11)
    >>> V = [[x, y, 0] for y in line for x in line]
    >>> F = [f for i in range(10) for j in range(10) for a in [11 * i + j] for f in [(a, a + 1, a + 12), (a, a + 12, a + 11)]]
    >>> d = bf.SignedHeatSolver(bf.Mesh(V, F)).distance([range(55, 66)])
    >>> (d.round(1) + 0)[[5, 60, 115]].tolist()
    [0.5, 0.0, -0.5]
    """

    def __init__(
        self, mesh: Mesh, *, time_factor: float = 1.0, time: float | None = None, delaunay: bool = True
    ) -> None:
        self.mesh = mesh
        self._core = _core.SignedHeatSolver(*_free_borders(mesh, time_factor, time, delaunay))

    def distance(
        self,
        curves: Iterable[Path | Places] = (),
        *,
        is_signed: Iterable[bool] | None = None,
        points: Places | None = None,
        constraint: str = "zero-set",
        soft_weight: float = 0.0,
        preserve_normals: bool = False,
    ) -> Floats:
        """(vertex_count,): negative on the left of curves, positive on their right; +inf in components without a source.

        :param curves: paths, or places of which consecutive ones share a face; a closed curve repeats its first.
        :param is_signed: of each curve whether it has sides; all do if not given.
        :param points: sources without a direction.
        :param constraint: ``"zero-set"``: all sources read 0; ``"multiple"``: each curve reads one value; ``"none"``.
        :param soft_weight: > 0: the constraint is weighed against the rest in place of being kept.
        :param preserve_normals: in the faces of the curves distances grow at right angles to them.

        >>> import brushfire as bf
        >>> V = [[x, y] for y in range(3) for x in range(3)]
        >>> mesh = bf.Mesh(V, [f for a in (0, 1, 3, 4) for f in [(a, a + 1, a + 4), (a, a + 4, a + 3)]])
        >>> d = bf.SignedHeatSolver(mesh).distance([[3, 4, 5]], constraint="none")
        >>> bool(d[1] > 0 > d[7])
        True
        """
        lines = [self._line(curve) for curve in curves]
        flags = [True] * len(lines) if is_signed is None else [bool(one) for one in is_signed]
        if len(flags) != len(lines):
            raise BrushfireError(f"is_signed: one per curve is needed, {len(lines)}, not {len(flags)}")
        index, weights, starts = _in_one(lines)
        single_index, single_weights, _ = _in_one([] if points is None else [self.mesh._arrays(points, "points")])
        return self._core.distance(
            index,
            weights,
            starts,
            np.array(flags, dtype=np.int64),
            single_index,
            single_weights,
            _one_of(constraint, _CONSTRAINTS, "constraint"),
            number(soft_weight, "soft_weight"),
            bool(preserve_normals),
        )

    def _line(self, curve: Any) -> PlaceArrays:
        closed = isinstance(curve, Path) and curve.closed
        arrays = self.mesh._arrays(curve.points if isinstance(curve, Path) else curve, "curves")
        if not closed:
            return arrays
        first = PlaceArrays(arrays.index[:1], None if arrays.weights is None else arrays.weights[:1])
        index, weights, _ = _in_one([arrays, first])
        return PlaceArrays(index, weights)
