"""The calls of gdist (tvb-gdist), with exact distances, threads, and rows that cost what they reach.

Different from the original:

- What cannot be reached, or is farther than ``max_distance``, reads +inf. The original writes 1e100 in places, and keeps
  some vertices a little beyond ``max_distance``.
- An index that does not exist is an IndexError. The original crashes or reads foreign memory.
- Meshes that are not manifold are fine. The original may crash or not end.
- Any integer and float types, lists included, are taken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._mesh import Mesh
from brushfire.compat._exact import METHOD, indices

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

__all__ = ["compute_gdist", "distance_matrix_of_selected_points", "local_gdist_matrix"]

GEODESIC_INF = 1e100


def _mesh(vertices: npt.ArrayLike, triangles: npt.ArrayLike, is_one_indexed: bool) -> Mesh:
    return Mesh(vertices, np.asarray(triangles) - 1 if is_one_indexed else triangles)


def compute_gdist(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    source_indices: npt.ArrayLike | None = None,
    target_indices: npt.ArrayLike | None = None,
    max_distance: float = GEODESIC_INF,
    is_one_indexed: bool = False,
) -> Floats:
    """Distances from the nearest source (default: vertex 0) to the targets, (targets,), or to all vertices.

    As in the original, ``max_distance`` counts only where no targets are given.

    >>> from brushfire.compat import gdist
    >>> V = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]]
    >>> gdist.compute_gdist(V, [[0, 1, 2], [0, 2, 3]], source_indices=[1]).tolist()
    [3.0, 0.0, 4.0, 5.0]
    """
    mesh = _mesh(vertices, triangles, is_one_indexed)
    sources = indices([0] if source_indices is None else source_indices, mesh.vertex_count, "source_indices")
    if target_indices is None:
        return mesh.distance(sources, max_distance=max_distance, method=METHOD)
    targets = indices(target_indices, mesh.vertex_count, "target_indices")
    return mesh.distance(sources, targets=targets, method=METHOD)


def local_gdist_matrix(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    max_distance: float = GEODESIC_INF,
    is_one_indexed: bool = False,
) -> csc_matrix:
    """All distances up to ``max_distance`` as a sparse matrix (n, n) of float64; zeros are not stored.

    >>> from brushfire.compat import gdist
    >>> V = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]]
    >>> gdist.local_gdist_matrix(V, [[0, 1, 2], [0, 2, 3]], max_distance=3).nnz
    4
    """
    mesh = _mesh(vertices, triangles, is_one_indexed)
    # Row v of ours is column v of the original's: the transpose is the same arrays, read the other way.
    matrix = mesh.distances_within(max_distance, method=METHOD, dtype=np.float64).T
    matrix.eliminate_zeros()
    return matrix


def distance_matrix_of_selected_points(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    points: npt.ArrayLike,
    max_distance: float = GEODESIC_INF,
    is_one_indexed: bool = False,
) -> csc_matrix:
    """Distances among the given points, up to ``max_distance``, in a sparse matrix (n, n) of float64.

    >>> from brushfire.compat import gdist
    >>> V = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]]
    >>> gdist.distance_matrix_of_selected_points(V, [[0, 1, 2], [0, 2, 3]], points=[1, 2])[1, 2].item()
    4.0
    """
    from scipy.sparse import csc_matrix

    mesh = _mesh(vertices, triangles, is_one_indexed)
    chosen = np.unique(indices(points, mesh.vertex_count, "points"))
    distances = mesh.distance_matrix(chosen, chosen, method=METHOD, dtype=np.float64, max_distance=max_distance)
    column, row = np.nonzero(np.isfinite(distances) & (distances > 0))
    values = distances[column, row]
    return csc_matrix((values, (chosen[row], chosen[column])), shape=(mesh.vertex_count, mesh.vertex_count))
