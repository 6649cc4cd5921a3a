"""Meshes out of whatever holds one: judged by attributes; no library is imported that the object has not brought along."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays
from brushfire._errors import BrushfireError, BrushfireTypeError
from brushfire._io import is_file, read
from brushfire._mesh import Mesh
from brushfire._places import Points
from brushfire._vtk import arrays_of_vtk, is_vtk

Arrays = tuple[Any, Any]  # vertices, faces

# What the two arrays are called, in objects and in dictionaries.
_NAMES = (
    ("vertices", "faces"),
    ("vertices", "triangles"),
    ("coordinates", "faces"),
    ("verts", "faces"),
    ("points", "triangles"),
    ("V", "F"),
)

# Attributes in which other objects hold a mesh: for telling which one is meant.
_HOLDERS = ("mesh", "surface", "geometry", "surf", "dataset", "polydata", "data", "parts", "current_mesh", "meshes")


def from_any(source: Any, *, format: str | None = None) -> Mesh:
    """A mesh from whatever holds one: judged by its attributes, no other library is imported.

    - a Mesh, itself; a path (``str`` or ``os.PathLike``), read; ``bytes`` or an open file, read as ``format``;
    - ``(vertices, faces, ...)``: a pair of arrays, what follows is left out; a dict of two arrays by their usual names;
    - trimesh (a Scene: its meshes as they are placed there), Open3D (legacy and tensor), compas, igl-like: ``.vertices``
      and ``.faces`` or ``.triangles``;
    - VTK: PolyData with triangles and strips, an UnstructuredGrid of triangles, a MultiBlock with one surface; of vtk,
      pyvista, vedo, brainspace;
    - meshio: ``.points`` and ``.cells_dict["triangle"]``;
    - nibabel GIFTI: ``.agg_data("pointset")`` and ``.agg_data("triangle")``;
    - nilearn: ``.coordinates`` and ``.faces``; a PolyMesh or SurfaceImage with one part;
    - pymeshlab: a Mesh, or the current one of a MeshSet;
    - torch_geometric ``Data``: ``.pos`` and ``.face``; PyTorch3D ``Meshes`` with one mesh;
    - matplotlib ``Triangulation``; scipy ``Delaunay`` of a plane and ``ConvexHull`` of a body.

    :param format: the extension that a file of these bytes would have, where the content does not say what it is.
    :raises TypeError: for anything else, saying which of its attributes holds a mesh where one does.
    :raises BrushfireError: where the faces are not triangles, are none at all, or do not make a mesh.

    >>> import brushfire as bf
    >>> bf.from_any(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    Mesh(3 vertices, 1 faces)
    >>> bf.from_any(b"OFF\\n3 1 0\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2")
    Mesh(3 vertices, 1 faces)
    """
    if isinstance(source, Mesh):
        return source
    if isinstance(source, (str, os.PathLike, bytes, bytearray, memoryview)) or is_file(source):
        return read(source, format=format)
    if format is not None:
        raise BrushfireTypeError(f"format: only bytes and files have one, not a {type(source).__name__}")
    found = _arrays_of(source)
    if found is None:
        raise BrushfireTypeError(_refusal(source))
    vertices, faces = found
    return Mesh(vertices, _triangles(faces, source))


def _arrays_of(source: Any) -> Arrays | None:
    """Vertices and faces; None where the object holds none that is known here."""
    for is_it, take in _KINDS:
        if is_it(source):
            return take(source)
    return _by_name(source)


def _has(*names: str) -> Callable[[Any], bool]:
    return lambda source: all(_attribute(source, name) is not _MISSING for name in names)


_MISSING = object()


def _attribute(source: Any, name: str) -> Any:
    """_MISSING where there is none, whatever the object raises then."""
    try:
        return getattr(source, name)
    except Exception:  # noqa: BLE001 - Open3D raises KeyError
        return _MISSING


def _triangles(faces: Any, source: Any) -> npt.NDArray[Any]:
    """(m, 3), m > 0."""
    array = _arrays.any_array(faces, "faces")
    if array.size == 0:
        raise BrushfireError(
            f"no triangles are in this {type(source).__name__}: brushfire.Mesh(vertices, faces) makes a mesh without faces "
            "where that is meant"
        )
    if array.ndim == 2 and array.shape[1] != 3:
        raise BrushfireError(f"faces with {array.shape[1]} corners: triangles are needed, triangulate it first")
    return array


def _value(source: Any, name: str) -> Any:
    """An attribute or an entry that is data; None for a method, and where there is none."""
    value = source.get(name) if isinstance(source, Mapping) else _attribute(source, name)
    return None if value is _MISSING or callable(value) else value


def _by_name(source: Any) -> Arrays | None:
    for vertices, faces in _NAMES:
        v, f = _value(source, vertices), _value(source, faces)
        if v is not None and f is not None:
            return v, f
    return None


# ---- kinds


def _of_tuple(source: Any) -> Arrays | None:
    """What readers return: vertices, faces, and often something else."""
    if len(source) < 2 or not _is_rows(source[0]):
        return None
    if isinstance(source[1], (list, tuple)) and len({len(face) for face in source[1] if hasattr(face, "__len__")}) > 1:
        raise BrushfireError("faces with different numbers of corners: triangles are needed, triangulate it first")
    return (source[0], source[1]) if _is_rows(source[1]) else None


def _is_rows(item: Any) -> bool:
    """A two-dimensional array, or an empty one."""
    if isinstance(item, (str, bytes, Mapping)) or _arrays_of_object(item):
        return False
    try:
        array = _arrays.any_array(item, "rows")
    except Exception:  # noqa: BLE001 - whatever the object's library raises: it is no array
        return False
    return array.dtype.kind in "iuf" and (array.ndim == 2 or array.size == 0)


def _arrays_of_object(item: Any) -> bool:
    """Whether this is a mesh of its own, and not an array."""
    return not hasattr(item, "dtype") and not isinstance(item, (list, tuple)) and _by_name(item) is not None


def _of_gifti(source: Any) -> Arrays:
    vertices, faces = source.agg_data("pointset"), source.agg_data("triangle")
    for array, what in ((vertices, "pointset"), (faces, "triangle")):
        if array is None or isinstance(array, tuple) and (len(array) == 0 or isinstance(array[0], np.ndarray)):
            count = len(array) if array is not None else 0
            raise BrushfireError(
                f"a GIFTI image with {count} arrays of intent {what}: a surface has one of pointset and one of triangle"
            )
    return vertices, faces


def _of_cells(source: Any) -> Arrays:
    """meshio."""
    kinds = {str(kind) for kind in source.cells_dict}
    others = sorted(kinds - {"triangle", "vertex", "line"})
    if others:
        raise BrushfireError(f"cells of type {', '.join(others)}: triangles are needed")
    return source.points, source.cells_dict.get("triangle", np.zeros((0, 3), dtype=np.int64))


def _of_vtk_layout(source: Any) -> Arrays:
    """``.points`` and ``.faces``, with the faces as VTK had them for long: 3, a, b, c, 3, ..."""
    faces = np.asarray(source.faces)
    if faces.ndim == 2:
        return source.points, faces
    if faces.size % 4 != 0 or (faces.reshape(-1, 4)[:, 0] != 3).any():
        raise BrushfireError("polygons that are not triangles: triangulate() them first")
    return source.points, faces.reshape(-1, 4)[:, 1:]


def _of_scene(source: Any) -> Arrays | None:
    """trimesh: all meshes, each where the scene has it."""
    if not source.geometry:
        raise BrushfireError("a scene without geometry")
    whole = source.to_mesh() if hasattr(source, "to_mesh") else source.dump(concatenate=True)
    return _by_name(whole)


def _of_tensors(source: Any) -> Arrays:
    """open3d.t.geometry.TriangleMesh."""
    if "positions" not in source.vertex or "indices" not in source.triangle:
        raise BrushfireError("a TriangleMesh without vertex.positions and triangle.indices")
    return source.vertex["positions"].cpu().numpy(), source.triangle["indices"].cpu().numpy()


def _of_meshlab(source: Any) -> Arrays:
    place = getattr(source, "transformed_vertex_matrix", source.vertex_matrix)
    return place(), source.face_matrix()


def _of_mesh_set(source: Any) -> Arrays:
    if source.mesh_number() == 0:
        raise BrushfireError("a MeshSet without a mesh")
    return _of_meshlab(source.current_mesh())


def _of_parts(source: Any) -> Arrays | None:
    """nilearn's PolyMesh."""
    parts = source.parts
    if len(parts) != 1:
        names = ", ".join(f".parts[{name!r}]" for name in parts)
        raise BrushfireError(f"a {type(source).__name__} of {len(parts)} parts: one is needed ({names})")
    return _by_name(next(iter(parts.values())))


def _of_graph(source: Any) -> Arrays:
    """torch_geometric: the faces stand in columns."""
    for name in ("pos", "face"):
        if getattr(source, name) is None:
            raise BrushfireError(
                f".{name} of this {type(source).__name__} is None: FaceToEdge(remove_faces=False) keeps it"
            )
    return source.pos, _arrays.any_array(source.face, "face").T


def _of_batch(source: Any) -> Arrays:
    """PyTorch3D."""
    vertices, faces = source.verts_list(), source.faces_list()
    if len(vertices) != 1:
        raise BrushfireError(f"a batch of {len(vertices)} meshes: one is needed, such as batch[0]")
    return vertices[0], faces[0]


def _of_triangulation(source: Any) -> Arrays:
    """matplotlib: what its mask hides is left out."""
    faces = source.get_masked_triangles() if hasattr(source, "get_masked_triangles") else source.triangles
    return np.column_stack([source.x, source.y]), faces


def _of_simplices(source: Any) -> Arrays:
    """scipy."""
    corners = np.shape(source.simplices)[1]
    if corners == 2:
        raise BrushfireError("the hull of a plane is a line: triangles are needed (scipy.spatial.Delaunay has some)")
    if corners > 3:
        raise BrushfireError("tetrahedra: triangles are needed (.convex_hull holds those of the border)")
    return source.points, source.simplices


def _of_lists(source: Any) -> Arrays:
    """compas."""
    vertices, faces = source.to_vertices_and_faces()
    if any(len(face) != 3 for face in faces):
        raise BrushfireError(
            "polygons that are not triangles: from_any(mesh.to_vertices_and_faces(triangulated=True)), or triangulate it first"
        )
    return vertices, faces


def _is_plain(source: Any) -> bool:
    return isinstance(source, (tuple, list)) and not isinstance(source, Points)


_KINDS: tuple[tuple[Callable[[Any], bool], Callable[[Any], Arrays | None]], ...] = (
    (_is_plain, _of_tuple),
    (lambda source: isinstance(source, Mapping), _by_name),
    (_has("agg_data"), _of_gifti),
    (is_vtk, arrays_of_vtk),
    (_has("points", "cells_dict"), _of_cells),
    (_has("points", "faces"), _of_vtk_layout),
    (_has("geometry", "graph"), _of_scene),
    (_has("vertex", "triangle"), _of_tensors),
    (_has("current_mesh", "mesh_number"), _of_mesh_set),
    (_has("vertex_matrix", "face_matrix"), _of_meshlab),
    (lambda source: isinstance(_attribute(source, "parts"), Mapping), _of_parts),
    (lambda source: isinstance(_attribute(_attribute(source, "mesh"), "parts"), Mapping), lambda s: _of_parts(s.mesh)),
    (_has("pos", "face"), _of_graph),
    (_has("verts_list", "faces_list"), _of_batch),
    (_has("x", "y", "triangles"), _of_triangulation),
    (_has("points", "simplices"), _of_simplices),
    (_has("to_vertices_and_faces"), _of_lists),
)


# ---- what is refused


def _refusal(source: Any) -> str:
    """Which attribute, which entry or which item of it would do."""
    name = type(source).__name__
    if isinstance(source, (list, tuple)):
        return f"a {name} of {len(source)}: (vertices, faces) are two arrays of three columns; of meshes give one"
    if isinstance(source, Mapping):
        return f"a {name} with {', '.join(map(repr, list(source)[:8])) or 'nothing'}: 'vertices' and 'faces' are needed"
    held = list(_held_meshes(source))
    if held:
        return f"no mesh is known to be in a {name} itself: give its {' or '.join(held)}"
    lacking = [faces for vertices, faces in (*_NAMES, ("points", "faces")) if _value(source, vertices) is not None]
    if lacking:
        return f"a {name} has points, but no .{' or .'.join(sorted(set(lacking)))}: (vertices, faces) gives both"
    if hasattr(source, "shape") and hasattr(source, "dtype"):
        return f"an array alone, of shape {tuple(source.shape)}: (vertices, faces) are two"
    return f"no mesh is known to be in a {name}"


def _held_meshes(source: Any) -> Iterator[str]:
    for name in _HOLDERS:
        value = _value(source, name)
        if value is not None and _holds_mesh(value):
            yield f".{name}"
        elif isinstance(value, Mapping):
            yield from (f".{name}[{key!r}]" for key, item in list(value.items())[:8] if _holds_mesh(item))


def _holds_mesh(value: Any) -> bool:
    try:
        return isinstance(value, Mesh) or _arrays_of(value) is not None
    except Exception:  # noqa: BLE001 - it is a mesh that is refused for a reason of its own, or no mesh
        return False
