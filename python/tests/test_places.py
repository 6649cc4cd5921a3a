"""Places: every spelling of where, and Points as a sequence."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import brushfire as bf
from conftest import grid
from test_from_any import Tensor, lib

WANTED = [3, 17, 100]


def mask(count):
    array = np.zeros(count, dtype=bool)
    array[WANTED] = True
    return array


SPELLINGS = {
    "set": lambda n: set(WANTED),
    "frozenset": lambda n: frozenset(WANTED),
    "generator": lambda n: (v for v in WANTED),
    "map": lambda n: map(int, WANTED),
    "keys": lambda n: dict.fromkeys(WANTED).keys(),
    "tuple": lambda n: tuple(WANTED),
    "mixed list": lambda n: [3, np.int8(17), 100.0, 100],
    "whole floats": lambda n: np.array([3.0, 17.0, 100.0, 100.0])[:4],
    "mask": mask,
    "list of bools": lambda n: mask(n).tolist(),
    "tensor": lambda n: Tensor(WANTED),
    "tensor with a gradient": lambda n: Tensor([3.0, 17.0, 100.0, 100.0]),
    "tensor mask": lambda n: Tensor(mask(n), False),
    "jax": lambda n: lib("jax.numpy").array(WANTED),
    "jax mask": lambda n: lib("jax.numpy").array(mask(n)),
    "dask": lambda n: lib("dask.array").from_array(np.array(WANTED)),
    "pandas": lambda n: lib("pandas").Series(WANTED, index=["a", "b", "c"]),
    "pandas nullable": lambda n: lib("pandas").Series(WANTED, dtype="Int64"),
    "pandas mask": lambda n: lib("pandas").Series(mask(n), dtype="boolean"),
    "pandas index": lambda n: lib("pandas").Index(WANTED),
    "pandas column of floats": lambda n: lib("pandas").DataFrame({"v": [3.0, 17.0, 100.0, 100.0]})["v"],
}


@pytest.mark.parametrize("spell", SPELLINGS.values(), ids=SPELLINGS)
def test_sources_targets_and_rows_come_from_whatever_holds_numbers(bumpy, spell):
    n = bumpy.vertex_count
    expected = bumpy.distance(WANTED, method="dijkstra")
    assert np.array_equal(bumpy.distance(spell(n), method="dijkstra"), expected)
    targets = bumpy.distance(0, targets=spell(n), method="dijkstra")
    assert np.array_equal(targets[:3], bumpy.distance(0, method="dijkstra")[WANTED])
    rows = bumpy.distance_matrix(spell(n), method="dijkstra", dtype=float)
    assert np.array_equal(rows.min(axis=0), expected)


def test_single_places_of_any_library(bumpy):
    expected = bumpy.distance(17, method="dijkstra")
    for one in (17.0, np.float32(17), Tensor(17), np.array(17), np.array(17.0)):
        assert np.array_equal(bumpy.distance(one, method="dijkstra"), expected)
    assert bumpy.position(17.0).shape == bumpy.position(Tensor(17)).shape == (3,)


def test_floats_that_could_be_a_position_are_refused_with_both_spellings(bumpy):
    for floats in ([1.0, 2.0, 0.0], np.zeros(3), bumpy.vertices[:2], Tensor([1.0, 2.0, 0.0])):
        with pytest.raises(TypeError, match=r"bf\.at\(.*integers"):
            bumpy.distance(floats)
    for floats, number in (([0.5], "0.5"), ([1.0, 2.5], "2.5"), ([np.nan], "nan"), (1e30, "1e\\+30")):
        with pytest.raises(TypeError, match=number):
            bumpy.distance(floats)


def test_negative_numbers_are_refused_by_number(bumpy):
    for places, number in ((-1, -1), ([3, -7], -7), (np.array([-2], dtype=np.int8), -2), ([-4.0], -4), ({5, -5}, -5)):
        with pytest.raises(IndexError, match=f"vertex {number} does not exist"):
            bumpy.distance(places)
        with pytest.raises(IndexError, match=f"vertex {number} does not exist"):
            bumpy.distance_matrix(places)


def test_points_are_a_sequence_of_points(bumpy):
    points, _ = bumpy.nearest(bumpy.vertices[[5, 70, 9, 100]] + [0.2, 0.1, 0])
    assert len(points) == 4
    assert all(isinstance(p, bf.Point) for p in points)
    assert points[0] == next(iter(points)) == bf.Point(int(points.face[0]), tuple(points.weights[0]))
    assert points[-1] == list(points)[3]
    assert points[np.int64(2)] == points[2]
    for index in (4, -5):
        with pytest.raises(IndexError):
            points[index]
    for which in (slice(1, 3), [1, 2], np.array([1, 2]), np.array([False, True, True, False])):
        assert isinstance(points[which], bf.Points)
        assert points[which] == points[1:3]
    assert next(reversed(points)) == points[3]
    assert points[2] in points
    assert points != points[:3]
    assert points == bf.Points(points.face.tolist(), points.weights.tolist())
    assert pickle.loads(pickle.dumps(points)) == points
    assert repr(points) == "Points(4 points)"
    with pytest.raises(TypeError):
        hash(points)


def test_points_go_wherever_places_go(bumpy):
    points, _ = bumpy.nearest(bumpy.vertices[[5, 70, 9]] + [0.2, 0.1, 0])
    assert bumpy.path(*points).length == bumpy.path(points).length == bumpy.path(list(points)).length
    expected = bumpy.distance(points, method="exact")
    assert np.array_equal(bumpy.distance(list(points), method="exact"), expected)
    assert np.array_equal(bumpy.distance((p for p in points), method="exact"), expected)
    assert np.array_equal(bumpy.distance(points[0], method="exact"), bumpy.distance(points[:1], method="exact"))
    assert bumpy.distance(0, targets=points[1:]).shape == (2,)
    way = bumpy.path(0, 143)
    assert bumpy.path(way.points[0], way.points[-1]).length == pytest.approx(way.length, rel=1e-12)
    assert bumpy.length_of(way.points[:3]) < way.length


def test_everything_says_in_one_line_what_it_is(bumpy):
    d = bumpy.distance(0)
    things = [
        bumpy, bumpy.solver(), bumpy.path(0, 3), bumpy.log_map(0), bumpy.nearest([0, 0, 0])[0], bumpy.isolines(d, [1.0]),
        bumpy.voronoi([0, 5]), bumpy.farthest_points(3), bumpy.cut(), bf.compare(d, d), bumpy.panel(d), bf.at([0, 0, 0]),
    ]  # fmt: skip
    for thing in things:
        assert len(repr(thing)) < 400, type(thing)
        assert "\n" not in repr(thing), type(thing)


def test_a_notebook_shows_a_picture_and_what_is_in_the_mesh(bumpy):
    shown = bumpy._repr_html_()
    assert "data:image/png;base64," in shown
    assert f"<td style='text-align:left'>{bumpy.vertex_count}</td>" in shown
    bare = bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]])
    assert "image/png" not in bare._repr_html_()
    assert "<table>" in bf.Mesh([], [])._repr_html_()


def test_the_area_is_that_of_the_faces():
    v, f = grid(5)
    assert bf.Mesh(v, f).area == pytest.approx(16, rel=1e-12)
    assert bf.Mesh(2 * v, f).area == pytest.approx(64, rel=1e-12)
    assert bf.Mesh([], []).area == 0
