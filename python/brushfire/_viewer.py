"""The viewer in a notebook: the page of `brushfire view`, with this mesh in it, in a frame."""

from __future__ import annotations

import base64
import functools
import importlib.resources
import json
import os
import tempfile
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brushfire import _core
from brushfire._arrays import floats
from brushfire._errors import BrushfireError
from brushfire._options import TOLERANT, options
from brushfire._places import Places, Points

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

# Where the page's source has it: web/index.html.
_PLACE = "<!-- brushfire view: the mesh -->"

# Shows the page in a frame, and tells Python where its sources are.
_WIDGET = """
function render({ model, el }) {
  const frame = document.createElement('iframe');
  const url = URL.createObjectURL(new Blob([model.get('page')], { type: 'text/html' }));
  frame.title = 'Brushfire: distances on a surface';
  frame.style = `width: 100%; height: ${model.get('height')}px; border: 0`;
  frame.src = url;
  const hear = (event) => {
    if (event.source !== frame.contentWindow || !event.data?.brushfire) return;
    model.set('sources', event.data.brushfire.sources);
    model.save_changes();
  };
  window.addEventListener('message', hear);
  el.append(frame);
  return () => {
    window.removeEventListener('message', hear);
    URL.revokeObjectURL(url);
  };
}
export default { render };
"""


def _empty_page() -> str | None:
    """The page without a mesh; None where this package was built without it."""
    named = os.environ.get("BRUSHFIRE_VIEWER")
    file = FilePath(named) if named else importlib.resources.files("brushfire") / "viewer.html"
    return file.read_text(encoding="utf-8") if file.is_file() else None


def _script(name: str, kind: str, content: str) -> str:
    return f'<script type="{kind}" id="held-{name}">{content}</script>\n'


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode()


@functools.cache
def _widget_class() -> Any:
    """None where anywidget is not installed."""
    try:
        import anywidget
        import traitlets
    except ImportError:
        return None

    class Viewer(anywidget.AnyWidget):
        """The viewer as a widget: ``sources`` are the page's, ``points`` the same as :class:`brushfire.Points`."""

        _esm = _WIDGET
        page: Any = traitlets.Unicode().tag(sync=True)
        height: Any = traitlets.Int(480).tag(sync=True)
        sources: Any = traitlets.List().tag(sync=True)

        @property
        def points(self) -> Points:
            return Points([s["face"] for s in self.sources], [s["weights"] for s in self.sources])

    return Viewer


def page_of(
    mesh: Mesh,
    values: npt.ArrayLike | None,
    sources: Places | None,
    method: str | None,
    tolerance: float | None,
    name: str = "mesh",
) -> str:
    """As Mesh.page() says."""
    page = _empty_page()
    if page is None:
        raise BrushfireError("this package was built without the viewer's page: './run web' in the sources builds it")
    cut = None if mesh._walls is None else mesh.cut()
    held_mesh = mesh if cut is None else cut.mesh
    if held_mesh.face_count == 0:
        raise BrushfireError("a mesh without faces cannot be shown")
    if cut is not None:
        _check_can_be_a_file(cut.mesh)
    if cut is not None and sources is not None:
        sources, starts = cut.points_from_original(sources)
        if len(starts) == 0:
            raise BrushfireError("sources: they lie behind walls")
    chosen = options(method, tolerance, np.inf)
    if chosen.get("method", TOLERANT) not in _core.method_names():
        raise BrushfireError(f"method: {method!r} is none of {', '.join(_core.method_names())}")
    state = {
        "name": name,
        "method": chosen.get("method", TOLERANT),
        "tolerance": repr(chosen.get("tolerance", 1e-3)),
        "sources": [{"face": 0, "weights": [1.0, 0.0, 0.0]}] if sources is None else _in_faces(held_mesh, sources),
    }
    # "</script>" in a name would end the element; in JSON a letter may be written by its number.
    held = _script("state", "application/json", json.dumps(state).replace("<", "\\u003c"))
    held += _script("mesh", "application/octet-stream", _base64(_ply(held_mesh)))
    if values is not None:
        shown = floats(values, "values")
        if shown.shape != (mesh.vertex_count,):
            raise BrushfireError(f"values: shape ({mesh.vertex_count},) is needed, not {shown.shape}")
        if cut is not None:
            shown = shown[cut.original_vertex]
        held += _script("values", "application/octet-stream", _base64(shown.astype("<f8").tobytes()))
    return page.replace(_PLACE, held)


def _check_can_be_a_file(mesh: Mesh) -> None:
    if type(mesh)(mesh.vertices, mesh.faces).report.boundary_edges != mesh.report.boundary_edges:
        raise BrushfireError("a wall of a single edge, whose ends stay whole, cannot be shown: block an edge beside it, too")


def show(
    mesh: Mesh,
    values: npt.ArrayLike | None,
    sources: Places | None,
    method: str | None,
    tolerance: float | None,
    height: int,
) -> Any:
    """As Mesh.show() says."""
    widget = _widget_class()
    if widget is not None and _empty_page() is not None:
        return widget(page=page_of(mesh, values, sources, method, tolerance), height=height)
    if values is None:
        values = mesh.distance(0 if sources is None else sources, method=method, tolerance=tolerance)
    return mesh.panel(values, dots=sources)


def _ply(mesh: Mesh) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder) / "mesh.ply"
        mesh.save(file)
        return file.read_bytes()


def _in_faces(mesh: Mesh, places: Places) -> list[dict[str, Any]]:
    """Every place as a face and weights: a vertex as a corner of the first of its faces."""
    arrays = mesh._arrays(places, "sources")
    mesh._mesh.positions(arrays.index, arrays.weights)  # which raises for what is not there
    found = []
    for k, index in enumerate(arrays.index.tolist()):
        weights = [0.0, 0.0, 0.0] if arrays.weights is None else arrays.weights[k].tolist()
        if not any(weights):
            at = np.argwhere(mesh.faces == index)
            if len(at) == 0:
                raise BrushfireError(f"sources: vertex {index} is in no face")
            index, corner = at[0].tolist()
            weights[corner] = 1.0
        found.append({"face": index, "weights": weights})
    return found
