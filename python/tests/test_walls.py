"""Walls, cells and centres, parcels, smoothing."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import brushfire as bf

V = np.array([[x, y, 0] for y in range(3) for x in range(5)], dtype=float)
F = np.array(
    [t for y in range(2) for x in range(4) for v in [y * 5 + x] for t in ((v, v + 1, v + 6), (v, v + 6, v + 5))]
)


@pytest.fixture
def strip() -> bf.Mesh:
    return bf.Mesh(V, F)


def test_every_query_keeps_to_walls_in_the_numbers_of_the_whole_mesh(strip: bf.Mesh) -> None:
    walled = strip.walled(edges=[(2, 7)])
    d = walled.distance(1, method="exact")
    assert d[3] == pytest.approx(2 * np.sqrt(2), abs=1e-12)
    assert strip.distance(1, method="exact")[3] == pytest.approx(2)
    assert np.allclose(walled.distance_matrix([1], method="exact", dtype="float64")[0], d, atol=1e-12)
    path = walled.path(1, 3)
    assert path.length == pytest.approx(d[3], abs=1e-12)
    assert any(np.allclose(p, (2, 1, 0)) for p in path.positions)
    tight = walled.path(1, 6, 8, 3, tighten=True)
    assert tight.length == pytest.approx(d[3], abs=1e-9)
    paths, source = walled.paths([1], [3, 2])
    assert [round(p.length, 9) for p in paths] == [round(d[3], 9), 1.0] and source.tolist() == [0, 0]
    assert walled.edge_path(1, 3).length > 2
    assert walled.log_map(1).radius == pytest.approx(d, abs=1e-12)
    assert walled.certify(d, 1).proven_wrong == 0
    assert walled.certify(strip.distance(1, method="exact"), 1).proven_wrong > 0
    assert walled.solver("exact").distance(1) == pytest.approx(d, abs=1e-12)
    for line in walled.curved_isolines(1, [1.5], chord_error=1e-3):
        assert (np.abs(line.line.positions[:, 0] - 1) <= 1.5).all()
    _, end = walled.trace(1, [1, 0.1, 0], 3.0)
    assert end == "boundary"
    cells = walled.voronoi([1, 3], method="exact")
    assert cells.distance == pytest.approx(walled.distance([1, 3], method="exact"))
    assert walled.open_components == 1 and walled.open_vertices.all()
    assert pickle.loads(pickle.dumps(walled)).distance(1, method="exact") == pytest.approx(d)


def test_masked_equals_the_cut_mesh(strip: bf.Mesh) -> None:
    rng = np.random.default_rng(3)
    bumpy = bf.Mesh(V + rng.normal(0, 0.1, V.shape), F)
    for _ in range(20):
        mask = rng.random(15) > 0.15
        masked = bumpy.walled(mask=mask)
        closed = ~mask[F].all(axis=1)
        cut = bumpy.cut(faces=closed)
        if not masked.open_vertices.any():
            continue
        start = int(np.flatnonzero(masked.open_vertices)[0])
        points, _ = cut.points_from_original([start])
        for method in bf.methods():
            expected = cut.to_original(cut.mesh.distance(points, method=method))
            assert np.array_equal(masked.distance(start, method=method), expected)
        assert np.isinf(masked.distance(start)[~masked.open_vertices]).all()


def test_what_is_behind_a_wall_is_an_error_as_a_source_and_inf_as_a_target(strip: bf.Mesh) -> None:
    masked = strip.walled(vertices=[3, 8, 13])
    with pytest.raises(bf.BrushfireError, match="behind a wall"):
        masked.distance(3)
    assert masked.distance(0, targets=[4, 1], method="exact").tolist() == [np.inf, 1.0]
    matrix = masked.distance_matrix(method="exact")
    assert np.isinf(matrix[3]).all() and np.isinf(matrix[0, 4])
    assert masked.walled(edges=[(5, 6)]).distance(0, method="exact")[4] == np.inf  # walls add up
    assert repr(masked) == "Mesh(15 vertices, 16 faces, walls)"
    with pytest.raises(bf.BrushfireError):
        strip.walled(edges=[(0, 14)])
    with pytest.raises(bf.BrushfireError):
        strip.walled(mask=[True])
    with pytest.raises(bf.BrushfireIndexError):
        strip.walled(faces=[99])


def test_isolines_stay_out_of_what_is_blocked(strip: bf.Mesh) -> None:
    masked = strip.walled(faces=[6, 7, 14, 15])
    for line in masked.isolines(np.arange(15.0), count=9):
        assert (line.line.positions[:, 0] <= 3 + 1e-9).all()
        assert strip.length_of(line.line) == pytest.approx(line.line.length)


def test_extent_and_eccentricity_agree_with_the_matrix(strip: bf.Mesh) -> None:
    matrix = strip.distance_matrix(method="exact")
    extent = strip.extent()
    assert extent.diameter_lower <= matrix.max() * (1 + 1e-6) and extent.diameter_upper >= matrix.max() * (1 - 1e-6)
    assert extent.centre == 7 and extent.radius_upper == pytest.approx(matrix.max(axis=1).min(), rel=1e-6)
    assert strip.eccentricity(method="exact") == pytest.approx(matrix.max(axis=1), rel=1e-6)
    assert strip.eccentricity([7, bf.Point(0, (1, 0, 0))], method="exact") == pytest.approx([np.sqrt(5), np.sqrt(20)])
    assert strip.average_distance(7, method="exact")[0] < strip.average_distance(0, method="exact")[0]


def test_discs_hold_their_share(strip: bf.Mesh) -> None:
    discs = strip.discs(0.25, method="exact")
    assert discs.area == pytest.approx(np.full(15, 2.0))
    assert (discs.radius < strip.eccentricity(method="exact")).all() and (discs.perimeter > 0).all()
    with pytest.raises(bf.BrushfireError):
        strip.discs(0)


def test_nearest_sources_are_the_sorted_rows(strip: bf.Mesh) -> None:
    sources = [0, 4, 10, 14, 7]
    distance, source = strip.nearest_sources(sources, 3, method="exact")
    matrix = np.sort(strip.distance_matrix(sources, method="exact", dtype="float64").T, axis=1)
    assert distance == pytest.approx(matrix[:, :3])
    assert source.shape == (15, 3) and source.dtype == np.int32


def test_means_medoids_and_cells(strip: bf.Mesh) -> None:
    mean = strip.karcher_mean([0, 4, 10, 14], [1, 1, 1, 1])
    assert mean.converged and strip.position(mean.point)[0] == pytest.approx([2, 1, 0], abs=1e-5)
    medoids = bf.k_medoids(strip.distance_matrix(method="exact"), 2)
    assert len(medoids.places) == 2 and medoids.nearest.max() == 1
    cells = strip.centroidal_voronoi(2, rounds=50, tolerance=1e-9)
    assert (np.diff(cells.energy) < 0).all()
    assert strip.position(cells.sites)[:, 0] == pytest.approx(sorted(strip.position(cells.sites)[:, 0]), abs=4)
    again = strip.centroidal_voronoi(cells.sites, rounds=0)
    assert again.distance == pytest.approx(cells.distance)
    with pytest.raises(bf.BrushfireError):
        bf.k_medoids([[0, 1, 2]], 1)


def test_parcels_equal_the_dense_matrix(strip: bf.Mesh) -> None:
    labels = np.array([5, 5, 0, 9, 9] * 3)
    matrix = strip.distance_matrix(method="exact", dtype="float64")
    a, b = labels == 5, labels == 9
    block = matrix[np.ix_(a, b)]
    expected = {"min": block.min(), "max": block.max(), "mean": block.mean(), "hausdorff": block.min(axis=1).max()}
    for kind, value in expected.items():
        found = strip.parcels(labels, kind, ignore=[0], method="exact")  # type: ignore[arg-type]
        assert found.labels.tolist() == [5, 9] and found.sizes.tolist() == [6, 6]
        assert found.distance[0, 1] == pytest.approx(value, abs=1e-12), kind
    assert strip.parcels(labels, "centroid", ignore=0).centroids is not None
    with pytest.raises(bf.BrushfireError):
        strip.parcels(labels[:3])


def test_smoothing_minds_nan_and_walls(strip: bf.Mesh) -> None:
    values = np.where(V[:, 0] < 2.5, 1.0, 9.0)
    walled = strip.walled(faces=[4, 5, 12, 13])
    smooth = walled.smooth(values, sigma=2, method="exact")
    assert smooth[V[:, 0] < 2.5] == pytest.approx(1) and smooth[V[:, 0] > 2.5] == pytest.approx(9)
    assert strip.smooth(values, fwhm=2)[2] > 1.1
    values[0] = np.nan
    columns = strip.smooth(np.stack([values, np.ones(15)], axis=1), sigma=1)
    assert np.isnan(columns[0, 0]) and not np.isnan(columns[1, 0]) and columns[:, 1] == pytest.approx(1)
    pytest.importorskip("scipy")
    kernel = strip.smoothing_kernel(sigma=1, method="exact")
    assert np.asarray(kernel.sum(axis=1)).ravel() == pytest.approx(1)
    with pytest.raises(bf.BrushfireError):
        strip.smooth(values)


def test_boundaries_are_curves(strip: bf.Mesh) -> None:
    [rim] = strip.boundaries()
    assert rim.closed and rim.length == pytest.approx(12) and rim.vertices[0] == 0 and len(rim.vertices) == 12


def test_voronoi_has_a_dual(strip: bf.Mesh) -> None:
    assert strip.voronoi([0, 4, 12], method="exact").dual.tolist() == [[0, 1, 2]]


def test_gradients_know_what_is_blocked(strip: bf.Mesh) -> None:
    walled = strip.walled(faces=[6, 7])
    uphill = walled.gradient(V[:, 0])
    assert uphill[0] == pytest.approx([1, 0, 0]) and (uphill[[6, 7]] == 0).all()
    assert walled.gradient(V[:, 0], on="vertices")[4] == pytest.approx([0, 0, 0])
    assert strip.gradient(V[:, 0], on="vertices")[4] == pytest.approx([1, 0, 0])


def test_a_solver_keeps_to_the_walls_of_its_mesh_in_all_that_it_gives():
    walled = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]]).walled(faces=[1])
    solver = walled.solver()
    assert solver.vertex_areas().sum() == walled.vertex_areas().sum() == 6.0
    assert np.array_equal(solver.gradient([0, 1, 2, 3]), walled.gradient([0, 1, 2, 3]))
    assert solver.trace(0, [0.1, 1, 0], 4.0)[0].length == walled.trace(0, [0.1, 1, 0], 4.0)[0].length
