"""Wrong input of every kind: a typed exception each, never a crash, never a silent answer."""

from __future__ import annotations

import itertools
import pickle

import numpy as np
import pytest

import brushfire as bf
from brushfire import _core
from conftest import grid

V, F = grid(4)
TYPED = (bf.BrushfireError, TypeError)


class Strange:
    def __array__(self, dtype=None, copy=None):
        raise RuntimeError("no array in here")


def wrong_arrays():
    rng = np.random.default_rng(3)
    yield from (
        [],
        None,
        "text",
        b"bytes",
        {},
        object(),
        Strange,
        3,
        3.5,
        float("nan"),
        [[]],
        [[1, 2], [3]],
        [["a", "b", "c"]],
    )
    yield from (np.zeros(3), np.zeros((3, 4)), np.zeros((2, 3, 3)), np.zeros((0, 4)), np.zeros((3, 0)), np.array(None))
    yield from (np.zeros((4, 3), dtype=complex), np.zeros((4, 3), dtype=bool), np.zeros((4, 3), dtype="M8[s]"))
    yield from (np.array([[None, 1, 2]]), np.array([["1", "2", "3"]]), np.zeros((4, 3), dtype=[("x", float)]))
    yield from (np.full((4, 3), np.nan), np.full((4, 3), np.inf), np.full((4, 3), 2**63, dtype=np.uint64), np.ma.masked)
    yield from (np.full((4, 3), -1), np.full((4, 3), 2**31), np.full((4, 3), 2**62), np.full((4, 3), 1e300))
    for dtype in (np.int8, np.uint16, np.float16, np.float32, np.int64):
        yield rng.integers(-3, 30, (5, 3)).astype(dtype)[::-2, ::-1]


def test_meshes_from_wrong_arrays_raise_or_are_meshes():
    values = list(wrong_arrays())
    good = refused = 0
    for v, f in itertools.chain(((v, F) for v in values), ((V, f) for f in values), itertools.product(values, values)):
        try:
            mesh = bf.Mesh(v, f)
        except TYPED:
            refused += 1
            continue
        except RuntimeError as error:
            assert "no array in here" in str(error)
            continue
        good += 1
        mesh.report  # noqa: B018
        if mesh.vertex_count:
            mesh.distance_matrix(method="dijkstra")
    assert refused > 500
    assert good > 0


def wrong_places():
    yield from (
        [],
        None,
        "0",
        b"0",
        {},
        object(),
        0.5,
        [0.5],
        [0.0, 1.0, 2.0],
        [1e300],
        float("inf"),
        1 + 2j,
        True,
        [True, False],
        [[0]],
        [[0, 1], [2, 3]],
    )
    yield from (-1, 16, 2**31, 2**32, 2**33, 2**63, 2**64, 10**30, [0, -1], [0, 16], np.array([2**64 - 1], np.uint64))
    yield from (np.zeros((2, 3)), np.array([0.25]), np.array([None]), np.ones(15, dtype=bool), np.zeros(16, dtype=bool))
    yield from (bf.Point(-1, (1, 0, 0)), bf.Point(18, (1, 0, 0)), bf.Point(0, (0, 0, 0)), bf.Point(0, (1, 1, 1)))
    yield from (
        bf.Point(0, (2, -1, 0)),
        bf.Point(0, (float("nan"), 0, 1)),
        bf.Point(0, (1, 0)),
        bf.Point("a", (1, 0, 0)),
    )
    yield from (
        bf.Points([0], [[1, 0]]),
        bf.Points([0, 1], [[1, 0, 0]]),
        bf.Points([[0]], [[1, 0, 0]]),
        bf.Points([0.5], [[1, 0, 0]]),
    )
    yield from (
        bf.Points([99], [[1, 0, 0]]),
        bf.Points([0], [[0, 0, 0]]),
        bf.Points([0], [[np.inf, 0, 0]]),
        [0, "x"],
        [bf.Point(0, (1, 0, 0)), None],
    )
    yield from (bf.Points([10**12], [[1, 0, 0]]), bf.Point(10**30, (1, 0, 0)))


@pytest.mark.parametrize("places", list(wrong_places()), ids=lambda p: repr(p)[:40])
def test_wrong_places_raise(places):
    mesh = bf.Mesh(V, F)
    with pytest.raises(TYPED):
        mesh.distance(places, method="dijkstra")


@pytest.mark.parametrize(
    "places", [-1, 16, 2**64, True, "0", [0.5], bf.Point(0, (1, 1, 1)), np.ones(15, dtype=bool)], ids=repr
)
def test_wrong_targets_rows_and_columns_raise(places):
    mesh = bf.Mesh(V, F)
    with pytest.raises(TYPED):
        mesh.distance(0, targets=places, method="dijkstra")
    with pytest.raises(TYPED):
        mesh.distance_matrix(places, method="dijkstra")
    with pytest.raises(TYPED):
        mesh.distance_matrix(0, places, method="dijkstra")
    with pytest.raises(TYPED):
        mesh.distances_within(1, places, method="dijkstra")


def test_a_vertex_that_does_not_exist_is_an_index_error_that_names_it():
    mesh = bf.Mesh(V, F)
    for index in (16, -1, 2**40):
        with pytest.raises(IndexError, match=str(index)) as error:
            mesh.distance(index, method="dijkstra")
        assert isinstance(error.value, bf.BrushfireError)
        assert error.value.code == "index_out_of_range"
        with pytest.raises(IndexError, match=str(index)):
            mesh.distance_matrix([0, index], method="dijkstra")
        with pytest.raises(IndexError, match=str(index)):
            mesh.distances_within(1, [index], method="dijkstra")


@pytest.mark.parametrize(
    "arguments",
    [
        {"method": "no-such-method"}, {"method": 7}, {"radius": -1}, {"radius": float("nan")},
        {"radius": "far"}, {"radius": None}, {"offset": [1, 2]}, {"offset": float("nan")},
        {"offset": float("inf")}, {"offset": "x"}, {"offset": None}, {"offset": [[0]]}, {"progress": 7, "method": "dijkstra"},
    ],
    ids=str,
)  # fmt: skip
def test_wrong_options_raise(arguments):
    with pytest.raises(TYPED):
        bf.Mesh(V, F).distance(0, **{"method": "dijkstra", **arguments})


@pytest.mark.parametrize(
    "arguments",
    [
        {"threads": -1},
        {"threads": 10**6},
        {"threads": 1.5},
        {"dtype": int},
        {"dtype": "nonsense"},
        {"dtype": np.complex64},
    ],
    ids=str,
)
def test_wrong_matrix_options_raise(arguments):
    mesh = bf.Mesh(V, F)
    with pytest.raises(TYPED):
        mesh.distance_matrix(method="dijkstra", **arguments)
    with pytest.raises(TYPED):
        mesh.distances_within(1.0, method="dijkstra", **arguments)


@pytest.mark.parametrize("radius", [-1, float("nan"), float("inf"), None, "x", [1, 2]], ids=repr)
def test_wrong_radii_raise(radius):
    with pytest.raises(TYPED):
        bf.Mesh(V, F).distances_within(radius, method="dijkstra")


def test_wrong_lengths_raise():
    for lengths in (
        [[1, 1]],
        [[1, 1, 5]],
        [[1, 1, float("nan")]],
        [[-1, 1, 1]],
        [1, 1, 1],
        [["a", 1, 1]],
        [],
        np.ones((2, 3)),
    ):
        with pytest.raises(TYPED):
            bf.Mesh.from_lengths([[0, 1, 2]], lengths)
    for count in (2, -1):
        with pytest.raises(TYPED):
            bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]], vertex_count=count)


def calls(mesh: bf.Mesh):
    """Every function that takes places or arrays, with one argument left open."""
    d = mesh.distance(0, method="dijkstra")
    yield from (lambda x: mesh.path(x), lambda x: mesh.path(0, x), lambda x: mesh.paths(x, 1))
    yield from (lambda x: mesh.paths(0, x), lambda x: mesh.edge_path(x, 1), lambda x: mesh.edge_path(0, x))
    yield from (lambda x: mesh.shorten(x), lambda x: mesh.length_of(x), lambda x: mesh.trace(x, 0.0, 1.0))
    yield from (lambda x: mesh.log_map(x), lambda x: mesh.angle_of(x, [1, 0, 0]), lambda x: mesh.voronoi(x))
    yield from (lambda x: mesh.steepest_descent(d, x), lambda x: mesh.curved_isolines(x, [1.0]))
    yield from (lambda x: mesh.farthest_points(3, x), lambda x: mesh.cut(vertices=x), lambda x: mesh.cut(faces=x))
    yield from (lambda x: mesh.render(dots=x, width=32, height=32, bar=False),)


def array_calls(mesh: bf.Mesh):
    """Every function that takes arrays of numbers."""
    slit = mesh.cut(edges=[(5, 6)])
    yield from (lambda x: mesh.isolines(x, [1.0]), lambda x: mesh.isolines(np.arange(16.0), x))
    yield from (lambda x: mesh.gradient(x), lambda x: mesh.steepest_descent(x, 0), lambda x: mesh.isolines(x, count=2))
    yield from (lambda x: bf.compare(x, np.ones(16)), lambda x: bf.compare(np.ones(16), np.ones(16), x))
    yield from (lambda x: mesh.curved_isolines(0, x), lambda x: slit.to_original(x), lambda x: mesh.cut(edges=x))
    yield from (lambda x: mesh.trace(0, x, 1.0), lambda x: mesh.trace(0, 0.0, x), lambda x: mesh.angle_of(0, x))
    yield from (
        lambda x: mesh.log_map(0, x),
        lambda x: mesh.paths(0, 1, offset=x),
        lambda x: mesh.voronoi([0, 1], offset=x),
    )
    yield from (lambda x: mesh.isolines(np.arange(16.0), every=x), lambda x: mesh.isolines(np.arange(16.0), count=x))
    yield from (lambda x: mesh.curved_isolines(0, [1.0], chord_error=x), lambda x: mesh.farthest_points(x))
    yield from (lambda x: mesh.render(x, width=32, height=32), lambda x: mesh.render(labels=x, width=32, height=32))
    yield from (lambda x: mesh.render(width=x), lambda x: mesh.render(zoom=x, width=32, height=32))


def refusals(functions, values) -> tuple[int, int]:
    """How many calls raised something typed, and how many gave an answer; anything else is raised here."""
    refused = answered = 0
    for call, value in itertools.product(functions, values):
        try:
            call(value)
            answered += 1
        except TYPED:
            refused += 1
        except RuntimeError as error:
            assert "no array in here" in str(error)
            refused += 1
    return refused, answered


def test_every_function_refuses_wrong_places_with_a_typed_error():
    refused, answered = refusals(list(calls(bf.Mesh(V, F))), list(wrong_places()))
    assert refused > 10 * answered, (refused, answered)


def test_every_function_refuses_wrong_arrays_with_a_typed_error():
    refused, answered = refusals(list(array_calls(bf.Mesh(V, F))), list(wrong_arrays()))
    assert refused > 3 * answered, (refused, answered)


def test_every_function_takes_a_mesh_without_positions_or_says_that_it_cannot():
    mesh = bf.Mesh.from_lengths(F, np.linalg.norm(V[np.roll(F, -1, axis=1)] - V[F], axis=2))
    for call in calls(mesh):
        try:
            call(1)
        except TYPED as error:
            assert str(error)


@pytest.mark.parametrize(
    "chosen", [{}, {"levels": [1], "every": 1}, {"every": 0}, {"every": -1}, {"count": -1}], ids=str
)
def test_wrong_choices_of_levels_raise(chosen):
    mesh = bf.Mesh(V, F)
    with pytest.raises(TYPED):
        mesh.isolines(np.arange(16.0), **chosen)
    with pytest.raises(TYPED):
        mesh.curved_isolines(0, **chosen)


@pytest.mark.parametrize(
    "look", [{"view": "inside"}, {"up": 3}, {"samples": 99}, {"colormap": "jet"}, {"nose": 1}], ids=str
)
def test_wrong_looks_raise(look):
    with pytest.raises(TYPED):
        bf.Mesh(V, F).render(width=32, height=32, **{"view": "top", **look})


def test_pictures_go_into_files_of_their_kind_only(tmp_path):
    mesh = bf.Mesh(V, F)
    for file, code in (("a.jpg", "unknown_format"), ("a.webp", "unknown_format"), ("no/a.png", "file_not_writable")):
        with pytest.raises(bf.BrushfireError) as error:
            mesh.render(width=32, height=32, file=tmp_path / file)
        assert error.value.code == code
    with pytest.raises(bf.BrushfireError) as error:
        bf.animate(mesh.panel(), turntable=2, width=32, height=32, file=tmp_path / "a.png")
    assert error.value.code == "unknown_format"


@pytest.mark.parametrize(
    "shown",
    [
        {"title": 3},
        {"label_names": [1]},
        {"scale": -1},
        {"scale": 1},
        {"openness": np.ones((3, 2))},
        {"openness": np.ones((1, 3, 2))},
        {"front": "x"},
    ],
    ids=str,
)
def test_wrong_panels_raise(shown):
    mesh = bf.Mesh(V, F)
    with pytest.raises(TYPED):
        bf.render([mesh.panel(np.arange(16.0), **shown)], width=32, height=32)


@pytest.mark.parametrize(
    "wrong",
    [
        {"scales": 3},
        {"scales": []},
        {"scales": [3]},
        {"scales": [{"nose": 1}]},
        {"scales": [{}], "low": 0},
        {"font": "no.ttf"},
        {"samples": 0},
    ],
    ids=str,
)
def test_wrong_scales_and_fonts_raise(wrong):
    mesh = bf.Mesh(V, F)
    for draw in (bf.render, bf.render_svg):
        with pytest.raises(TYPED):
            draw([mesh.panel(np.arange(16.0))], **{"width": 32, "height": 32, **wrong})


@pytest.mark.parametrize(
    "frames",
    [{}, {"turntable": 2, "wave": 2}, {"turntable": 1}, {"wave": 9999}, {"wave": 2, "frame_ms": 1}, {"wave": 2}],
    ids=str,
)
def test_wrong_animations_raise(frames):
    with pytest.raises(TYPED):  # the last: a wave of nothing
        bf.animate(bf.Mesh(V, F).panel(), **frames, width=32, height=32)


@pytest.mark.parametrize("panels", [[], 3, [3], None], ids=str)
def test_what_is_no_panel_is_refused(panels):
    for draw in (bf.render, bf.render_svg, lambda p: bf.animate(p, turntable=2)):
        with pytest.raises(TYPED):
            draw(panels)


def test_errors_survive_pickling():
    for error in (bf.BrushfireError("why", "too_large"), bf.BrushfireIndexError("vertex 7")):
        again = pickle.loads(pickle.dumps(error))
        assert type(again) is type(error)
        assert (str(again), again.code) == (str(error), error.code)


def test_options_that_only_one_side_knows_are_errors():
    """The Python files name options to the compiled module in dicts: a key that nothing reads is a fault, not ignored."""
    mesh = bf.Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    with pytest.raises(bf.BrushfireError, match="'speed'") as error:
        _core.Solver(mesh._space).set_up({"speed": 1.0})
    assert error.value.code == "internal"
    for shown, look in [({"glow": 1.0}, {}), ({}, {"glow": 1.0}), ({}, {"scales": [{"glow": 1.0}]})]:
        with pytest.raises(bf.BrushfireError, match="'glow'"):
            _core.render([(mesh._mesh, shown)], {"scales": [{}], **look})


def test_a_radius_below_nothing_and_an_empty_name_are_told_by_their_arguments(tmp_path):
    mesh = bf.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    runs = (
        lambda r: mesh.distance(0, radius=r),
        lambda r: mesh.path(0, 2, radius=r),
        lambda r: mesh.log_map(0, r),
        lambda r: mesh.distances_within(r),
        lambda r: mesh.solver().distances_within(r, [0]),
    )
    for run in runs:
        for radius in (-1, float("nan")):
            with pytest.raises(bf.BrushfireError, match=rf"^radius: a number >= 0 is needed, not {radius}"):
                run(radius)
    for use in (bf.read, mesh.save, lambda name: bf.write(name, mesh.distance(0))):
        with pytest.raises(bf.BrushfireError, match="the name of a file is needed, not ''"):
            use("")
    with pytest.raises(bf.BrushfireError, match="no mesh is written as 'foo' .*stl"):
        mesh.save(tmp_path / "mesh.foo")
