"""Mesh.page() and Mesh.show(): what is put into the viewer's page. That the page shows it is tested in a browser."""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pytest

import brushfire as bf

EMPTY = "<html>\n<!-- brushfire view: the mesh -->\n</html>\n"


@pytest.fixture
def mesh(tmp_path, monkeypatch):
    page = tmp_path / "viewer.html"
    page.write_text(EMPTY)
    monkeypatch.setenv("BRUSHFIRE_VIEWER", str(page))
    return bf.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])


def held(page, name):
    return re.search(f'id="held-{name}">(.*?)</script>', page, re.DOTALL).group(1)


def test_the_page_holds_the_mesh_the_values_and_where_it_starts(mesh, tmp_path):
    d = mesh.distance(3)
    page = mesh.page(d, sources=[3, bf.Point(0, (0.5, 0.5, 0))], method="exact", name="</script>")
    file = tmp_path / "back.ply"
    file.write_bytes(base64.b64decode(held(page, "mesh")))
    assert np.array_equal(bf.read(file).vertices, mesh.vertices)
    assert np.array_equal(np.frombuffer(base64.b64decode(held(page, "values"))), d)
    state = json.loads(held(page, "state"))
    assert state["name"] == "</script>"
    assert state["method"] == "exact"
    assert state["sources"] == [{"face": 1, "weights": [0, 0, 1]}, {"face": 0, "weights": [0.5, 0.5, 0]}]


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"sources": 4}, "4"),
        ({"method": "magic"}, "magic"),
        ({"values": [1.0]}, r"values: shape \(4,\)"),
        ({"method": "exact", "tolerance": 0.1}, "tolerance"),
    ],
)
def test_what_is_wrong_is_said(mesh, wrong, says):
    with pytest.raises(bf.BrushfireError, match=says):
        mesh.page(**wrong)


def test_without_the_page_show_gives_a_picture_and_page_says_why(mesh, monkeypatch, tmp_path):
    monkeypatch.setenv("BRUSHFIRE_VIEWER", str(tmp_path / "nowhere.html"))
    shown = mesh.show(sources=1)
    assert isinstance(shown, bf.Panel)
    assert shown._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(bf.BrushfireError, match="without the viewer's page"):
        mesh.page()


def test_the_widget_hears_where_the_sources_are(mesh):
    pytest.importorskip("anywidget")
    heard = []
    widget = mesh.show(mesh.distance(0))
    widget.observe(lambda change: heard.append(change["new"]), "sources")
    widget.set_state({"sources": [{"face": 1, "weights": [0.25, 0.25, 0.5]}]})
    assert len(heard) == 1
    assert list(widget.points) == [bf.Point(1, (0.25, 0.25, 0.5))]
    assert mesh.distance(widget.points).shape == (4,)
