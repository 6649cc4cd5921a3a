"""Patches of a surface that follow a given base mesh: shortest paths between landmarks that do not cross."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, Labels, whole
from brushfire._base_mesh import BaseMesh, base_mesh, check_surface, landmark_vertices, manifold_surface
from brushfire._errors import BrushfireError
from brushfire._faces import Edge, components, edges_of, filled_euler_characteristic, split_faces
from brushfire._resampled import resampled

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


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
        return resampled(self, whole(count, "count", 10_000))


def patches(mesh: Mesh, landmarks: Sequence[int], connectivity: npt.ArrayLike) -> Patches:
    """Cuts a surface into patches, one for each face of a base mesh over landmarks (Praun, Sweldens, Schroder, 2001).

    :param mesh: consistently oriented, without edges of three faces, in the components that landmarks lie in. Holes are
        no matter as long as each lies within a patch. Faces that name a vertex twice are left out, and where fans of
        faces meet at a vertex, each has one of its own.
    :param landmarks: the vertex that each vertex of the base mesh stands for.
    :param connectivity: (k, 3) the faces of the base mesh, positions in ``landmarks``, oriented as the surface: a
        manifold, with as many handles as the surface where it is closed. Open ones may lie anywhere.
    :return: :class:`Patches`.
    :raises BrushfireError: for landmarks that repeat or lie apart, a base mesh that is none or that fits the surface in
        one sense only, the other, and where nothing leads from one landmark to another without crossing a path.
    :raises BrushfireIndexError: for landmarks that do not exist.

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
    places = landmark_vertices(mesh, landmarks)
    base = base_mesh(connectivity, len(places))
    surface = manifold_surface(mesh, places)
    lengths = check_surface(surface, places, base)
    tracer = _Tracer(surface, places, base)
    tracer.run(lengths)
    return Patches(tracer.mesh, base.faces, places, tracer.paths, tracer.patch_of_faces(), tuple(tracer.touching))


class _Tracer:
    """The surface as it is cut up, and what has been traced on it."""

    def __init__(self, mesh: Mesh, landmarks: tuple[int, ...], base: BaseMesh) -> None:
        self.mesh, self.landmarks, self.base = mesh, landmarks, base
        self.paths: dict[Edge, list[int]] = {}
        self.touching: list[Edge] = []
        self.walls: set[Edge] = set()
        # As if every path came through every face of the surface, which shortest paths do once at most: each time two
        # faces more. What comes to that many winds around others without end.
        self.most_faces = mesh.face_count * (1 + 2 * len(base.edges))

    def run(self, lengths: Floats) -> None:
        """`lengths`: of the shortest paths from landmark to landmark, had each the surface for itself."""
        tree, rest, joined = [], [], list(range(len(self.landmarks)))
        for a, b in sorted(self.base.edges, key=lambda e: (lengths[e], e)):
            if joined[a] != joined[b]:
                tree.append((a, b))
                joined = [joined[a] if j == joined[b] else j for j in joined]
            else:
                rest.append((a, b))
        for edge in tree + rest:
            self._trace(edge)

    # ---- one path

    def _trace(self, edge: Edge) -> None:
        points = self._path(edge)
        if points is None:
            raise BrushfireError(
                f"patches: earlier paths leave no way from landmark {edge[0]} to {edge[1]} on the side where the base mesh "
                "has it: it does not fit the surface there; where that has handles, more landmarks around each say how"
            )
        for _ in range(_REFINEMENTS):
            if not self._touched(points):
                break
            self._refine_along(points, edge)
            free = self._path(edge, off=True)
            points = free if free is not None else self._path(edge)
        if self._touched(points):
            self.touching.append(edge)
        way = self._insert(points, edge)
        self.paths[edge] = way
        self.walls |= {(min(p, q), max(p, q)) for p, q in pairwise(way)}

    def _path(self, edge: Edge, *, off: bool = False) -> Any:
        """Points of the shortest path that crosses no earlier one, None where there is none; ``off``: that touches none."""
        a, b = edge
        cut = self.mesh.cut(edges=np.array(sorted(self.walls)).reshape(-1, 2)) if self.walls else None
        mesh = self.mesh if cut is None else cut.mesh
        start, end = self._side(cut, a, b), self._side(cut, b, a)
        if start is None or end is None:
            return None
        if off:
            original = np.arange(mesh.vertex_count) if cut is None else np.asarray(cut.original_vertex)
            blocked = np.flatnonzero(np.isin(original, self._taken()))
            mesh = mesh.walled(vertices=blocked[(blocked != start) & (blocked != end)])
        points = mesh.path(start, end).points
        if not len(points):
            return None
        return points if cut is None else cut.points_to_original(points)

    def _taken(self) -> list[int]:
        """Vertices of earlier paths, and landmarks: a path's own from another side, too."""
        return sorted({v for way in self.paths.values() for v in way} | set(self.landmarks))

    def _on(self, points: Any) -> list[tuple[int, ...]]:
        """The vertex, or the ends of the edge, that each point of a path lies on."""
        corners = self.mesh.faces[points.face]
        return [tuple(c[w >= _SNAP].tolist()) for c, w in zip(corners, points.weights, strict=True)]

    def _touched(self, points: Any) -> set[int]:
        """What is taken on the way from end to end."""
        return {on[0] for on in self._on(points)[1:-1] if len(on) == 1}.intersection(self._taken())

    def _refine_along(self, points: Any, edge: Edge) -> None:
        """Cuts in two what ends, beside the path, at vertices that are taken: the faces next to those become half as wide."""
        vertices, faces = self.mesh.vertices, self.mesh.faces
        crossed = np.zeros(len(vertices), dtype=bool)
        crossed[[v for on in self._on(points) for v in on]] = True
        near = np.zeros(len(vertices), dtype=bool)
        near[faces[crossed[faces].any(axis=1)]] = True
        taken = np.zeros(len(vertices), dtype=bool)
        taken[self._taken()] = True
        own = {self.landmarks[k] for k in edge} - self._touched(points)
        taken[list(own)] = False
        ends, _ = edges_of(faces)
        ends = ends[(near & taken)[ends].any(axis=1)]
        chosen = [(p, q) for p, q in ends.tolist() if (p, q) not in self.walls]
        split = {e: len(vertices) + i for i, e in enumerate(chosen)}
        keep, new = split_faces(faces, split, [])
        self._recut(vertices[np.array(chosen)].mean(axis=1), np.concatenate([faces[keep], new]), edge)

    def _recut(self, added: Any, faces: Any, edge: Edge) -> None:
        """The surface with vertices added, in these faces; `edge`: for which path."""
        if len(faces) > self.most_faces:
            raise BrushfireError(
                f"patches: on the way from landmark {edge[0]} to {edge[1]} paths wind around each other so often that the "
                f"surface would be cut into more than {self.most_faces} faces: are landmarks in the base mesh's order?"
            )
        self.mesh = type(self.mesh)(np.concatenate([self.mesh.vertices, added]), faces)

    def _side(self, cut: Any, a: int, b: int) -> int | None:
        """The copy of landmark a, in the cut mesh, between its traced neighbours on either side of b; None: not there."""
        ring, closed = self.base.rings[a], self.base.closed[a]
        place = ring.index(b)
        before = ring[:place][::-1] + (ring[:place:-1] if closed else [])
        for c, left in [(c, True) for c in before] + [(c, False) for c in ring[place + 1 :]]:
            way = self.paths.get((min(a, c), max(a, c)))
            if way is not None:
                way = way if way[0] == self.landmarks[a] else way[::-1]
                return self._copy_beside(cut, way[0], way[1], left)
        return self.landmarks[a]

    def _copy_beside(self, cut: Any, v: int, w: int, left: bool) -> int | None:
        """The copy of v in the face to the left, or the right, of its edge to w."""
        faces = self.mesh.faces
        for k in range(3):
            found = np.flatnonzero((faces[:, k] == v) & (faces[:, (k + (1 if left else 2)) % 3] == w))
            if len(found):
                return int(cut.mesh.faces[int(cut.cut_face[found[0]]), k])
        return None

    # ---- faces are cut along a path

    def _insert(self, points: Any, edge: Edge) -> list[int]:
        """The vertices along the path, new ones where it crosses an edge; the mesh is the refined one then."""
        vertices, faces = self.mesh.vertices, self.mesh.faces
        way: list[int] = []
        split: dict[Edge, int] = {}
        added: list[Any] = []
        for on, face, weight in zip(self._on(points), points.face, points.weights, strict=True):
            if len(on) == 1:
                vertex = on[0]
            else:
                ends = (min(on), max(on))
                if ends not in split:
                    split[ends] = len(vertices) + len(added)
                    weight = np.where(weight >= _SNAP, weight, 0)
                    added.append(weight @ vertices[faces[face]] / weight.sum())
                vertex = split[ends]
            if not way or way[-1] != vertex:
                way.append(vertex)
        if split:
            keep, new = split_faces(faces, split, way)
            self._split_walls(split)
            self._recut(np.array(added), np.concatenate([faces[keep], new]), edge)
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
        """By what lies to the left of each base face's paths, between the paths."""
        faces = self.mesh.faces
        cut = self.mesh.cut(edges=np.array(sorted(self.walls)).reshape(-1, 2))
        component = components(cut.mesh.faces)
        label = np.full(len(faces), -1, dtype=np.int32)
        left = {(int(f[k]), int(f[(k + 1) % 3])): i for i, f in enumerate(faces) for k in range(3)}
        for number, face in enumerate(self.base.faces.tolist()):
            steps = set()
            for a, b in zip(face, face[1:] + face[:1], strict=True):
                way = self.paths[(min(a, b), max(a, b))]
                way = way if a < b else way[::-1]
                steps |= set(pairwise(way))
            inside = [left[step] for step in steps if step in left]
            pieces = np.unique(component[cut.cut_face[inside]])
            members = np.isin(component, pieces)
            if not self.touching:
                whole = len(pieces) == 1 and len(inside) == len(steps)
                self._check_disc(number, whole, cut.mesh.faces[members], label[members])
            label[cut.original_face[members]] = number
        return label

    def _check_disc(self, number: int, whole: bool, faces: Any, label: Labels) -> None:
        if not whole or (label >= 0).any() or filled_euler_characteristic(faces) != 2:
            raise BrushfireError(
                f"patches: the paths around face {number} of the base mesh do not bound a disc of the surface: the base "
                "mesh does not fit it there"
            )


_REFINEMENTS = 4  # two make room in a corner between two paths, a third beside another landmark
_SNAP = 1e-9  # nearer to an edge than this share of the face, a path's point lies on it
