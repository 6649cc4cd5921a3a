"""Curves as sources: bf.Curve, whatever path(), isolines(), boundaries() and region() return, lists of them and places."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

N = 6
V, F = grid(N)
X, Y = V[:, 0], V[:, 1]


@pytest.fixture(scope="module")
def plane() -> bf.Mesh:
    return bf.Mesh(V, F)


def near(found, expected):
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


def rows(y: int) -> list[int]:
    return [y * N + x for x in range(N)]


def test_a_curve_of_vertices_is_its_segments_and_not_its_ends(plane):
    near(plane.distance(bf.Curve(rows(0)), method="exact"), Y)
    near(plane.distance(bf.Curve([0]), method="exact"), np.hypot(X, Y))
    middle = bf.Curve(bf.Points([0, 0], [[0.5, 0.5, 0], [0.5, 0, 0.5]]))  # within one face
    ends = plane.position(middle.places)
    assert plane.distance(middle, targets=bf.Point(0, (0.5, 0.25, 0.25)), method="exact") == pytest.approx(0, abs=1e-12)
    assert plane.distance(bf.at(ends), method="exact").min() >= plane.distance(middle, method="exact").min()


def test_paths_isolines_boundaries_and_borders_are_sources(plane):
    near(plane.distance(plane.path(0, N - 1), method="exact"), Y)
    near(plane.distance(plane.curve_along(rows(0)), method="exact"), Y)
    near(plane.distance(plane.project_curve([[0, 0, 1], [N - 1, 0, 1]])[0], method="exact"), Y)
    rim = np.minimum.reduce([X, Y, N - 1 - X, N - 1 - Y])
    near(plane.distance(plane.boundaries(), method="exact"), rim)
    near(plane.distance(plane.boundaries()[0], method="exact"), rim)
    d = plane.distance(bf.Curve(rows(0)), method="exact")
    lines = plane.isolines(d, [1.0, 3.0])
    field, source = plane.distance(lines, method="exact", return_source=True)
    near(field, np.minimum(abs(Y - 1), abs(Y - 3)))
    assert set(source[Y < 1]) == {0}
    assert set(source[Y > 3]) == {1}
    cells = plane.voronoi([0, N * N - 1], method="exact")
    on_border = plane.distance(cells.borders, method="exact")
    np.testing.assert_allclose(cells.distance, cells.distance[::-1], atol=1e-12)  # both cells are alike
    assert on_border[0] == pytest.approx(on_border[-1])


def test_curves_and_places_mix_and_keep_their_numbers(plane):
    sources = [N * N - 1, bf.Curve(rows(0)), bf.Point(0, (1, 0, 0))]
    d, source = plane.distance(sources, method="exact", return_source=True, offset=[0.0, 2.0, 0.0])
    near(d, np.minimum.reduce([np.hypot(N - 1 - X, N - 1 - Y), Y + 2, np.hypot(X, Y)]))
    assert source[N * N - 1] == 0
    assert source[N - 1] == 1
    assert source[0] == 2
    near(plane.distance((c for c in sources), method="exact", offset=[0.0, 2.0, 0.0]), d)
    with pytest.raises(TypeError, match="beside curves each item is one place"):
        plane.distance([bf.Curve(rows(0)), [1, 2]])


def test_offsets_run_along_a_curve(plane):
    d = plane.distance(bf.Curve(rows(0), offset=0.5 * np.arange(N)), method="exact")
    near(d[rows(0)], 0.5 * np.arange(N))
    near(plane.distance(bf.Curve(rows(0), offset=2.0), method="exact"), Y + 2)
    with pytest.raises(bf.BrushfireError, match="differ by more"):
        plane.distance(bf.Curve([0, 1], offset=[0.0, 1.5]))
    with pytest.raises(bf.BrushfireError, match="one per place"):
        plane.distance(bf.Curve([0, 1], offset=[0.0, 0.5, 0.5]))


def test_pieces_are_not_joined(plane):
    two = bf.Curve([*rows(0), *rows(N - 1)], starts=[0, N])
    near(plane.distance(two, method="exact"), np.minimum(Y, N - 1 - Y))
    with pytest.raises(bf.BrushfireError, match="starts"):
        plane.distance(bf.Curve([0, 1], starts=[1]))


def test_regions(plane):
    low = Y <= 2
    for region in (plane.region(vertices=low), plane.region(vertices=np.flatnonzero(low))):
        near(plane.distance(region, method="exact"), np.maximum(0, Y - 2))
    faces = (Y[F] <= 2).all(axis=1)
    for region in (plane.region(faces=faces), plane.region(faces=np.flatnonzero(faces))):
        near(plane.distance(region, method="exact"), np.maximum(0, Y - 2))
    with pytest.raises(bf.BrushfireError, match="empty region"):
        plane.region(vertices=[])
    with pytest.raises(IndexError, match="no vertex"):
        plane.region(vertices=[N * N])
    with pytest.raises(IndexError, match="face"):
        plane.region(faces=[-1])
    with pytest.raises(bf.BrushfireError, match="one of vertices and faces"):
        plane.region()


def test_everything_that_starts_somewhere_starts_from_curves(plane):
    bottom, top = bf.Curve(rows(0)), plane.curve_along(rows(N - 1))
    solver = plane.solver("exact")
    near(solver.distance(bottom), Y)
    paths, source = plane.paths([bottom, top], [2 * N + 1, 4 * N + 1])
    near([p.length for p in paths], [2, 1])
    assert source.tolist() == [0, 1]
    assert plane.voronoi([bottom, top], method="exact").area.tolist() == pytest.approx([12.5, 12.5])
    d, which = plane.nearest_sources([bottom, top], 2, method="exact")
    near(d[:, 0] + d[:, 1], np.full(N * N, N - 1.0))
    assert which[0].tolist() == [0, 1]
    level = plane.curved_isolines(bottom, [1.5])
    near(level[0].line.positions[:, 1], np.full(len(level[0].line.positions), 1.5))


def test_tolerances_have_words(plane):
    for word, number in (("draft", 1e-2), ("standard", 1e-3), ("fine", 1e-5), ("exact", 0)):
        np.testing.assert_array_equal(plane.distance(0, tolerance=word), plane.distance(0, tolerance=number))
    with pytest.raises(bf.BrushfireTypeError, match="draft, standard, fine, exact"):
        plane.distance(0, tolerance="coarse")


def test_what_is_no_curve_is_refused(plane):
    with pytest.raises(bf.BrushfireError, match="share no face"):
        plane.distance(bf.Curve([0, 3 * N + 3]))
    with pytest.raises(bf.BrushfireError, match="without points"):
        plane.distance(bf.Path(bf.Points([], np.zeros((0, 3))), np.zeros((0, 3)), np.inf))
    with pytest.raises(IndexError):
        plane.distance(bf.Curve([0, N * N]))
    with pytest.raises(bf.BrushfireError, match="at least one"):
        plane.distance(bf.Curve([]))


def test_the_left_of_a_curve_is_negative(plane):
    up = bf.Curve([y * N + 2 for y in range(N)])
    near(plane.signed_distance(up), X - X[2])
    near(plane.signed_distance(bf.Curve(list(reversed(up.places)))), X[2] - X)
    with pytest.raises(bf.BrushfireError, match="is a point"):
        plane.signed_distance([up, 0])
    with pytest.raises(bf.BrushfireError, match="offsets"):
        plane.signed_distance(bf.Curve(rows(0), offset=1.0))
    near(plane.walled(edges=[[0, 1]]).signed_distance(up), X - X[2])
