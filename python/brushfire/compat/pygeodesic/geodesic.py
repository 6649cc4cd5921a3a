"""pygeodesic.geodesic: exact distances and paths between vertices.

Different from the original: an index that does not exist is an IndexError (the original prints a line and returns
``(None, None)``), and an unreachable target has the distance +inf, no path, and the best source -1.
"""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._mesh import Mesh
from brushfire.compat._exact import METHOD, indices

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
        self._mesh = Mesh(points, faces)
        self._solver = self._mesh.solver()

    def geodesicDistance(self, sourceIndex: int, targetIndex: int) -> tuple[float, Floats]:
        """The distance, and the positions along the path, (k, 3), from the target back to the source."""
        source, target = indices([sourceIndex, targetIndex], self._mesh.vertex_count, "index").tolist()
        path = self._mesh.path(source, target)
        return path.length, path.positions[::-1]

    def geodesicDistances(
        self, source_indices: npt.ArrayLike, target_indices: npt.ArrayLike | None = None
    ) -> tuple[Floats, npt.NDArray[np.int32]]:
        """Distances of the targets (default: all vertices) from their nearest sources, and which these are."""
        sources = indices(source_indices, self._mesh.vertex_count, "source_indices")
        if target_indices is None:
            return self._solver.distance(sources, method=METHOD, return_source=True)
        targets = indices(target_indices, self._mesh.vertex_count, "target_indices")
        return self._solver.distance(sources, targets=targets, method=METHOD, return_source=True)


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
