"""The same mesh over every surface that a base mesh was traced on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError

if TYPE_CHECKING:
    from brushfire._patches import Patches


def resampled(patches: Patches, count: int) -> tuple[Floats, npt.NDArray[np.int32]]:
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
