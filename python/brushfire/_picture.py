"""Pictures of a mesh and of what was computed on it."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats
from brushfire._curves import OnMesh, Path
from brushfire._errors import BrushfireError
from brushfire._fields import Isoline, _values
from brushfire._places import Places

_TEXTS = ("up", "view", "colormap", "unit", "title")
_SWITCHES = ("perspective", "bands", "colour_bar", "wireframe", "silhouettes", "transparent")
_NUMBERS = ("azimuth", "elevation", "zoom", "low", "high", "front", "line_width", "path_width", "dot_size")
_COUNTS = ("width", "height", "samples", "threads")


class Pictures(OnMesh):
    """The picture of a Mesh."""

    def render(
        self,
        values: npt.ArrayLike | None = None,
        *,
        isolines: npt.ArrayLike | None = None,
        labels: npt.ArrayLike | None = None,
        paths: Iterable[Path | Isoline] = (),
        dots: Places | None = None,
        file: str | os.PathLike[str] | None = None,
        **look: Any,
    ) -> npt.NDArray[np.uint8]:
        """A picture of the mesh, without a display: (height, width, 4) RGBA, wider where a colour bar stands beside it.

        :param values: one per vertex, shown as colours with a colour bar; what is not finite is grey.
        :param isolines: levels of ``values``, drawn as lines.
        :param labels: one integer per vertex, shown as colours instead; negative ones are grey.
        :param paths: paths or isolines, drawn as tubes.
        :param dots: places, drawn as dots.
        :param file: also written there, as PNG.
        :param look: ``width``, ``height`` (pixels), ``view`` ("front", "back", "left", "right", "top", "bottom", "iso"),
            ``azimuth``, ``elevation`` (degrees), ``up`` ("x", "y", "z"), ``perspective``, ``zoom``; ``colormap``
            ("viridis", "magma", "cividis"), ``low``, ``high``, ``unit``, ``bands``, ``colour_bar``, ``front``, ``title``;
            ``wireframe``, ``silhouettes``, ``transparent``, ``line_width``, ``path_width``, ``dot_size``, ``samples``,
            ``threads``.
        :raises BrushfireError: for a mesh from lengths, for arrays of another size, for what is out of range.
        :raises TypeError: for a look that does not exist.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> mesh.render(mesh.distance(0), isolines=[0.5], dots=0, width=64, height=48, colour_bar=False).shape
        (48, 64, 4)
        """
        given = _look(look)
        if values is not None:
            given["scalar"] = _values(values, "values")
        if isolines is not None:
            given["isolines"] = np.sort(_values(isolines, "isolines"))
        if labels is not None:
            given["labels"] = _arrays.integers(labels, "labels").reshape(-1)
        given["paths"] = [_line(p) for p in paths]
        if dots is not None:
            arrays = self._arrays(dots, "dots")
            given["dots"] = self._mesh.positions(arrays.index, arrays.weights)
        image = _core.render(self._mesh, given)
        if file is not None:
            _write(file, _core.encode_png(image))
        return image


def _line(path: Path | Isoline) -> tuple[Floats, bool]:
    line = path.line if isinstance(path, Isoline) else path
    if not isinstance(line, Path):
        raise TypeError(f"paths: Paths and Isolines are needed, not {type(line).__name__}")
    return np.ascontiguousarray(line.positions), line.closed


def _look(look: dict[str, Any]) -> dict[str, Any]:
    """Checked: every name is known, every value of its type."""
    given: dict[str, Any] = {}
    for name, value in look.items():
        if name in _TEXTS and isinstance(value, str):
            given[name] = value
        elif name in _SWITCHES and isinstance(value, (bool, np.bool_)):
            given[name] = bool(value)
        elif name in _NUMBERS:
            given[name] = _arrays.number(value, name)
        elif name in _COUNTS:
            given[name] = _arrays.whole(value, name, np.iinfo(np.int32).max)
        else:
            raise TypeError(f"render: {name}={value!r} is not known")
    return given


def _write(file: str | os.PathLike[str], data: bytes) -> None:
    if not os.fspath(file).lower().endswith(".png"):
        raise BrushfireError(f"{os.fspath(file)}: pictures are written as .png", "unknown_format")
    try:
        with open(file, "wb") as out:
            out.write(data)
    except OSError as error:
        raise BrushfireError(f"{os.fspath(file)}: {error.strerror}", "file_not_writable") from None
