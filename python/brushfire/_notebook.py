"""What a notebook shows of a mesh: a small picture, and what is in it."""

from __future__ import annotations

import base64
import html
from typing import TYPE_CHECKING

from brushfire import _core
from brushfire._errors import BrushfireError

if TYPE_CHECKING:
    from brushfire._mesh import Mesh

_WIDTH, _HEIGHT = 240, 180
_LARGEST_PICTURE = 2_000_000  # faces; drawing more would keep who only wanted to see a name waiting


def mesh_table(mesh: Mesh) -> str:
    """HTML."""
    report = mesh.report
    rows = [
        ("vertices", f"{report.vertices}"),
        ("faces", f"{report.faces}"),
        ("components", f"{report.components}"),
        ("boundary edges", f"{report.boundary_edges}"),
        ("area", f"{report.area:.6g}"),
        ("mean edge", f"{report.mean_edge_length:.6g}"),
        *(("", html.escape(remark)) for remark in report.remarks),
    ]
    cells = "".join(
        f"<tr><th style='text-align:left'>{a}</th><td style='text-align:left'>{b}</td></tr>" for a, b in rows
    )
    return f"<div style='display:flex;align-items:center'>{_picture(mesh)}<table>{cells}</table></div>"


def _picture(mesh: Mesh) -> str:
    if not 0 < mesh.face_count <= _LARGEST_PICTURE:
        return ""
    try:
        pixels = mesh.render(width=_WIDTH, height=_HEIGHT)
    except BrushfireError:  # a mesh from lengths
        return ""
    data = base64.b64encode(_core.encode_png(pixels)).decode()
    return f"<img src='data:image/png;base64,{data}' width='{_WIDTH}' height='{_HEIGHT}'/>"
