"""Mesh and Solver."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats, number
from brushfire._certify import Certificates
from brushfire._curves import Curves
from brushfire._distance import Distances, Progress
from brushfire._errors import BrushfireError
from brushfire._fields import Fields
from brushfire._options import options, thread_count
from brushfire._picture import Pictures
from brushfire._places import At, PlaceArrays, Places, Points, at, is_one, place_arrays
from brushfire._regions import Regions

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


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


class Mesh(Distances, Curves, Fields, Certificates, Regions, Pictures):
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
        count = int(f.max()) + 1 if f.size and vertex_count is None else int(vertex_count or 0)
        if count < 0:
            raise BrushfireError(f"vertex_count: {count} is negative")
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
        """The positions, (vertex_count, 3), a read-only view; (0, 3) for a mesh from lengths."""
        return self._mesh.vertices

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """The vertex numbers of the faces, (face_count, 3), a read-only view."""
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

    def nearest(self, xyz: npt.ArrayLike) -> tuple[Points, Floats]:
        """The points of the surface nearest to positions in space, and how far away they are.

        :param xyz: (k, 3), or (3,) for a single one.
        :return: :class:`Points` and distances, (k,) each.
        :raises BrushfireError: for a mesh from lengths or without faces, and for positions that are not finite.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
        >>> points, distance = mesh.nearest([[0.5, 0.5, 3]])
        >>> points.face.tolist(), points.weights.tolist(), distance.tolist()
        ([0], [[0.5, 0.25, 0.25]], [3.0])
        """
        if self._finder is None:
            self._finder = _core.NearestPointFinder(self._mesh)
        face, weights, distance = self._finder.nearest(at(xyz).xyz)
        return Points(face, weights), distance

    def masked(self, open_vertices: npt.ArrayLike) -> Mesh:
        """The mesh of the faces whose three vertices are all open; vertices keep their numbers.

        :param open_vertices: one bool per vertex. Closed vertices, and those left without a face, read +inf.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.masked([True, True, True, False]).distance(0, method="exact").tolist()
        [0.0, 3.0, 5.0, inf]
        """
        mask = np.asarray(open_vertices)
        if mask.dtype != np.bool_ or mask.shape != (self.vertex_count,):
            raise BrushfireError(
                f"open_vertices: one bool per vertex is needed, not {mask.dtype} of shape {mask.shape}"
            )
        chosen = mask[self.faces].all(axis=1) if self.face_count else np.zeros(0, dtype=bool)
        if self._mesh.has_positions:
            return type(self)(self.vertices, self.faces[chosen])
        return type(self).from_lengths(self.faces[chosen], self._mesh.lengths()[chosen], self.vertex_count)

    def solver(self) -> Solver:
        """A solver for many calls on this mesh: see :class:`Solver`."""
        return Solver(self)

    def distance_matrix(
        self,
        rows: Places | None = None,
        columns: Places | None = None,
        *,
        method: str | None = None,
        tolerance: float | None = None,
        max_distance: float = np.inf,
        precision: str | None = None,
        dtype: npt.DTypeLike = np.float32,
        out: npt.NDArray[Any] | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> npt.NDArray[Any]:
        """Distances from every row's place to every column's place.

        :param rows: vertices, points or a mask; all vertices if none are given.
        :param columns: likewise.
        :param method, tolerance, precision: as for :meth:`distance`.
        :param max_distance: what is farther reads +inf.
        :param dtype: float32 (rounded from float64, 7 digits) or float64.
        :param out: a C-contiguous, writable array of shape (rows, columns) of the dtype that is wanted, a
            ``numpy.memmap`` for instance, to be filled instead of a new one.
        :param threads: 0 means one per processor. The numbers are the same to the bit for any number of threads.
        :return: (rows, columns). Rows and columns of vertices in no face are +inf throughout.
        :raises BrushfireError: code ``too_large`` before anything is computed where the result does not fit into memory.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.distance_matrix([0, 1], method="dijkstra").tolist()
        [[0.0, 3.0, 5.0, 4.0], [3.0, 0.0, 4.0, 7.0]]
        """
        row, row_count = self._optional(rows, "rows")
        column, column_count = self._optional(columns, "columns")
        shape = (row_count, column_count)
        chosen = options(method, tolerance, max_distance, precision=precision)
        if out is None:
            single = _is_float32(dtype)
            _core.require_dense_memory(*shape, single, 0)
            out = np.empty(shape, dtype=np.float32 if single else np.float64)
        else:
            _check_out(out, shape)
        if out.size:
            _core.fill_matrix(self._mesh, out, *row, *column, chosen, thread_count(threads), progress)
        return out

    def distances_within(
        self,
        radius: float,
        rows: Places | None = None,
        *,
        method: str | None = None,
        tolerance: float | None = None,
        precision: str | None = None,
        dtype: npt.DTypeLike = np.float32,
        threads: int = 0,
        memory_limit: int = 0,
        progress: Progress = None,
    ) -> csr_matrix:
        """All distances up to a radius, as a ``scipy.sparse.csr_matrix`` of shape (rows, vertex_count).

        A row costs what it reaches, whatever the size of the mesh. A place's distance to itself is a stored zero: what is
        not stored is farther than the radius. Columns ascend within a row.

        :param radius: finite, >= 0.
        :param rows: vertices, points or a mask; all vertices if none are given.
        :param method, tolerance, precision: as for :meth:`distance`.
        :param memory_limit: bytes that the result may take; 0 means what the machine has left.
        :raises BrushfireError: code ``too_large`` where the result will not fit.
        :raises ImportError: where scipy is not installed.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> near = mesh.distances_within(3.5, method="dijkstra")
        >>> near.nnz, near[0].indices.tolist(), near[0].data.tolist()
        (8, [0, 1], [0.0, 3.0])
        """
        try:
            from scipy.sparse import csr_matrix
        except ImportError:
            raise ImportError("distances_within() returns a scipy matrix: pip install 'brushfire[sparse]'") from None
        row, row_count = self._optional(rows, "rows")
        compute = _core.sparse_float32 if _is_float32(dtype) else _core.sparse_float64
        if memory_limit < 0:
            raise BrushfireError(f"memory_limit: {memory_limit} is negative")
        data, indices, starts = compute(
            self._mesh,
            number(radius, "radius"),
            *row,
            options(method, tolerance, np.inf, precision=precision),
            thread_count(threads),
            memory_limit,
            progress,
        )
        # scipy wants one integer type for both: 32 bits where they do.
        integer = np.int32 if len(data) <= np.iinfo(np.int32).max else np.int64
        pointers = starts.astype(integer, copy=False)
        numbers = indices.astype(integer, copy=False)
        matrix = csr_matrix((data, numbers, pointers), shape=(row_count, self.vertex_count), copy=False)
        matrix.has_sorted_indices = True
        matrix.has_canonical_format = True
        return matrix

    def write_distance_matrix(
        self,
        path: str | os.PathLike[str],
        rows: Places | None = None,
        columns: Places | None = None,
        *,
        method: str | None = None,
        tolerance: float | None = None,
        max_distance: float = np.inf,
        precision: str | None = None,
        dtype: npt.DTypeLike = np.float32,
        threads: int = 0,
        progress: Progress = None,
    ) -> None:
        """``distance_matrix()`` into a .npy file, a row at a time, for what is larger than memory.

        Interrupted, it goes on where it stopped when it is called again with the same arguments; until it is complete
        the rows stand in ``path + ".part"``. Open the result with ``numpy.load(path, mmap_mode="r")``.

        :raises BrushfireError: code ``file_not_writable``, also where the disk has not enough room left.

        >>> import brushfire as bf, numpy as np, tempfile, os
        >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     mesh.write_distance_matrix(os.path.join(folder, "d.npy"), [1], method="dijkstra")
        ...     np.load(os.path.join(folder, "d.npy")).tolist()
        [[3.0, 0.0, 4.0, 7.0]]
        """
        row, _ = self._optional(rows, "rows")
        column, _ = self._optional(columns, "columns")
        chosen = options(method, tolerance, max_distance, precision=precision)
        _core.write_matrix(
            self._mesh, os.fspath(path), _is_float32(dtype), *row, *column, chosen, thread_count(threads), progress
        )

    def _run(self) -> _core.Solver:
        return _core.Solver(self._mesh)

    def _whole(self) -> Mesh:
        return self

    def _arrays(self, places: Any, what: str) -> PlaceArrays:
        if isinstance(places, At):
            places = self.nearest(places.xyz)[0]
        return place_arrays(places, self.vertex_count, what)

    def _optional(self, places: Any, what: str) -> tuple[tuple[Any, Any], int]:
        """Index and weights, and how many; all vertices for None."""
        if places is None:
            return (None, None), self.vertex_count
        arrays = self._arrays(places, what)
        return (arrays.index, arrays.weights), len(arrays.index)

    def __repr__(self) -> str:
        return f"Mesh({self.vertex_count} vertices, {self.face_count} faces)"

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        if self._mesh.has_positions:
            return type(self), (self.vertices, self.faces)
        return type(self).from_lengths, (self.faces, self._mesh.lengths(), self.vertex_count)

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        return self


class Solver(Distances):
    """Distances again and again on one mesh: the workspace is made once, a radius-limited call costs what it reaches.

    Safe to share between threads, which then wait for each other; give every thread a solver of its own where they
    should not.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> solver = mesh.solver()
    >>> [solver.distance(v, method="dijkstra").max().item() for v in range(4)]
    [5.0, 7.0, 5.0, 7.0]
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._solver = _core.Solver(mesh._mesh)

    def _run(self) -> _core.Solver:
        return self._solver

    def _arrays(self, places: Any, what: str) -> PlaceArrays:
        return self.mesh._arrays(places, what)

    def __repr__(self) -> str:
        return f"Solver({self.mesh!r})"

    def __reduce__(self) -> tuple[type[Solver], tuple[Mesh]]:
        return type(self), (self.mesh,)


def _is_float32(dtype: npt.DTypeLike) -> bool:
    wanted = np.dtype(dtype)
    if wanted not in (np.dtype(np.float32), np.dtype(np.float64)):
        raise BrushfireError(f"dtype: float32 or float64 are possible, not {wanted}")
    return bool(wanted == np.float32)


def _check_out(out: Any, shape: tuple[int, int]) -> None:
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out: a numpy array is needed, not {type(out).__name__}")
    _is_float32(out.dtype)
    if out.shape != shape or not out.flags.c_contiguous or not out.flags.writeable:
        raise BrushfireError(f"out: a writable C-contiguous array of shape {shape} is needed, not {out.shape}")
