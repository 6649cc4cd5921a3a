"""Multiresolution Reeb graphs of the integral geodesic function, and how alike two shapes are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, Labels, whole
from brushfire._errors import BrushfireError

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_MOST_LEVELS = 12
_WEIGHT = 0.5  # Hilaga's w: how much the area of a node counts beside the range of its values


@dataclass(frozen=True, eq=False)
class ReebGraph:
    """What :func:`reeb_graph` returns.

    ``values`` (vertex_count,): the average geodesic distance of every vertex from the surface, less its least, divided by
    its greatest: 0 at the centre. ``error``: by how much these may be off, absolute. At the finest level, which has
    2 ** ``levels`` intervals of values: ``node`` (vertex_count,): to which node a vertex belongs, -1: to none;
    ``interval`` (nodes,): of each node; ``area`` (nodes,): its share of the surface; ``edges`` (k, 2): nodes of
    neighbouring intervals that touch. ``parents[i]`` (nodes at level i + 1): which node of the coarser level i holds each.
    """

    values: Floats
    error: float
    node: Labels
    interval: Labels
    area: Floats
    edges: npt.NDArray[np.int32]
    parents: tuple[Labels, ...]
    _levels: tuple[dict[str, Any], ...] = ()

    def __repr__(self) -> str:
        return f"ReebGraph({len(self.interval)} nodes, {len(self.edges)} edges, {self.loops} loop(s))"

    @property
    def levels(self) -> int:
        """How many times the range of values is halved."""
        return len(self._levels) - 1

    @property
    def loops(self) -> int:
        """Independent cycles of the graph: the number of handles of a closed surface, where the levels resolve them.

        >>> import brushfire as bf
        >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
        >>> bf.reeb_graph(bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], tetrahedron), 2).loops
        0
        """
        return len(self.edges) - len(self.interval) + _pieces(len(self.interval), self.edges)

    def similarity(self, other: ReebGraph) -> float:
        """How alike two shapes are, in [0, 1]; 1 for a shape and itself. Both graphs have the same number of levels.

        From the coarsest level to the finest, nodes over the same values, whose parents and neighbours were matched
        with each other, are matched, the most alike first; what matches counts by area and by range of values.
        Neither rotation nor scale nor, but for the error, the resolution counts. Based on Hilaga et al., 2001.

        >>> import brushfire as bf
        >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
        >>> graph = bf.reeb_graph(bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], tetrahedron), 2)
        >>> graph.similarity(graph)
        1.0
        """
        if self.levels != other.levels:
            raise BrushfireError(f"similarity: {self.levels} and {other.levels} levels cannot be compared")
        return float(_similarity(self._levels, other._levels))


def reeb_graph(mesh: Mesh, levels: int = 5, *, samples: int = 150, method: str | None = None) -> ReebGraph:
    """The multiresolution Reeb graph of the average geodesic distance (Hilaga et al., 2001).

    :param mesh: with faces, in one piece.
    :param levels: the range of values is cut into 2 ** levels intervals.
    :param samples: from how many vertices, spread evenly, distances are averaged, each weighed by the area nearer to it
        than to the others.
    :param method: as for :meth:`Mesh.distance`.
    :return: :class:`ReebGraph`. Its ``error`` is proven but for the method's own: the average over all vertices, weighed
        by their area, is off by no more than their average distance from the samples.

    Nodes are connected pieces of the surface between two values; faces are cut there, so that what the graph says does
    not depend on how fine they are.

    >>> import brushfire as bf
    >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    >>> bf.reeb_graph(bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], tetrahedron), 2)
    ReebGraph(4 nodes, 3 edges, 0 loop(s))
    """
    finest = whole(levels, "levels", _MOST_LEVELS)
    values, error = _integral(mesh, whole(samples, "samples", 10**6), method)
    pieces = _Pieces(mesh, values, finest)
    chain = [pieces.graph(level) for level in range(finest + 1)]
    parents = tuple(pieces.parents(level) for level in range(1, finest + 1))
    for level, above in enumerate(parents):
        chain[level + 1]["parent"] = above
    last = chain[-1]
    return ReebGraph(
        values,
        error,
        pieces.node_of_vertices(finest),
        last["interval"],
        last["area"],
        last["edges"],
        parents,
        tuple(chain),
    )


def _integral(mesh: Mesh, samples: int, method: str | None) -> tuple[Floats, float]:
    """Normalised, with the error that sampling leaves."""
    used = np.unique(mesh.faces)
    if not len(used):
        raise BrushfireError("reeb_graph: a mesh with faces is needed")
    if len(mesh.vertices) < mesh.vertex_count:
        raise BrushfireError("reeb_graph: a mesh with positions is needed")
    if not mesh.area > 0:
        raise BrushfireError("reeb_graph: a surface without area has no mean distances")
    chosen = mesh.farthest_points(min(max(samples, 1), len(used)))
    corner = _corner_areas(mesh)
    weight = np.bincount(chosen.nearest[used], corner[used], len(chosen.vertices))
    total = np.zeros(mesh.vertex_count)
    solver = mesh.solver(method)
    for vertex, share in zip(chosen.vertices, weight / weight.sum(), strict=True):
        total += share * solver.distance(int(vertex))
    if not np.isfinite(total[used]).all():
        raise BrushfireError("reeb_graph: the mesh is in several pieces: take one at a time")
    off = float((chosen.distance[used] * corner[used]).sum() / weight.sum())
    low, high = total[used].min(), total[used].max()
    values = np.full(mesh.vertex_count, np.nan)
    values[used] = (total[used] - low) / high
    # The value, the least and the greatest may each be off.
    return values, 3 * off / max(high - off, np.finfo(float).tiny)


def _corner_areas(mesh: Mesh) -> Floats:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    corners: Floats = np.bincount(mesh.faces.ravel(), np.repeat(area / 3, 3), mesh.vertex_count).astype(np.float64)
    return corners


def _pieces(count: int, edges: npt.NDArray[Any]) -> int:
    return len(np.unique(_connected(count, edges)))


def _connected(count: int, pairs: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
    """The lowest member of each one's component: labels handed on until nothing changes, with short cuts."""
    label = np.arange(count)
    if len(pairs) == 0:
        return label
    a, b = pairs[:, 0], pairs[:, 1]
    while True:
        low = np.minimum(label[a], label[b])
        new = label.copy()
        np.minimum.at(new, a, low)
        np.minimum.at(new, b, low)
        np.minimum.at(new, label[a], low)
        np.minimum.at(new, label[b], low)
        new = new[new]
        if np.array_equal(new, label):
            return label
        label = new


class _Pieces:
    """Faces cut at the finest values, and which pieces hang together at every level."""

    def __init__(self, mesh: Mesh, values: Floats, finest: int) -> None:
        self.finest = finest
        self.count = 2**finest
        scale = self.count / np.nanmax(values) if np.nanmax(values) > 0 else 0.0
        # A vertex on a cut counts to the interval above it, the greatest value to the last.
        self.height = np.minimum(values * scale, np.nextafter(self.count, 0))
        faces = mesh.faces
        corner = np.sort(self.height[faces], axis=1)
        low, high = np.floor(corner[:, 0]).astype(int), np.floor(corner[:, 2]).astype(int)
        spans = high - low + 1
        self.face = np.repeat(np.arange(len(faces)), spans)
        first = np.cumsum(spans) - spans
        self.interval = low[self.face] + np.arange(len(self.face)) - first[self.face]
        self.first, self.low = first, low
        edge = mesh.vertices[faces]
        whole_area = np.linalg.norm(np.cross(edge[:, 1] - edge[:, 0], edge[:, 2] - edge[:, 0]), axis=1) / 2
        below = _share_below(corner[self.face], self.interval + 1.0) - _share_below(
            corner[self.face], self.interval + 0.0
        )
        self.area = whole_area[self.face] * below / max(whole_area.sum(), np.finfo(float).tiny)
        self.beside = self._across_edges(faces)
        self.above = np.flatnonzero(self.face[1:] == self.face[:-1])  # a piece and the next one of its face
        self.faces = faces
        self.vertex_count = mesh.vertex_count

    def _across_edges(self, faces: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
        """Pieces of neighbouring faces that share a part of their edge."""
        ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        owner = np.tile(np.arange(len(faces)), 3)
        order = np.lexsort((owner, ends[:, 1], ends[:, 0]))
        ends, owner = ends[order], owner[order]
        same = np.flatnonzero((ends[1:] == ends[:-1]).all(axis=1))
        left, right = owner[same], owner[same + 1]
        span = np.sort(np.floor(self.height[ends[same]]).astype(int), axis=1)
        long = span[:, 1] - span[:, 0] + 1
        which = np.repeat(np.arange(len(same)), long)
        at = span[which, 0] + np.arange(len(which)) - (np.cumsum(long) - long)[which]
        return np.column_stack([self._piece(left[which], at), self._piece(right[which], at)])

    def _piece(self, face: npt.NDArray[Any], interval: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
        result: npt.NDArray[np.int64] = self.first[face] + interval - self.low[face]
        return result

    def labels(self, level: int) -> npt.NDArray[np.int64]:
        """The node of every piece."""
        coarse = self.interval >> (self.finest - level)
        inner = self.above[coarse[self.above] == coarse[self.above + 1]]
        pairs = np.concatenate([self.beside, np.column_stack([inner, inner + 1])])
        return np.unique(_connected(len(self.face), pairs), return_inverse=True)[1]

    def graph(self, level: int) -> dict[str, Any]:
        label = self.labels(level)
        count = int(label.max()) + 1
        coarse = self.interval >> (self.finest - level)
        interval = np.zeros(count, dtype=np.int32)
        interval[label] = coarse
        edges = np.column_stack([label[self.above], label[self.above + 1]])
        edges = np.unique(np.sort(edges[edges[:, 0] != edges[:, 1]], axis=1), axis=0).astype(np.int32)
        area = np.bincount(label, self.area, count)
        return {"interval": interval, "edges": edges.reshape(-1, 2), "area": area, "parent": None, "bins": 2**level}

    def parents(self, level: int) -> Labels:
        fine, coarse = self.labels(level), self.labels(level - 1)
        parent = np.zeros(int(fine.max()) + 1, dtype=np.int32)
        parent[fine] = coarse
        return parent

    def node_of_vertices(self, level: int) -> Labels:
        node = np.full(self.vertex_count, -1, dtype=np.int32)
        label = self.labels(level)
        for k in range(3):
            v = self.faces[:, k]
            node[v] = label[self._piece(np.arange(len(v)), np.floor(self.height[v]).astype(int))]
        return node


def _share_below(corner: Floats, level: Floats) -> Floats:
    """Of a triangle with these three ascending values, the share that lies below a value."""
    a, b, c = corner.T
    with np.errstate(divide="ignore", invalid="ignore"):
        lower = (level - a) ** 2 / ((b - a) * (c - a))
        upper = 1 - (c - level) ** 2 / ((c - b) * (c - a))
    share = np.where(level <= b, np.where(b > a, lower, 0.0), np.where(c > b, upper, 1.0))
    share = np.where(level <= a, 0.0, np.where(level >= c, 1.0, share))
    clipped: Floats = np.clip(np.nan_to_num(share), 0, 1)
    return clipped


def _similarity(one: tuple[dict[str, Any], ...], two: tuple[dict[str, Any], ...]) -> float:
    """The sum over levels of what matched nodes have in common."""
    total = 0.0
    matched: dict[int, int] | None = None
    for a, b in zip(one, two, strict=True):
        near_a, near_b = _neighbours(a), _neighbours(b)
        share_a, share_b = _attributes(a), _attributes(b)
        pairs = []
        for i in range(len(share_a)):
            for j in np.flatnonzero(b["interval"] == a["interval"][i]).tolist():
                if matched is None or matched.get(int(a["parent"][i])) == int(b["parent"][j]):
                    common = float(min(share_a[i], share_b[j]))
                    # Neighbours of like size first: what hangs on a node tells it from its twins.
                    around = abs(near_a[i] - near_b[j]).sum()
                    pairs.append((float(around) - common, i, int(j), common))
        level: dict[int, int] = {}
        taken: set[int] = set()
        for _, own, other, common in sorted(pairs):
            if own in level or other in taken:
                continue
            level[own] = other
            taken.add(other)
            total += common
        matched = level
    return total / len(one)


def _attributes(graph: dict[str, Any]) -> Floats:
    """Hilaga's sim(m, m): adds up to 1 at each level."""
    per_interval = np.bincount(graph["interval"], minlength=graph["bins"])
    used = np.count_nonzero(per_interval)
    span = 1 / (used * per_interval[graph["interval"]])
    result: Floats = _WEIGHT * graph["area"] / graph["area"].sum() + (1 - _WEIGHT) * span
    return result


def _neighbours(graph: dict[str, Any]) -> Floats:
    """The area next to each node, below and above."""
    area = np.zeros((len(graph["interval"]), 2))
    for a, b in graph["edges"]:
        low, high = (a, b) if graph["interval"][a] < graph["interval"][b] else (b, a)
        area[low, 1] += graph["area"][high]
        area[high, 0] += graph["area"][low]
    return area
