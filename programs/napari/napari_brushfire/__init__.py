"""Brushfire in napari: Plugins, Brushfire. A Surface layer, and a Points layer that says where distances start.

Points are taken to the nearest point of the surface. The layers' scales, rotations and translations count: distances
are in the units of the world, and a path between two surfaces' pixels is not mistaken for one in micrometres.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import brushfire as bf

if TYPE_CHECKING:
    import napari

__all__ = ["geodesic_distance", "geodesic_isolines", "geodesic_path"]


def _world(layer: Any, positions: Any) -> Any:
    """Positions of a layer's last three dimensions, in the world. The way there is affine: four places tell it."""
    corners = np.zeros((4, layer.ndim))
    corners[1:, -3:] = np.eye(3)
    origin, *ends = (np.asarray(layer.data_to_world(corner))[-3:] for corner in corners)
    return np.asarray(positions, dtype=float)[:, -3:] @ (np.array(ends) - origin) + origin


def _mesh(surface: napari.layers.Surface) -> bf.Mesh:
    return bf.Mesh(_world(surface, surface.data[0]), surface.data[1])


def _places(points: napari.layers.Points, fewest: int) -> bf.At:
    if len(points.data) < fewest:
        raise bf.BrushfireError(f"layer {points.name!r} has {len(points.data)} points: at least {fewest} are needed")
    return bf.at(_world(points, points.data))


def _shown_as(surface: napari.layers.Surface, values: Any, name: str) -> tuple[Any, dict[str, Any], str]:
    """The surface once more, coloured by values; as in the original, vertices are in the layer's own units."""
    reached = np.isfinite(values)
    limits = (0.0, float(values[reached].max(initial=0)) or 1.0)
    how = {"name": name, "colormap": "viridis", "contrast_limits": limits, "affine": surface.affine,
           "scale": surface.scale, "translate": surface.translate, "rotate": surface.rotate, "shear": surface.shear}  # fmt: skip
    return (surface.data[0], surface.data[1], np.where(reached, values, np.nan)), how, "surface"


def _drawn(paths: list[bf.Path], name: str, values: list[float], what: str) -> tuple[Any, dict[str, Any], str]:
    """Polylines in the world as a Shapes layer, with one number for each."""
    drawn = [(np.concatenate([p.positions, p.positions[:1]]) if p.closed else p.positions, v)
             for p, v in zip(paths, values, strict=True) if len(p.positions) > 1]  # fmt: skip
    how = {
        "name": name,
        "shape_type": "path",
        "features": {what: [value for _, value in drawn]},
        "edge_color": "orange",
    }
    return [line for line, _ in drawn], how, "shapes"


def geodesic_distance(
    surface: napari.layers.Surface, sources: napari.layers.Points, exact: bool = False
) -> napari.types.LayerDataTuple:
    """The surface, coloured by its distance from the points: within 0.1 %, proven, or exact. NaN where nothing leads."""
    values = _mesh(surface).distance(_places(sources, 1), method="exact" if exact else "windows")
    return _shown_as(surface, values, f"{surface.name} distance")


def geodesic_path(surface: napari.layers.Surface, ends: napari.layers.Points) -> napari.types.LayerDataTuple:
    """The shortest paths from the first point to the second, from there to the third, and so on; `length` in features."""
    places = _places(ends, 2)
    mesh = _mesh(surface)
    points, _ = mesh.nearest(places.xyz)
    paths = [mesh.path(points[i], points[i + 1]) for i in range(len(points) - 1)]
    return _drawn(paths, f"{surface.name} path", [path.length for path in paths], "length")


def geodesic_isolines(
    surface: napari.layers.Surface, sources: napari.layers.Points, count: int = 10
) -> napari.types.LayerDataTuple:
    """Curves at equal distance from the points, arcs drawn as arcs; `distance` in features."""
    found = _mesh(surface).curved_isolines(_places(sources, 1), count=count)
    return _drawn([f.line for f in found], f"{surface.name} isolines", [f.level for f in found], "distance")
