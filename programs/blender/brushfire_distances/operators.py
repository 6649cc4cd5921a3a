"""What the panel's buttons do. Each works on the active object and its selected vertices."""

from __future__ import annotations

import contextlib

import bpy
import numpy as np

from . import meshes


@contextlib.contextmanager
def _object_mode(obj):
    """Blender lets attributes be written in object mode only; afterwards the mode is as it was."""
    mode = obj.mode
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


class _OnSelection:
    """Operators that need a mesh with selected vertices, and say so where there are none."""

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 (Blender reads it from the class)
    fewest = 1

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "MESH"

    def execute(self, context):
        import brushfire

        obj = context.active_object
        with _object_mode(obj):
            vertices = meshes.selected_vertices(obj)
            if len(vertices) < self.fewest:
                self.report({"ERROR"}, f"Select at least {self.fewest} vertices: {len(vertices)} are selected")
                return {"CANCELLED"}
            try:
                told = self.compute(context, obj, meshes.mesh_of(obj), vertices)
            except brushfire.BrushfireError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
        self.report({"INFO"}, told)
        return {"FINISHED"}


class MESH_OT_geodesic_distance(_OnSelection, bpy.types.Operator):
    """Distance from the selected vertices along the surface: an attribute, and a vertex group that falls off with it"""

    bl_idname = "mesh.geodesic_distance"
    bl_label = "Distance from selected"

    falloff: bpy.props.FloatProperty(
        name="Falloff",
        description="Where the group's weight reaches 0; 0: at the farthest vertex",
        min=0,
        unit="LENGTH",
    )

    def compute(self, context, obj, mesh, vertices):
        distance = mesh.distance(vertices)
        reached = np.isfinite(distance)
        farthest = distance[reached].max()
        meshes.set_attribute(obj.data, "distance", "FLOAT", "POINT", distance)
        with np.errstate(invalid="ignore"):
            weights = np.where(reached, 1 - distance / (self.falloff or farthest or 1.0), 0.0)
        meshes.set_vertex_group(obj, "distance", weights.clip(0, 1))
        unreached = f", {(~reached).sum()} vertices cannot be reached" if not reached.all() else ""
        return f"Attribute and vertex group 'distance': at most {farthest:.6g}{unreached}"


class MESH_OT_geodesic_path(_OnSelection, bpy.types.Operator):
    """The shortest path between two selected vertices, across faces, as a curve"""

    bl_idname = "mesh.geodesic_path"
    bl_label = "Path between two selected"
    fewest = 2

    def compute(self, context, obj, mesh, vertices):
        if len(vertices) > 2:
            return self._refuse(len(vertices))
        path = mesh.path(*vertices)
        if len(path.positions) == 0:
            return "No path: the two vertices are not connected"
        made = meshes.new_curve(context, f"{obj.name} path", [path])
        return f"'{made.name}': {path.length:.6g} long"

    def _refuse(self, count):
        import brushfire

        raise brushfire.BrushfireError(f"a path has two ends: select 2 vertices, not {count}")


class MESH_OT_geodesic_isolines(_OnSelection, bpy.types.Operator):
    """Curves at equal distance from the selected vertices"""

    bl_idname = "mesh.geodesic_isolines"
    bl_label = "Isolines around selected"

    count: bpy.props.IntProperty(name="Count", default=10, min=1, max=1000)

    def compute(self, context, obj, mesh, vertices):
        lines = [isoline.line for isoline in mesh.curved_isolines(vertices, count=self.count)]
        made = meshes.new_curve(context, f"{obj.name} isolines", lines)
        return f"'{made.name}': {len(lines)} curves"


class MESH_OT_geodesic_cells(_OnSelection, bpy.types.Operator):
    """Face sets: which of the selected vertices is nearest"""

    bl_idname = "mesh.geodesic_cells"
    bl_label = "Face sets of nearest selected"
    fewest = 2

    def compute(self, context, obj, mesh, vertices):
        distance, source = mesh.distance(vertices, return_source=True)
        nearest = meshes.nearest_of_polygons(obj.data, source, distance)
        # 1 is what Blender gives to faces that are in no set of their own: those that nothing reaches.
        meshes.set_attribute(obj.data, ".sculpt_face_set", "INT", "FACE", nearest + 2)
        return f"{len(np.unique(nearest[nearest >= 0]))} face sets"


ALL = (MESH_OT_geodesic_distance, MESH_OT_geodesic_path, MESH_OT_geodesic_isolines, MESH_OT_geodesic_cells)
