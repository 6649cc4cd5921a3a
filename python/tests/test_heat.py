"""The heat method, vectors and signs carried by heat; beside potpourri3d where that is installed."""

from __future__ import annotations

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

if "heat" not in bf.methods():
    pytest.skip("this build has no Eigen", allow_module_level=True)

V, F = grid(14, 0.4)
MESH = bf.Mesh(V, F)


def sphere(levels: int = 3) -> bf.Mesh:
    t = (1 + 5**0.5) / 2
    v = np.array([[-1, t, 0], [1, t, 0], [-1, -t, 0], [1, -t, 0], [0, -1, t], [0, 1, t]])
    v = np.concatenate([v, [[0, -1, -t], [0, 1, -t], [t, 0, -1], [t, 0, 1], [-t, 0, -1], [-t, 0, 1]]])
    f = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6]]
    f += [[7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10]]
    f = np.array([*f, [8, 6, 7], [9, 8, 1]])
    for _ in range(levels):
        edges, where = np.unique(
            np.sort(np.stack([f, np.roll(f, -1, 1)], 2).reshape(-1, 2), 1), axis=0, return_inverse=True
        )
        m = len(v) + where.reshape(-1, 3)
        v = np.concatenate([v, v[edges].mean(1)])
        a, b, c = f.T
        ab, bc, ca = m.T
        f = np.concatenate([np.stack(x, 1) for x in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return bf.Mesh(v / np.linalg.norm(v, axis=1, keepdims=True), f)


class TestHeatSolver:
    def test_it_is_the_method_of_that_name(self):
        heat = bf.HeatSolver(MESH)
        assert np.array_equal(heat.distance([3, 90]), MESH.distance([3, 90], method="heat"))
        assert heat.time == pytest.approx(heat.mean_edge_length**2)

    def test_rows_are_those_of_single_calls(self):
        heat = bf.HeatSolver(MESH, time_factor=2)
        sets = [[k, (7 * k) % len(V)] for k in range(19)] + [[bf.Point(5, (0.2, 0.3, 0.5))]]
        rows = heat.distances(sets)
        assert rows.shape == (20, len(V))
        for row, sources in zip(rows, sets, strict=True):
            assert np.allclose(row, heat.distance(sources), rtol=1e-9, atol=1e-12)

    def test_a_time_is_a_factor_of_the_mean_edge_squared(self):
        one = bf.HeatSolver(MESH, time_factor=3)
        other = bf.HeatSolver(MESH, time=3 * one.mean_edge_length**2)
        assert np.allclose(one.distance(0), other.distance(0))

    @pytest.mark.parametrize("t", [1.0, 5.0])
    def test_it_is_potpourri3d_s_with_its_shift(self, t):
        pp3d = pytest.importorskip("potpourri3d", reason="the original potpourri3d is not installed")
        for mesh, shift in ((MESH, 0.5e-6), (sphere(), 0.5e-6)):  # its matrices are those of two sheets
            v, f = mesh.vertices.copy(), mesh.faces.astype(np.int64)
            theirs = pp3d.MeshHeatMethodDistanceSolver(v, f, t_coef=t).compute_distance(7)
            ours = bf.HeatSolver(mesh, time_factor=t, poisson_shift=shift).distance(7)
            assert np.abs(ours - theirs).max() < 1e-6 * theirs.max()

    def test_bad_names_are_errors(self):
        with pytest.raises(bf.BrushfireError, match="neumann"):
            bf.HeatSolver(MESH, boundary="warm")
        with pytest.raises(bf.BrushfireError, match="time_factor"):
            bf.HeatSolver(MESH, time_factor=0)


class TestLaplacian:
    def test_rows_sum_to_zero_and_areas_to_the_whole(self):
        matrix, mass = bf.laplacian(MESH)
        assert np.abs(matrix.sum(axis=1)).max() < 1e-9
        assert abs(matrix - matrix.T).max() == 0
        assert mass.sum() == pytest.approx(MESH.area)
        off = matrix.tocoo()
        assert off.data[off.row != off.col].max() <= 1e-6


class TestVectorHeat:
    def test_on_a_sphere_logarithms_are_great_circles(self):
        mesh = sphere()
        p = mesh.vertices
        solver = bf.VectorHeatSolver(mesh)
        x, y, _ = solver.tangent_frames()
        distance = np.arccos(np.clip(p @ p[40], -1, 1))
        near = distance < 1.2
        away = p - (p @ p[40])[:, None] * p[40]
        away *= (distance / np.maximum(np.linalg.norm(away, axis=1), 1e-300))[:, None]
        for strategy in ("affine-adaptive", "affine-local", "vector-heat"):
            log = solver.log_map(40, strategy)
            error = np.linalg.norm(log[:, :1] * x[40] + log[:, 1:] * y[40] - away, axis=1)
            assert error[near].max() < 0.15, strategy

    def test_values_lie_between_those_given(self):
        values = bf.VectorHeatSolver(MESH).extend([0, 100], [-2.0, 5.0])
        assert values.min() >= -2
        assert values.max() <= 5

    def test_the_connection_laplacian_is_hermitian(self):
        matrix = bf.VectorHeatSolver(MESH).connection_laplacian()
        assert abs(matrix - matrix.conj().T).max() == 0

    def test_errors(self):
        with pytest.raises(bf.BrushfireError, match="strategy"):
            bf.VectorHeatSolver(MESH).log_map(0, "magic")
        with pytest.raises(bf.BrushfireIndexError):
            bf.VectorHeatSolver(MESH).extend([len(V)], [1.0])


class TestSignedHeat:
    def test_left_is_negative_and_the_curve_zero(self):
        v, f = grid(11, 0.0)
        mesh = bf.Mesh(v, f)
        row = [int(np.argmin(np.abs(v[:, :2] - [x, 4]).sum(1))) for x in range(11)]
        for constraint in ("zero-set", "multiple", "none"):
            d = bf.SignedHeatSolver(mesh).distance([row], constraint=constraint)
            assert np.abs(d - (4 - v[:, 1])).max() < 0.3

    def test_paths_may_be_curves(self):
        d = bf.SignedHeatSolver(MESH).distance([MESH.path(0, len(V) - 1)], points=[5])
        assert np.isfinite(d).all()


class TestWalls:
    """What each of the solvers gives is what it gives on the mesh that is cut."""

    @pytest.fixture(params=["mask", "edges"])
    def walled(self, request: pytest.FixtureRequest) -> bf.Mesh:
        if request.param == "mask":
            return MESH.walled(mask=~np.isin(np.arange(len(V)), [30, 31, 45, 60, 75, 90]))
        return MESH.walled(edges=[(14 * y + 6, 14 * y + 20) for y in range(2, 13)])  # up the column x = 6, to the border

    def test_distances(self, walled: bf.Mesh) -> None:
        cut = walled.cut()
        here = bf.HeatSolver(walled).distances([0, [100, 8]])
        for row, sources in zip(here, ([0], [100, 8]), strict=True):
            points, _ = cut.points_from_original(sources)
            assert np.array_equal(row, cut.to_original(bf.HeatSolver(cut.mesh).distance(points)))
            assert row == pytest.approx(walled.distance(sources, method="heat"), rel=1e-12, abs=1e-12)

    def test_laplacians(self, walled: bf.Mesh) -> None:
        cut = walled.cut()
        for here, there in (
            (bf.laplacian(walled)[0], bf.laplacian(cut.mesh)[0]),
            (*(bf.VectorHeatSolver(m).connection_laplacian() for m in (walled, cut.mesh)),),
        ):
            assert here.shape == there.shape == (cut.mesh.vertex_count,) * 2
            assert abs(here - there).max() == 0
        assert bf.laplacian(walled)[1].shape == (cut.mesh.vertex_count,)

    def test_values_vectors_and_logarithms(self, walled: bf.Mesh) -> None:
        cut, n = walled.cut(), len(V)
        here, there = bf.VectorHeatSolver(walled), bf.VectorHeatSolver(cut.mesh)
        single = np.bincount(cut.original_vertex)[cut.original_vertex[:n]] == 1
        for a, b in (
            (here.extend([0, 100], [-1, 2]), there.extend([0, 100], [-1, 2])),
            (here.log_map(0), there.log_map(0)),
        ):
            assert np.array_equal(a[single], b[:n][single], equal_nan=True) and len(a) == n
        assert np.array_equal(here.transport([0], [[1, 2]]), there.transport([0], [[1, 2]]), equal_nan=True)
        assert np.array_equal(here.tangent_frames()[0], there.tangent_frames()[0])

    def test_signed_distances_along_a_wall(self) -> None:
        v, f = grid(11)
        column = [11 * y + 4 for y in range(11)]
        mesh = bf.Mesh(v, f).walled(edges=np.column_stack([column[:-1], column[1:]]))
        d = bf.SignedHeatSolver(mesh).distance([column])
        assert np.abs(d - (v[:, 0] - 4)).max() < 0.6  # near a border vectors tend to run along it
        assert np.array_equal(np.sign(d.round(6)), np.sign(v[:, 0] - 4))

    def test_a_vertex_that_walls_part_has_no_direction(self) -> None:
        walled = MESH.walled(edges=[(14 * y + 6, 14 * y + 20) for y in range(13)])
        solver = bf.VectorHeatSolver(walled)
        for call in (lambda: solver.log_map(20), lambda: solver.transport([20], [[1, 0]])):
            with pytest.raises(bf.BrushfireError, match="no common frame"):
                call()
        assert np.isnan(solver.extend([0], [1.0])[13])
        assert np.isinf(bf.HeatSolver(walled).distance(0)[13])
