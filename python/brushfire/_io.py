"""Meshes from files and from other libraries' objects."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import path_text
from brushfire._errors import BrushfireError, BrushfireTypeError
from brushfire._mesh import Mesh


@dataclass(frozen=True)
class FileInfo:
    """What a file was besides its mesh.

    ``face_origin`` (face_count,) numbers the file's face that each triangle comes from, and ``vertex_map`` (3 * faces of
    the file,) the vertex that each corner became where corners were welded (STL); both are None where they say nothing.
    """

    format: str
    remarks: tuple[str, ...]
    face_origin: npt.NDArray[np.int32] | None
    vertex_map: npt.NDArray[np.int32] | None


@overload
def read(path: str | os.PathLike[str], *, return_info: Literal[False] = ...) -> Mesh: ...
@overload
def read(path: str | os.PathLike[str], *, return_info: Literal[True]) -> tuple[Mesh, FileInfo]: ...
def read(path: str | os.PathLike[str], *, return_info: bool = False) -> Mesh | tuple[Mesh, FileInfo]:
    """A mesh from a file: the file's vertex order, indices and double precision are kept.

    The content decides about the format where it names one, the extension otherwise.

    :param return_info: also return a :class:`FileInfo`.
    :raises BrushfireError: codes ``file_not_readable``, ``unknown_format``, ``file_malformed`` (with line or byte).

    >>> import brushfire as bf, os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "triangle.obj")
    ...     _ = open(path, "w").write("v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n")
    ...     bf.read(path)
    Mesh(3 vertices, 1 faces)
    """
    core, name, remarks, face_origin, vertex_map = _core.read(path_text(path))
    mesh = Mesh._of(core)
    if not return_info:
        return mesh
    return mesh, FileInfo(
        name, remarks, face_origin if face_origin.size else None, vertex_map if vertex_map.size else None
    )


def from_any(source: Any) -> Mesh:
    """A mesh from whatever holds one: judged by its attributes, no other library is imported.

    - a Mesh, itself; a path (``str`` or ``os.PathLike``), read;
    - ``(vertices, faces)``: a pair of arrays;
    - trimesh, Open3D, igl-like: ``.vertices`` and ``.faces`` or ``.triangles``;
    - pyvista ``PolyData``: ``.points`` and ``.regular_faces``, or ``.faces`` in VTK's layout (3, a, b, c, ...);
    - meshio: ``.points`` and ``.cells_dict["triangle"]``;
    - nibabel GIFTI: ``.agg_data("pointset")`` and ``.agg_data("triangle")``;
    - nilearn surface meshes: ``.coordinates`` and ``.faces``.

    :raises TypeError: for anything else.
    :raises BrushfireError: where the faces are not triangles, or do not make a mesh.

    >>> import brushfire as bf
    >>> bf.from_any(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    Mesh(3 vertices, 1 faces)
    """
    if isinstance(source, Mesh):
        return source
    if isinstance(source, (str, os.PathLike)):
        return read(source)
    if hasattr(source, "agg_data"):
        return Mesh(source.agg_data("pointset"), source.agg_data("triangle"))
    if hasattr(source, "points") and hasattr(source, "cells_dict"):
        return _from_cells(source)
    if hasattr(source, "points") and hasattr(source, "faces"):
        return Mesh(source.points, _vtk_faces(source))
    for vertices, faces in (("vertices", "faces"), ("vertices", "triangles"), ("coordinates", "faces"), ("V", "F")):
        if hasattr(source, vertices) and hasattr(source, faces):
            return Mesh(np.asarray(getattr(source, vertices)), np.asarray(getattr(source, faces)))
    if isinstance(source, (tuple, list)) and len(source) == 2:
        return Mesh(source[0], source[1])
    raise BrushfireTypeError(f"no mesh is known to be in a {type(source).__name__}")


def _from_cells(source: Any) -> Mesh:
    others = sorted(set(source.cells_dict) - {"triangle", "vertex", "line"})
    if others:
        raise BrushfireError(f"cells of type {', '.join(others)}: triangles are needed")
    return Mesh(source.points, source.cells_dict.get("triangle", np.zeros((0, 3), dtype=np.int64)))


def _vtk_faces(source: Any) -> npt.NDArray[Any]:
    faces = np.asarray(source.faces)
    if faces.ndim == 2:
        return faces
    if faces.size % 4 != 0 or (faces.reshape(-1, 4)[:, 0] != 3).any():
        raise BrushfireError("polygons that are not triangles: triangulate() them first")
    return faces.reshape(-1, 4)[:, 1:]
