"""Files of meshes, of polygons, and of points alone."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire._arrays import Floats
from brushfire._errors import BrushfireError
from brushfire._io import read
from brushfire._mesh import Mesh
from brushfire.compat.potpourri3d._operators import validate_mesh, validate_points

_UV_TYPES = (None, "per-vertex", "per-face", "per-corner")


def read_mesh(filename: str | os.PathLike[str]) -> tuple[Floats, npt.NDArray[np.int64]]:
    """Vertices and faces of a file, in arrays that may be written to: float64 and int64."""
    mesh = read(filename)
    return mesh.vertices.copy(), mesh.faces.astype(np.int64)


def read_polygon_mesh(filename: str | os.PathLike[str]) -> tuple[Floats, list[list[int]]]:
    """Vertices and polygons of a file. Their corners are in order, and begin anywhere."""
    mesh, info = read(filename, return_info=True)
    faces = mesh.faces
    if info.face_origin is None:
        return mesh.vertices.copy(), [[int(v) for v in face] for face in faces]
    polygons: dict[int, list[npt.NDArray[np.int32]]] = {}
    for face, origin in zip(faces, info.face_origin.tolist(), strict=True):
        polygons.setdefault(origin, []).append(face)
    return mesh.vertices.copy(), [_outline(triangles) for _, triangles in sorted(polygons.items())]


def _outline(triangles: list[npt.NDArray[np.int32]]) -> list[int]:
    """The corners of the polygon that was cut into these: every cut is there in both directions."""
    if len(triangles) == 1:
        return [int(v) for v in triangles[0]]
    sides = [(int(t[k]), int(t[(k + 1) % 3])) for t in triangles for k in range(3)]
    for a, b in list(sides):
        if (b, a) in sides and (a, b) in sides:
            sides.remove((a, b))
            sides.remove((b, a))
    after: dict[int, list[int]] = {}
    for a, b in sides:
        after.setdefault(a, []).append(b)
    corners = [sides[0][0]]
    while len(corners) < len(sides):
        corners.append(after[corners[-1]].pop())
    return corners


def write_mesh(
    V: npt.ArrayLike,
    F: Any,
    filename: str | os.PathLike[str],
    UV_coords: Any = None,
    UV_type: str | None = None,
) -> None:
    """A mesh, in the format that the name says; polygons and texture coordinates as OBJ.

    :param UV_coords: (vertices, 2), (faces, 2) or (faces * corners, 2), by ``UV_type``: ``"per-vertex"``, ``"per-face"`` or
        ``"per-corner"``.
    """
    validate_mesh(V, F, test_indices=True)
    if UV_type not in _UV_TYPES:
        raise BrushfireError(f"UV_type: {', '.join(map(repr, _UV_TYPES))} are possible, not {UV_type!r}")
    if UV_type is None and all(len(polygon) == 3 for polygon in F):
        Mesh(V, F).save(filename)
    else:
        _write_obj(V, F, filename, UV_coords, UV_type)


def _write_obj(V: npt.ArrayLike, F: Any, filename: str | os.PathLike[str], uv: Any, uv_type: str | None) -> None:
    if not os.fspath(filename).lower().endswith(".obj"):
        raise BrushfireError(f"{os.fspath(filename)}: polygons and texture coordinates are written as .obj")
    sizes = [len(polygon) for polygon in F]
    # Which texture coordinate each corner has, corner by corner.
    numbers = {
        None: np.zeros(0, dtype=np.int64),
        "per-vertex": np.array([v for polygon in F for v in polygon], dtype=np.int64),
        "per-face": np.repeat(np.arange(len(F)), sizes),
        "per-corner": np.arange(sum(sizes)),
    }[uv_type]
    rows = {None: 0, "per-vertex": len(np.asarray(V)), "per-face": len(F), "per-corner": sum(sizes)}[uv_type]
    texture = np.zeros((0, 2)) if uv_type is None else np.asarray(uv, dtype=np.float64)
    if texture.shape != (rows, 2):
        raise BrushfireError(f"UV_coords: shape ({rows}, 2) is needed, not {texture.shape}")
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in np.asarray(V, dtype=np.float64).tolist()]
    lines += [f"vt {u!r} {v!r}" for u, v in texture.tolist()]
    corner = 0
    for polygon in F:
        names = []
        for v in polygon:
            names.append(f"{int(v) + 1}" if uv_type is None else f"{int(v) + 1}/{int(numbers[corner]) + 1}")
            corner += 1
        lines.append("f " + " ".join(names))
    _write_text(filename, lines)


def read_point_cloud(filename: str | os.PathLike[str]) -> Floats:
    """The vertices of a file, (points, 3); faces are passed over."""
    return read(filename).vertices.copy()


def write_point_cloud(V: npt.ArrayLike, filename: str | os.PathLike[str]) -> None:
    """Points as .obj or .ply."""
    validate_points(V)
    points = np.asarray(V, dtype=np.float64).tolist()
    extension = os.path.splitext(os.fspath(filename))[1].lower()
    if extension == ".obj":
        _write_text(filename, [f"v {x!r} {y!r} {z!r}" for x, y, z in points])
    elif extension == ".ply":
        head = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
        head += [f"property double {axis}" for axis in "xyz"]
        _write_text(filename, [*head, "end_header", *(f"{x!r} {y!r} {z!r}" for x, y, z in points)])
    else:
        raise BrushfireError(f"{os.fspath(filename)}: points are written as .obj or .ply", "unknown_format")


def _write_text(filename: str | os.PathLike[str], lines: list[str]) -> None:
    with open(filename, "w", encoding="ascii") as file:
        file.write("\n".join([*lines, ""]))
