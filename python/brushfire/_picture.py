"""Pictures of meshes and of what was computed on them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats
from brushfire._curves import Path
from brushfire._errors import BrushfireError, BrushfireTypeError
from brushfire._fields import Isoline
from brushfire._options import thread_count

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_SCALE_TEXTS = ("colormap", "bar_title")
_SCALE_NUMBERS = ("low", "high")
_TEXTS = ("up", "view", "font")
_SWITCHES = ("perspective", "bands", "bar", "wireframe", "silhouettes", "transparent")
_NUMBERS = ("azimuth", "elevation", "zoom", "line_width", "path_width", "dot_size")
_COUNTS = ("width", "height", "samples")
_MOST = np.iinfo(np.int32).max

Pixels = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class Panel:
    """One mesh and what is shown on it, as :meth:`Mesh.panel` makes it: what :func:`render` and its like draw."""

    mesh: Mesh
    _shown: dict[str, Any]

    def __repr__(self) -> str:
        return f"Panel({self.mesh!r})"

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        return bytes(_core.encode_png(render(self)))


def render(panels: Panel | Iterable[Panel], *, file: str | os.PathLike[str] | None = None, **look: Any) -> Pixels:
    """The panels side by side in one picture: (height, width, 4) RGBA.

    :param panels: one or several of what :meth:`Mesh.panel` makes.
    :param file: also written there, as PNG or, with lines and text as vectors, as SVG; the extension decides.
    :param look: ``width``, ``height`` (of a panel, pixels), ``view`` ("front", "back", "left", "right", "top", "bottom",
        "iso"), ``azimuth``, ``elevation`` (degrees), ``up`` ("x", "y", "z"), ``perspective``, ``zoom``; ``colormap``
        ("viridis", "magma", "cividis"), ``low``, ``high``, ``bar_title``, ``bands``, ``bar``; ``wireframe``,
        ``silhouettes``, ``transparent``, ``line_width``, ``path_width``, ``dot_size``, ``samples``, ``threads``, ``font``
        (a TrueType file). Panels with scales of their own: instead of ``colormap``, ``low``, ``high`` and ``bar_title`` a list
        ``scales`` of dicts of these. Each scale has one range and one colour bar for all of its panels.
    :raises BrushfireError: for a mesh from lengths, for arrays of another size, for what is out of range, for a file that
        cannot be written.
    :raises TypeError: for a look that does not exist.

    >>> import numpy as np, brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> edges, exact = mesh.distance(1, method="dijkstra"), mesh.distance(1, method="exact")
    >>> panels = [mesh.panel(edges, title="edges"), mesh.panel(exact), mesh.panel(edges - exact, scale=1)]
    >>> scales = [{"bar_title": "mm"}, {"colormap": "magma", "low": 0, "bar_title": "error, mm"}]
    >>> bf.render(panels, scales=scales, width=64, height=48).ndim
    3
    """
    shown, given = _shown(panels), _look(look)
    image = _core.render([(p.mesh._mesh, p._shown) for p in shown], given)
    if file is not None:
        _write(file, {".png": lambda: _core.encode_png(image), ".svg": lambda: _svg(shown, given).encode()})
    return image


def render_svg(panels: Panel | Iterable[Panel], **look: Any) -> str:
    """The same picture as SVG: the shaded surface as pixels; isolines, paths, dots and text over it as vectors.

    :param panels, look: as for :func:`render`, which raises the same.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> bf.render_svg(mesh.panel(mesh.distance(0), isolines=[0.5]), width=64, height=48).startswith("<svg")
    True
    """
    return _svg(_shown(panels), _look(look))


def animate(
    panels: Panel | Iterable[Panel],
    *,
    turntable: int | None = None,
    wave: int | None = None,
    frame_ms: int = 40,
    file: str | os.PathLike[str] | None = None,
    **look: Any,
) -> Pixels:
    """The frames of an animation, (frames, height, width, 4) RGBA: once around, or the fire spreading.

    :param turntable: this many frames, from 2 to 2000, in which the camera goes around once; or
    :param wave: this many, in which ``values`` (of scale 0) appear from 0 to the greatest.
    :param frame_ms: how long a frame is shown, 10 to 10000 milliseconds.
    :param file: also written there, as WebP where brushfire was built with it (wheels are not).
    :param panels, look: as for :func:`render`, which raises the same.

    >>> import brushfire as bf
    >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> bf.animate(mesh.panel(mesh.distance(0)), wave=3, width=64, height=48, bar=False).shape
    (3, 48, 64, 4)
    """
    if (turntable is None) == (wave is None):
        raise BrushfireError("animate: one of turntable and wave is needed")
    count = _between(wave if turntable is None else turntable, "frames", 2, 2000)
    duration = _between(frame_ms, "frame_ms", 10, 10_000)
    shown, given = _shown(panels), _look(look)
    moving = _spreading(shown, given, count) if turntable is None else _turning(shown, given, count)
    frames = [_core.render(panels_now, look_now) for panels_now, look_now in moving]
    if file is not None:
        _write(file, {".webp": lambda: _core.encode_webp(frames, duration)})
    return np.stack(frames)


_Given = list[tuple[_core.Mesh, dict[str, Any]]]


def _turning(panels: list[Panel], look: dict[str, Any], count: int) -> Iterable[tuple[_Given, dict[str, Any]]]:
    shown = [(p.mesh._mesh, p._shown) for p in panels]
    for i in range(count):
        yield shown, {**look, "turn": 360.0 * i / count}


def _spreading(panels: list[Panel], look: dict[str, Any], count: int) -> Iterable[tuple[_Given, dict[str, Any]]]:
    """A scale that has no end of its own keeps the whole range, however little of it is shown."""
    values = [p._shown["scalar"] for p in panels if p._shown["scale"] == 0 and "scalar" in p._shown]
    if not values:
        raise BrushfireError("animate: a wave needs values")
    joined = np.concatenate(values)
    high = max(0.0, joined[np.isfinite(joined)].max(initial=0.0))
    for i in range(1, count + 1):
        fronts = [{"front": high * i / count} if p._shown["scale"] == 0 else {} for p in panels]
        yield [(p.mesh._mesh, {**p._shown, **front}) for p, front in zip(panels, fronts)], look


def _svg(panels: list[Panel], look: dict[str, Any]) -> str:
    return _core.render_svg([(p.mesh._mesh, {**p._shown, "lines": _lines(p, look)}) for p in panels], look)


def _lines(panel: Panel, look: dict[str, Any]) -> list[tuple[Floats, bool]]:
    """The isolines, which pixels take from the values themselves and vectors do not."""
    shown = panel._shown
    if look.get("bands", False) or "scalar" not in shown or "isolines" not in shown:
        return []
    return [line_of(line) for line in panel.mesh.isolines(shown["scalar"], shown["isolines"])]


def _shown(panels: Panel | Iterable[Panel]) -> list[Panel]:
    shown = [panels] if isinstance(panels, Panel) else list(panels)
    for panel in shown:
        if not isinstance(panel, Panel):
            raise BrushfireTypeError(f"panels: what Mesh.panel() makes is needed, not {type(panel).__name__}")
    return shown


def line_of(path: Path | Isoline) -> tuple[Floats, bool]:
    line = path.line if isinstance(path, Isoline) else path
    if not isinstance(line, Path):
        raise BrushfireTypeError(f"paths: Paths and Isolines are needed, not {type(line).__name__}")
    return np.ascontiguousarray(line.positions), line.closed


def text(value: Any, what: str) -> str:
    if not isinstance(value, str):
        raise BrushfireTypeError(f"{what}: a text is needed, not {value!r}")
    return value


def _between(value: Any, what: str, least: int, most: int) -> int:
    number = _arrays.whole(value, what, most)
    if number < least:
        raise BrushfireError(f"{what}: a number from {least} to {most} is needed, not {number}")
    return number


def _look(look: Mapping[str, Any]) -> dict[str, Any]:
    """Checked: every name is known, every value of its type."""
    given: dict[str, Any] = {}
    scale: dict[str, Any] = {}
    for name, value in look.items():
        if name in _SCALE_TEXTS + _SCALE_NUMBERS:
            scale[name] = value
        elif name in _TEXTS and isinstance(value, str):
            given[name] = value
        elif name in _SWITCHES and isinstance(value, (bool, np.bool_)):
            given[name] = bool(value)
        elif name in _NUMBERS:
            given[name] = _arrays.number(value, name)
        elif name == "threads":
            given[name] = thread_count(value)
        elif name in _COUNTS:
            given[name] = _arrays.whole(value, name, _MOST)
        elif name != "scales":
            raise BrushfireTypeError(f"render: {name}={value!r} is not known")
    if scale and "scales" in look:
        raise BrushfireError(f"render: {next(iter(scale))} goes into one of the scales where there are some")
    given["scales"] = [_scale(s) for s in look.get("scales", [scale])]
    return given


def _scale(scale: Any) -> dict[str, Any]:
    if not isinstance(scale, Mapping):
        raise BrushfireTypeError(f"scales: dicts are needed, not {scale!r}")
    given: dict[str, Any] = {}
    for name, value in scale.items():
        if name in _SCALE_TEXTS and isinstance(value, str):
            given[name] = value
        elif name in _SCALE_NUMBERS:
            given[name] = _arrays.number(value, name)
        else:
            raise BrushfireTypeError(f"render: {name}={value!r} is not known")
    return given


def _write(file: str | os.PathLike[str], writers: Mapping[str, Any]) -> None:
    """By what writes its extension."""
    name = _arrays.path_text(file, "file")
    for extension, encode in writers.items():
        if name.lower().endswith(extension):
            break
    else:
        raise BrushfireError(f"{name}: this is written as {' or '.join(writers)}", "unknown_format")
    data = encode()
    try:
        with open(file, "wb") as out:
            out.write(data)
    except OSError as error:
        raise BrushfireError(f"{name}: {error.strerror}", "file_not_writable") from None
