"""Curves from files."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from brushfire import _core
from brushfire._arrays import Floats, path_text
from brushfire._curves import Path
from brushfire._fields import Isoline
from brushfire._io import Source, content_of
from brushfire._mesh import Mesh
from brushfire._places import Points


def read_lines(source: Source, mesh: Mesh | None = None, *, format: str | None = None) -> list[Path] | list[Isoline]:
    """Curves from a file, those that :func:`write` has written among them: csv json obj ply vtp.

    :param source: a path, the ``bytes`` of a file, or an open file.
    :param mesh: on which the curves lie. Where the file has positions only, they are laid onto its surface, to the nearest
        points; a remark is made where these are far.
    :param format: an extension that counts in place of the name's.
    :return: :class:`Isoline` where the file has levels, else :class:`Path`. Without a mesh, of files that have positions
        only, ``points`` is empty.
    :raises BrushfireError: as :func:`read` does, and where points are not on the mesh.

    >>> import brushfire as bf, os, tempfile
    >>> mesh = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "way.obj")
    ...     bf.write(path, mesh.path(1, 3))
    ...     [way] = bf.read_lines(path, mesh)
    >>> way, mesh.distance(way.points).tolist()
    (Path(3 points, length 5), [2.5, 0.0, 2.5, 0.0])
    """
    if isinstance(source, (str, os.PathLike)) and format is None:
        value_name, _, lines = _core.read_lines(path_text(source))
    else:
        value_name, _, lines = _core.read_lines_bytes(*content_of(source, format))
    paths = [_path(positions, points, closed, mesh) for positions, points, closed, _ in lines]
    if value_name != "level":
        return paths
    levels = [value for _, _, _, value in lines]
    places = {level: i for i, level in enumerate(sorted(set(levels)))}
    return [Isoline(level, places[level], path) for level, path in zip(levels, paths, strict=True)]


def _path(positions: Floats, points: Any, closed: bool, mesh: Mesh | None) -> Path:
    if points is not None:
        on_surface = Points(*points)
    elif mesh is not None and len(positions):
        on_surface = mesh._snapped_all(positions)
    else:
        on_surface = Points(np.zeros(0, dtype=np.int32), np.zeros((0, 3)))
    if mesh is not None and len(on_surface):
        positions = mesh.position(on_surface)
    ends = np.vstack([positions, positions[:1]]) if closed else positions
    length = float(np.linalg.norm(np.diff(ends, axis=0), axis=1).sum()) if len(positions) else np.inf
    return Path(on_surface, positions, length, closed, None if mesh is None else mesh._mesh)
