"""pygeodesic.geodesic: exact distances and paths between vertices.

As in the original, no sources given means vertex 0. Different on purpose:

- An index that does not exist is an IndexError (the original prints a line and returns ``(None, None)``), and so is a
  mesh that is none (the original prints a line, and later calls give ``(None, None)``).
- An unreachable target has the distance +inf, no path, and the best source -1.
- What is farther than ``max_distance`` reads +inf and -1; the original keeps some vertices a little beyond.
- Vertices that are in no face are allowed.
"""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._mesh import Mesh
from brushfire.compat._exact import GEODESIC_INF, METHOD, in_faces, indices, whole_faces

__all__ = ["PyGeodesicAlgorithmExact", "read_mesh_from_file"]


class PyGeodesicAlgorithmExact:
    """Exact distances on one mesh.

    :param points: (n, 3) positions. :param faces: (m, 3) vertex numbers.

    >>> from brushfire.compat.pygeodesic import geodesic
    >>> algorithm = geodesic.PyGeodesicAlgorithmExact([[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> distance, path = algorithm.geodesicDistance(1, 3)
    >>> distance, path.round(6).tolist()
    (5.0, [[0.0, 4.0, 0.0], [1.5, 2.0, 0.0], [3.0, 0.0, 0.0]])
    >>> distances, best_sources = algorithm.geodesicDistances([1, 2])
    >>> distances.tolist(), best_sources.tolist()
    ([3.0, 0.0, 0.0, 3.0], [0, 0, 1, 1])
    """

    def __init__(self, points: npt.ArrayLike, faces: npt.ArrayLike) -> None:
        self._mesh = Mesh(points, whole_faces(faces))
        self._solver = self._mesh.solver()

    def geodesicDistance(self, sourceIndex: int, targetIndex: int) -> tuple[float, Floats]:
        """The distance, and the positions along the path, (k, 3), from the target back to the source."""
        source, target = indices([sourceIndex, targetIndex], self._mesh.vertex_count, "index").tolist()
        joined = in_faces(self._mesh)
        if not (joined[source] and joined[target]):
            return (0.0, self._mesh.vertices[[source]]) if source == target else (np.inf, np.zeros((0, 3)))
        path = self._solver.path(source, target)
        return path.length, np.ascontiguousarray(path.positions[::-1])

    def geodesicDistances(
        self,
        source_indices: npt.ArrayLike | None = None,
        target_indices: npt.ArrayLike | None = None,
        max_distance: float = GEODESIC_INF,
    ) -> tuple[Floats, npt.NDArray[np.int32]]:
        """Distances of the targets (default: all vertices) from their nearest sources, and which these are.

        :param source_indices: vertex 0 if none are given.
        :param max_distance: what is farther reads +inf, and -1 as its source.
        """
        count = self._mesh.vertex_count
        sources = indices([0] if source_indices is None else source_indices, count, "source_indices")
        targets = None if target_indices is None else indices(target_indices, count, "target_indices")
        joined = in_faces(self._mesh)
        kept = np.flatnonzero(joined[sources])
        distances, best = np.full(count, np.inf), np.full(count, -1, dtype=np.int32)
        if kept.size:
            goal = None if targets is None else np.unique(targets[joined[targets]])
            where = slice(None) if goal is None else goal
            if goal is None or goal.size:
                distances[where], source = self._solver.distance(
                    sources[kept], targets=goal, radius=max_distance, method=METHOD, return_source=True
                )
                best[where] = np.where(source < 0, -1, kept[source]).astype(np.int32)
        return (distances, best) if targets is None else (distances[targets], best[targets])


def read_mesh_from_file(filename: str | os.PathLike[str]) -> tuple[Floats, npt.NDArray[np.int32]]:
    """Points and faces of the original's example files: both counts, then the points, then the faces."""
    with open(filename, encoding="ascii") as file:
        words = file.read().split()
    try:
        points, faces = int(words[0]), int(words[1])
        numbers = np.array(words[2:], dtype=np.float64)
        split = 3 * points
        return numbers[:split].reshape(points, 3), numbers[split:].reshape(faces, 3).astype(np.int32)
    except (IndexError, ValueError) as error:
        raise BrushfireError(f"{os.fspath(filename)}: {error}", "file_malformed") from None
