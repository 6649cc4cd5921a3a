"""What is shown on a mesh, for the pictures of it."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _arrays, _core, _picture
from brushfire._curves import Path
from brushfire._errors import BrushfireError
from brushfire._fields import Isoline, values_of
from brushfire._options import thread_count
from brushfire._picture import Panel, Pixels, line_of, text
from brushfire._places import Places
from brushfire._progress import Progress, shown

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_MOST = np.iinfo(np.int32).max


def panel(
    mesh: Mesh,
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
        "title": text(title, "title"),
        "scale": _arrays.whole(scale, "scale", _MOST),
        "label_names": [text(name, "label_names") for name in label_names],
        "paths": [line_of(p) for p in paths],
    }
    if values is not None:
        shown["scalar"] = values_of(values, "values")
    if isolines is not None:
        shown["isolines"] = np.sort(values_of(isolines, "isolines"))
    if labels is not None:
        shown["labels"] = _arrays.integers(labels, "labels").reshape(-1)
    if dots is not None:
        arrays = mesh._arrays(dots, "dots")
        shown["dots"] = mesh._mesh.positions(arrays.index, arrays.weights)
    if openness is not None:
        shown["openness"] = _openness(openness)
    return Panel(mesh, shown)


def render(
    mesh: Mesh,
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
    shown = panel(
        mesh,
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
    return _picture.render(shown, file=file, **look)


def ambient_occlusion(
    mesh: Mesh, *, directions: int = 256, reach: float = np.inf, threads: int = 0, progress: Progress = None
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
        return _core.ambient_occlusion(mesh._mesh, count, farthest, team, report)


def _openness(openness: npt.ArrayLike) -> npt.NDArray[np.float32]:
    array = np.asarray(_arrays.floats(openness, "openness"), dtype=np.float32)
    if array.ndim != 3 or array.shape[1:] != (3, 2):
        raise BrushfireError(f"openness: shape (face_count, 3, 2) is needed, not {array.shape}")
    return array
