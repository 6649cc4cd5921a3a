"""Flattening, its files, and decals."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import grid

import brushfire as bf


def rolled(n=12):
    """A third of a cylinder's side."""
    vertices, faces = grid(n)
    x = vertices[:, 0] / 4
    return bf.Mesh(np.column_stack([4 * np.cos(x), 4 * np.sin(x), vertices[:, 1]]), faces)


def cone(rings=6, segments=16):
    angle = 2 * np.pi * np.arange(segments) / segments
    levels = [
        np.column_stack([r * np.cos(angle), r * np.sin(angle), np.full(segments, -4 * r)]) for r in range(1, rings)
    ]
    faces = [[0, 1 + k, 1 + (k + 1) % segments] for k in range(segments)]
    for r in range(rings - 2):
        for k in range(segments):
            a, b = 1 + r * segments + k, 1 + r * segments + (k + 1) % segments
            faces += [[a, a + segments, b + segments], [a, b + segments, b]]
    return bf.Mesh(np.concatenate([[[0, 0, 0]], *levels]), faces)


def test_what_unrolls_is_laid_flat_exactly():
    for flat in (
        bf.flatten(rolled(), 10, method="exact"),
        bf.flatten(cone(), 20, seams=[[0, 1 + 4 * 16]], method="exact"),
    ):
        assert flat.distortion.stress < 1e-6
        assert flat.distortion.max_stretch == pytest.approx(1, abs=1e-6)
        assert flat.distortion.min_stretch == pytest.approx(1, abs=1e-6)
        assert flat.distortion.flipped == 0


def test_stress_is_that_of_classical_scaling_of_the_same_matrix():
    manifold = pytest.importorskip("sklearn.manifold")
    mesh = bf.Mesh(*grid(10, 1.5))
    flat = bf.flatten(mesh, mesh.vertex_count, method="exact")
    matrix = mesh.distance_matrix(method="exact", dtype=np.float64, symmetric="mean")

    def stress(uv):
        apart = np.linalg.norm(uv[:, None] - uv[None], axis=2)
        return np.sqrt(((apart - matrix) ** 2).sum() / (matrix**2).sum())

    assert stress(flat.uv) == pytest.approx(flat.distortion.stress, rel=1e-9)
    if not hasattr(manifold, "ClassicalMDS"):
        pytest.skip("scikit-learn without ClassicalMDS")
    classical = manifold.ClassicalMDS(n_components=2, metric="precomputed").fit_transform(matrix)
    assert stress(flat.uv) == pytest.approx(stress(classical), rel=1e-6)
    iterative = manifold.MDS(
        n_components=2, metric="precomputed", n_init=1, init="random", max_iter=300, eps=1e-9
    ).fit_transform(matrix, init=flat.uv)
    assert stress(iterative) <= flat.distortion.stress * (1 + 1e-9)  # it minimises the stress itself
    assert flat.distortion.stress < 1.5 * stress(iterative)


def test_files_hold_the_cut_mesh_with_its_coordinates(tmp_path):
    flat = bf.flatten(cone(), 20, seams=[[0, 1 + 4 * 16]])
    assert flat.mesh.vertex_count == cone().vertex_count + 5  # one on each ring, twice
    for name in ("uv.obj", "uv.glb", "uv.ply"):
        flat.save(tmp_path / name)
        again = bf.read(tmp_path / name)
        np.testing.assert_allclose(again.vertices, flat.mesh.vertices, atol=1e-6)
        np.testing.assert_array_equal(again.faces, flat.mesh.faces)
    lines = [line.split() for line in (tmp_path / "uv.obj").read_text().splitlines()]
    texture = np.array([[float(x) for x in line[1:3]] for line in lines if line and line[0] == "vt"])
    assert texture.min() >= 0 and texture.max() <= 1


def test_landmarks_of_pieces_are_refused():
    mesh = bf.Mesh([[0, 0], [1, 0], [0, 1], [5, 5], [6, 5], [5, 6]], [[0, 1, 2], [3, 4, 5]])
    with pytest.raises(bf.BrushfireError, match="pieces"):
        bf.flatten(mesh, 3)


def test_a_decal_keeps_lengths_on_a_rolled_sheet():
    mesh = rolled(20)
    middle = 9 * 20 + 9
    faces, uv = bf.decal(mesh, middle, [0, 0, 1], 6.0, 4.0)
    away = (uv - 0.5) * [6.0, 4.0]
    inside = np.isfinite(uv).all(axis=1)
    np.testing.assert_allclose(
        np.linalg.norm(away[inside], axis=1), mesh.distance(middle, method="exact")[inside], atol=1e-9
    )
    assert uv[middle + 20] == pytest.approx([0.5 + 1 / 6, 0.5], abs=1e-9)
    assert 0 < len(faces) < mesh.face_count


def test_what_no_decal_sticks_to_is_told():
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    for mesh in (bf.Mesh(corners, np.zeros((0, 3), dtype=int)), bf.Mesh.from_lengths([[0, 1, 2]], [[1, 1, 1]])):
        with pytest.raises(bf.BrushfireError, match="faces and positions"):
            bf.decal(mesh, 0, [1, 0, 0], 1.0)
    for width in (0, -1, np.inf, np.nan):
        with pytest.raises(bf.BrushfireError, match="width"):
            bf.decal(bf.Mesh(corners, [[0, 1, 2]]), 0, [1, 0, 0], width)
