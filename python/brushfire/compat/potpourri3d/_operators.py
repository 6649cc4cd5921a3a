"""Matrices, areas and edges of the faces as they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire.compat._exact import whole_faces

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


def validate_mesh(V: Any, F: Any, force_triangular: bool = False, test_indices: bool = False) -> None:
    """Raises an error where the arrays are no mesh."""
    vertices = np.asarray(V)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise BrushfireError(f"V: shape (n, 3) is needed, not {vertices.shape}")
    sizes = {len(polygon) for polygon in F}
    if any(size < 3 for size in sizes) or force_triangular and sizes - {3}:
        raise BrushfireError(f"F: faces of {'3' if force_triangular else '3 or more'} vertices are needed, not {sizes}")
    if test_indices and len(F) and max(max(polygon) for polygon in F) >= len(vertices):
        raise BrushfireError("F: a face names a vertex that does not exist", "invalid_mesh")


def validate_points(V: Any) -> None:
    """Raises an error where the array holds no points."""
    validate_mesh(V, [])


def _mesh_arrays(V: npt.ArrayLike, F: npt.ArrayLike) -> tuple[Floats, npt.NDArray[Any]]:
    faces = whole_faces(F)
    validate_mesh(V, faces, force_triangular=True, test_indices=True)
    return np.asarray(V, dtype=np.float64), faces


def cotan_laplacian(V: npt.ArrayLike, F: npt.ArrayLike, denom_eps: float = 0.0) -> csr_matrix:
    """Cotangent weights of the faces as they are, positive semidefinite, (n, n).

    :param denom_eps: added to twice every face's area: faces without one give finite weights.

    :func:`brushfire.laplacian` is the one that takes any mesh.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> pp3d.cotan_laplacian([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).toarray().round(6).tolist()[1]
    [-0.5, 0.5, 0.0]
    """
    from scipy.sparse import coo_matrix

    vertices, faces = _mesh_arrays(V, F)
    rows, columns, values = [], [], []
    for k in range(3):
        i, j, apex = (faces[:, (k + n) % 3] for n in range(3))
        a, b = vertices[i] - vertices[apex], vertices[j] - vertices[apex]
        weight = 0.5 * np.einsum("ij,ij->i", a, b) / (np.linalg.norm(np.cross(a, b), axis=1) + denom_eps)
        rows += [i, j, i, j]
        columns += [i, j, j, i]
        values += [weight, weight, -weight, -weight]
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    return coo_matrix(entries, shape=(len(vertices), len(vertices))).tocsr()


def face_areas(V: npt.ArrayLike, F: npt.ArrayLike) -> Floats:
    """(faces,)."""
    vertices, faces = _mesh_arrays(V, F)
    a, b = (vertices[faces[:, k]] - vertices[faces[:, 0]] for k in (1, 2))
    areas: Floats = 0.5 * np.linalg.norm(np.cross(a, b), axis=1)
    return areas


def vertex_areas(V: npt.ArrayLike, F: npt.ArrayLike) -> Floats:
    """A third of the areas of the faces around, (vertices,)."""
    vertices, faces = _mesh_arrays(V, F)
    thirds = np.repeat(face_areas(vertices, faces) / 3, 3)
    return np.bincount(faces.ravel(), thirds, minlength=len(vertices)).astype(np.float64)


def edges(V: npt.ArrayLike, F: Any) -> npt.NDArray[np.int64]:
    """(edges, 2), numbered in the order in which the faces name them first, in that direction.

    >>> import brushfire.compat.potpourri3d as pp3d
    >>> pp3d.edges([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]).tolist()
    [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]
    """
    validate_mesh(V, F, test_indices=True)
    pairs = [(polygon[k - 1], polygon[k]) for polygon in map(list, F) for k in [*range(1, len(polygon)), 0]]
    ends = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    _, first = np.unique(np.sort(ends, axis=1), axis=0, return_index=True)
    return ends[np.sort(first)]
