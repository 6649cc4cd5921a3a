"""Patches of a surface that follow a given base mesh: shortest paths between landmarks that do not cross."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, Labels, any_array, whole
from brushfire._errors import BrushfireError

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

Edge = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Patches:
    """What :func:`patches` returns.

    ``mesh``: the surface, its faces cut where paths cross them: its first vertices are those of the mesh that was given.
    ``paths``: for every edge (i, j) of the base mesh, i < j, the vertices of ``mesh`` along it. ``patch`` (face_count,):
    which face of the base mesh a face of ``mesh`` belongs to. ``touching``: edges whose path had to run along earlier
    ones; none crosses another.
    """

    mesh: Mesh
    base: npt.NDArray[np.int64]
    landmarks: tuple[int, ...]
    paths: dict[Edge, list[int]]
    patch: Labels
    touching: tuple[Edge, ...]

    def __repr__(self) -> str:
        return f"Patches({len(self.base)} patches, {len(self.paths)} paths)"

    def resample(self, count: int) -> tuple[Floats, npt.NDArray[np.int32]]:
        """A mesh over the base mesh that is the same for every surface: each patch a triangle of count^2 faces.

        :param count: into how many pieces each path is cut, >= 1.
        :return: vertices and faces; the faces, and what the vertices mean, depend on the base mesh and ``count`` alone, so
            that two surfaces are blended by blending the vertices.
        :raises ImportError: where scipy is not installed.

        Paths are cut by arc length; patches are laid into triangles by Tutte's embedding.

        >>> import brushfire as bf, numpy as np
        >>> V = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1.0]])
        >>> F = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
        >>> vertices, faces = bf.patches(bf.Mesh(V, F), range(6), F).resample(2)  # doctest: +SKIP
        """
        return _resampled(self, whole(count, "count", 10_000))


def patches(mesh: Mesh, landmarks: Sequence[int], connectivity: npt.ArrayLike) -> Patches:
    """Cuts a surface into patches, one for each face of a base mesh over landmarks (Praun, Sweldens, Schroder, 2001).

    :param mesh: connected, consistently oriented, without edges of three faces; fine enough that paths find room.
    :param landmarks: the vertex that each vertex of the base mesh stands for.
    :param connectivity: (k, 3) the faces of the base mesh, positions in ``landmarks``, oriented as the surface.
    :return: :class:`Patches`.
    :raises BrushfireError: where a landmark cannot be reached without crossing, and for landmarks that repeat.

    Paths are traced in order of length: first a tree that spans the landmarks, then the rest. Each is the shortest that
    keeps off earlier ones and leaves and arrives in its place in the cyclic order of the base mesh, so that none crosses
    another and none swirls around a landmark. Where no room is left beside earlier paths it runs along them.

    >>> import brushfire as bf, numpy as np
    >>> V = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1.0]])
    >>> F = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    >>> octahedron = bf.Mesh(V, F)
    >>> found = bf.patches(octahedron, [0, 1, 2, 3, 4, 5], F)
    >>> found, np.unique(found.patch).size
    (Patches(8 patches, 12 paths), 8)
    """
    base = any_array(connectivity, "connectivity").astype(np.int64)
    if base.ndim != 2 or base.shape[1:] != (3,):
        raise BrushfireError(f"connectivity: shape (k, 3) is needed, not {base.shape}")
    places = tuple(int(v) for v in landmarks)
    if len(set(places)) < len(places):
        raise BrushfireError("landmarks: one repeats")
    tracer = _Tracer(mesh, places, base)
    tracer.run()
    return Patches(tracer.mesh, base, places, tracer.paths, tracer.patch_of_faces(), tuple(tracer.touching))


def _rings(base: npt.NDArray[np.int64], count: int) -> list[list[int]]:
    """The neighbours of every base vertex, counter-clockwise."""
    after: list[dict[int, int]] = [{} for _ in range(count)]
    for face in base.tolist():
        for k in range(3):
            after[face[k]][face[(k + 1) % 3]] = face[(k + 2) % 3]
    rings = []
    for turn in after:
        first = next(iter(set(turn) - set(turn.values())), next(iter(turn), None))
        ring = [] if first is None else [first]
        while ring and ring[-1] in turn and turn[ring[-1]] != first:
            ring.append(turn[ring[-1]])
        rings.append(ring)
    return rings


class _Tracer:
    """The surface as it is cut up, and what has been traced on it."""

    def __init__(self, mesh: Mesh, landmarks: tuple[int, ...], base: npt.NDArray[np.int64]) -> None:
        self.mesh, self.landmarks, self.base = mesh, landmarks, base
        self.rings = _rings(base, len(landmarks))
        self.paths: dict[Edge, list[int]] = {}
        self.touching: list[Edge] = []
        self.walls: set[Edge] = set()

    def run(self) -> None:
        edges = {
            (min(a, b), max(a, b))
            for face in self.base.tolist()
            for a, b in zip(face, face[1:] + face[:1], strict=True)
        }
        matrix = self.mesh.distance_matrix(list(self.landmarks), list(self.landmarks), dtype=np.float64)
        waiting = sorted(edges, key=lambda e: (matrix[e], e))
        tree, rest, joined = [], [], list(range(len(self.landmarks)))
        for a, b in waiting:
            if joined[a] != joined[b]:
                tree.append((a, b))
                joined = [joined[a] if j == joined[b] else j for j in joined]
            else:
                rest.append((a, b))
        for edge in tree + rest:
            self._trace(edge)

    # ---- one path

    def _trace(self, edge: Edge) -> None:
        a, b = edge
        for _ in range(_REFINEMENTS):
            cut, path = self._path(edge, off=True)
            if path is not None:
                break
            self._refine_beside(edge)
        else:
            cut, path = self._path(edge, off=False)
            if path is None:
                raise BrushfireError(f"patches: nothing leads from landmark {a} to {b} without crossing a path")
            self.touching.append(edge)
        points = path.points if cut is None else cut.points_to_original(path.points)
        way = self._insert(points)
        self.paths[edge] = way
        self.walls |= {(min(p, q), max(p, q)) for p, q in zip(way, way[1:], strict=False)}

    def _path(self, edge: Edge, *, off: bool) -> tuple[Any, Any]:
        """The surface cut along earlier paths, and the shortest path there; ``off``: that touches none."""
        a, b = edge
        cut = self.mesh.cut(edges=np.array(sorted(self.walls)).reshape(-1, 2)) if self.walls else None
        mesh = self.mesh if cut is None else cut.mesh
        original = np.arange(mesh.vertex_count) if cut is None else np.asarray(cut.original_vertex)
        start, end = self._side(cut, a, b), self._side(cut, b, a)
        blocked = np.flatnonzero(np.isin(original, self._taken(edge))) if off else np.zeros(0, dtype=int)
        path = (mesh.walled(vertices=blocked) if len(blocked) else mesh).path(start, end)
        return cut, path if len(path.points) else None

    def _taken(self, edge: Edge) -> list[int]:
        """Vertices of earlier paths, and the other landmarks."""
        taken = {v for way in self.paths.values() for v in way} | set(self.landmarks)
        return sorted(taken - {self.landmarks[edge[0]], self.landmarks[edge[1]]})

    def _refine_beside(self, edge: Edge) -> None:
        """Cuts the edges that end at what is taken in two: what is next to it becomes half as wide."""
        vertices, faces = self.mesh.vertices, self.mesh.faces
        ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        ends = np.unique(np.sort(ends, axis=1), axis=0)
        ends = ends[np.isin(ends, self._taken(edge)).any(axis=1)]
        chosen = [(p, q) for p, q in ends.tolist() if (p, q) not in self.walls]
        split = {e: len(vertices) + i for i, e in enumerate(chosen)}
        keep, new = _cut_faces(faces, split, [])
        middles = vertices[np.array(chosen)].mean(axis=1)
        self.mesh = type(self.mesh)(np.concatenate([vertices, middles]), np.concatenate([faces[keep], new]))

    def _side(self, cut: Any, a: int, b: int) -> int:
        """The copy of landmark a, in the cut mesh, between its traced neighbours on either side of b."""
        ring = self.rings[a]
        place = ring.index(b)
        before = [c for c in ring[place - 1 :: -1] + ring[:place:-1] if c != b] if place else ring[:0:-1]
        for c in before:
            way = self.paths.get((min(a, c), max(a, c)))
            if way is None or cut is None:
                continue
            first, second = (way[0], way[1]) if way[0] == self.landmarks[a] else (way[-1], way[-2])
            return self._left_copy(cut, first, second)
        return self.landmarks[a]

    def _left_copy(self, cut: Any, v: int, w: int) -> int:
        """The copy of v in the face to the left of its edge to w."""
        faces = self.mesh.faces
        for k in range(3):
            found = np.flatnonzero((faces[:, k] == v) & (faces[:, (k + 1) % 3] == w))
            if len(found):
                return int(cut.mesh.faces[int(cut.cut_face[found[0]]), k])
        return v

    # ---- faces are cut along a path

    def _insert(self, points: Any) -> list[int]:
        """The vertices along the path, new ones where it crosses an edge; the mesh is the refined one then."""
        vertices, faces = self.mesh.vertices, self.mesh.faces
        weights = np.where(points.weights < _SNAP, 0, points.weights)
        way: list[int] = []
        split: dict[Edge, int] = {}
        added: list[Any] = []
        for face, weight in zip(points.face, weights / weights.sum(axis=1, keepdims=True), strict=True):
            corners = faces[face]
            on = np.flatnonzero(weight)
            if len(on) == 1:
                vertex = int(corners[on[0]])
            else:
                ends = (int(min(corners[on])), int(max(corners[on])))
                if ends not in split:
                    split[ends] = len(vertices) + len(added)
                    added.append(weight @ vertices[corners])
                vertex = split[ends]
            if not way or way[-1] != vertex:
                way.append(vertex)
        if split:
            keep, new = _cut_faces(faces, split, way)
            positions = np.concatenate([vertices, np.array(added)])
            self._split_walls(split)
            self.mesh = type(self.mesh)(positions, np.concatenate([faces[keep], new]))
        return way

    def _split_walls(self, split: dict[Edge, int]) -> None:
        for (p, q), middle in split.items():
            if (p, q) in self.walls:  # touched, not crossed
                self.walls -= {(p, q)}
                self.walls |= {(p, middle), (q, middle)}
                for way in self.paths.values():
                    for i in range(len(way) - 1):
                        if {way[i], way[i + 1]} == {p, q}:
                            way.insert(i + 1, middle)
                            break

    def patch_of_faces(self) -> Labels:
        """By flooding between the paths, from the left of each base face's first edge."""
        faces = self.mesh.faces
        cut = self.mesh.cut(edges=np.array(sorted(self.walls)).reshape(-1, 2))
        component = _components(cut.mesh.faces, cut.mesh.vertex_count)
        label = np.full(len(faces), -1, dtype=np.int32)
        left = {(int(f[k]), int(f[(k + 1) % 3])): i for i, f in enumerate(faces) for k in range(3)}
        for number, face in enumerate(self.base.tolist()):
            a, b = face[0], face[1]
            way = self.paths[(min(a, b), max(a, b))]
            if a > b:
                way = way[::-1]
            for p, q in zip(way, way[1:], strict=False):
                inside = left.get((p, q))
                if inside is None:
                    continue
                members = np.flatnonzero(component == component[int(cut.cut_face[inside])])
                if (label[members] < 0).all():
                    label[members] = number
                break
        return label


_REFINEMENTS = 4  # two make room in a corner between two paths, a third beside another landmark
_SNAP = 1e-9  # nearer to an edge than this share of the face, a path's point lies on it


def _cut_faces(
    faces: npt.NDArray[Any], split: dict[Edge, int], way: list[int]
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[Any]]:
    """Faces with new vertices on their edges, cut so that the path runs along edges."""
    steps = {frozenset(pair) for pair in zip(way, way[1:], strict=False)}
    ends = np.array(list(split))
    touched = np.isin(faces, ends[:, 0]).any(axis=1) & np.isin(faces, ends[:, 1]).any(axis=1)
    keep = np.ones(len(faces), dtype=bool)
    new: list[list[int]] = []
    for f in np.flatnonzero(touched):
        polygon: list[int] = []
        corners = faces[f].tolist()
        for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
            polygon.append(a)
            middle = split.get((min(a, b), max(a, b)))
            if middle is not None:
                polygon.append(middle)
        if len(polygon) > 3:
            keep[f] = False
            new += _triangles(polygon, steps, set(split.values()))
    return keep, np.array(new, dtype=faces.dtype).reshape(-1, 3)


def _triangles(polygon: list[int], steps: set[frozenset[int]], added: set[int]) -> list[list[int]]:
    """Of a triangle with points on its sides: cut along the path first, then what is between two points off."""
    n = len(polygon)
    if n == 3:
        return [polygon]
    for i in range(n):
        for j in range(i + 2, n):
            if (i, j) != (0, n - 1) and frozenset((polygon[i], polygon[j])) in steps:
                rest = steps - {frozenset((polygon[i], polygon[j]))}
                return _triangles(polygon[i : j + 1], rest, added) + _triangles(
                    polygon[j:] + polygon[: i + 1], rest, added
                )
    for i in range(n):
        before, after = polygon[i - 1], polygon[(i + 1) % n]
        if polygon[i] not in added and before in added and after in added:
            return [[before, polygon[i], after], *_triangles(polygon[:i] + polygon[i + 1 :], steps, added)]
    # A fan from a point of a side: it sees all corners.
    first = next(i for i in range(n) if polygon[i] in added)
    turned = polygon[first:] + polygon[:first]
    return [[turned[0], turned[i], turned[i + 1]] for i in range(1, n - 1)]


def _components(faces: npt.NDArray[Any], vertex_count: int) -> npt.NDArray[np.int64]:
    """Of faces that share an edge."""
    from brushfire._reeb import _connected

    ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64), axis=1)
    owner = np.tile(np.arange(len(faces)), 3)
    order = np.lexsort((owner, ends[:, 1], ends[:, 0]))
    same = np.flatnonzero((ends[order][1:] == ends[order][:-1]).all(axis=1))
    return _connected(len(faces), np.column_stack([owner[order][same], owner[order][same + 1]]))


# ---- the same mesh over every surface


def _resampled(patches: Patches, count: int) -> tuple[Floats, npt.NDArray[np.int32]]:
    if count < 1:
        raise BrushfireError("count: at least 1 is needed")
    grid = [(i, j) for i in range(count + 1) for j in range(count + 1 - i)]
    number = {p: n for n, p in enumerate(grid)}
    weights = np.array([[count - i - j, i, j] for i, j in grid]) / count
    triangles = [[number[i, j], number[i + 1, j], number[i, j + 1]] for i, j in grid if i + j < count]
    triangles += [[number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]] for i, j in grid if i + j < count - 1]
    points, faces, meaning = [], [], []
    for k, corners in enumerate(patches.base.tolist()):
        points.append(_sampled_patch(patches, k, weights))
        faces.append(np.array(triangles) + len(grid) * k)
        for w in (weights * count).round().astype(int).tolist():
            meaning.append(tuple(sorted((c, n) for c, n in zip(corners, w, strict=True) if n)) if 0 in w else (k, *w))
    # Points of edges and corners are one for all patches there.
    names: dict[Any, int] = {}
    index = np.array([names.setdefault(m, len(names)) for m in meaning])
    vertices = np.zeros((len(names), 3))
    vertices[index[::-1]] = np.concatenate(points)[::-1]
    return vertices, index[np.concatenate(faces)].astype(np.int32)


def _sampled_patch(patches: Patches, k: int, weights: Floats) -> Floats:
    mesh = patches.mesh
    faces = mesh.faces[patches.patch == k]
    used, local = np.unique(faces, return_inverse=True)
    local = local.reshape(-1, 3)
    flat = _tutte(patches, k, used, local)
    corner = np.array([[0, 0], [1, 0], [0, 1.0]])
    plane = type(mesh)(flat, local)
    found, _ = plane.nearest(np.column_stack([weights @ corner, np.zeros(len(weights))]))
    result: Floats = np.einsum("nk,nkx->nx", found.weights, mesh.vertices[used][local[found.face]])
    return result


def _tutte(patches: Patches, k: int, used: npt.NDArray[Any], faces: npt.NDArray[Any]) -> Floats:
    """The patch in the triangle (0,0), (1,0), (0,1): its rim by arc length, every other vertex the mean of its neighbours."""
    import scipy.sparse
    import scipy.sparse.linalg

    corner = np.array([[0, 0], [1, 0], [0, 1.0]])
    flat = np.zeros((len(used), 2))
    fixed = np.zeros(len(used), dtype=bool)
    base = patches.base[k].tolist()
    for s in range(3):
        a, b = base[s], base[(s + 1) % 3]
        way = patches.paths[(min(a, b), max(a, b))]
        way = way if a < b else way[::-1]
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(patches.mesh.vertices[way], axis=0), axis=1))])
        share = (length / length[-1])[:, None]
        where = np.searchsorted(used, way)
        flat[where] = (1 - share) * corner[s] + share * corner[(s + 1) % 3]
        fixed[where] = True
    i = faces[:, [0, 1, 2, 1, 2, 0]].ravel()
    j = faces[:, [1, 2, 0, 0, 1, 2]].ravel()
    beside = scipy.sparse.csr_matrix((np.ones(len(i)), (i, j)), shape=(len(used),) * 2)
    beside.data[:] = 1
    free = np.flatnonzero(~fixed)
    if len(free):
        laplacian = (scipy.sparse.diags(np.asarray(beside.sum(axis=1)).ravel()) - beside).tocsr()
        right = -laplacian[free][:, np.flatnonzero(fixed)] @ flat[fixed]
        flat[free] = scipy.sparse.linalg.spsolve(laplacian[free][:, free].tocsc(), right)
    return flat
