"""Pictures of meshes and of what was computed on them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core
from brushfire._arrays import Floats
from brushfire._curves import OnMesh, Path
from brushfire._errors import BrushfireError, BrushfireTypeError
from brushfire._fields import Fields, Isoline, _values
from brushfire._options import thread_count
from brushfire._places import Places
from brushfire._progress import Progress, shown

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

    mesh: OnMesh
    _shown: dict[str, Any]

    def __repr__(self) -> str:
        return f"Panel({self.mesh!r})"

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        return bytes(_core.encode_png(render(self)))


class Pictures(OnMesh):
    """The picture of a Mesh."""

    def panel(
        self,
        values: npt.ArrayLike | None = None,
        *,
        isolines: npt.ArrayLike | None = None,
        labels: npt.ArrayLike | None = None,
        label_names: Iterable[str] = (),
        paths: Iterable[Path | Isoline] = (),
        dots: Places | None = None,
        front: float = np.inf,
        title: str = "",
        scale: int = 0,
        openness: npt.ArrayLike | None = None,
    ) -> Panel:
        """The mesh and what is to be shown on it, for :func:`render`, :func:`render_svg` and :func:`animate`.

        :param values: one per vertex, shown as colours with a colour bar; what is not finite is grey.
        :param isolines: levels of ``values``, drawn as lines.
        :param labels: one integer per vertex, shown as colours instead; negative ones are grey.
        :param label_names: what the legend calls the labels 0, 1, ...; by number where there are none.
        :param paths: paths or isolines, drawn as tubes.
        :param dots: places, drawn as dots.
        :param front: where ``values`` is greater, the surface is plain: what a fire has not reached yet.
        :param title: written above.
        :param scale: which of the picture's ``scales`` colours the values.
        :param openness: as :meth:`ambient_occlusion` gives it; crevices are then darker.
        :raises BrushfireError: for arrays of another shape.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> pair = [mesh.panel(mesh.distance(0, method=m)) for m in ("dijkstra", "exact")]
        >>> bf.render(pair, width=64, height=48, bar=False).shape
        (48, 128, 4)
        """
        shown: dict[str, Any] = {
            "front": _arrays.number(front, "front"),
            "title": _text(title, "title"),
            "scale": _arrays.whole(scale, "scale", _MOST),
            "label_names": [_text(name, "label_names") for name in label_names],
            "paths": [_line(p) for p in paths],
        }
        if values is not None:
            shown["scalar"] = _values(values, "values")
        if isolines is not None:
            shown["isolines"] = np.sort(_values(isolines, "isolines"))
        if labels is not None:
            shown["labels"] = _arrays.integers(labels, "labels").reshape(-1)
        if dots is not None:
            arrays = self._arrays(dots, "dots")
            shown["dots"] = self._mesh.positions(arrays.index, arrays.weights)
        if openness is not None:
            shown["openness"] = _openness(openness)
        return Panel(self, shown)

    def render(
        self,
        values: npt.ArrayLike | None = None,
        *,
        isolines: npt.ArrayLike | None = None,
        labels: npt.ArrayLike | None = None,
        label_names: Iterable[str] = (),
        paths: Iterable[Path | Isoline] = (),
        dots: Places | None = None,
        front: float = np.inf,
        title: str = "",
        openness: npt.ArrayLike | None = None,
        file: str | os.PathLike[str] | None = None,
        **look: Any,
    ) -> Pixels:
        """A picture of the mesh, without a display: (height, width, 4) RGBA, wider where a colour bar stands beside it.

        :param values, isolines, labels, label_names, paths, dots, front, title, openness: what is shown, as for
            :meth:`panel`.
        :param file, look: as for :func:`render`.
        :raises BrushfireError: for a mesh from lengths, for arrays of another size, for what is out of range.
        :raises TypeError: for a look that does not exist.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> mesh.render(mesh.distance(0), isolines=[0.5], dots=0, width=64, height=48, bar=False).shape
        (48, 64, 4)
        """
        panel = self.panel(
            values,
            isolines=isolines,
            labels=labels,
            label_names=label_names,
            paths=paths,
            dots=dots,
            front=front,
            title=title,
            openness=openness,
        )
        return render(panel, file=file, **look)

    def ambient_occlusion(
        self, *, directions: int = 256, reach: float = np.inf, threads: int = 0, progress: Progress = None
    ) -> npt.NDArray[np.float32]:
        """How much of the sky every corner of every face sees on the face's front and back: (face_count, 3, 2), 0 to 1.

        :param directions: how many rays go out from a vertex, 8 to 65536.
        :param reach: what is farther away than this casts no shade.
        :param threads: 0 means one per processor. The numbers are the same for any number of threads.
        :raises BrushfireError: where brushfire was built without Embree, as wheels are; for a mesh from lengths.

        >>> import brushfire as bf
        >>> mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> try:
        ...     shape = mesh.ambient_occlusion().shape
        ... except bf.BrushfireError:  # built without Embree
        ...     shape = (1, 3, 2)
        >>> shape
        (1, 3, 2)
        """
        count = _arrays.whole(directions, "directions", _MOST)
        team = thread_count(threads)
        farthest = _arrays.number(reach, "reach")
        with shown(progress, "ambient occlusion") as report:
            return _core.ambient_occlusion(self._mesh, count, farthest, team, report)


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
    return [_line(line) for line in cast(Fields, panel.mesh).isolines(shown["scalar"], shown["isolines"])]


def _shown(panels: Panel | Iterable[Panel]) -> list[Panel]:
    shown = [panels] if isinstance(panels, Panel) else list(panels)
    for panel in shown:
        if not isinstance(panel, Panel):
            raise BrushfireTypeError(f"panels: what Mesh.panel() makes is needed, not {type(panel).__name__}")
    return shown


def _line(path: Path | Isoline) -> tuple[Floats, bool]:
    line = path.line if isinstance(path, Isoline) else path
    if not isinstance(line, Path):
        raise BrushfireTypeError(f"paths: Paths and Isolines are needed, not {type(line).__name__}")
    return np.ascontiguousarray(line.positions), line.closed


def _openness(openness: npt.ArrayLike) -> npt.NDArray[np.float32]:
    array = np.asarray(_arrays.floats(openness, "openness"), dtype=np.float32)
    if array.ndim != 3 or array.shape[1:] != (3, 2):
        raise BrushfireError(f"openness: shape (face_count, 3, 2) is needed, not {array.shape}")
    return array


def _text(value: Any, what: str) -> str:
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
