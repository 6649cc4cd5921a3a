"""from_any(): the mesh objects of other libraries, those that are installed, and look-alikes of the rest."""

from __future__ import annotations

import importlib
import io
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import brushfire as bf
from conftest import grid

V, F = grid(4, 0.3)
VTK_FACES = np.column_stack([np.full(len(F), 3), F]).ravel()
REFUSED = (bf.BrushfireError, TypeError)


def lib(name):
    """An ImportError of something that it needs is as good as its absence."""
    return pytest.importorskip(name, exc_type=ImportError)


def trimesh_mesh():
    return lib("trimesh").Trimesh(V, F, process=False)


def pyvista_mesh():
    return lib("pyvista").PolyData(V, VTK_FACES)


def vtk_polydata():
    """Of vtk alone, without what pyvista adds."""
    lib("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(V, deep=True))
    cells.SetData(3, numpy_to_vtkIdTypeArray(F.ravel().astype(np.int64), deep=True))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def open3d_mesh():
    o3d = lib("open3d")
    return o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(V), o3d.utility.Vector3iVector(F.astype(np.int32)))


def mesh_set():
    pymeshlab = lib("pymeshlab")
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(V[:3], [[0, 1, 2]]))
    meshes.add_mesh(pymeshlab.Mesh(V, F))  # the last one is the current one
    return meshes


def surface():
    return lib("nilearn.surface").InMemoryMesh(V, F)


def gifti(*intents):
    gii = lib("nibabel").gifti
    data = {"POINTSET": V.astype(np.float32), "TRIANGLE": F.astype(np.int32), "SHAPE": V[:, 0].astype(np.float32)}
    return gii.GiftiImage(darrays=[gii.GiftiDataArray(data[i], intent=f"NIFTI_INTENT_{i}") for i in intents])


class Tensor:
    """As torch's: its numpy() refuses while there is a gradient, and a set of any size has an __index__."""

    def __init__(self, array, gradient=True):
        self.array, self.gradient = np.asarray(array), gradient

    dtype = property(lambda self: "torch." + str(self.array.dtype))
    ndim = property(lambda self: self.array.ndim)
    T = property(lambda self: Tensor(self.array.T, self.gradient))

    def detach(self):
        return Tensor(self.array, False)

    def cpu(self):
        return self

    def numpy(self):
        return self.__array__()

    def __array__(self, dtype=None, copy=None):
        if self.gradient:
            raise RuntimeError("Can't call numpy() on Tensor that requires grad.")
        return np.asarray(self.array, dtype=dtype)

    def __len__(self):
        return len(self.array)

    def __index__(self):
        return self.array.__index__()


SAME = {
    "pair": lambda: (V, F),
    "triple": lambda: (V, F, V),
    "reader's tuple": lambda: (V, F, {"volume": 1}, None),
    "lists": lambda: [V.tolist(), F.tolist()],
    "dict": lambda: {"vertices": V, "faces": F, "metadata": {}},
    "dict of triangles": lambda: {"vertices": V, "triangles": F},
    "dict of V and F": lambda: {"V": V, "F": F},
    "tensors": lambda: (Tensor(V), Tensor(F, False)),
    "Mesh": lambda: bf.Mesh(V, F),
    "vertices and faces": lambda: SimpleNamespace(vertices=V, faces=F),
    "vertices and triangles": lambda: SimpleNamespace(vertices=V, triangles=F),
    "verts and faces": lambda: SimpleNamespace(verts=V, faces=F),
    "points and triangles": lambda: SimpleNamespace(points=V, triangles=F),
    "coordinates and faces": lambda: SimpleNamespace(coordinates=V, faces=F),
    "VTK's layout": lambda: SimpleNamespace(points=V, faces=VTK_FACES),
    "cells_dict": lambda: SimpleNamespace(points=V, cells_dict={"triangle": F, "vertex": np.zeros((1, 1), int)}),
    "agg_data": lambda: SimpleNamespace(agg_data=lambda intent: {"pointset": V, "triangle": F}[intent]),
    "torch_geometric's Data": lambda: SimpleNamespace(pos=Tensor(V), face=Tensor(F.T, False)),
    "PyTorch3D's Meshes": lambda: SimpleNamespace(verts_list=lambda: [Tensor(V)], faces_list=lambda: [Tensor(F)]),
    "vedo's wrapper": lambda: SimpleNamespace(dataset=vtk_polydata()),
    "brainspace's wrapper": lambda: SimpleNamespace(VTKObject=vtk_polydata()),
    "trimesh": trimesh_mesh,
    "trimesh.Scene": lambda: lib("trimesh").Scene(trimesh_mesh()),
    "trimesh's dict": lambda: trimesh_mesh().to_dict(),
    "pyvista": pyvista_mesh,
    "pyvista UnstructuredGrid": lambda: lib("pyvista").UnstructuredGrid({5: F}, V),
    "pyvista MultiBlock": lambda: lib("pyvista").MultiBlock([pyvista_mesh(), lib("pyvista").Line(), None]),
    "pyvista MultiBlock in another": lambda: lib("pyvista").MultiBlock([lib("pyvista").MultiBlock([pyvista_mesh()])]),
    "vtkPolyData": vtk_polydata,
    "vedo": lambda: lib("vedo").Mesh([V, F]),
    "open3d": open3d_mesh,
    "open3d tensor": lambda: lib("open3d").t.geometry.TriangleMesh.from_legacy(open3d_mesh()),
    "pymeshlab.Mesh": lambda: lib("pymeshlab").Mesh(V, F),
    "pymeshlab.MeshSet": mesh_set,
    "nilearn surface mesh": surface,
    "nilearn PolyMesh": lambda: lib("nilearn.surface").PolyMesh(left=surface()),
    "nilearn SurfaceImage": lambda: lib("nilearn.surface").SurfaceImage({"left": surface()}, {"left": V[:, 0]}),
    "nilearn part": lambda: lib("nilearn.surface").PolyMesh(left=surface(), right=surface()).parts["right"],
    "meshio": lambda: lib("meshio").Mesh(V, [("triangle", F), ("line", F[:, :2])]),
    "nibabel": lambda: gifti("POINTSET", "TRIANGLE", "SHAPE"),
    "compas": lambda: lib("compas.datastructures").Mesh.from_vertices_and_faces(V.tolist(), F.tolist()),
    "pandas": lambda: (lib("pandas").DataFrame(V), lib("pandas").DataFrame(F)),
    "jax": lambda: (lib("jax.numpy").array(V), lib("jax.numpy").array(F)),
    "dask": lambda: (lib("dask.array").from_array(V), lib("dask.array").from_array(F)),
}


@pytest.mark.parametrize("make", SAME.values(), ids=SAME)
def test_the_mesh_comes_out_as_it_is(make):
    mesh = bf.from_any(make())
    assert np.allclose(mesh.vertices, V, atol=1e-7)
    assert np.array_equal(mesh.faces, F)


def hull():
    return lib("scipy.spatial").ConvexHull(np.random.default_rng(0).normal(size=(50, 3)))


def triangulation(**options):
    return lib("matplotlib.tri").Triangulation(*V[:, :2].T, F, **options)


def scene_of_two():
    trimesh = lib("trimesh")
    scene = trimesh.Scene(trimesh_mesh())
    scene.add_geometry(trimesh_mesh(), transform=trimesh.transformations.translation_matrix([10, 0, 0]))
    return scene


def file_of_the_mesh():
    lines = ["OFF", f"{len(V)} {len(F)} 0", *(f"{x!r} {y!r} {z!r}" for x, y, z in V.tolist())]
    return "\n".join([*lines, *(f"3 {a} {b} {c}" for a, b, c in F.tolist())]).encode()


FOLDER = tempfile.TemporaryDirectory()  # gone when this module is


def path_of_the_mesh():
    path = Path(FOLDER.name) / "mesh.off"
    path.write_bytes(file_of_the_mesh())
    return path


FACES, AREA = len(F), bf.Mesh(V, F).area

# What is numbered in another way, holds more than V and F, or is a file of them: how many faces, and their area.
ANOTHER = {
    "matplotlib Triangulation": (triangulation, lambda: (FACES, 9)),
    "matplotlib Triangulation, masked": (lambda: triangulation(mask=np.arange(FACES) < 4), lambda: (FACES - 4, 7)),
    "scipy Delaunay": (lambda: lib("scipy.spatial").Delaunay(V[:, :2]), lambda: (FACES, 9)),
    "scipy ConvexHull": (hull, lambda: (len(hull().simplices), hull().area)),
    "pyvista strips": (lambda: pyvista_mesh().strip(), lambda: (FACES, AREA)),
    "trimesh.Scene of two": (scene_of_two, lambda: (2 * FACES, 2 * AREA)),
    "path": (path_of_the_mesh, lambda: (FACES, AREA)),
    "name of a file": (lambda: str(path_of_the_mesh()), lambda: (FACES, AREA)),
    "open file": (lambda: io.BytesIO(file_of_the_mesh()), lambda: (FACES, AREA)),
    "bytes of a file": (file_of_the_mesh, lambda: (FACES, AREA)),
}


@pytest.mark.parametrize(("make", "measures"), ANOTHER.values(), ids=ANOTHER)
def test_the_surface_comes_out_as_it_is(make, measures):
    mesh = bf.from_any(make())
    faces, area = measures()
    assert mesh.face_count == faces
    assert mesh.area == pytest.approx(area)


def test_triangulations_keep_their_points_and_a_hull_is_closed():
    for make in (triangulation, lambda: lib("scipy.spatial").Delaunay(V[:, :2])):
        assert np.array_equal(bf.from_any(make()).vertices[:, :2], V[:, :2])
    assert bf.from_any(hull()).report.boundary_edges == 0


def test_strips_give_their_triangles_the_right_way_round():
    strips = pyvista_mesh().strip()
    assert strips.n_strips > 0
    mesh = bf.from_any(strips)
    assert mesh.report.misoriented_edges == 0
    assert sorted(map(sorted, mesh.faces.tolist())) == sorted(map(sorted, F.tolist()))
    normals = np.cross(*(mesh.vertices[mesh.faces[:, k]] - mesh.vertices[mesh.faces[:, 0]] for k in (1, 2)))
    assert (normals[:, 2] > 0).all()


def test_the_meshes_of_a_scene_stand_where_the_scene_has_them():
    mesh = bf.from_any(scene_of_two())
    assert mesh.report.components == 2
    assert mesh.vertices[:, 0].max() == pytest.approx(13)


# What is refused, and what the message has to say.
REFUSALS = {
    "None": (lambda: None, "NoneType"),
    "number": (lambda: 3, "int"),
    "array": (lambda: V, "array alone"),
    "meshes": (lambda: [bf.Mesh(V, F), bf.Mesh(V, F)], "give one"),
    "dict": (lambda: {"pts": V, "tri": F}, "'vertices' and 'faces'"),
    "no faces": (lambda: (V, np.zeros((0, 3), int)), "no triangles"),
    "points": (lambda: SimpleNamespace(points=V), "no .faces"),
    "quads": (lambda: (V, [[0, 1, 5, 4]]), "4 corners"),
    "mixed polygons": (lambda: (V, [[0, 1, 5, 4], [0, 1, 5]]), "corners"),
    "VTK's layout of quads": (lambda: SimpleNamespace(points=V, faces=np.array([4, 0, 1, 2, 3])), "triang"),
    "solver": (lambda: bf.Mesh(V, F).solver(), r"give its \.mesh"),
    "viewer's layer": (lambda: SimpleNamespace(data=(V, F, V[:, 0])), r"give its \.data"),
    "holder of several": (lambda: SimpleNamespace(meshes={"a": bf.Mesh(V, F)}), r"give its \.meshes\['a'\]"),
    "torch_geometric without faces": (lambda: SimpleNamespace(pos=V, face=None), r"\.face .* None"),
    "PyTorch3D's batch": (lambda: SimpleNamespace(verts_list=lambda: [V, V], faces_list=lambda: [F, F]), "2 meshes"),
    "trimesh.Scene": (lambda: lib("trimesh").Scene(), "without geometry"),
    "trimesh.PointCloud": (lambda: lib("trimesh").PointCloud(V), "no .faces"),
    "pyvista quads": (lambda: lib("pyvista").Plane(), "triangulate"),
    "pyvista points": (lambda: lib("pyvista").PolyData(V), "16 points and 0 lines"),
    "pyvista line": (lambda: lib("pyvista").Line(), "1 lines"),
    "pyvista grid of quads": (lambda: lib("pyvista").UnstructuredGrid({9: np.array([[0, 1, 5, 4]])}, V), "quadrangles"),
    "pyvista grid of bodies": (
        lambda: lib("pyvista").UnstructuredGrid({10: np.array([[0, 1, 5, 4]])}, V),
        "extract_surface",
    ),
    "pyvista grid of lines": (lambda: lib("pyvista").UnstructuredGrid({3: np.array([[0, 1]])}, V), "no triangles"),
    "pyvista image": (lambda: lib("pyvista").ImageData(dimensions=(3, 3, 1)), "extract_surface"),
    "pyvista MultiBlock": (lambda: lib("pyvista").MultiBlock([pyvista_mesh(), pyvista_mesh()]), "2 surfaces"),
    "vtk source": (lambda: lib("vtkmodules.vtkFiltersSources").vtkSphereSource(), "GetOutput"),
    "open3d cloud": (
        lambda: lib("open3d").geometry.PointCloud(lib("open3d").utility.Vector3dVector(V)),
        "no .faces or .triangles",
    ),
    "open3d tensor": (lambda: lib("open3d").t.geometry.TriangleMesh(), "vertex.positions"),
    "open3d tensor cloud": (lambda: lib("open3d").t.geometry.PointCloud(V), "PointCloud"),
    "pymeshlab.MeshSet": (lambda: lib("pymeshlab").MeshSet(), "without a mesh"),
    "nilearn PolyMesh": (
        lambda: lib("nilearn.surface").PolyMesh(left=surface(), right=surface()),
        r"\.parts\['left'\]",
    ),
    "meshio quads": (lambda: lib("meshio").Mesh(V, [("quad", np.array([[0, 1, 5, 4]]))]), "quad"),
    "meshio lines": (lambda: lib("meshio").Mesh(V, [("line", F[:, :2])]), "no triangles"),
    "nibabel curve": (lambda: gifti("SHAPE"), "pointset"),
    "nibabel points": (lambda: gifti("POINTSET"), "triangle"),
    "nibabel both hemispheres": (lambda: gifti("POINTSET", "TRIANGLE", "POINTSET", "TRIANGLE"), "2 arrays"),
    "nibabel volume": (lambda: lib("nibabel").Nifti1Image(np.zeros((2, 2, 2)), np.eye(4)), "Nifti1Image"),
    "scipy tetrahedra": (
        lambda: lib("scipy.spatial").Delaunay(np.random.default_rng(0).normal(size=(9, 3))),
        "convex_hull",
    ),
    "scipy plane hull": (lambda: lib("scipy.spatial").ConvexHull(V[:, :2]), "line"),
    "compas quads": (lambda: lib("compas.datastructures").Mesh.from_meshgrid(3, 3, 1, 1), "triangulated=True"),
}


@pytest.mark.parametrize(("make", "says"), REFUSALS.values(), ids=REFUSALS)
def test_what_holds_no_triangles_is_refused_and_the_message_says_what_would_do(make, says):
    source = make()
    with pytest.raises(REFUSED, match=says):
        bf.from_any(source)


def test_no_library_is_imported_for_an_object():
    """In a process of its own: look-alikes of everything, and none of the libraries."""
    import subprocess
    import sys

    program = (
        "import sys, brushfire as bf, numpy as np; from types import SimpleNamespace as S\n"
        "V, F = np.eye(3), [[0, 1, 2]]\n"
        "[bf.from_any(s) for s in ((V, F), {'V': V, 'F': F}, S(vertices=V, faces=F), S(pos=V, face=np.transpose(F)))]\n"
        "print(sorted({m.split('.')[0] for m in sys.modules} & {'vtkmodules', 'trimesh', 'scipy', 'nibabel', 'torch'}))"
    )
    ended = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert ended.stdout.strip() == "[]"


def test_the_table_names_libraries_that_exist():
    """Should all be missing, this file has tested look-alikes only: say so."""
    names = ("trimesh", "pyvista", "vedo", "open3d", "pymeshlab", "nilearn", "meshio", "nibabel", "compas", "scipy")
    if not any(importlib.util.find_spec(name) for name in names):
        pytest.skip("none of the libraries is installed: look-alikes only")
