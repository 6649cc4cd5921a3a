"""Meshes from files."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import IO, Any, Literal, TypeAlias, overload

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
    the file,) the vertex that each corner became where corners were welded (STL); both are None where they say nothing. With
    ``weld=`` the map is that of the file's vertices (STL: corners).
    """

    format: str
    remarks: tuple[str, ...]
    face_origin: npt.NDArray[np.int32] | None
    vertex_map: npt.NDArray[np.int32] | None


Source: TypeAlias = "str | os.PathLike[str] | bytes | bytearray | memoryview | IO[bytes] | IO[str]"


@overload
def read(
    source: Source, *, format: str | None = ..., weld: float | None = ..., return_info: Literal[False] = ...
) -> Mesh: ...
@overload
def read(
    source: Source, *, format: str | None = ..., weld: float | None = ..., return_info: Literal[True]
) -> tuple[Mesh, FileInfo]: ...
def read(
    source: Source, *, format: str | None = None, weld: float | None = None, return_info: bool = False
) -> Mesh | tuple[Mesh, FileInfo]:
    """A mesh from a file: the file's vertex order, indices and double precision are kept.

    The content decides about the format where it names one, the extension otherwise.

    :param source: a path, the ``bytes`` of a file, or an open file, which is read to its end.
    :param format: an extension ("obj", "ply", ...) that counts in place of the name's.
    :param weld: join vertices within this of one another, 0 for equal ones: see :meth:`Mesh.weld`.
    :param return_info: also return a :class:`FileInfo`.
    :raises BrushfireError: codes ``file_not_readable``, ``unknown_format``, ``file_malformed`` (with line or byte).

    >>> import brushfire as bf, io, os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "triangle.obj")
    ...     _ = open(path, "w").write("v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n")
    ...     bf.read(path)
    Mesh(3 vertices, 1 faces)
    >>> bf.read(io.BytesIO(b"v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n"), format="obj")
    Mesh(3 vertices, 1 faces)
    """
    if isinstance(source, (str, os.PathLike)) and format is None:
        loaded = _core.read(path_text(source))
    else:
        loaded = _core.read_bytes(*content_of(source, format))
    core, name, remarks, face_origin, vertex_map = loaded
    mesh = Mesh._of(core)
    if weld is not None:
        mesh, joined = mesh.weld(weld)
        vertex_map = joined[vertex_map] if vertex_map.size else joined
    if not return_info:
        return mesh
    return mesh, FileInfo(
        name, remarks, face_origin if face_origin.size else None, vertex_map if vertex_map.size else None
    )


def content_of(source: Any, format: str | None) -> tuple[bytes, str]:
    """The bytes, and a name for messages whose extension decides where they do not."""
    name = "bytes"
    if isinstance(source, (str, os.PathLike)):
        name = path_text(source)
        try:
            with open(name, "rb") as file:
                source = file.read()
        except OSError as error:
            raise BrushfireError(f"{name}: {error.strerror}", "file_not_readable") from None
    elif is_file(source):
        name = source.name if isinstance(getattr(source, "name", None), str) else "file"
        source = source.read()
    elif not isinstance(source, (bytes, bytearray, memoryview)):
        raise BrushfireTypeError(f"source: a path, bytes or an open file is needed, not {source!r}")
    content = source.encode() if isinstance(source, str) else bytes(source)
    return content, name if format is None else f"{name}.{format.lstrip('.')}"


def is_file(source: Any) -> bool:
    """Whether it is open for reading; some libraries' meshes have a read(), too."""
    return callable(getattr(source, "read", None)) and callable(getattr(source, "readline", None))
