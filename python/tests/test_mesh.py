"""Mesh: conversion in, views out, pickling, memory."""

from __future__ import annotations

import copy
import gc
import pickle

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

V, F = grid(5, 0.3)


@pytest.mark.parametrize(
    "faces",
    [F.astype(t) for t in (np.int8, np.uint8, np.int32, np.uint32, np.int64, np.uint64)]
    + [np.asfortranarray(F), F[::-1][::-1], F.tolist(), F.astype(">i4")],
)
def test_faces_of_any_integer_type_and_layout_make_the_same_mesh(faces):
    assert np.array_equal(bf.Mesh(V, faces).faces, F)


@pytest.mark.parametrize(
    "vertices",
    [V, np.asfortranarray(V), V.tolist(), V.astype(">f8"), np.repeat(V, 2, axis=0)[::2], V.astype(np.longdouble)],
)
def test_positions_of_any_layout_make_the_same_mesh(vertices):
    assert np.array_equal(bf.Mesh(vertices, F).vertices, V)


def test_float32_and_integer_positions_are_converted_to_float64():
    assert bf.Mesh(V.astype(np.float32), F).vertices.dtype == np.float64
    assert np.array_equal(bf.Mesh(V.round().astype(np.int16), F).vertices, V.round())


def test_read_only_arrays_are_taken():
    v, f = V.copy(), F.copy()
    v.flags.writeable = f.flags.writeable = False
    assert bf.Mesh(v, f).face_count == len(F)


def test_two_columns_are_a_flat_mesh():
    assert np.array_equal(bf.Mesh(V[:, :2], F).vertices, V * [1, 1, 0])


def test_the_mesh_does_not_change_with_the_arrays_that_it_was_made_of():
    v = V.copy()
    mesh = bf.Mesh(v, F)
    v[:] = 7
    assert np.array_equal(mesh.vertices, V)


def test_arrays_of_a_mesh_are_read_only_and_outlive_it():
    mesh = bf.Mesh(V, F)
    vertices, faces = mesh.vertices, mesh.faces
    assert faces.dtype == np.int32
    for view in (vertices, faces):
        assert not view.flags.owndata
        with pytest.raises(ValueError):
            view[0] = 1
    del mesh
    gc.collect()
    assert np.array_equal(vertices, V)
    assert np.array_equal(faces, F)


def test_results_own_their_memory():
    mesh = bf.Mesh(V, F)
    d = mesh.distance(0, method="dijkstra")
    expected = d.copy()
    del mesh
    gc.collect()
    bf.Mesh(*grid(50)).distance(0, method="dijkstra")
    assert d.flags.writeable
    assert np.array_equal(d, expected)


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_pickling_keeps_the_distances_to_the_bit(protocol):
    mesh = bf.Mesh(V, F)
    lengths = np.linalg.norm(V[np.roll(F, -1, axis=1)] - V[F], axis=2)
    for original in (mesh, bf.Mesh.from_lengths(F, lengths, vertex_count=len(V) + 2)):
        again = pickle.loads(pickle.dumps(original, protocol))
        assert again.vertex_count == original.vertex_count
        assert np.array_equal(again.distance(3, method="dijkstra"), original.distance(3, method="dijkstra"))
    solver = pickle.loads(pickle.dumps(mesh.solver(), protocol))
    assert np.array_equal(solver.distance(3, method="dijkstra"), mesh.distance(3, method="dijkstra"))


def test_copies_are_the_mesh_itself():
    mesh = bf.Mesh(V, F)
    assert copy.copy(mesh) is mesh
    assert copy.deepcopy(mesh) is mesh


def test_report_counts_and_remarks():
    report = bf.Mesh(np.vstack([V, [[9, 9, 9]]]), F).report
    assert report.vertices == 26
    assert report.isolated_vertices == 1
    assert report.boundary_edges == 16
    assert any("isolated" in remark or "no face" in remark for remark in report.remarks)
    assert "26 vertices" in str(report)


def test_from_lengths_agrees_with_positions():
    lengths = np.linalg.norm(V[np.roll(F, -1, axis=1)] - V[F], axis=2)
    a, b = bf.Mesh(V, F), bf.Mesh.from_lengths(F, lengths)
    assert b.vertices.shape == (0, 3)
    assert np.allclose(a.distance(0, method="dijkstra"), b.distance(0, method="dijkstra"), rtol=1e-12)


def test_an_empty_mesh_is_a_mesh():
    mesh = bf.Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=int))
    assert mesh.vertex_count == mesh.face_count == 0
    assert mesh.distance_matrix().shape == (0, 0)
    assert bf.Mesh([], []).face_count == 0
