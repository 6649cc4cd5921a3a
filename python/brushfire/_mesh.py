"""Mesh: what it is made of; what it can do stands in the modules of functions that it names."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import (
    _arrays,
    _barriers,
    _boundaries,
    _cells,
    _certify,
    _core,
    _curves,
    _derivatives,
    _distance,
    _extent,
    _fields,
    _files,
    _isochrones,
    _matrices,
    _panel,
    _regions,
    _sets,
    _smoothing,
    _snapping,
    _viewer,
    _weighted,
)
from brushfire._arrays import Floats, Ints, number
from brushfire._errors import BrushfireError
from brushfire._notebook import mesh_table
from brushfire._options import Tolerance
from brushfire._places import At, PlaceArrays, Places, Points, at, place_arrays
from brushfire._report import MeshReport
from brushfire._solver import Solver


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


class Mesh:
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

    distance, signed_distance = _distance.distance, _distance.signed_distance
    distance_vjp = _derivatives.distance_vjp
    pair_distances = _sets.pair_distances
    distance_matrix, distances_within = _matrices.distance_matrix, _matrices.distances_within
    write_distance_matrix = _matrices.write_distance_matrix
    certify = _certify.certify
    weighted, isochrones = _weighted.weighted, _isochrones.isochrones

    path, paths, edge_path = _curves.path, _curves.paths, _curves.edge_path
    shorten, length_of = _curves.shorten, _curves.length_of
    trace, angle_of, log_map = _curves.trace, _curves.angle_of, _curves.log_map
    boundaries, region = _boundaries.boundaries, _boundaries.region
    curve_along, project_curve = _boundaries.curve_along, _boundaries.project_curve

    isolines, curved_isolines = _fields.isolines, _fields.curved_isolines
    gradient, steepest_descent, vertex_areas = _fields.gradient, _fields.steepest_descent, _fields.vertex_areas
    smoothing_kernel, smooth = _smoothing.smoothing_kernel, _smoothing.smooth

    voronoi, farthest_points = _regions.voronoi, _regions.farthest_points
    nearest_sources, centroidal_voronoi, parcels = _cells.nearest_sources, _cells.centroidal_voronoi, _cells.parcels
    extent, eccentricity, average_distance = _extent.extent, _extent.eccentricity, _extent.average_distance
    discs, karcher_mean = _extent.discs, _extent.karcher_mean

    position, nearest = _snapping.position, _snapping.nearest
    cut, walled, masked = _regions.cut, _barriers.walled, _barriers.masked

    panel, render, ambient_occlusion = _panel.panel, _panel.render, _panel.ambient_occlusion
    save = _files.save

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

    def _snapped_all(self, xyz: Floats) -> Points:
        return _snapping.snapped(self, at(xyz))

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
        Of a mesh with walls, the page has what they leave open, cut apart along them.

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

    def _or_defaults(
        self, method: Any, tolerance: Any, bound: Any, precision: Any, *, limit: Any
    ) -> tuple[Any, Any, Any, Any, Any]:
        """As options() takes them; a solver has defaults."""
        return method, tolerance, limit, bound, precision

    def _arrays(self, places: Any, what: str) -> PlaceArrays:
        if isinstance(places, At):
            places = _snapping.snapped(self, places)
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


def _walled(mesh: Mesh, vertices: Ints, faces: Ints, ends: Ints) -> Mesh:
    """One that was pickled."""
    return mesh.walled(vertices=vertices, faces=faces, edges=ends.reshape(-1, 2))
