"""Figures and numbers of docs/applications.md: python benchmarks/applications.py SCAN.ply [--figures FOLDER]

SCAN is any mesh of some ten thousand vertices; the figures in the documentation show the Stanford bunny.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

import brushfire as bf

EXAMPLES = Path(__file__).parents[1] / "examples" / "python"
sys.path.insert(0, str(EXAMPLES))
LOOK = {"width": 420, "height": 420, "colour_bar": False}


def disc(mesh, place, radius):
    """The part of a surface within a radius of a vertex."""
    near = mesh.distance(place, radius=radius) < radius
    faces = mesh.faces[near[mesh.faces].all(axis=1)]
    used, faces = np.unique(faces, return_inverse=True)
    return bf.Mesh(mesh.vertices[used], faces.reshape(-1, 3))


def grid_lines(mesh, uv, every):
    return [line for k in (0, 1) for line in mesh.isolines(uv[:, k] - uv[:, k].min(), every=every)]


def draw_flattening(scan, folder):
    size = np.linalg.norm(np.ptp(scan.vertices, axis=0))
    part = disc(scan, int(np.argmax(scan.vertices[:, 2])), size / 5)
    flat = bf.flatten(part, 150)
    plane = bf.Mesh(flat.uv, flat.mesh.faces)
    every = np.ptp(flat.uv, axis=0).max() / 16
    d = flat.mesh.distance(int(flat.landmarks[0]))
    panels = [
        flat.mesh.panel(d, paths=grid_lines(flat.mesh, flat.uv, every), title="a texture's squares on the scan"),
        plane.panel(d, paths=grid_lines(plane, flat.uv, every), title="laid flat; colours: a distance"),
    ]
    bf.render(panels, file=folder / "flattening.png", **LOOK)
    print(f"flattening.png: {part}, {flat.distortion}")


def draw_reeb(folder):
    from shape_search import collection

    panels = []
    for name in ("caterpillar, pose 2", "peanut, pose 1", "ring"):
        graph = bf.reeb_graph(collection[name], 3)
        panels.append(collection[name].panel(labels=graph.node % 12, title=f"{name}: {len(graph.interval)} nodes"))
    bf.render(panels, file=folder / "reeb.png", **LOOK)


def draw_morph(folder):
    import morph

    panels = []
    for patches in morph.found:
        lines = [patches.mesh.path(*way) for way in patches.paths.values()]
        panels.append(patches.mesh.panel(labels=_of_vertices(patches), paths=lines, title="patches"))
    half = bf.Mesh((morph.V0 + morph.V1) / 2, morph.F)
    panels.insert(1, half.panel(half.distance(0), isolines=np.linspace(0, 4, 21), title="half way"))
    bf.render(panels, file=folder / "morph.png", **LOOK)


def _of_vertices(patches):
    labels = np.zeros(patches.mesh.vertex_count, dtype=int)
    for k in range(3):
        labels[patches.mesh.faces[:, k]] = patches.patch
    return labels


def draw_gradient(scan, folder):
    field = scan.distance_vjp(0)
    pull = np.linalg.norm(field.vjp(np.ones(scan.vertex_count)).vertices, axis=1)
    panels = [
        scan.panel(field.distance / field.distance.max(), isolines=np.linspace(0, 1, 25), title="distances"),
        scan.panel(np.log10(pull + 1) / np.log10(pull.max() + 1), title="their sum, by vertex (log of the rate)"),
    ]
    bf.render(panels, file=folder / "gradient.png", **LOOK)


def best(function, rounds=5):
    """CPU seconds: what other programs take on the machine does not count."""
    times = []
    for _ in range(rounds):
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def measure_gradient(scan):
    forward = best(lambda: scan.distance(0, method="exact"))
    kept = scan.distance_vjp(0)
    backward = best(lambda: kept.vjp(np.ones(scan.vertex_count)))
    whole = best(lambda: scan.distance_vjp(0).vjp(np.ones(scan.vertex_count)))
    print(
        f"derivatives, {scan}: forward {1e3 * forward:.0f} ms, backward {1e3 * backward:.0f} ms "
        f"({backward / forward:.1f} times), both {1e3 * whole:.0f} ms"
    )


def measure_rows(rows=200):
    """Rows of the matrix of a mesh as large as those of the FAUST set."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        from subprocess import run

        file = Path(folder) / "s.ply"
        program = Path(__file__).parents[1] / "build" / "release" / "brushfire"
        run([program, "shape", "torus", "-n", "6890", "-o", file, "-q"], check=True)
        mesh = bf.read(file)
    some = np.arange(rows)
    for method in ("exact", "windows", "novotni-klein", "dijkstra"):
        seconds = best(lambda method=method: mesh.distance_matrix(some, method=method, threads=1), 3)
        print(f"rows, {mesh}: {method} {rows / seconds:.0f} a second")
    try:
        import gdist
    except ImportError:
        print("(no gdist here)")
    else:
        f = mesh.faces.astype(np.int32)
        seconds = best(lambda: [gdist.compute_gdist(mesh.vertices, f, np.array([s], np.int32)) for s in range(3)], 1)
        print(f"rows: gdist (exact) {3 / seconds:.2f} a second")
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import dijkstra

    ends = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    length = np.linalg.norm(mesh.vertices[ends[:, 0]] - mesh.vertices[ends[:, 1]], axis=1)
    graph = csr_matrix((length, (ends[:, 0], ends[:, 1])), shape=(mesh.vertex_count,) * 2)
    seconds = best(lambda: dijkstra(graph, directed=False, indices=some), 1)
    print(f"rows: scipy's dijkstra (along edges) {rows / seconds:.0f} a second")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scan", type=Path)
    parser.add_argument("--figures", type=Path)
    given = parser.parse_args()
    scan = bf.read(given.scan)
    measure_gradient(scan)
    measure_rows()
    if given.figures:
        draw_flattening(scan, given.figures)
        draw_gradient(scan, given.figures)
        draw_reeb(given.figures)
        draw_morph(given.figures)
