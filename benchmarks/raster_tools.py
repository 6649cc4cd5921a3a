"""Walking times on a real DEM beside the tools of the trade: raster_tools.py [--grass PROGRAM]

scikit-image's MCP_Geometric (8 directions), xarray-spatial's cost_distance, GRASS's r.walk (8 directions; -k: 16), where they
are installed: pip install brushfire matplotlib scikit-image xarray-spatial; Debian's grass-core. The DEM is matplotlib's
sample of the Jacksboro fault, 344 x 403. On flat ground the truth is known: a circle.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import brushfire as bf


def dem() -> tuple[np.ndarray, float, float]:
    """Heights and the sizes of a cell, in metres."""
    from matplotlib.cbook import get_sample_data

    data = get_sample_data("jacksboro_fault_dem.npz")
    latitude = 0.5 * (float(data["ymin"]) + float(data["ymax"]))
    metres = 111_320.0
    dx = float(data["dx"]) * metres * math.cos(math.radians(latitude))
    return data["elevation"].astype(float), dx, float(data["dy"]) * metres


def timed(work: Callable[[], np.ndarray]) -> tuple[np.ndarray, float]:
    work()
    start = time.process_time()
    result = work()
    return result, time.process_time() - start


def by_brushfire(heights: np.ndarray, dx: float, dy: float, start: int, tolerance: float) -> tuple[np.ndarray, float]:
    ground = bf.terrain(heights, (0, dx, 0, 0, 0, -dy))
    walking = ground.mesh.weighted(slope="naismith")
    seconds, took = timed(lambda: walking.distance(start, tolerance=tolerance))
    return seconds.reshape(heights.shape), took


def by_grass(program: str, heights: np.ndarray, dx: float, dy: float, start: int, knight: bool) -> tuple[np.ndarray, float]:
    rows, columns = heights.shape
    x, y = (start % columns + 0.5) * dx, (rows - 0.5 - start // columns) * dy
    with tempfile.TemporaryDirectory() as folder:
        grid = Path(folder) / "heights.txt"
        head = f"north: {rows * dy}\nsouth: 0\neast: {columns * dx}\nwest: 0\nrows: {rows}\ncols: {columns}\n"
        grid.write_text(head + "\n".join(" ".join(map(repr, row)) for row in heights.tolist()) + "\n")
        script = f"""set -e
r.in.ascii input={grid} output=heights type=DCELL --quiet
g.region raster=heights
r.mapcalc expression='friction = 0.0' --quiet
date +%s.%N > {folder}/start
r.walk {"-k" if knight else ""} elevation=heights friction=friction output=seconds start_coordinates={x},{y} memory=300 --quiet
date +%s.%N > {folder}/end
r.out.ascii -h input=seconds output={folder}/seconds.txt precision=17 null_value=nan --quiet
"""
        subprocess.run([program, "--tmp-location", "XY", "--exec", "sh", "-c", script], check=True, capture_output=True)
        took = float((Path(folder) / "end").read_text()) - float((Path(folder) / "start").read_text())
        return np.loadtxt(Path(folder) / "seconds.txt"), took


def by_scikit_image(cost: np.ndarray, dx: float, dy: float, start: int) -> tuple[np.ndarray, float]:
    from skimage.graph import MCP_Geometric

    def work() -> np.ndarray:
        return MCP_Geometric(cost, sampling=(dy, dx)).find_costs([divmod(start, cost.shape[1])])[0]

    return timed(work)


def by_xarray_spatial(cost: np.ndarray, dx: float, dy: float, start: int) -> tuple[np.ndarray, float]:
    import xarray
    from xrspatial import cost_distance

    rows, columns = cost.shape
    where = {"y": -dy * np.arange(rows), "x": dx * np.arange(columns)}
    source = np.zeros(cost.shape)
    source.flat[start] = 1
    grids = [xarray.DataArray(a, dims=("y", "x"), coords=where) for a in (source, cost)]
    return timed(lambda: cost_distance(*grids).values)


def report(name: str, seconds: np.ndarray, took: float, beside: np.ndarray) -> None:
    known = (beside > 0) & np.isfinite(beside) & np.isfinite(seconds)
    off = seconds[known] / beside[known] - 1
    share = 1e6 * took / seconds.size
    print(f"{name:34s} {share:7.2f} us a cell   mean {100 * off.mean():+7.3f} %   {100 * off.min():+7.3f} to {100 * off.max():+7.3f} %")


def attempt(name: str, beside: np.ndarray, work: Callable[[], tuple[np.ndarray, float]]) -> None:
    try:
        report(name, *work(), beside)
    except (ImportError, FileNotFoundError, subprocess.CalledProcessError) as error:
        print(f"{name:34s} not here: {error}")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--grass", default="grass", help="the program (grass)")
    grass = parser.parse_args().grass
    heights, dx, dy = dem()
    rows, columns = heights.shape
    start = rows // 2 * columns + columns // 2
    flat = np.zeros_like(heights)
    y, x = np.mgrid[:rows, :columns]
    pace = 0.72  # naismith's seconds for a metre of flat ground
    truth = pace * np.hypot((x - columns // 2) * dx, (y - rows // 2) * dy)
    for name, ground, beside in (("flat", flat, truth), ("Jacksboro fault", heights, None)):
        print(f"{name}, {rows} x {columns} cells of {dx:.1f} x {dy:.1f} m, naismith")
        if beside is None:
            beside, _ = by_brushfire(ground, dx, dy, start, 0.003)
            print("(beside brushfire at tolerance 0.003)")
        for tolerance in (0.03, 0.01):
            report(f"brushfire, tolerance {tolerance}", *by_brushfire(ground, dx, dy, start, tolerance), beside)
        attempt("GRASS r.walk, 8 directions", beside, lambda g=ground: by_grass(grass, g, dx, dy, start, False))
        attempt("GRASS r.walk -k, 16 directions", beside, lambda g=ground: by_grass(grass, g, dx, dy, start, True))
        if name == "flat":  # these know no slopes
            cost = np.full(flat.shape, pace)
            attempt("scikit-image MCP_Geometric", beside, lambda c=cost: by_scikit_image(c, dx, dy, start))
            attempt("xarray-spatial cost_distance", beside, lambda c=cost: by_xarray_spatial(c, dx, dy, start))


if __name__ == "__main__":
    main()
