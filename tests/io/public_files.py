#!/usr/bin/env python3
"""A table: mesh files that anyone can have, read by brushfire and by other readers, at least two of them where there are.

    public_files.py FILE_PROBE VENV_FOLDER [ARCHIVE_OR_FOLDER...]

The files are those that lie in the wheels of nilearn, nibabel, pyvista, pymeshfix, pymeshlab and gmsh, what meshio, trimesh
and VTK write, and what is in the given folders and archives: `./run demo` leaves that of Debian's libcgal-demo in
demo/data.tar.gz. Compared are the numbers of vertices and of triangles, and the area. The packages (1 GB) are installed from
PyPI into VENV_FOLDER; where they cannot be had the script says so and exits with 77. Every difference is printed, then the
table; ends with 1 where brushfire does not read a surface that two others read alike, or agrees with nobody.
"""
import collections
import contextlib
import glob
import gzip
import multiprocessing
import os
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile

from environment import enter_environment

PACKAGES = ["numpy", "scipy", "lxml", "networkx", "meshio==5.3.5", "trimesh==5.2.0", "nibabel==5.4.2", "pyvista==0.49.1",
            "vtk==9.7.2", "libigl==2.6.3", "pymeshlab==2025.7.post1", "itk-io==5.4.7", "gmsh==4.15.2", "pymeshfix", "nilearn"]

try:
    import gmsh
    import igl
    import itk
    import meshio
    import nibabel
    import numpy as np
    import pymeshlab
    import pyvista
    import trimesh
except ImportError:
    enter_environment(sys.argv[2], PACKAGES, "BRUSHFIRE_PUBLIC_FILES", "the readers of other projects", seconds=1800)

from plain_off import faces_of_off  # needs what has been made sure of above

EXTENSIONS = ("off", "ply", "gii", "vtk", "vtp", "vtu", "stl", "msh", "mesh", "meshb", "obj", "glb", "gltf", "3mf")
Read = collections.namedtuple("Read", "points faces")  # faces: arrays [faces, corners], as many as there are sizes of them


def from_meshio(path):
    mesh = meshio.read(path)
    return Read(mesh.points, [c.data for c in mesh.cells if c.type in ("triangle", "quad", "polygon")])


def from_text(path):
    points, polygons = faces_of_off(path)
    return Read(points, [np.array([p for p in polygons if len(p) == n]) for n in sorted(set(map(len, polygons)))])


def from_trimesh(path):
    mesh = trimesh.load(path, process=False, force="mesh", **({"maintain_order": True} if path.endswith(".obj") else {}))
    return Read(mesh.vertices, [mesh.faces])


def from_pymeshlab(path):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(path)
    mesh = meshes.current_mesh()
    return Read(mesh.vertex_matrix(), [mesh.face_matrix()])


def from_vtk(path):
    surface = pyvista.read(path)
    if not isinstance(surface, pyvista.PolyData):
        if not set(np.unique(surface.celltypes)) <= {5, 6, 7, 8, 9}:  # triangle, strip, polygon, pixel, quadrangle
            raise ValueError("cells that are no faces")
        surface = surface.extract_surface(algorithm=None)
    points = surface.points
    return Read(points, [surface.triangulate().regular_faces])


def from_igl(path):
    return Read(*(lambda v, f: (v, [f]))(*igl.read_triangle_mesh(path)))


def from_nibabel(path):
    image = nibabel.load(path)
    return Read(image.agg_data("pointset"), [image.agg_data("triangle")])


def from_itk(path):
    mesh = itk.meshread(path)
    cells = itk.array_from_vector_container(mesh.GetCellsArray()).reshape(-1, 5)  # type, size, corners
    return Read(itk.array_from_vector_container(mesh.GetPoints()), [cells[:, 2:]])


def from_gmsh(path):
    gmsh.clear()
    gmsh.merge(path)
    tags, points, _ = gmsh.model.mesh.getNodes()
    order = {t: i for i, t in enumerate(tags.tolist())}
    faces = []
    for kind, corners in ((2, 3), (3, 4)):
        nodes = gmsh.model.mesh.getElementsByType(kind)[1].reshape(-1, corners)
        faces.append(np.vectorize(order.get, otypes=[int])(nodes) if len(nodes) else np.empty((0, corners), int))
    return Read(points.reshape(-1, 3), faces)


OTHERS = {"by hand": (from_text, "off"), "meshio": (from_meshio, "off ply vtk vtu stl msh mesh meshb obj"), "trimesh": (from_trimesh, "off ply stl obj glb gltf 3mf"),
          "pymeshlab": (from_pymeshlab, "off ply stl obj glb gltf 3mf"), "VTK": (from_vtk, "ply vtk vtp vtu stl obj"),
          "libigl": (from_igl, "off ply stl obj mesh"), "nibabel": (from_nibabel, "gii"), "ITK": (from_itk, "gii"),
          "Gmsh": (from_gmsh, "msh mesh meshb")}


def summary(read):
    """(vertices, triangles, area). A polygon counts as the triangles that it can be cut into, and by its vector area,
    which, where it is flat, is its own however it is cut."""
    points = np.asarray(read.points, dtype=float)
    points = np.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    triangles, area = 0, 0.0
    for faces in map(np.asarray, read.faces):
        if len(faces) and faces.shape[1] > 2:
            corners = points[faces.astype(int)] - points[faces[:, :1].astype(int)]
            area += np.linalg.norm(np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1), axis=1).sum() / 2
            triangles += len(faces) * (faces.shape[1] - 2)
    return len(points), triangles, float(area)


def agree(ours, other, extension):
    # Files in single precision; of an STL file corners become vertices in as many ways as there are readers. Polygons
    # that are not flat have no one area.
    return ((extension == "stl" or ours[0] == other[0]) and ours[1] == other[1]
            and abs(ours[2] - other[2]) <= 1e-4 * max(ours[2], other[2]))


def read_by_brushfire(path, scratch):
    done = subprocess.run([probe, "mesh", path, scratch], capture_output=True, text=True)
    if done.returncode:
        raise ValueError(done.stderr.strip())
    return summary(Read(np.load(scratch + ".positions.npy"), [np.load(scratch + ".faces.npy")]))


def attempt(read, *arguments):
    try:
        return read(*arguments), ""
    except (Exception, SystemExit) as error:  # whatever another library throws
        return None, f"{type(error).__name__}: {error}".split("\n")[0][-100:]


def apart(read, path):
    """attempt() in a process of its own: some readers crash."""
    receive, send = multiprocessing.Pipe(duplex=False)

    def answer():
        for stream in (1, 2):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
        send.send(attempt(lambda: summary(read(path))))

    child = multiprocessing.get_context("fork").Process(target=answer)
    child.start()
    send.close()
    found = (None, "no answer in a minute")
    if receive.poll(60):
        found = attempt(receive.recv)[0] or (None, "crashed")
    child.kill()
    child.join()
    return found


def write_files(folder):
    """What meshio, trimesh and VTK write of a sphere, in every format for a surface."""
    sphere = trimesh.creation.icosphere(2)
    plain = meshio.Mesh(sphere.vertices, [("triangle", sphere.faces)])
    for name, options in {"a.ply": {}, "b.ply": {"binary": False}, "a.obj": {}, "a.off": {}, "a.stl": {"binary": True}, "b.stl": {},
                          "a.vtk": {"file_format": "vtk42"}, "b.vtk": {"file_format": "vtk51"}, "a.vtu": {}, "a.mesh": {},
                          "a.meshb": {"file_format": "medit"}, "a.msh": {"file_format": "gmsh22"}, "b.msh": {"file_format": "gmsh"}}.items():
        plain.write(os.path.join(folder, "meshio-" + name), **options)
    for extension in ("ply", "obj", "off", "stl", "glb", "gltf", "3mf"):
        place = os.path.join(folder, "trimesh") if extension == "gltf" else folder  # with its buffers
        os.makedirs(place, exist_ok=True)
        sphere.export(os.path.join(place, f"trimesh.{extension}"))
    for extension in ("ply", "stl", "vtk", "vtp"):
        pyvista.wrap(sphere).save(os.path.join(folder, f"vtk.{extension}"))


def collect(folder, tops):
    """Every mesh file, once; those that are packed, unpacked."""
    for top in tops:
        if os.path.isfile(top):
            place = os.path.join(folder, os.path.basename(top) + ".d")
            with tarfile.open(top) as tar:
                tar.extractall(place)
            top = place
        for place, _, names in sorted(os.walk(top)):
            for name in sorted(names):
                path = os.path.join(place, name)
                if name.lower().endswith(tuple("." + e + ".gz" for e in EXTENSIONS)):
                    path = os.path.join(folder, f"{len(os.listdir(folder))}-{name[:-3]}")
                    with gzip.open(os.path.join(place, name)) as packed, open(path, "wb") as file:
                        file.write(packed.read())
                    for beside in glob.glob(os.path.join(place, "*.dat")):  # what it may refer to
                        shutil.copy(beside, folder)
                if path.lower().endswith(tuple("." + e for e in EXTENSIONS)):
                    yield path


def compare(path, row, scratch):
    """Counts the file in its format's row; whether it is read as others read it."""
    extension = path.lower().rsplit(".", 1)[1]
    ours, why = attempt(read_by_brushfire, path, scratch)
    others = {name: apart(read, path) for name, (read, kinds) in OTHERS.items() if extension in kinds.split()}
    same = [name for name, (found, _) in others.items() if found and ours and agree(ours, found, extension)]
    differ = {name: found for name, (found, _) in others.items() if found and name not in same}
    row["files"] += 1
    row["read"] += ours is not None
    row["two or more agree"] += len(same) >= 2
    row["one agrees"] += len(same) == 1
    row["one differs"] += ours is not None and bool(differ)
    if ours is None or differ or len(same) < 2:
        short = {n: (*map(int, f[:2]), float(f"{f[2]:.6g}")) for n, f in differ.items()}
        print(f"{os.path.relpath(path, '/')}: {ours or why}; agree: {', '.join(same) or 'none'}; differ: {short or 'none'}; "
              f"fail: {({n: e for n, (f, e) in others.items() if f is None}) or 'none'}")
    both = list(differ.values())
    alike = any(agree(a, b, extension) for i, a in enumerate(both) for b in both[:i])
    return bool(same) or not (alike or (ours and differ))


def main():
    table = collections.defaultdict(collections.Counter)
    gmsh.initialize(["-v", "0"])
    pyvista.set_error_output_file(os.devnull)
    with tempfile.TemporaryDirectory() as folder:
        written, files = os.path.join(folder, "written"), os.path.join(folder, "files")
        os.mkdir(written)
        os.mkdir(files)
        write_files(written)
        packages = [os.path.join(sysconfig.get_path("purelib"), p) for p in
                    ("nilearn", "nibabel", "pyvista", "pymeshfix", "pymeshlab", "trimesh", "meshio")]
        tops = [*packages, os.path.join(sys.prefix, "share"), written, *sys.argv[3:]]
        wrong = [p for p in collect(files, tops) if not compare(p, table[p.lower().rsplit(".", 1)[1]], os.path.join(folder, "out"))]
    columns = ["files", "read", "two or more agree", "one agrees", "one differs"]
    print("\n| | " + " | ".join(columns) + " |\n|" + " --- |" * (len(columns) + 1))
    total = sum(table.values(), collections.Counter())
    for name, row in [*((e, table[e]) for e in EXTENSIONS if e in table), ("all", total)]:
        print(f"| {name} | " + " | ".join(str(row[c] or "") for c in columns) + " |")
    print(f"{len(wrong)} read unlike others: {wrong}")
    return 1 if wrong else 0


probe = os.path.abspath(sys.argv[1])
with contextlib.suppress(BrokenPipeError):
    sys.exit(main())
