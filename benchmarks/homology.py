"""Which way around the handles of a closed surface a curve goes: two curves of one homotopy class agree in all numbers.

A basis of the integer cocycles: trees of edges and of faces that do not cross leave two edges for every handle, and the
loop of faces over each of those counts, with signs, how often a curve crosses it. The count is a difference of a linear
function in every face, so a curve may begin and end anywhere; two curves with the same ends differ by whole numbers.

Based on: Eppstein, Dynamic generators of topologically embedded graphs, 2003 (tree and cotree).
"""

from __future__ import annotations

import numpy as np

import brushfire as bf


def _tree(neighbours: list[list[int]], allowed) -> dict[int, int]:
    """Of each node the one before it, from node 0, over links that are allowed."""
    before, waiting = {0: 0}, [0]
    for node in waiting:
        for other in neighbours[node]:
            if other not in before and allowed(node, other):
                before[other] = node
                waiting.append(other)
    return before


class Homology:
    def __init__(self, mesh: bf.Mesh) -> None:
        self.faces = np.array(mesh.faces, dtype=np.int64)
        sides = [(int(f[k]), int(f[(k + 1) % 3])) for f in self.faces for k in range(3)]
        self._face_of = {side: i // 3 for i, side in enumerate(sides)}
        if len(self._face_of) != len(sides) or any((b, a) not in self._face_of for a, b in sides):
            raise ValueError("not a closed oriented surface")
        around: list[list[int]] = [[] for _ in range(int(self.faces.max()) + 1)]
        for a, b in sides:
            around[a].append(b)
        up = _tree(around, lambda a, b: True)
        in_tree = {frozenset((a, b)) for a, b in up.items() if a != b}
        beside = [[self._face_of[b, a] for a, b in sides[3 * f : 3 * f + 3]] for f in range(len(self.faces))]
        shared = {(self._face_of[s], self._face_of[s[::-1]]): s for s in sides if frozenset(s) not in in_tree}
        root = _tree(beside, lambda f, g: (f, g) in shared)
        crossed = {frozenset(shared[f, g]) for f, g in root.items() if f != g}
        free = {frozenset(s): s for s in sides if frozenset(s) not in in_tree and frozenset(s) not in crossed}
        self._potential = np.stack([self._of_loop(side, root, shared) for side in free.values()], axis=-1)

    def _of_loop(self, side: tuple[int, int], root: dict[int, int], shared: dict) -> np.ndarray:
        """(faces, 3): a linear function of each face whose differences count crossings with one loop of faces."""
        count: dict[tuple[int, int], int] = {}

        def cross(edge: tuple[int, int], sign: int) -> None:  # from the face of `edge` to that of its other side
            count[edge] = count.get(edge, 0) + sign
            count[edge[::-1]] = count.get(edge[::-1], 0) - sign

        cross(side, 1)
        for start, sign in ((self._face_of[side], -1), (self._face_of[side[::-1]], 1)):
            while root[start] != start:
                cross(shared[start, root[start]], sign)
                start = root[start]
        steps = np.array([[count.get((int(f[k]), int(f[(k + 1) % 3])), 0) for k in range(3)] for f in self.faces])
        assert not steps.sum(axis=1).any()
        return np.concatenate([np.zeros((len(steps), 1)), np.cumsum(steps[:, :2], axis=1)], axis=1)

    def numbers(self, path: bf.Path) -> np.ndarray:
        """Of a curve, of which consecutive points share a face: two for every handle; whole if it is closed."""
        points = list(zip(np.array(path.points.face), np.array(path.points.weights), strict=True))
        pairs = zip(points, points[1:] + (points[:1] if path.closed else []), strict=False)
        return sum(self._between(*a, *b) for a, b in pairs)

    def _between(self, f: int, p: np.ndarray, g: int, q: np.ndarray) -> np.ndarray:
        corners = {int(v) for v, w in zip(self.faces[f], p, strict=True) if w > 0}
        corners |= {int(v) for v, w in zip(self.faces[g], q, strict=True) if w > 0}
        for face in {f, g, *self._with(corners)}:
            if corners <= {int(v) for v in self.faces[face]}:
                return (self._weights(face, g, q) - self._weights(face, f, p)) @ self._potential[face]
        raise ValueError("two points of a path share no face")

    def _with(self, corners: set[int]) -> list[int]:
        return [self._face_of[a, b] for a in corners for b in corners if (a, b) in self._face_of]

    def _weights(self, face: int, own: int, weights: np.ndarray) -> np.ndarray:
        by_vertex = dict(zip(self.faces[own].tolist(), weights.tolist(), strict=True))
        return np.array([by_vertex.get(int(v), 0.0) for v in self.faces[face]])
