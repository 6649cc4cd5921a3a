#!/usr/bin/env python3
"""Brushfire's readers and writers against nibabel, meshio and trimesh, index by index.

    compare_readers.py FILE_PROBE VENV_FOLDER [MESH_FOLDER...]

Generated files of every format that the three packages write, then all meshes below the given folders and of Debian's
libcgal-demo, where it is installed. The packages are installed from PyPI into VENV_FOLDER where Python lacks them;
where they cannot be had the script says so and exits with 77, which ctest counts as skipped.
"""
import os
import subprocess
import sys
import tarfile
import tempfile

from environment import enter_environment

PACKAGES = ["numpy", "nibabel==5.4.2", "meshio==5.3.5", "trimesh==5.2.0", "scipy"]

try:
    import meshio
    import nibabel
    import numpy as np
    import trimesh
except ImportError:
    enter_environment(sys.argv[2], PACKAGES, "BRUSHFIRE_COMPARE_READERS", "nibabel, meshio and trimesh")

from plain_off import faces_of_off  # needs what has been made sure of above

probe = os.path.abspath(sys.argv[1])
folder = tempfile.TemporaryDirectory()
checks = 0


def at(name):
    return os.path.join(folder.name, name)


def run(*words):
    done = subprocess.run([probe, *words], capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(f"{' '.join(words)}: {done.stderr.strip()}")


def mesh_of(path):
    run("mesh", path, at("out"))
    return tuple(np.load(at(f"out.{what}.npy")) for what in ("positions", "faces", "origin", "map"))


def check(name, condition):
    global checks
    checks += 1
    if not condition:
        raise AssertionError(f"{name}: brushfire differs")


def check_mesh(path, positions, faces):
    ours = mesh_of(path)
    name = os.path.basename(path)
    check(name + " positions", np.array_equal(ours[0], np.asarray(positions, dtype=np.float64)))
    check(name + " faces", np.array_equal(ours[1], np.asarray(faces)))


def field_of(path):
    run("field", path, at("out"))
    return np.load(at("out.values.npy"))


def random_mesh(vertices, faces, seed=5):
    random = np.random.default_rng(seed)
    return random.normal(size=(vertices, 3)) * 10.0 ** random.integers(-4, 5, (vertices, 1)), \
        random.integers(0, vertices, (faces, 3))


def compare_nibabel(positions, faces):
    narrow = positions.astype(np.float32)
    for encoding in ("ASCII", "B64BIN", "B64GZ"):
        image = nibabel.GiftiImage(darrays=[
            nibabel.gifti.GiftiDataArray(narrow, intent="NIFTI_INTENT_POINTSET", encoding=f"GIFTI_ENCODING_{encoding}"),
            nibabel.gifti.GiftiDataArray(faces.astype(np.int32), intent="NIFTI_INTENT_TRIANGLE",
                                         encoding=f"GIFTI_ENCODING_{encoding}")])
        nibabel.save(image, at("a.surf.gii"))
        back = nibabel.load(at("a.surf.gii")).agg_data()
        ours = mesh_of(at("a.surf.gii"))  # text keeps its digits here, and is cut to float32 there
        check(f"surf.gii {encoding}", np.array_equal(ours[0].astype(np.float32), back[0]) and np.array_equal(ours[1], back[1]))
        shape = nibabel.GiftiImage(darrays=[nibabel.gifti.GiftiDataArray(
            narrow[:, 0].copy(), intent="NIFTI_INTENT_SHAPE", encoding=f"GIFTI_ENCODING_{encoding}")])
        nibabel.save(shape, at("a.shape.gii"))
        check("shape.gii", np.array_equal(field_of(at("a.shape.gii")).astype(np.float32), nibabel.load(at("a.shape.gii")).agg_data()))
    fs = nibabel.freesurfer
    fs.write_geometry(at("lh.white"), narrow, faces)
    check_mesh(at("lh.white"), *fs.read_geometry(at("lh.white")))
    fs.write_morph_data(at("lh.thickness"), narrow[:, 1])
    check("thickness", np.array_equal(field_of(at("lh.thickness")), fs.read_morph_data(at("lh.thickness"))))
    labels = np.arange(len(positions)) % 4
    table = np.array([[10 * k, k, 200, 0, 0] for k in range(4)])
    fs.write_annot(at("lh.a.annot"), labels, table, [f"part{k}" for k in range(4)], fill_ctab=True)
    check("annot", np.array_equal(field_of(at("lh.a.annot")), fs.read_annot(at("lh.a.annot"))[0]))


def write_trimesh(name, positions, faces, **options):
    trimesh.Trimesh(positions, faces, process=False, validate=False).export(at(name), **options)


def compare_meshio(positions, faces):
    mesh = meshio.Mesh(positions, [("triangle", faces)], point_data={"value": positions[:, 0].copy()})
    plain = meshio.Mesh(positions, [("triangle", faces)])
    variants = [("a.vtk", mesh, {"binary": True}), ("b.vtk", mesh, {"binary": False}), ("a.ply", mesh, {"binary": True}),
                ("b.ply", mesh, {"binary": False}), ("a.msh", plain, {"file_format": "gmsh22", "binary": False}),
                ("b.msh", plain, {"file_format": "gmsh22", "binary": True}),
                ("c.msh", plain, {"file_format": "gmsh", "binary": False}),
                ("d.msh", plain, {"file_format": "gmsh", "binary": True}), ("a.mesh", plain, {}), ("a.obj", plain, {}),
                ("a.off", plain, {})]
    for name, what, options in variants:
        meshio.write(at(name), what, **options)
        back = meshio.read(at(name))
        check_mesh(at(name), back.points, back.cells_dict["triangle"])
        if what is mesh:
            check(name + " field", np.array_equal(field_of(at(name)), back.point_data["value"].ravel()))
    for binary in (True, False):  # STL has no shared vertices: compare corner by corner
        meshio.write(at("a.stl"), plain, binary=binary)
        back = trimesh.load(at("a.stl"), process=False, file_type="stl" if binary else "stl_ascii")
        ours = mesh_of(at("a.stl"))
        check("stl corners", np.array_equal(ours[0][ours[1]].astype(np.float32), back.triangles.astype(np.float32)))
        check("stl welded", len(np.unique(ours[0], axis=0)) == len(ours[0]))


def compare_trimesh(positions, faces):
    for name in ("t.ply", "t.off", "t.obj", "t.glb"):
        write_trimesh(name, positions, faces)
        options = {"maintain_order": True} if name == "t.obj" else {}
        back = trimesh.load(at(name), process=False, force="mesh", **options)
        check_mesh(at(name), back.vertices, back.faces)


def compare_writers(positions, faces):
    meshio.write(at("in.ply"), meshio.Mesh(positions, [("triangle", faces)]), binary=True)
    x = positions[:, 0]
    run("write", at("in.ply"), at("w.ply"))  # none of the three reads PolyData, so VTK and VTP are not among these
    back = meshio.read(at("w.ply"))
    check("w.ply written", np.array_equal(back.points, positions) and np.array_equal(back.cells_dict["triangle"], faces))
    check("w.ply values", np.array_equal(back.point_data["quality"].ravel(), x))
    run("write", at("in.ply"), at("w.obj"))
    back = trimesh.load(at("w.obj"), process=False, maintain_order=True)
    check("w.obj written", np.array_equal(back.vertices, positions) and np.array_equal(back.faces, faces))
    run("write", at("in.ply"), at("w.func.gii"))
    check("w.func.gii", np.array_equal(nibabel.load(at("w.func.gii")).agg_data(), x.astype(np.float32)))
    run("write", at("in.ply"), at("w.curv"))
    check("w.curv", np.array_equal(nibabel.freesurfer.read_morph_data(at("w.curv")), x.astype(np.float32)))
    run("write", at("in.ply"), at("w.npy"))
    check("w.npy", np.array_equal(np.load(at("w.npy")), x))


def compare_file(path):
    ours = mesh_of(path)
    name = os.path.basename(path)
    if path.endswith(".off"):
        positions, polygons = faces_of_off(path)
        check(name + " positions", np.array_equal(ours[0], positions))
        triangles = [p for p in polygons if len(p) == 3]
        if len(triangles) == len(polygons):
            check(name + " faces", np.array_equal(ours[1], np.array(polygons, dtype=int).reshape(-1, 3)))
            return
        check(name + " number of triangles", len(ours[1]) == sum(max(len(p) - 2, 0) for p in polygons))
        inside = all(set(face) <= set(polygons[origin]) for face, origin in zip(ours[1].tolist(), ours[2]))
        check(name + " origins", inside)
        return
    if len(ours[1]) == 0:  # a cloud of points
        cloud = trimesh.load(path, process=False).vertices
        check(name + " positions", np.array_equal(ours[0], cloud) or  # float properties as text keep their digits here
              np.array_equal(ours[0].astype(np.float32), np.asarray(cloud, dtype=np.float32)))
        return
    back = trimesh.load(path, process=False, force="mesh")
    if path.endswith(".stl"):
        check(name + " corners", np.array_equal(ours[0][ours[1]].astype(np.float32), back.triangles.astype(np.float32)))
    elif len(back.faces) == len(ours[1]) and len(back.vertices) == len(ours[0]):
        check(name + " positions", np.array_equal(ours[0], back.vertices))
        if len(ours[2]) == 0:
            check(name + " faces", np.array_equal(ours[1], back.faces))
    else:
        raise AssertionError(f"{name}: {len(ours[0])} vertices and {len(ours[1])} faces, "
                             f"but trimesh has {len(back.vertices)} and {len(back.faces)}")


def files_below(top):
    return sorted(os.path.join(place, f) for place, _, files in os.walk(top) for f in files
                  if f.endswith((".off", ".ply", ".stl")))


def main():
    positions, faces = random_mesh(500, 900)
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
    compare_nibabel(positions, faces)
    compare_meshio(positions, faces)
    compare_trimesh(positions, faces)
    compare_writers(positions, faces)
    generated = checks
    tops = list(sys.argv[3:])
    archive = "/usr/share/doc/libcgal-dev/data.tar.gz"
    if os.path.exists(archive):
        with tarfile.open(archive) as tar:
            tar.extractall(at("cgal"))
        tops.append(at("cgal"))
    else:
        print("libcgal-demo is not installed: its meshes are left out")
    differences = []
    files = [path for top in tops for path in files_below(top)]
    for path in files:
        try:
            compare_file(path)
        except Exception as error:  # everything is shown, then it fails
            differences.append(f"{path}: {error}")
    print(f"{generated} comparisons of generated files, {checks - generated} of {len(files)} packaged ones")
    print("\n".join(differences))
    sys.exit(1 if differences else 0)


main()
