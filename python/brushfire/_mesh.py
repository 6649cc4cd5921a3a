"""Mesh and Solver."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core, _viewer
from brushfire._arrays import Floats, Ints, number
from brushfire._cells import Cells
from brushfire._certify import Certificates
from brushfire._curves import Curves
from brushfire._derivatives import Derivatives
from brushfire._distance import Distances
from brushfire._errors import BrushfireError, BrushfireWarning
from brushfire._fields import Fields
from brushfire._files import Files
from brushfire._matrices import Matrices, float_type, sparse_matrix
from brushfire._notebook import mesh_table
from brushfire._options import Options, Tolerance, options
from brushfire._picture import Pictures
from brushfire._places import At, PlaceArrays, Places, Points, at, is_one, place_arrays
from brushfire._progress import Progress, shown
from brushfire._regions import Regions
from brushfire._sources import Sources, sources_of
from brushfire._sets import Pairs
from brushfire._weighted import WithWeights

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


# Beyond this share of the mesh's size a position is far off its surface.
_FAR = 0.1


@contextlib.contextmanager
def _named(faces: npt.NDArray[np.uint32]) -> Iterator[None]:
    """An error about numbers that were negative names them so."""
    try:
        yield
    except BrushfireError:
        _arrays.check_faces(faces.view(np.int32))
        raise


def methods() -> tuple[str, ...]:
    """The names of the solvers, as ``method=`` takes them.

    >>> import brushfire as bf
    >>> "dijkstra" in bf.methods()
    True
    """
    return _core.method_names()


@dataclass(frozen=True)
class MeshReport:
    """What is in a mesh. ``remarks`` says in sentences what is unusual about it; empty for a clean closed mesh."""

    vertices: int
    faces: int
    edges: int
    components: int
    boundary_edges: int
    nonmanifold_edges: int
    misoriented_edges: int
    nonmanifold_vertices: int
    isolated_vertices: int
    repeated_index_faces: int
    zero_area_faces: int
    zero_length_edges: int
    duplicate_faces: int
    duplicate_positions: int
    looks_like_soup: bool
    min_edge_length: float
    mean_edge_length: float
    max_edge_length: float
    area: float
    euler_characteristic: int
    length_precision: float
    remarks: tuple[str, ...]

    def __str__(self) -> str:
        head = f"{self.vertices} vertices, {self.faces} faces, {self.components} component(s)"
        return "\n".join([head, *self.remarks])


class Mesh(
    Distances, Derivatives, Curves, Fields, Certificates, Regions, Cells, Matrices, Pairs, Pictures, Files, WithWeights
):
    """An immutable triangle mesh: closed or not, manifold or not, with whatever is degenerate in it.

    :param vertices: (n, 3) positions, or (n, 2) for a flat mesh. Kept as float64.
    :param faces: (m, 3) vertex numbers, any integer type.
    :raises BrushfireError: code ``invalid_mesh`` for a face that names a vertex that does not exist and for a position
        that is not finite; ``invalid_argument`` for arrays of another shape.
    :raises TypeError: for arrays that do not hold numbers, or faces that are not integers.

    Nothing is repaired: distances are those of the given triangles, and ``report`` tells what is in them. A mesh may be
    shared between threads, copied (free of charge) and pickled.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh
    Mesh(4 vertices, 2 faces)
    """

    _mesh: _core.Mesh
    _finder: _core.NearestPointFinder | None = None
    _walls: tuple[Ints, Ints, Ints] | None = None  # blocked vertices and faces, and the ends of blocked edges
    _domain: _core.Domain | None = None

    def __init__(self, vertices: npt.ArrayLike, faces: npt.ArrayLike) -> None:
        f = _arrays.faces(faces)
        with _named(f):
            self._mesh = _core.make_mesh(_arrays.vertices(vertices), f)

    @classmethod
    def _of(cls, core: _core.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._mesh = core
        return mesh

    @classmethod
    def from_lengths(cls, faces: npt.ArrayLike, lengths: npt.ArrayLike, vertex_count: int | None = None) -> Mesh:
        """A mesh that has edge lengths and no positions.

        :param faces: (m, 3) vertex numbers.
        :param lengths: (m, 3): ``lengths[f, k]`` runs from corner k to corner k + 1 of face f.
        :param vertex_count: one more than the highest number in ``faces`` if not given.
        :raises BrushfireError: where two faces disagree on an edge by more than 1e-9 of it, or three lengths make no
            triangle.

        >>> import brushfire as bf
        >>> tetrahedron = bf.Mesh.from_lengths([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]], [[1, 1, 1]] * 4)
        >>> tetrahedron.distance(0, method="dijkstra").tolist()
        [0.0, 1.0, 1.0, 1.0]
        """
        f = _arrays.faces(faces)
        triples = _arrays.triples(lengths, "lengths")
        _arrays.check_faces(f.view(np.int32))
        if vertex_count is None:
            count = int(f.max()) + 1 if f.size else 0
        else:
            count = _arrays.whole(vertex_count, "vertex_count", np.iinfo(np.int32).max)
        return cls._of(_core.make_from_lengths(count, f, triples))

    @property
    def vertex_count(self) -> int:
        """How many vertices there are."""
        return self._mesh.vertex_count

    @property
    def face_count(self) -> int:
        """How many faces there are."""
        return self._mesh.face_count

    @property
    def vertices(self) -> Floats:
        """The positions, (vertex_count, 3), a read-only copy; (0, 3) for a mesh from lengths.

        A copy every time (24 bytes a vertex): ask once, not in a loop.
        """
        return self._mesh.vertices

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """The vertex numbers of the faces, (face_count, 3), a read-only copy: ask once, not in a loop."""
        return self._mesh.faces

    @property
    def report(self) -> MeshReport:
        """What is in the mesh: counts, lengths, and remarks on what is unusual. Computed on first use.

        >>> import brushfire as bf
        >>> print(bf.Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).report.boundary_edges)
        3
        """
        return MeshReport(**self._mesh.report())  # type: ignore[arg-type]

    def position(self, places: Places) -> Floats:
        """Where places are, in coordinates: (3,) for one, (k, 3) for several.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
        >>> mesh.position([1, bf.Point(0, (0, 0.5, 0.5))]).tolist()
        [[2.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
        """
        arrays = self._arrays(places, "places")
        xyz = self._mesh.positions(arrays.index, arrays.weights)
        return xyz[0] if is_one(places) else xyz

    def nearest(self, xyz: npt.ArrayLike, *, snap_within: float = np.inf) -> tuple[Points, Floats]:
        """The points of the surface nearest to positions in space, and how far away they are.

        :param xyz: (k, 3), or (3,) for a single one.
        :param snap_within: farther than this from the surface no position may be.
        :return: :class:`Points` and distances, (k,) each.
        :raises BrushfireError: for a mesh from lengths or without faces, for positions that are not finite, and for those
            that are farther away than ``snap_within``.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
        >>> points, distance = mesh.nearest([[0.5, 0.5, 3]])
        >>> points.face.tolist(), points.weights.tolist(), distance.tolist()
        ([0], [[0.5, 0.25, 0.25]], [3.0])
        """
        if self._finder is None:
            self._finder = _core.NearestPointFinder(self._mesh)
        positions = at(xyz, snap_within=snap_within)
        face, weights, distance = self._finder.nearest(positions.xyz)
        too_far = distance > positions.snap_within
        if too_far.any():
            bad = int(np.argmax(too_far))
            raise BrushfireError(
                f"position {bad} is {distance[bad]:.6g} from the surface, farther than snap_within={positions.snap_within:.6g}"
            )
        return Points(face, weights), distance

    def _snapped(self, positions: At) -> Points:
        """Not without a word where that is far, for the size of the mesh."""
        points, distance = self.nearest(positions.xyz, snap_within=positions.snap_within)
        size = self._mesh.size
        if np.isinf(positions.snap_within) and distance.size and distance.max() > _FAR * size:
            far = int(np.argmax(distance))
            warnings.warn(
                f"position {far} is {distance[far]:.6g} from the surface (the mesh is {size:.6g} across): its nearest "
                "point was taken; at(..., snap_within=...) says how far is near enough",
                BrushfireWarning,
                stacklevel=4,
            )
        return points

    def _snapped_all(self, xyz: Floats) -> Points:
        return self._snapped(at(xyz))

    def walled(
        self,
        *,
        mask: npt.ArrayLike | None = None,
        vertices: npt.ArrayLike = (),
        faces: npt.ArrayLike = (),
        edges: npt.ArrayLike = (),
    ) -> Mesh:
        """The same mesh with walls in it: the same vertices and faces, through which no distance and no path goes.

        :param mask: one bool per vertex: open are the faces whose three vertices are.
        :param vertices: numbers, or a mask with one bool per vertex: nothing passes them, all their faces are blocked.
        :param faces: numbers, or a mask with one bool per face: nothing enters them.
        :param edges: (k, 2) vertex numbers: both sides can be reached, nothing crosses.
        :return: a mesh whose every method keeps to what is open, in the numbers of this one. What lies behind a wall reads
            +inf; a vertex on a wall has the least distance of its sides.
        :raises BrushfireError: for arrays of another shape, and two vertices that no edge joins.
        :raises BrushfireIndexError: for what does not exist.

        Walls add to those that are there. A wall is tight, also where blocked faces touch at a vertex only.
        :meth:`cut` gives the open part as a mesh of its own.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> walled = mesh.walled(edges=[(0, 2)])
        >>> mesh.distance(1, method="exact").tolist(), walled.distance(1, method="exact").tolist()
        ([3.0, 0.0, 4.0, 5.0], [3.0, 0.0, 4.0, inf])
        >>> walled
        Mesh(4 vertices, 2 faces, walls)
        """
        blocked = self._barriers(vertices, faces, edges)
        if mask is not None:
            closed = self._closed_faces(mask)
            blocked = blocked[0], np.concatenate([blocked[1], closed]), blocked[2]
        if self._walls is not None:
            old = self._walls
            blocked = tuple(np.concatenate(pair) for pair in zip(old, blocked, strict=True))  # type: ignore[assignment]
        walled = self._of(self._mesh)
        walled._walls, walled._domain = blocked, _core.make_domain(self._mesh, *blocked)
        return walled

    def _closed_faces(self, open_vertices: npt.ArrayLike) -> Ints:
        mask = np.asarray(open_vertices)
        if mask.dtype != np.bool_ or mask.shape != (self.vertex_count,):
            raise BrushfireError(
                f"open_vertices: one bool per vertex is needed, not {mask.dtype} of shape {mask.shape}"
            )
        closed = ~mask[self.faces].all(axis=1) if self.face_count else np.zeros(0, dtype=bool)
        return np.flatnonzero(closed).astype(np.int64)

    def masked(self, open_vertices: npt.ArrayLike) -> Mesh:
        """:meth:`walled` by a mask: only the faces whose three vertices are all open.

        :param open_vertices: one bool per vertex. Closed vertices, and those left without a face, read +inf.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.masked([True, True, True, False]).distance(0, method="exact").tolist()
        [0.0, 3.0, 5.0, inf]
        """
        return self.walled(faces=self._closed_faces(open_vertices))

    @property
    def open_vertices(self) -> npt.NDArray[np.bool_]:
        """Which vertices are in a face that no wall blocks, (vertex_count,).

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.walled(faces=[1]).open_vertices.tolist()
        [True, True, True, False]
        """
        return self._open_part()["open"].astype(bool)  # type: ignore[no-any-return]

    @property
    def open_components(self) -> int:
        """In how many pieces walls leave the mesh, which hang together through faces and vertices.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.open_components, mesh.walled(edges=[(0, 2)]).open_components
        (1, 2)
        """
        return int(self._open_part()["components"])

    def _open_part(self) -> dict[str, Any]:
        return (self._domain or _core.Domain(self._mesh)).open_part()

    @property
    def _space(self) -> _core.Space:
        return self._mesh if self._domain is None else self._domain

    def weld(self, tolerance: float) -> tuple[Mesh, npt.NDArray[np.int32]]:
        """The mesh with vertices that are near one another made one, so that faces that only touch are connected.

        :param tolerance: how near, >= 0, in units of the vertices; 0 joins equal positions. No position moves farther.
        :return: the mesh, and which of its vertices each of these became, (vertex_count,). Faces keep their numbers.
        :raises BrushfireError: for a mesh from lengths, and for a tolerance that is no number >= 0.

        >>> import brushfire as bf
        >>> torn = bf.Mesh([[0, 0], [1, 0], [1, 1], [1, 0], [2, 0], [1, 1]], [[0, 1, 2], [3, 4, 5]])
        >>> mesh, vertex_map = torn.weld(0)
        >>> mesh, vertex_map.tolist(), mesh.distance(0)[vertex_map].round(6).tolist()
        (Mesh(4 vertices, 2 faces), [0, 1, 2, 1, 3, 2], [0.0, 1.0, 1.414214, 1.0, 2.0, 1.414214])
        """
        core, vertex_map, _ = _core.weld(self._mesh, number(tolerance, "tolerance"))
        return type(self)._of(core), vertex_map

    @property
    def area(self) -> float:
        """The area of the surface, in the square of the units of the vertices.

        >>> import brushfire as bf
        >>> bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]]).area
        12.0
        """
        return float(self._mesh.report()["area"])  # type: ignore[arg-type]

    def solver(
        self,
        method: str | None = None,
        *,
        tolerance: Tolerance | None = None,
        bound: str | None = None,
        precision: str | None = None,
    ) -> Solver:
        """A solver for many calls on this mesh: see :class:`Solver`, which takes the same arguments."""
        return Solver(self, method, tolerance=tolerance, bound=bound, precision=precision)

    def signed_distance(
        self, curves: Sources, *, radius: float = np.inf, threads: int = 1, progress: Progress = None
    ) -> Floats:
        """Exact distance with a sign: negative on the left of the nearest curve, positive on its right.

        Left is seen along the curve, the faces lying counter-clockwise: the inside of a closed curve that runs
        counter-clockwise is negative, and curves that nest with opposite senses bound what lies between them. On which
        side a vertex is, its shortest path says, by where it arrives (docs/curve-sources.md); where there is no side, as on
        the curve, the distance is positive.

        :param curves: one or several, as :meth:`distance` takes them, without offsets.
        :param radius, threads, progress: as for :meth:`distance`.
        :return: float64 (vertex_count,); +inf where nothing is reached.
        :raises BrushfireError: for points among the curves, offsets, a mesh with walls, and as :meth:`distance` does.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.signed_distance(bf.Curve([0, 2])).round(9).tolist()
        [0.0, 2.4, 0.0, -2.4]
        """
        if self._walls is not None:
            raise BrushfireError("signed_distance: a mesh with walls has no sides; cut() it")
        chosen = options("exact", None, radius, threads=threads)
        start = sources_of(self, curves)
        with shown(progress, "distance") as report:
            return _core.signed_distance(self._mesh, start, chosen, report)

    def page(
        self,
        values: npt.ArrayLike | None = None,
        *,
        sources: Places | None = None,
        method: str | None = None,
        tolerance: float | None = None,
        name: str = "mesh",
    ) -> str:
        """One HTML page with the mesh and the library in it, which computes as one clicks; what ``brushfire view`` writes.

        :param values: (vertex_count,) distances that are shown until a source is set; None: the page computes those from
            ``sources``.
        :param sources: where the page starts from; None: the first corner of face 0.
        :param method, tolerance: what it computes with, as for :meth:`distance`.
        :param name: what it calls the mesh.
        :raises BrushfireError: where the package was built without the page (``./run web`` in the sources builds it, the
            environment's BRUSHFIRE_VIEWER names one that lies elsewhere); for a mesh without faces or positions, for
            values that are not one per vertex, and as :meth:`distance` does.

        >>> import brushfire as bf, pathlib
        >>> mesh = bf.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
        >>> pathlib.Path("page.html").write_text(mesh.page(sources=0))  # doctest: +SKIP
        """
        return _viewer.page_of(self, values, sources, method, tolerance, name)

    def show(
        self,
        values: npt.ArrayLike | None = None,
        *,
        sources: Places | None = None,
        method: str | None = None,
        tolerance: float | None = None,
        height: int = 480,
    ) -> Any:
        """In a notebook: the surface, which one turns and clicks on, and the distances from where one clicked.

        The result is a widget (anywidget's) with ``sources``, a trait that follows the page's, and ``points``, the same as
        :class:`Points`; ``widget.observe(f, "sources")`` calls ``f`` whenever they change. Where anywidget is not
        installed, or this package was built without the page, it is a picture of ``values`` (:meth:`panel`).

        :param height: of the frame, in pixels.
        :param values, sources, method, tolerance: as for :meth:`page`, which raises the same.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
        >>> shown = mesh.show(mesh.distance(0))  # the last line of a notebook's cell, without a name
        """
        return _viewer.show(self, values, sources, method, tolerance, height)

    def _run(self) -> _core.Solver:
        return _core.Solver(self._space)

    def _whole(self) -> Mesh:
        return self

    def _arrays(self, places: Any, what: str) -> PlaceArrays:
        if isinstance(places, At):
            places = self._snapped(places)
        return place_arrays(places, self.vertex_count, what)

    def __repr__(self) -> str:
        walls = "" if self._walls is None else ", walls"
        return f"Mesh({self.vertex_count} vertices, {self.face_count} faces{walls})"

    def _repr_html_(self) -> str:
        return mesh_table(self)

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        if self._walls is not None:
            return _walled, (self._of(self._mesh), *self._walls)
        if self._mesh.has_positions:
            return type(self), (self.vertices, self.faces)
        return type(self).from_lengths, (self.faces, self._mesh.lengths(), self.vertex_count)

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        return self


class Solver(Distances, Curves, Fields):
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
        limit = number(radius, "radius")
        with shown(progress, "rows") as report:
            data, indices, starts = self._solver_rows(limit, row, chosen, report)
        return sparse_matrix(data.astype(wanted, copy=False), indices, starts, self._mesh.vertex_count)

    def _solver_rows(self, radius: float, row: PlaceArrays, chosen: Options, report: Any) -> Any:
        return _core.sparse_rows(self._solver, radius, row.index, row.weights, chosen, report)

    def _or_defaults(
        self, method: Any, tolerance: Any, bound: Any, precision: Any, *, limit: Any
    ) -> tuple[Any, Any, Any, Any, Any]:
        if method is None and tolerance is None and bound is None:
            method, tolerance, bound, usual = self._defaults
            precision = usual if precision is None else precision
        return method, tolerance, limit, bound, precision

    def _run(self) -> _core.Solver:
        return self._solver

    def _arrays(self, places: Any, what: str) -> PlaceArrays:
        return self.mesh._arrays(places, what)

    def __repr__(self) -> str:
        return f"Solver({self.mesh!r})"

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return _solver, (self.mesh, *self._defaults)


def _walled(mesh: Mesh, vertices: Ints, faces: Ints, ends: Ints) -> Mesh:
    """One that was pickled."""
    return mesh.walled(vertices=vertices, faces=faces, edges=ends.reshape(-1, 2))


def _solver(mesh: Mesh, method: Any, tolerance: Any, bound: Any, precision: Any) -> Solver:
    """One that was pickled."""
    return Solver(mesh, method, tolerance=tolerance, bound=bound, precision=precision)
