"""Times one peer on one mesh: the counterpart of time_solver.cpp, with the same arguments and the same answers.

    python peer.py VERTICES FACES SOURCE PEER [DISTANCES]

One round per line of input: build the peer's own mesh from the arrays, solve, solve again with what is built; one line
of JSON with first_s, set_up_s and solve_s in seconds of processor time. Where the peer's interface has no set-up of its
own, everything is in the solve. Converting the arrays to the number type that the peer wants is not counted.
"""

import json
import sys
from functools import partial
from time import process_time

import numpy as np


class MeshLib:
    """MeshLib, computeSurfaceDistances: fast marching in float."""

    def __init__(self, vertices, faces):
        import meshlib.mrmeshnumpy as arrays
        import meshlib.mrmeshpy as meshlib

        self.arrays, self.meshlib = arrays, meshlib
        self.vertices, self.faces = vertices, faces

    def set_up(self):
        self.mesh = self.arrays.meshFromFacesVerts(self.faces, self.vertices)

    def solve(self, source):
        start = self.meshlib.VertBitSet()
        start.resize(len(self.vertices))
        start.set(self.meshlib.VertId(source))
        return self.meshlib.computeSurfaceDistances(self.mesh, start)

    def distances(self, result):
        return np.array(list(result.vec), dtype=np.float64)


class PyMeshLab:
    """MeshLab's geodesic filter (VCG): Novotni-Klein trilateration, label-correcting."""

    def __init__(self, vertices, faces):
        import pymeshlab

        self.pymeshlab, self.vertices, self.faces = pymeshlab, vertices, faces

    def set_up(self):
        self.meshes = self.pymeshlab.MeshSet()
        self.meshes.add_mesh(self.pymeshlab.Mesh(self.vertices, self.faces))

    def solve(self, source):
        self.meshes.compute_scalar_by_geodesic_distance_from_given_point_per_vertex(
            startpoint=self.vertices[source], maxdistance=self.pymeshlab.PureValue(1e30)
        )

    def distances(self, _):
        return self.meshes.current_mesh().vertex_scalar_array()


class GeometryCentralMarching:
    """geometry-central's FMMDistance through potpourri3d: Kimmel-Sethian."""

    def __init__(self, vertices, faces):
        import potpourri3d

        self.potpourri3d, self.vertices, self.faces = potpourri3d, vertices, faces

    def set_up(self):
        self.solver = self.potpourri3d.MeshFastMarchingDistanceSolver(self.vertices, self.faces)

    def solve(self, source):
        return self.solver.compute_distance([[(source, [])]])

    def distances(self, result):
        return result


class GeometryCentralHeat(GeometryCentralMarching):
    """geometry-central's heat method through potpourri3d, factorised once."""

    def set_up(self):
        self.solver = self.potpourri3d.MeshHeatMethodDistanceSolver(self.vertices, self.faces, use_robust=False)

    def solve(self, source):
        return self.solver.compute_distance(source)


class PyGeodesic:
    """Kirsanov's exact MMP code through pygeodesic."""

    def __init__(self, vertices, faces):
        import pygeodesic.geodesic

        self.pygeodesic, self.vertices, self.faces = pygeodesic.geodesic, vertices, faces

    def set_up(self):
        self.solver = self.pygeodesic.PyGeodesicAlgorithmExact(self.vertices, self.faces)

    def solve(self, source):
        return self.solver.geodesicDistances(np.array([source]), None)[0]

    def distances(self, result):
        return result


class Gdist:
    """Kirsanov's exact MMP code through tvb-gdist: one call does everything."""

    def __init__(self, vertices, faces):
        import gdist

        self.gdist, self.vertices, self.faces = gdist, vertices, faces

    def set_up(self):
        pass

    def solve(self, source):
        return self.gdist.compute_gdist(self.vertices, self.faces, np.array([source], dtype=np.int32))

    def distances(self, result):
        return result


class Igl:
    """igl.exact_geodesic: Kirsanov's code once more, and a path traced to every target."""

    def __init__(self, vertices, faces):
        import igl

        self.igl, self.vertices, self.faces = igl, vertices, faces.astype(np.int64)

    def set_up(self):
        pass

    def solve(self, source):
        targets = np.arange(len(self.vertices), dtype=np.int64)
        return self.igl.exact_geodesic(self.vertices, self.faces, np.array([source], dtype=np.int64), VT=targets)

    def distances(self, result):
        return result


class PyVista:
    """VTK's Dijkstra over edges, which pyvista's geodesic() runs: distances along edges."""

    def __init__(self, vertices, faces):
        import pyvista

        self.pyvista, self.vertices = pyvista, vertices
        self.cells = np.column_stack([np.full(len(faces), 3), faces]).ravel()

    def set_up(self):
        self.mesh = self.pyvista.PolyData(self.vertices, self.cells)

    def solve(self, source):
        from vtkmodules.vtkFiltersModeling import vtkDijkstraGraphGeodesicPath

        self.path = vtkDijkstraGraphGeodesicPath()
        self.path.SetInputData(self.mesh)
        self.path.SetStartVertex(source)
        self.path.SetEndVertex((source + 1) % self.mesh.n_points)
        self.path.StopWhenEndReachedOff()
        self.path.Update()

    def distances(self, _):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkDoubleArray

        weights = vtkDoubleArray()
        self.path.GetCumulativeWeights(weights)
        return vtk_to_numpy(weights)


class Brushfire:
    """This library through its Python package, by one of its methods."""

    def __init__(self, vertices, faces, **options):
        import brushfire

        self.brushfire, self.options = brushfire, options
        self.vertices, self.faces = vertices, faces

    def set_up(self):
        self.solver = self.brushfire.Mesh(self.vertices, self.faces).solver()
        self.solver.distance(0, radius=0, **self.options)  # builds all, reaches the source

    def solve(self, source):
        return self.solver.distance(source, **self.options)

    def distances(self, result):
        return result


PEERS = {
    "brushfire": Brushfire,
    "brushfire-exact": partial(Brushfire, method="exact"),
    "brushfire-nk": partial(Brushfire, method="novotni-klein", precision="float64"),
    "brushfire-nk-float": partial(Brushfire, method="novotni-klein"),
    "meshlib": MeshLib,
    "pymeshlab": PyMeshLab,
    "gc-fmm": GeometryCentralMarching,
    "gc-heat": GeometryCentralHeat,
    "pygeodesic": PyGeodesic,
    "gdist": Gdist,
    "igl-exact": Igl,
    "pyvista": PyVista,
}


def memory_mib(key):
    """VmRSS: now; VmHWM: at most so far. (ru_maxrss includes the program that started this one.)"""
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(key)) / 1024


def main():
    vertices = np.fromfile(sys.argv[1], dtype="<f8").reshape(-1, 3)
    faces = np.fromfile(sys.argv[2], dtype="<i4").reshape(-1, 3)
    source = int(sys.argv[3])
    peer = PEERS[sys.argv[4]](vertices, faces)
    before, memory = memory_mib("VmRSS"), None
    for _ in sys.stdin:
        begin = process_time()
        peer.set_up()
        ready = process_time()
        result = peer.solve(source)
        first = process_time()
        if memory is None:
            memory = memory_mib("VmHWM") - before
            if len(sys.argv) > 5:
                np.asarray(peer.distances(result), dtype="<f8").tofile(sys.argv[5])
        solve = first - ready
        if solve < 5:  # the slow ones are not asked twice
            again = process_time()
            peer.solve(source)
            solve = process_time() - again
        times = {"first_s": first - begin, "set_up_s": ready - begin, "solve_s": solve, "memory_mib": memory}
        print(json.dumps(times), flush=True)


if __name__ == "__main__":
    main()
