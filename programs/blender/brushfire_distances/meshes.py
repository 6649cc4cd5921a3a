"""Between Blender's data and Brushfire's."""

from __future__ import annotations

import bpy
import numpy as np

import brushfire as bf


def mesh_of(obj) -> bf.Mesh:
    """The object's mesh as it stands in the world, in the triangles that Blender draws. In object mode."""
    data = obj.data
    data.calc_loop_triangles()
    vertices = np.empty(3 * len(data.vertices))
    data.vertices.foreach_get("co", vertices)
    triangles = np.empty(3 * len(data.loop_triangles), dtype=np.int32)
    data.loop_triangles.foreach_get("vertices", triangles)
    world = np.array(obj.matrix_world)
    return bf.Mesh(vertices.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3], triangles.reshape(-1, 3))


def selected_vertices(obj) -> list[int]:
    """Ascending. In object mode, into which Blender has then written the selection of edit mode."""
    flags = np.empty(len(obj.data.vertices), dtype=bool)
    obj.data.vertices.foreach_get("select", flags)
    return np.flatnonzero(flags).tolist()


def set_attribute(data, name: str, kind: str, domain: str, values) -> None:
    """A named attribute with these values, in the place of one of another kind."""
    old = data.attributes.get(name)
    if old is not None and (old.data_type != kind or old.domain != domain):
        data.attributes.remove(old)
        old = None
    attribute = old or data.attributes.new(name, kind, domain)
    attribute.data.foreach_set("value", values)


def set_vertex_group(obj, name: str, weights) -> None:
    """A vertex group with a weight from 0 to 1 for each vertex; vertices of weight 0 are not in it."""
    old = obj.vertex_groups.get(name)
    if old is not None:
        obj.vertex_groups.remove(old)
    group = obj.vertex_groups.new(name=name)
    for vertex in np.flatnonzero(weights > 0).tolist():
        group.add([vertex], float(weights[vertex]), "REPLACE")


def new_curve(context, name: str, paths):
    """Polylines as one curve object at the world's origin."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    for path in paths:
        spline = curve.splines.new("POLY")
        spline.points.add(len(path.positions) - 1)
        spline.points.foreach_set("co", np.c_[path.positions, np.ones(len(path.positions))].ravel())
        spline.use_cyclic_u = path.closed
    made = bpy.data.objects.new(name, curve)
    context.collection.objects.link(made)
    return made


def nearest_of_polygons(data, source, distance):
    """For each polygon the source that its nearest vertex reads."""
    corners = np.empty(len(data.loops), dtype=np.int32)
    data.loops.foreach_get("vertex_index", corners)
    starts = np.empty(len(data.polygons), dtype=np.int32)
    data.polygons.foreach_get("loop_start", starts)
    ends = np.append(starts[1:], len(corners))
    return np.array([source[(v := corners[a:b])[np.argmin(distance[v])]] for a, b in zip(starts, ends)], dtype=np.int32)
