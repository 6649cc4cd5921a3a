"""brushfire.compat.potpourri3d: what its classes promise; the same numbers as the original where that is installed."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

pytest.importorskip("scipy")

from brushfire.compat import potpourri3d as ours

V, F = grid(14, 0.4)
F = F.astype(np.int64)
needs_heat = pytest.mark.skipif("heat" not in bf.methods(), reason="this build has no Eigen")


@pytest.fixture
def original():
    return pytest.importorskip("potpourri3d", reason="the original potpourri3d is not installed")


def length(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


class TestLikeTheOriginal:
    def test_every_name_is_there(self, original):
        theirs = {name for name in dir(original) if not name.startswith("_") and name not in ("np", "scipy", "pp3db")}
        modules = {"core", "io", "mesh", "point_cloud"}
        assert theirs - modules <= set(ours.__all__)

    def test_every_argument_is_there_in_its_place(self, original):
        for name in ours.__all__:
            theirs, mine = getattr(original, name), getattr(ours, name)
            methods = [m for m in dir(theirs) if callable(getattr(theirs, m)) and (m == "__init__" or m[0] != "_")]
            for method in methods if inspect.isclass(theirs) else [None]:
                a, b = (getattr(x, method) if method else x for x in (theirs, mine))
                expected = list(inspect.signature(a).parameters)
                assert list(inspect.signature(b).parameters)[: len(expected)] == expected, (name, method)

    def test_operators(self, original):
        assert np.array_equal(ours.edges(V, F), original.edges(V, F))
        assert abs(ours.cotan_laplacian(V, F, 1e-3) - original.cotan_laplacian(V, F, 1e-3)).max() < 1e-12
        assert np.allclose(ours.face_areas(V, F), original.face_areas(V, F))
        assert np.allclose(ours.vertex_areas(V, F), original.vertex_areas(V, F))

    def test_curves_of_equal_value_cross_the_same_edges_at_the_same_places(self, original):
        u = np.sin(V[:, 0] / 2) + V[:, 1] / 5
        theirs = {(e, round(t[0], 9)) for curve in original.marching_triangles(V, F, u, 1.1) for e, t in curve}
        mine = {(e, round(t[0], 9)) for curve in ours.marching_triangles(V, F, u, 1.1) for e, t in curve}
        assert mine == theirs

    @needs_heat
    def test_values_and_the_connection_laplacian(self, original):
        theirs, mine = original.MeshVectorHeatSolver(V, F), ours.MeshVectorHeatSolver(V, F)
        assert np.allclose(mine.extend_scalar([3, 50], [1.0, 5.0]), theirs.extend_scalar([3, 50], [1.0, 5.0]))
        assert abs(abs(mine.get_connection_laplacian()) - abs(theirs.get_connection_laplacian())).max() < 1e-9
        assert np.allclose(mine.get_tangent_frames()[2], theirs.get_tangent_frames()[2])

    @needs_heat
    def test_signed_distances_have_the_same_sides(self, original):
        curve = [(14 * 6 + i, []) for i in range(14)]
        theirs = original.MeshSignedHeatSolver(V, F).compute_distance([curve])
        mine = ours.MeshSignedHeatSolver(V, F).compute_distance([curve])
        clear = np.abs(theirs) > 0.5
        assert (np.sign(mine) == np.sign(theirs))[clear].all()
        assert np.abs(mine - theirs).max() < 0.1 * np.abs(theirs).max()

    def test_paths_are_no_longer(self, original):
        theirs, mine = original.EdgeFlipGeodesicSolver(V, F), ours.EdgeFlipGeodesicSolver(V, F)
        for a, b in ((0, 195), (13, 182), (5, 99)):
            assert length(mine.find_geodesic_path(a, b)) <= length(theirs.find_geodesic_path(a, b)) * (1 + 1e-3)

    def test_traces_from_a_face_end_in_the_same_place(self, original):
        direction = np.array([2.0, 3.0, 0.5])
        theirs = original.GeodesicTracer(V, F).trace_geodesic_from_face(160, [0.2, 0.3, 0.5], direction)
        mine = ours.GeodesicTracer(V, F).trace_geodesic_from_face(160, [0.2, 0.3, 0.5], direction)
        assert np.allclose(mine[-1], theirs[-1])


class TestPaths:
    def test_loops_that_can_be_pulled_together_end_in_a_point(self):
        loop = ours.EdgeFlipGeodesicSolver(V, F).find_geodesic_loop([60, 64, 120])
        assert loop.ndim == 2
        assert length(loop) < 1e-9

    def test_paths_by_way_of_a_vertex_twice(self):
        path = ours.EdgeFlipGeodesicSolver(V, F).find_geodesic_path_poly([0, 90, 95, 90, 195])
        assert np.allclose(path[[0, -1]], V[[0, 195]])

    def test_what_cannot_be_is_an_error(self):
        solver = ours.EdgeFlipGeodesicSolver(V, F)
        with pytest.raises(bf.BrushfireError):
            solver.find_geodesic_path(3, 3)
        with pytest.raises(bf.BrushfireIndexError):
            solver.find_geodesic_path(3, len(V))
        far = ours.EdgeFlipGeodesicSolver(np.vstack([V, V + [50, 0, 0]]), np.vstack([F, F + len(V)]))
        with pytest.raises(bf.BrushfireError, match="no way"):
            far.find_geodesic_path(3, len(V))

    def test_a_trace_is_as_long_as_its_direction(self):
        tracer = ours.GeodesicTracer(V, F)
        flat = np.array([1.0, 0.5, 0.0])
        assert length(tracer.trace_geodesic_from_vertex(100, flat)) == pytest.approx(np.linalg.norm(flat), rel=0.2)
        assert len(tracer.trace_geodesic_from_vertex(100, 5 * flat, max_iterations=2)) == 4


class TestFiles:
    @pytest.mark.parametrize("extension", ["obj", "ply", "off"])
    def test_meshes_come_back(self, tmp_path, extension):
        ours.write_mesh(V, F, tmp_path / f"a.{extension}")
        v, f = ours.read_mesh(tmp_path / f"a.{extension}")
        assert np.allclose(v, V)
        assert np.array_equal(f, F)

    def test_polygons_come_back(self, tmp_path):
        quads = [[0, 1, 15, 14], [1, 2, 16, 15], [2, 3, 17]]
        ours.write_mesh(V, quads, tmp_path / "a.obj")
        _, polygons = ours.read_polygon_mesh(tmp_path / "a.obj")
        turned = [p[p.index(min(p)) :] + p[: p.index(min(p))] for p in polygons]
        assert turned == quads

    @pytest.mark.parametrize(("kind", "rows"), [("per-vertex", len(V)), ("per-face", len(F)), ("per-corner", F.size)])
    def test_texture_coordinates_are_written(self, tmp_path, kind, rows):
        ours.write_mesh(V, F, tmp_path / "a.obj", np.random.default_rng(1).random((rows, 2)), kind)
        text = (tmp_path / "a.obj").read_text()
        assert text.count("vt ") == rows
        assert np.array_equal(ours.read_mesh(tmp_path / "a.obj")[1], F)

    @pytest.mark.parametrize("extension", ["obj", "ply"])
    def test_points_come_back(self, tmp_path, extension):
        ours.write_point_cloud(V, tmp_path / f"a.{extension}")
        assert np.allclose(ours.read_point_cloud(tmp_path / f"a.{extension}"), V)

    def test_what_is_not_written_is_said(self, tmp_path):
        with pytest.raises(bf.BrushfireError, match="obj"):
            ours.write_mesh(V, [[0, 1, 15, 14]], tmp_path / "a.ply")
        with pytest.raises(bf.BrushfireError, match="UV_coords"):
            ours.write_mesh(V, F, tmp_path / "a.obj", V[:3, :2], "per-vertex")


class TestPolygonsAndPoints:
    @needs_heat
    def test_polygons_are_cut_into_triangles(self):
        quads = [[14 * i + j, 14 * i + j + 1, 14 * i + j + 15, 14 * i + j + 14] for i in range(13) for j in range(13)]
        flat = V * [1, 1, 0]
        solver = ours.PolygonMeshHeatSolver(flat, quads)
        assert np.allclose(solver.compute_distance([0]), np.linalg.norm(flat - flat[0], axis=1))
        assert solver.extend_scalar([0, 195], [1.0, 2.0])[0] == pytest.approx(1, abs=0.1)
        row = list(range(14 * 6, 14 * 7))
        assert np.abs(solver.compute_signed_distance([row])[row]).max() < 1e-6

    def test_points_around_a_centre_form_a_wheel(self):
        angle = np.arange(24) * 2 * np.pi / 24
        points = np.vstack([[0, 0, 0], np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)])
        stars = ours.PointCloudLocalTriangulation(points).get_local_triangulation()
        assert {tuple(t) for t in stars[0]} == {(0, k, k % 24 + 1) for k in range(1, 25)}
        assert all((star[:2] >= 0).all() and (star[2:] == -1).all() for star in stars[1:])

    @needs_heat
    def test_a_cloud_on_a_plane_has_the_plane_s_distances(self):
        points = np.random.default_rng(3).random((900, 3)) * [1, 1, 0]
        solver = ours.PointCloudHeatSolver(points)
        truth = np.linalg.norm(points - points[7], axis=1)
        assert solver.compute_distance(7)[7] == 0
        assert np.abs(solver.compute_distance(7) - truth).max() < 0.1
        log = solver.compute_log_map(7)
        assert np.allclose(np.linalg.norm(log, axis=1), solver.compute_distance(7), atol=1e-9)
        assert np.isfinite(solver.transport_tangent_vector(7, [1, 2])).all()
        line = np.argsort(np.abs(points[:, 1] - 0.5))[:40]
        line = line[np.argsort(points[line, 0])]
        signed = solver.compute_signed_distance([line], np.tile([0.0, 0.0, 1.0], (900, 1)))
        assert np.corrcoef(signed, points[:, 1])[0, 1] > 0.95

    def test_large_clouds_are_refused_with_a_pointer(self):
        with pytest.raises(bf.BrushfireError, match="mesh"):
            ours.PointCloudLocalTriangulation(np.zeros((20_001, 3)))


@needs_heat
class TestHeat:
    def test_every_source_reads_zero_and_other_components_inf(self):
        two = np.vstack([V, V + [50, 0, 0]]), np.vstack([F, F + len(V)])
        d = ours.MeshHeatMethodDistanceSolver(*two, method="heat").compute_distance_multisource([3, 40, 77])
        assert d[[3, 40, 77]].tolist() == [0, 0, 0]
        assert np.isinf(d[len(V) :]).all()

    def test_signs_of_fast_marching_are_those_of_the_curve(self):
        curve = [(14 * 6 + i, []) for i in range(14)]
        d = ours.MeshFastMarchingDistanceSolver(V, F).compute_distance([curve], sign=True)
        plain = ours.MeshFastMarchingDistanceSolver(V, F).compute_distance([curve])
        assert np.array_equal(np.abs(d), plain)
        assert (d < 0).sum() > 60 and (d > 0).sum() > 60


class TestAsPrograms:
    def test_the_operators_of_diffusion_networks(self):
        """The Laplacian with a small denominator, areas that are not 0, and the lowest eigenvectors of both."""
        eigsh = pytest.importorskip("scipy.sparse.linalg").eigsh
        diags = pytest.importorskip("scipy.sparse").diags
        stiffness = ours.cotan_laplacian(V, F, denom_eps=1e-10)
        areas = ours.vertex_areas(V, F)
        areas += 1e-8 * np.mean(areas)
        assert not np.isnan(stiffness.data).any()
        values, vectors = eigsh((stiffness + 1e-8 * diags(np.ones(len(V)))).tocsc(), k=8, M=diags(areas), sigma=1e-8)
        assert values[0] == pytest.approx(0, abs=1e-6)
        assert (values[1:] > 1e-3).all()
        assert vectors.shape == (len(V), 8)

    def test_a_metric_made_of_single_rows(self):
        solver = ours.MeshHeatMethodDistanceSolver(V, F)
        rows = np.stack([solver.compute_distance(i) for i in (0, 7, 100)])
        assert np.allclose(rows[0, [7, 100]], rows[1:, 0])
