"""Terrain and costs that depend on the slope."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import brushfire as bf


def pace(slope: float) -> float:
    """Tobler's hiking function, seconds per metre."""
    return 3.6 / (6 * math.exp(-3.5 * abs(slope + 0.05)))


def test_vertices_are_the_array_and_holes_stay_holes() -> None:
    heights = np.arange(12.0).reshape(3, 4)
    heights[0, 0] = np.nan
    ground = bf.terrain(heights, (1000, 10, 0, 2000, 0, -10))
    assert ground.mesh.face_count == 11 and ground.shape == (3, 4)
    assert ground.mesh.vertices[5].tolist() == [1015, 1985, 5]
    place = ground.below([1017, 1983])
    assert ground.mesh.position(place)[0, :2].tolist() == pytest.approx([1017, 1983])
    with pytest.raises(bf.BrushfireError, match="no ground below"):
        ground.below([1005, 1995])
    with pytest.raises(bf.BrushfireError, match="no ground below"):
        ground.below([0, 0])
    assert (bf.terrain(np.where(np.isnan(heights), -1, heights), no_data=-1).mesh.faces == ground.mesh.faces).all()


@pytest.mark.parametrize("name", ["dem.asc", "dem.npy", "dem.tif"])
def test_terrain_comes_from_files_and_values_go_back_into_them(tmp_path: Path, name: str) -> None:
    heights = np.arange(12.0).reshape(3, 4) / 3
    heights[0, 0] = np.nan
    file = tmp_path / name
    if name.endswith(".tif"):
        pytest.importorskip("rasterio", reason="rasterio is not installed")
    ground = bf.terrain(heights, (1000, 10, 0, 2000, 0, -10))
    ground.write(file, heights)
    again = bf.terrain(file, (1000, 10, 0, 2000, 0, -10) if name.endswith(".npy") else None)
    assert (again.mesh.vertices == ground.mesh.vertices).all() and (again.mesh.faces == ground.mesh.faces).all()
    seconds = again.mesh.weighted(slope="tobler").distance(5)
    again.write(str(file), seconds)
    back = bf.terrain(file).mesh.vertices[:, 2]
    assert np.isinf(seconds[0]) and (back[1:] == seconds[1:]).all()
    with pytest.raises(bf.BrushfireError, match="3 x 4"):
        again.write(file, seconds[:5])
    with pytest.raises(bf.BrushfireError, match="tif"):
        again.write(tmp_path / "x.png", seconds)
    assert sorted(f.name for f in tmp_path.iterdir()) == [name]


def test_maps_in_degrees_are_refused(tmp_path: Path) -> None:
    rasterio = pytest.importorskip("rasterio", reason="rasterio is not installed")
    how = {"driver": "GTiff", "width": 3, "height": 3, "count": 1, "dtype": "int16", "nodata": -32768}
    for crs, good in (("EPSG:4326", False), ("EPSG:32632", True)):
        with rasterio.open(
            tmp_path / "dem.tif", "w", **how, crs=crs, transform=rasterio.Affine(30, 0, 0, 0, -30, 0)
        ) as out:
            out.write(np.array([[1, 2, -32768], [4, 5, 6], [7, 8, 9]], np.int16), 1)
        if good:
            assert bf.terrain(tmp_path / "dem.tif").mesh.face_count == 7
            ground = bf.terrain(tmp_path / "dem.tif")
            ground.write(tmp_path / "out.tif", np.zeros(9))
            with rasterio.open(tmp_path / "out.tif") as data:
                assert data.crs.to_epsg() == 32632
        else:
            with pytest.raises(bf.BrushfireError, match="degrees"):
                bf.terrain(tmp_path / "dem.tif")


def test_circles_on_flat_ground_are_circles() -> None:
    n = 61
    ground = bf.terrain(np.zeros((n, n)), (0, 10, 0, 0, 0, -10))
    middle = n // 2 * n + n // 2
    seconds = ground.mesh.weighted(slope="tobler").distance(middle).reshape(n, n)
    y, x = np.mgrid[:n, :n]
    truth = 10 * np.hypot(x - n // 2, y - n // 2) * pace(0)
    off = seconds[truth > 0] / truth[truth > 0] - 1
    assert off.min() > -1e-7 and off.max() < 0.01
    graph = pytest.importorskip("skimage.graph", reason="scikit-image is not installed")
    steps, _ = graph.MCP_Geometric(np.full((n, n), 10 * pace(0))).find_costs([(n // 2, n // 2)])
    eight = steps[truth > 0] / truth[truth > 0] - 1
    assert eight.max() > 0.08  # eight directions
    assert (seconds <= steps * (1 + 1e-7)).all()


def test_up_and_down_differ_as_toblers_function_says() -> None:
    n = 21
    ramp = bf.terrain(np.tile(2.0 * np.arange(n), (n, 1)), (0, 10, 0, 0, 0, -10))  # slope 0.2 to the east
    weighted = ramp.mesh.weighted(slope="tobler")
    west, east = 10 * n, 10 * n + n - 1
    up, down = weighted.distance(west)[east], weighted.distance(east)[west]
    assert up == pytest.approx(200 * pace(0.2), rel=0.03) and up <= 200 * pace(0.2) * (1 + 1e-6)
    assert down == pytest.approx(200 * pace(-0.2), rel=0.03)
    assert weighted.distance(west, towards=True)[east] == pytest.approx(down, rel=0.01)
    path = weighted.path(west, east)
    assert path.cost == pytest.approx(up, rel=1e-9)
    assert (path.leg_length * path.weight).sum() == pytest.approx(path.cost)
    back = weighted.path(west, east, towards=True)
    assert back.cost == pytest.approx(down, rel=0.01) and back.positions[0, 0] == pytest.approx(205)


def test_isochrones_are_polygons() -> None:
    n = 41
    ground = bf.terrain(np.zeros((n, n)), (0, 10, 0, 0, 0, -10))
    seconds = ground.mesh.weighted(slope="tobler").distance(n // 2 * n + n // 2)
    found = ground.mesh.isochrones(seconds, [60, 120])
    assert [f["properties"]["level"] for f in found["features"]] == [60, 120]
    [[ring]] = found["features"][1]["geometry"]["coordinates"]
    assert ring[0] == ring[-1]
    x, y = np.array(ring).T
    area = 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    assert area == pytest.approx(math.pi * (120 / pace(0)) ** 2, rel=0.02)


def test_a_corridor_is_the_sum_of_two_fields() -> None:
    n = 21
    rng = np.random.default_rng(1)
    ground = bf.terrain(rng.uniform(0, 5, (n, n)), (0, 10, 0, 0, 0, -10))
    weighted = ground.mesh.weighted(slope="naismith")
    corridor = weighted.distance(0) + weighted.distance(n * n - 1, towards=True)
    best = weighted.path(0, n * n - 1).cost
    assert corridor.min() == pytest.approx(best, rel=0.01) and (corridor >= best * 0.99).all()


def test_tables_and_steepest_and_what_is_refused() -> None:
    n = 11
    ramp = bf.terrain(np.tile(3.0 * np.arange(n), (n, 1)), (0, 10, 0, 0, 0, -10))  # slope 0.3
    table = ramp.mesh.weighted(slope=([-1, 0, 1], [1, 1, 1]))
    assert table.distance(0)[n - 1] == pytest.approx(100)
    assert ramp.mesh.weighted(slope="tobler", steepest=0.001).distance(0)[n - 1] > 10 * 100 * pace(0.3)
    tacks = ramp.mesh.weighted(slope="tobler", steepest=0.15, tacking=True)
    assert tacks.distance(0)[n - 1] == pytest.approx(10 * (n - 1) * 2 * pace(0.15), rel=1e-6)
    called = ramp.mesh.weighted(slope=lambda s: pace(s) if abs(s) <= 0.5 else math.inf)
    assert called.distance(0) == pytest.approx(ramp.mesh.weighted(slope="tobler").distance(0), rel=1e-6)
    with pytest.raises(bf.BrushfireError, match="beyond the steepest"):
        ramp.mesh.weighted(slope=lambda s: math.inf if abs(s) < 0.1 else 1)
    with pytest.raises(bf.BrushfireTypeError, match="the pace"):
        ramp.mesh.weighted(slope=lambda s: "fast")  # type: ignore[arg-type, return-value]
    with pytest.raises(bf.BrushfireError, match="unknown slope"):
        ramp.mesh.weighted(slope="walking")
    with pytest.raises(bf.BrushfireError, match="ascend"):
        ramp.mesh.weighted(slope=([1, 0], [1, 1]))
    assert ramp.mesh.weighted(slope="tobler").costs(0).lower is None
