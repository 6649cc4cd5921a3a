"""In Blender's own Python: the bpy wheel, or `blender -b --python-expr`."""

import sys
from pathlib import Path

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")
from octahedron import OPPOSITE, SIDE

sys.path.insert(0, str(Path(__file__).parents[1] / "blender"))
import brushfire_distances


@pytest.fixture
def obj(octahedron):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    brushfire_distances.register()
    data = bpy.data.meshes.new("octahedron")
    data.from_pydata(octahedron[0], [], octahedron[1])
    data.update()
    made = bpy.data.objects.new("octahedron", data)
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    yield made
    brushfire_distances.unregister()


def select(obj, *vertices):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for vertex in vertices:
        obj.data.vertices[vertex].select = True


def attribute(obj, name):
    return [item.value for item in obj.data.attributes[name].data]


def test_distance_becomes_an_attribute_and_a_vertex_group(obj):
    select(obj, 0)
    assert bpy.ops.mesh.geodesic_distance() == {"FINISHED"}
    assert attribute(obj, "distance") == pytest.approx([0, OPPOSITE, SIDE, SIDE, SIDE, SIDE])
    group = obj.vertex_groups["distance"]
    assert group.weight(0) == pytest.approx(1)
    assert group.weight(2) == pytest.approx(1 - SIDE / OPPOSITE)


def test_the_group_falls_off_where_it_is_told(obj):
    select(obj, 0)
    bpy.ops.mesh.geodesic_distance(falloff=2.0)
    assert obj.vertex_groups["distance"].weight(2) == pytest.approx(1 - SIDE / 2)
    with pytest.raises(RuntimeError, match="not in group"):
        obj.vertex_groups["distance"].weight(1)


def test_distances_are_those_of_the_scene(obj):
    obj.scale = (2, 2, 2)
    bpy.context.view_layer.update()
    select(obj, 0)
    bpy.ops.mesh.geodesic_distance()
    assert attribute(obj, "distance")[2] == pytest.approx(2 * SIDE)


def test_a_path_becomes_a_curve(obj):
    select(obj, 0, 1)
    bpy.ops.mesh.geodesic_path()
    [spline] = bpy.data.objects["octahedron path"].data.splines
    points = np.array([point.co[:3] for point in spline.points])
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() == pytest.approx(OPPOSITE)
    assert points[0] == pytest.approx([1, 0, 0])


def test_isolines_become_closed_curves(obj):
    select(obj, 0)
    bpy.ops.mesh.geodesic_isolines(count=3)
    splines = bpy.data.objects["octahedron isolines"].data.splines
    assert len(splines) == 3
    assert all(spline.use_cyclic_u for spline in splines)


def test_nearest_sources_become_face_sets(obj):
    select(obj, 0, 1)
    bpy.ops.mesh.geodesic_cells()
    assert attribute(obj, ".sculpt_face_set") == [2, 3, 3, 2, 2, 3, 3, 2]


def test_too_few_vertices_are_refused_by_number(obj):
    select(obj)
    with pytest.raises(RuntimeError, match="Select at least 1 vertices: 0 are selected"):
        bpy.ops.mesh.geodesic_distance()
    select(obj, 0, 1, 2)
    with pytest.raises(RuntimeError, match="select 2 vertices, not 3"):
        bpy.ops.mesh.geodesic_path()


def test_edit_mode_stays_edit_mode(obj):
    select(obj, 0)
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.mesh.geodesic_distance() == {"FINISHED"}
    assert obj.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert attribute(obj, "distance")[1] == pytest.approx(OPPOSITE)
