"""Brushfire in Blender: in the 3D view's sidebar, under Brushfire. Select vertices, go back to object mode or stay.

Distances are in the scene's units: scale and rotation of the object count. Polygons are taken as the triangles that
Blender draws. Modifiers do not count: results lie on the mesh that is edited.
"""

from __future__ import annotations

import bpy

from . import operators

bl_info = {
    "name": "Brushfire: geodesic distances",
    "description": "Distances, shortest paths, isolines and cells on a mesh",
    "author": "The authors of Brushfire",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D view, sidebar, Brushfire",
    "category": "Mesh",
}


class VIEW3D_PT_brushfire(bpy.types.Panel):
    bl_label = "Geodesic distances"
    bl_category = "Brushfire"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"

    def draw(self, context):
        for operator in operators.ALL:
            self.layout.operator(operator.bl_idname)


CLASSES = (*operators.ALL, VIEW3D_PT_brushfire)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
