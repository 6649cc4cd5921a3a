"""Isolines, gradients, the way down, comparison, pictures: facts of geometry on simple meshes."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid


@pytest.fixture(scope="module")
def plane() -> bf.Mesh:
    v, f = grid(41)
    return bf.Mesh(v / 20 - [1, 1, 0], f)


def test_linear_isolines_of_a_linear_field_are_straight(plane):
    values = plane.vertices[:, 0] + 0.0
    lines = plane.isolines(values, [-0.52, 0.31])
    assert [line.level for line in lines] == [-0.52, 0.31]
    assert [line.level_index for line in lines] == [0, 1]
    for line in lines:
        assert np.allclose(line.line.positions[:, 0], line.level, atol=1e-12)
        assert line.line.length == pytest.approx(2, rel=1e-12)
        assert not line.line.closed
        x = plane.position(line.line.points)
        assert np.array_equal(x, line.line.positions)


def test_smaller_values_are_on_the_left(plane):
    d = plane.distance(20 * 41 + 20, method="exact")
    [ring] = plane.isolines(d, [0.5])
    p = ring.line.positions
    turn = np.cross(p, np.roll(p, -1, axis=0))[:, 2].sum() / 2
    assert ring.line.closed
    assert turn == pytest.approx(np.pi / 4, rel=0.01)  # counter-clockwise around the source


def test_levels_every_and_count_agree_with_levels_given(plane):
    d = plane.distance(0, method="exact")
    every = plane.isolines(d, every=0.7)
    assert sorted({line.level for line in every}) == pytest.approx([0.7 * k for k in range(1, 5) if 0.7 * k <= d.max()])
    count = plane.isolines(d, count=3)
    assert sorted({line.level for line in count}) == pytest.approx(d.max() * np.array([0.25, 0.5, 0.75]))
    again = plane.isolines(d, [line.level for line in every])
    assert sum(line.line.length for line in again) == pytest.approx(sum(line.line.length for line in every))


def test_curved_isolines_are_circles_to_the_chord_error(plane):
    centre = 20 * 41 + 20
    for error in (1e-3, 1e-5):
        [ring] = plane.curved_isolines(centre, [0.6], chord_error=error)
        radius = np.linalg.norm(ring.line.positions, axis=1)
        assert np.allclose(radius, 0.6, rtol=1e-11)  # the nodes lie on the circle
        assert ring.line.length == pytest.approx(1.2 * np.pi, rel=2 * error / 0.6)
    merged = plane.curved_isolines(centre, every=0.4, tolerance=1e-3)
    assert [round(line.level, 9) for line in merged][:2] == [0.4, 0.8]
    assert len(plane.curved_isolines(centre, count=2)) >= 2
    half = plane.curved_isolines(centre, [0.5], offset=0.25, chord_error=1e-4)
    assert half[0].line.length == pytest.approx(0.5 * np.pi, rel=1e-3)


def test_the_gradient_of_a_linear_field_is_its_slope(plane):
    values = plane.vertices @ [0.3, -1.1, 0]
    gradient = plane.gradient(values)
    assert gradient.shape == (plane.face_count, 3)
    assert np.allclose(gradient, [0.3, -1.1, 0], atol=1e-12)
    bumpy = bf.Mesh(*grid(12, 0.5))
    lengths = np.linalg.norm(bumpy.gradient(bumpy.distance(0, method="exact")), axis=1)
    assert np.median(lengths) == pytest.approx(1, abs=0.05)


def test_steepest_descent_points_to_the_source(plane):
    d = plane.distance(0, method="exact")
    point = bf.Point(1000, (0.3, 0.3, 0.4))
    down = plane.steepest_descent(d, point)
    towards = plane.vertices[0] - plane.position(point)
    assert np.dot(down.vector, towards / np.linalg.norm(towards)) > 0.999
    assert down.slope == pytest.approx(-1, abs=0.01)
    assert sum(down.weight_rates) == pytest.approx(0, abs=1e-9)
    assert plane.steepest_descent(d, 0) is None
    tetrahedron = bf.Mesh.from_lengths([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]], [[1, 1, 1]] * 4)
    assert tetrahedron.steepest_descent([0, 1, 1, 1], 1).vector is None


def test_comparison_counts_and_weighs():
    field, reference = [0, 1.1, 2, np.inf, 5, np.inf], [0, 1, 2, 3, np.inf, np.inf]
    c = bf.compare(field, reference, [1, 1, 3, 1, 1, 1])
    assert (c.compared, c.zero_reference, c.missing, c.surplus, c.unreached_in_both) == (2, 1, 1, 1, 1)
    assert c.relative.max == pytest.approx(0.1)
    assert c.relative.mean == pytest.approx(0.05)
    assert c.weighted_relative.mean == pytest.approx(0.025)
    assert c.relative.max_vertex == 1
    assert bf.compare(field, reference).weighted_relative is None
    mesh = bf.Mesh(*grid(5))
    assert mesh.vertex_areas().sum() == pytest.approx(mesh.report.area)


def test_pictures_show_what_they_are_asked_for(plane, tmp_path):
    d = plane.distance(0, method="exact")
    look = {"width": 120, "height": 90, "view": "front", "up": "y", "bar": False, "samples": 1}
    bare = plane.render(**look)
    assert bare.shape == (90, 120, 4)
    assert bare.dtype == np.uint8
    coloured = plane.render(d, **look)
    lined = plane.render(d, isolines=[0.5, 1.0], **look)
    ring = plane.isolines(d, [0.5])
    full = plane.render(d, paths=[plane.path(0, 41 * 41 - 1), *ring], dots=[0, 5], file=tmp_path / "a.png", **look)
    for a, b in ((bare, coloured), (coloured, lined), (coloured, full)):
        assert (a != b).any(axis=2).sum() > 50
    assert (tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"
    assert np.array_equal(full, plane.render(d, paths=[plane.path(0, 41 * 41 - 1), *ring], dots=[0, 5], **look))
    labels = plane.render(labels=np.arange(plane.vertex_count) % 3, **look)
    assert (labels != bare).any()


LOOK = {"width": 64, "height": 48, "view": "front", "up": "y", "bar": False, "samples": 1}


def test_panels_stand_side_by_side_and_share_their_scale(plane):
    d = plane.distance(0, method="exact")
    alone = plane.render(d, **LOOK)
    both = bf.render([plane.panel(d), plane.panel(d)], **LOOK)
    assert both.shape == (48, 128, 4)
    assert np.array_equal(both[:, :64], alone)
    assert np.array_equal(both[:, 64:], alone)
    shared = bf.render([plane.panel(d), plane.panel(2 * d)], **LOOK)
    assert not np.array_equal(shared[:, :64], alone)
    own = bf.render([plane.panel(d), plane.panel(2 * d, scale=1)], scales=[{}, {"colormap": "magma"}], **LOOK)
    assert np.array_equal(own[:, :64], alone)
    assert not np.array_equal(own[:, 64:], alone)
    titled = bf.render([plane.panel(d, title="one"), plane.panel(d)], **LOOK)
    assert not np.array_equal(titled, both)
    legend = LOOK | {"width": 240, "height": 180, "bar": True}
    names = plane.render(labels=np.arange(plane.vertex_count) % 2, label_names=["one", "two"], **legend)
    numbers = plane.render(labels=np.arange(plane.vertex_count) % 2, **legend)
    assert names.shape != numbers.shape or not np.array_equal(names, numbers)


def test_svg_has_lines_as_vectors(plane, tmp_path):
    d = plane.distance(0, method="exact")
    bare = bf.render_svg(plane.panel(d), **LOOK)
    lined = bf.render_svg(plane.panel(d, isolines=[0.5, 1.0], paths=[plane.path(0, 41 * 41 - 1)]), **LOOK)
    assert bare.startswith("<svg")
    assert lined.count("<path") > bare.count("<path")
    assert bf.render_svg(plane.panel(d, isolines=[0.5]), bands=True, **LOOK).count("<path") == bare.count("<path")
    plane.render(d, file=tmp_path / "a.SVG", **LOOK)
    assert (tmp_path / "a.SVG").read_text() == bare


def test_animations_turn_and_spread(plane, tmp_path):
    d = plane.distance(0, method="exact")
    bare, full = plane.render(**LOOK), plane.render(d, **LOOK)
    turning = bf.animate(plane.panel(d), turntable=4, **LOOK)
    assert turning.shape == (4, 48, 64, 4)
    assert np.array_equal(turning[0], full)
    assert np.array_equal(turning[1], plane.render(d, **LOOK | {"azimuth": 90}))
    spreading = bf.animate(plane.panel(d), wave=5, **LOOK)
    assert np.array_equal(spreading[-1], full)
    different = [(frame != full).any(axis=2).sum() for frame in spreading]
    assert different == sorted(different, reverse=True)
    assert different[0] > different[-1]
    assert not np.array_equal(spreading[0], bare)
    try:
        bf.animate(plane.panel(d), wave=2, file=tmp_path / "a.webp", **LOOK)
        assert (tmp_path / "a.webp").read_bytes()[8:12] == b"WEBP"
    except bf.BrushfireError as error:
        assert "WebP" in str(error)  # built without it


def test_openness_darkens(plane):
    openness = np.full((plane.face_count, 3, 2), 0.2)
    assert plane.render(openness=openness, **LOOK).mean() < plane.render(**LOOK).mean()


def test_single_precision_is_near_double_and_marching_only(plane):
    for method in bf.methods():
        a = plane.distance(7, method=method, precision="float64")
        b = plane.distance(7, method=method, precision="float32")
        assert np.allclose(a, b, rtol=1e-4, atol=1e-6)
        if method in ("windows", "exact", "dijkstra"):
            assert np.array_equal(a, b)
    assert np.allclose(
        plane.distance_matrix([0, 9], method="novotni-klein", precision="float32"),
        plane.distance_matrix([0, 9], method="novotni-klein", precision="float64"),
        rtol=1e-4,
    )
