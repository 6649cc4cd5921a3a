"""The calls of gdist (tvb-gdist), with exact distances, threads, and rows that cost what they reach.

As in the original: sources in no face are left out and targets in none read +inf, no source at all gives +inf
everywhere, and :func:`compute_gdist` heeds ``max_distance`` only where no targets are given.

Different from the original, on purpose:

- What is farther than ``max_distance`` reads +inf, what is exactly as far its distance. The original keeps some vertices a
  little beyond, and gives +inf for those exactly as far.
- In a sparse matrix, which reads 0 where nothing is stored, pairs that no way joins are stored as +inf where there is no
  limit (the default, 1e100 or +inf); :func:`local_gdist_matrix` of the original leaves them out. With a limit, what is
  not stored is farther, or is a vertex itself.
- :func:`distance_matrix_of_selected_points` heeds ``max_distance``; a point that is given twice counts once.
- An index that does not exist is an IndexError. The original crashes or reads foreign memory.
- Meshes that are not manifold are fine. The original may crash or not end.
- Any integer and float types, lists and tensors included, are taken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats, radius_of
from brushfire._mesh import Mesh
from brushfire.compat._exact import GEODESIC_INF, METHOD, in_faces, indices, whole_faces

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

__all__ = ["compute_gdist", "distance_matrix_of_selected_points", "local_gdist_matrix"]


def _mesh(vertices: npt.ArrayLike, triangles: npt.ArrayLike, is_one_indexed: bool) -> Mesh:
    faces = whole_faces(triangles)
    return Mesh(vertices, faces - 1 if is_one_indexed else faces)


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
    joined = in_faces(mesh)
    sources = indices([0] if source_indices is None else source_indices, mesh.vertex_count, "source_indices")
    sources = sources[joined[sources]]
    targets = None if target_indices is None else indices(target_indices, mesh.vertex_count, "target_indices")
    if sources.size == 0:
        return np.full(mesh.vertex_count if targets is None else targets.size, np.inf)
    if targets is None:
        return mesh.distance(sources, radius=radius_of(max_distance, "max_distance"), method=METHOD)
    distances = np.full(targets.size, np.inf)
    reachable = joined[targets]
    if reachable.any():
        distances[reachable] = mesh.distance(sources, targets=targets[reachable], method=METHOD)
    return distances


def local_gdist_matrix(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    max_distance: float = GEODESIC_INF,
    is_one_indexed: bool = False,
) -> csc_matrix:
    """All distances up to ``max_distance`` as a sparse matrix (n, n) of float64; zeros are not stored.

    Without a limit, vertices that no way joins are stored as +inf, and all pairs take 12 n² bytes.

    >>> from brushfire.compat import gdist
    >>> V = [[0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]]
    >>> gdist.local_gdist_matrix(V, [[0, 1, 2], [0, 2, 3]], max_distance=3).nnz
    4
    """
    mesh = _mesh(vertices, triangles, is_one_indexed)
    if max_distance >= GEODESIC_INF:
        return _stored(mesh, np.arange(mesh.vertex_count), mesh.distance_matrix(method=METHOD, dtype=np.float64))
    # Row v of ours is column v of the original's: the transpose is the same arrays, read the other way.
    matrix = mesh.distances_within(radius_of(max_distance, "max_distance"), method=METHOD, dtype=np.float64).T
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
    mesh = _mesh(vertices, triangles, is_one_indexed)
    chosen = np.unique(indices(points, mesh.vertex_count, "points"))
    # Without the limit, which would not tell far points from those that no way joins.
    distances = mesh.distance_matrix(chosen, chosen, method=METHOD, dtype=np.float64)
    distances[(distances > max_distance) & np.isfinite(distances)] = 0
    return _stored(mesh, chosen, distances)


def _stored(mesh: Mesh, chosen: npt.NDArray[np.int64], distances: Floats) -> csc_matrix:
    """The distances among some vertices, those that are 0 left out, as a matrix among all."""
    from scipy.sparse import csc_matrix

    np.fill_diagonal(distances, 0)
    column, row = np.nonzero(distances)
    shape = (mesh.vertex_count, mesh.vertex_count)
    return csc_matrix((distances[column, row], (chosen[row], chosen[column])), shape=shape)
