"""Whatever is done to an array that the package gave, it neither crashes nor changes its mind."""

from __future__ import annotations

import ctypes
import threading
from typing import Any

import numpy as np
import pytest

import brushfire as bf

SIDE = 40


def grid() -> bf.Mesh:
    x, y = np.meshgrid(np.arange(SIDE + 1.0), np.arange(SIDE + 1.0))
    v = np.column_stack([x.ravel(), y.ravel(), np.sin(x.ravel())])
    a = (np.arange(SIDE)[:, None] * (SIDE + 1) + np.arange(SIDE)).ravel()
    f = np.concatenate([np.column_stack([a, a + 1, a + SIDE + 2]), np.column_stack([a, a + SIDE + 2, a + SIDE + 1])])
    return bf.Mesh(v, f)


def past_the_mark(array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """The same memory, writable: as VTK's wrappers see it."""

    class Wrapped:
        __array_interface__ = {**array.__array_interface__, "data": (array.ctypes.data, False)}

    alias = np.asarray(Wrapped())
    assert alias.flags.writeable and np.shares_memory(alias, array)
    return alias


def test_arrays_of_a_mesh_say_that_they_are_read_only() -> None:
    mesh = grid()
    for array in (mesh.vertices, mesh.faces):
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 0


@pytest.mark.parametrize("method", bf.methods())
def test_writing_past_the_mark_changes_neither_mesh_nor_distances(method: str) -> None:
    mesh = grid()
    solver = mesh.solver()
    vertices, faces = mesh.vertices.copy(), mesh.faces.copy()
    before = mesh.distance(0, method=method)
    given_vertices, given_faces = mesh.vertices, mesh.faces
    past_the_mark(given_vertices)[:] -= given_vertices.mean(axis=0)
    past_the_mark(given_vertices)[::2] = np.nan
    past_the_mark(given_faces)[:] = 2**31 - 1
    ctypes.memset(given_faces.ctypes.data, 0xFF, given_faces.nbytes)
    np.testing.assert_array_equal(mesh.distance(0, method=method), before)
    np.testing.assert_array_equal(solver.distance(0, method=method), before)
    np.testing.assert_array_equal(mesh.vertices, vertices)
    np.testing.assert_array_equal(mesh.faces, faces)
    assert mesh.report.components == 1


def test_what_was_computed_may_be_overwritten() -> None:
    mesh = grid()
    distance, source, bound = mesh.distance([0, 9], tolerance=0, return_source=True, return_bound=True)
    path = mesh.path(0, mesh.vertex_count - 1)
    expected = distance.copy(), path.length
    for array in (
        distance,
        source,
        bound,
        path.positions,
        np.asarray(path.points.weights),
        np.asarray(path.points.face),
    ):
        past_the_mark(array)[:] = -1
    np.testing.assert_array_equal(mesh.distance([0, 9], tolerance=0), expected[0])
    assert mesh.path(0, mesh.vertex_count - 1).length == expected[1]


def test_a_mesh_does_not_share_the_arrays_it_was_made_of() -> None:
    mesh = grid()
    v, f = np.array(mesh.vertices), np.array(mesh.faces)
    other = bf.Mesh(v, f)
    before = other.distance(0)
    v[:] = np.nan
    f[:] = -1
    np.testing.assert_array_equal(other.distance(0), before)


def test_arguments_that_change_during_the_call_do_not_crash() -> None:
    mesh = grid()
    values = mesh.distance(0)
    levels = np.linspace(1, 30, 200)
    stop = threading.Event()

    def disturb() -> None:
        while not stop.is_set():
            levels[:] = 1e300
            values[:] = -values
            levels[:] = np.linspace(1, 30, 200)

    thread = threading.Thread(target=disturb)
    thread.start()
    try:
        for _ in range(200):
            try:
                mesh.isolines(values, levels)
                mesh.gradient(values)
            except bf.BrushfireError:
                pass  # nonsense may be refused
    finally:
        stop.set()
        thread.join()


# ---- options of the wrong type

WRONG_INTEGERS = [1.5, "2", None, [1], np.float64(2), True]
WRONG_NUMBERS = ["1e-3", [1, 2], object(), b"1", True]


def calls_with_integers(mesh: bf.Mesh) -> list[Any]:
    d = mesh.distance(0)
    return [
        lambda n: mesh.distance(0, threads=n),
        lambda n: mesh.distance_matrix([0], threads=n),
        lambda n: mesh.distances_within(1.0, [0], threads=n),
        lambda n: mesh.distances_within(1.0, [0], memory_limit=n),
        lambda n: mesh.farthest_points(n),
        lambda n: mesh.render(d, width=n),
        lambda n: mesh.render(d, height=n),
        lambda n: mesh.render(d, samples=n),
        lambda n: mesh.render(d, threads=n),
        lambda n: bf.animate(mesh.panel(d), wave=2, frame_ms=n),
        lambda n: mesh.ambient_occlusion(directions=n),
        lambda n: mesh.ambient_occlusion(threads=n),
        lambda n: mesh.panel(d, scale=n),
        lambda n: mesh.position(bf.Point(n, (1, 0, 0))),
    ]


def calls_with_numbers(mesh: bf.Mesh) -> list[Any]:
    d = mesh.distance(0)
    return [
        lambda x: mesh.distance(0, tolerance=x),
        lambda x: mesh.distance(0, radius=x),
        lambda x: mesh.distances_within(x, [0]),
        lambda x: mesh.distance_matrix([0], tolerance=x),
        lambda x: mesh.isolines(d, every=x),
        lambda x: mesh.curved_isolines(0, [1.0], chord_error=x),
        lambda x: mesh.curved_isolines(0, [1.0], tolerance=x),
        lambda x: mesh.trace(0, 0.0, x),
        lambda x: mesh.log_map(0, x),
        lambda x: mesh.render(d, zoom=x),
        lambda x: mesh.render(d, low=x),
        lambda x: mesh.panel(d, front=x),
        lambda x: mesh.nearest([[0, 0, 0]], snap_within=x),
        lambda x: bf.at([0, 0, 0], snap_within=x),
        lambda x: mesh.ambient_occlusion(reach=x),
    ]


@pytest.mark.parametrize("wrong", WRONG_INTEGERS)
def test_what_is_no_integer_is_a_typed_error(wrong: Any) -> None:
    for call in calls_with_integers(grid()):
        with pytest.raises(bf.BrushfireTypeError):
            call(wrong)


@pytest.mark.parametrize("wrong", WRONG_NUMBERS)
def test_what_is_no_number_is_a_typed_error(wrong: Any) -> None:
    for call in calls_with_numbers(grid()):
        with pytest.raises(bf.BrushfireTypeError):
            call(wrong)


@pytest.mark.parametrize("wrong", [5, 1.5, ["exact"], b"exact", True])
def test_what_is_no_text_is_a_typed_error(wrong: Any) -> None:
    mesh = grid()
    d = mesh.distance(0)
    for call in (
        lambda t: mesh.distance(0, method=t),
        lambda t: mesh.distance(0, bound=t),
        lambda t: mesh.distance(0, precision=t),
        lambda t: mesh.render(d, view=t),
        lambda t: mesh.render(d, colormap=t),
        lambda t: mesh.render(d, up=t),
        lambda t: mesh.render(d, title=t),
        lambda t: mesh.distance(0, progress="x" if t in (5, True) else t),
    ):
        with pytest.raises(bf.BrushfireTypeError):
            call(wrong)
    for path in (5.5, None, ["a.ply"]):
        with pytest.raises(bf.BrushfireTypeError):
            bf.read(path)  # type: ignore[call-overload]
    with pytest.raises(bf.BrushfireTypeError):
        mesh.distance_matrix([0], dtype="nonsense")
    with pytest.raises(bf.BrushfireTypeError):
        bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]], vertex_count=3.5)  # type: ignore[arg-type]


def test_integers_of_numpy_are_integers() -> None:
    mesh = grid()
    np.testing.assert_array_equal(mesh.distance(0, threads=np.int16(1)), mesh.distance(0))
    with pytest.raises(bf.BrushfireError):
        mesh.distance(0, threads=5000)
    with pytest.raises(bf.BrushfireError):
        mesh.distance(0, threads=-1)


# ---- positions far off, targets in no face


def test_a_position_far_off_is_not_taken_without_a_word() -> None:
    mesh = grid()
    with pytest.warns(bf.BrushfireWarning, match="from the surface"):
        mesh.distance(bf.at([1000, 2000, 3000]))
    with pytest.raises(bf.BrushfireError, match="farther than snap_within=5"):
        mesh.distance(bf.at([1000, 2000, 3000], snap_within=5))
    with pytest.raises(bf.BrushfireError, match="position 1 is"):
        mesh.nearest([[0, 0, 0], [1000, 2000, 3000]], snap_within=5)
    with pytest.raises(bf.BrushfireError):
        bf.at([0, 0, 0], snap_within=-1)
    points, distance = mesh.nearest([1000, 2000, 3000])
    assert np.isclose(distance[0], np.linalg.norm(mesh.position(points) - [1000, 2000, 3000]))


def test_a_target_in_no_face_reads_infinity() -> None:
    mesh = bf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], [[0, 1, 2]])
    for method in bf.methods():
        assert mesh.distance(0, targets=[3, 1, 3], method=method).tolist()[::2] == [np.inf, np.inf]
    d, source = mesh.distance(0, targets=[3], return_source=True)
    assert d.tolist() == [np.inf] and source.tolist() == [-1]
    assert mesh.path(0, 3).length == np.inf
    assert mesh.path(3, 0).length == np.inf
    assert mesh.edge_path(0, 3).length == np.inf
    paths, source = mesh.paths(0, [3, 1])
    assert [p.length for p in paths] == [np.inf, 1.0] and source.tolist() == [-1, 0]
