"""Base meshes of patches: what can be told of one, and of the surface under it, before any path is traced."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, Ints, columns, integers
from brushfire._errors import BrushfireError, BrushfireIndexError
from brushfire._faces import Edge, components, edges_of, ends_of, filled_euler_characteristic, parted_fans

if TYPE_CHECKING:
    from brushfire._mesh import Mesh


@dataclass(eq=False)
class BaseMesh:
    """A mesh over landmarks: oriented, each edge of one or two faces, each vertex of one fan of faces.

    ``faces`` (k, 3); ``rings``: the neighbours of every vertex counter-clockwise; ``closed``: whether they go all round.
    """

    faces: Ints
    rings: list[list[int]] = field(default_factory=list)
    closed: list[bool] = field(default_factory=list)

    @property
    def edges(self) -> list[Edge]:
        return sorted({(min(a, b), max(a, b)) for a, b in directed_edges(self.faces)})


def directed_edges(faces: Ints) -> list[Edge]:
    return [(f[k], f[(k + 1) % 3]) for f in faces.tolist() for k in range(3)]


def base_mesh(connectivity: npt.ArrayLike, count: int) -> BaseMesh:
    """Checks the faces over `count` landmarks."""
    faces = integers(connectivity, "connectivity")
    if faces.size == 0:
        raise BrushfireError("connectivity: a base mesh has at least one face")
    columns(faces, 3, "connectivity")
    if faces.min() < 0 or faces.max() >= count:
        bad = int(np.argmax((faces < 0) | (faces >= count)))
        raise BrushfireIndexError(f"connectivity: face {bad // 3} names landmark {faces.flat[bad]} of {count}")
    owner: dict[Edge, int] = {}
    for n, (a, b) in enumerate(directed_edges(faces)):
        if a == b:
            raise BrushfireError(f"connectivity: face {n // 3} has landmark {a} twice")
        if (a, b) in owner:
            raise BrushfireError(
                f"connectivity: faces {owner[a, b]} and {n // 3} both run from landmark {a} to {b}: an edge has at most "
                "two faces, and they run along it in opposite directions"
            )
        owner[a, b] = n // 3
    base = BaseMesh(faces)
    after: list[dict[int, int]] = [{} for _ in range(count)]
    for face in faces.tolist():
        for k in range(3):
            after[face[k]][face[(k + 1) % 3]] = face[(k + 2) % 3]
    for landmark, turn in enumerate(after):
        base.rings.append(_ring(landmark, turn))
        base.closed.append(set(turn) == set(turn.values()))
    return base


def _ring(landmark: int, turn: dict[int, int]) -> list[int]:
    """The neighbours in order; `turn`: from each to the next."""
    if not turn:
        raise BrushfireError(f"landmarks: number {landmark} is in no face of the base mesh: leave it out")
    neighbours = set(turn) | set(turn.values())
    ring = [min(set(turn) - set(turn.values()), default=min(turn))]
    while ring[-1] in turn and turn[ring[-1]] != ring[0]:
        ring.append(turn[ring[-1]])
    if len(ring) < len(neighbours):
        raise BrushfireError(
            f"connectivity: the faces at landmark {landmark} are not one fan: give each fan a landmark of its own"
        )
    return ring


def landmark_vertices(mesh: Mesh, landmarks: Sequence[int]) -> tuple[int, ...]:
    """The vertices of the surface that landmarks are, each another one, all in faces."""
    given = integers(landmarks, "landmarks")
    if given.ndim != 1:
        raise BrushfireError(f"landmarks: one vertex each is needed, shape (n,), not {given.shape}")
    places = tuple(given.tolist())
    known: dict[int, int] = {}
    used = np.zeros(mesh.vertex_count, dtype=bool)
    used[mesh.faces.ravel()] = True
    for n, v in enumerate(places):
        if not 0 <= v < mesh.vertex_count:
            raise BrushfireIndexError(
                f"landmarks: vertex {v} does not exist: the mesh has {mesh.vertex_count} vertices"
            )
        if v in known:
            raise BrushfireError(f"landmarks: vertex {v} repeats, as numbers {known[v]} and {n}")
        if not used[v]:
            raise BrushfireError(f"landmarks: vertex {v} is in no face of the mesh")
        known[v] = n
    return places


# ---- the surface under it


def manifold_surface(mesh: Mesh, landmarks: tuple[int, ...]) -> Mesh:
    """Without faces that name a vertex twice, and with a vertex for every fan of faces."""
    if mesh._walls is not None:
        raise BrushfireError("patches: walls are not kept: take cut().mesh, the open part")
    if len(mesh.vertices) < mesh.vertex_count:
        raise BrushfireError("patches: a mesh with positions is needed")
    if not mesh.report.repeated_index_faces and not mesh.report.nonmanifold_vertices:
        return mesh
    given = np.sort(mesh.faces, axis=1)
    faces = mesh.faces[(given[:, 0] < given[:, 1]) & (given[:, 1] < given[:, 2])]
    numbers, copied = parted_fans(faces, mesh.vertex_count)
    for n, v in enumerate(landmarks):
        if v in copied:
            raise BrushfireError(
                f"landmarks: several fans of faces meet at vertex {v} (number {n}): take one beside it"
            )
    return type(mesh)(np.concatenate([mesh.vertices, mesh.vertices[copied]]), numbers)


def check_surface(mesh: Mesh, landmarks: tuple[int, ...], base: BaseMesh) -> Floats:
    """Whether the base mesh can lie on the surface, and which way round. Returns distances between landmarks."""
    if mesh.report.misoriented_edges or mesh.report.nonmanifold_edges:
        _check_orientation(mesh, landmarks)
    angle, distance = _seen_from(mesh, landmarks)
    for a, b in base.edges:
        if not np.isfinite(distance[a, b]):
            soup = " (faces share no vertices: weld() the mesh first)" if mesh.report.looks_like_soup else ""
            raise BrushfireError(
                f"patches: nothing leads from landmark {a} to {b}: they lie on different components{soup}"
            )
    _check_topology(mesh, landmarks, base)
    _check_sense(angle, base)
    return distance


def _check_orientation(mesh: Mesh, landmarks: tuple[int, ...]) -> None:
    """Of the faces that paths may come to: two at an edge, the same way round."""
    piece = components(mesh.faces)
    at_landmark = np.isin(mesh.faces, landmarks).any(axis=1)
    near = np.isin(piece, piece[at_landmark])
    ends = ends_of(mesh.faces[near])
    _, times = np.unique(np.sort(ends, axis=1), axis=0, return_counts=True)
    if (times > 2).any():
        raise BrushfireError(
            f"patches: {int((times > 2).sum())} edges have three faces or more: the surface is not a manifold there"
        )
    _, times = np.unique(ends, axis=0, return_counts=True)
    if (times > 1).any():
        raise BrushfireError(
            f"patches: the faces at {int((times > 1).sum())} edges are oriented against each other: turn them (mesh.faces"
            "[k, ::-1]) so that all are counter-clockwise from one side"
        )


def _seen_from(mesh: Mesh, landmarks: tuple[int, ...]) -> tuple[Floats, Floats]:
    """The shortest path from one landmark to another: its direction, in full turns, and its length."""
    maps = [mesh.log_map(v) for v in landmarks]
    angle = np.array([m.angle[list(landmarks)] / (2 * np.pi) for m in maps])
    return angle, np.array([m.radius[list(landmarks)] for m in maps])


def _check_topology(mesh: Mesh, landmarks: tuple[int, ...], base: BaseMesh) -> None:
    """A closed part of the base mesh covers a component of the surface: with as many handles. (Holes lie in patches.)"""
    edges, times = edges_of(mesh.faces)
    border = set(edges[times == 1].ravel().tolist())
    for landmark, vertex in enumerate(landmarks):
        if base.closed[landmark] and vertex in border:
            raise BrushfireError(
                f"patches: landmark {landmark} lies on the surface's boundary, and faces of the base mesh all round it: "
                "move it inside, or leave out a face there"
            )
    part, under = components(base.faces), components(mesh.faces)
    for p in np.unique(part):
        faces = base.faces[part == p]
        if not all(base.closed[v] for v in np.unique(faces)):
            continue
        at_landmark = (mesh.faces == landmarks[faces[0, 0]]).any(axis=1)
        surface = mesh.faces[under == under[np.argmax(at_landmark)]]
        wanted, found = filled_euler_characteristic(faces), filled_euler_characteristic(surface)
        if wanted != found:
            raise BrushfireError(
                f"patches: the surface has {1 - found // 2} handles and the base mesh {1 - wanted // 2}: a closed base mesh "
                "needs as many, one around each"
            )


def _check_sense(angle: Floats, base: BaseMesh) -> None:
    """Whether shortest paths leave landmarks the way round that the base mesh has.

    From one of n > 2 neighbours all round a landmark to the next it is less than half a turn in the mean: together they
    make one turn. In the opposite order they make n - 1.
    """
    turns, corners, reversed_rings, rings = 0.0, 0, 0, 0
    for a, ring in enumerate(base.rings):
        if not base.closed[a] or len(ring) < 3:
            continue
        found = sum((angle[a, q] - angle[a, p]) % 1.0 for p, q in zip(ring, ring[1:] + ring[:1], strict=True))
        turns, corners, rings = turns + found, corners + len(ring), rings + 1
        reversed_rings += round(found) == len(ring) - 1
    if 2 * turns <= corners:
        return
    if reversed_rings == rings:
        raise BrushfireError(
            "patches: the base mesh's faces run the other way round than the surface's: reverse them "
            "(connectivity[:, ::-1])"
        )
    raise BrushfireError(
        "patches: shortest paths leave most landmarks in another order than the base mesh's faces have there: are landmarks "
        "in the order that connectivity counts them in, and its faces oriented as the surface's?"
    )
