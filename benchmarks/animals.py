"""One base mesh traced on three animals, and morphs between them: python benchmarks/animals.py [--figure FILE.png]

The animals are those of CGAL's demonstrations (see meshes.py). Eight landmarks are found on each by where it reaches
farthest; twelve patches join them. Printed is what a consistent parameterisation is for: that no path lacks room, that
every patch is a disc, and that vertices of the common mesh lie on the animals, from which the morphs are made.
"""

import argparse

import meshes
import numpy as np

import brushfire as bf

AXES = {"cow": ("x", "y"), "camel": ("z", "y"), "triceratops": ("x", "y")}  # where they look, and up
NOSE, TAIL, BACK, BELLY, FORE_LEFT, FORE_RIGHT, HIND_LEFT, HIND_RIGHT = range(8)
BASE = [  # counter-clockwise from outside
    [BACK, NOSE, FORE_LEFT],
    [BACK, FORE_LEFT, HIND_LEFT],
    [BACK, HIND_LEFT, TAIL],
    [BACK, FORE_RIGHT, NOSE],
    [BACK, HIND_RIGHT, FORE_RIGHT],
    [BACK, TAIL, HIND_RIGHT],
    [BELLY, FORE_LEFT, NOSE],
    [BELLY, NOSE, FORE_RIGHT],
    [BELLY, FORE_RIGHT, HIND_RIGHT],
    [BELLY, HIND_RIGHT, TAIL],
    [BELLY, TAIL, HIND_LEFT],
    [BELLY, HIND_LEFT, FORE_LEFT],
]


def axis(name):
    return (-1 if name[0] == "-" else 1) * np.eye(3)["xyz".index(name[-1])]


def animal(name):
    """Looking along x, its left along y, z up; of length 1."""
    vertices, faces = meshes.arrays(name)
    ahead, up = (axis(a) for a in AXES[name])
    turned = vertices @ np.column_stack([ahead, np.cross(up, ahead), up])
    low, high = turned.min(axis=0), turned.max(axis=0)
    return bf.Mesh((turned - [low[0], (low[1] + high[1]) / 2, low[2]]) / (high - low)[0], faces)


def landmarks(mesh):
    x, y, z = mesh.vertices.T
    low = z < 0.12 * z.max()
    middle, side = (x[low].min() + x[low].max()) / 2, np.median(y[low])
    feet = []
    for fore in (True, False):
        for left in (True, False):
            foot = np.flatnonzero(low & ((x > middle) == fore) & ((y > side) == left))
            feet.append(foot[np.argmin(z[foot])])
    trunk = np.flatnonzero(np.abs(x - x[feet].mean()) < 0.25 * (x[feet[:2]].mean() - x[feet[2:]].mean()))
    back, belly = trunk[np.argmax(z[trunk])], trunk[np.argmin(z[trunk] + 3 * np.abs(y[trunk] - side))]
    return [int(v) for v in (np.argmax(x), np.argmin(x), back, belly, *feet)]


def euler_characteristic(faces):
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return len(np.unique(faces)) - len(np.unique(edges, axis=0)) + len(faces)


def told(name, patches):
    discs = sum(euler_characteristic(patches.mesh.faces[patches.patch == k]) == 1 for k in range(len(BASE)))
    inner = [v for way in patches.paths.values() for v in way[1:-1]]
    print(
        f"{name}: {patches}, {len(inner) - len(set(inner))} vertices on two paths, {discs} of {len(BASE)} patches are "
        f"discs, {len(patches.touching)} paths without room"
    )


def coloured(patches, title):
    """Vertices on borders once for each patch, so that colours end there."""
    corner = np.column_stack([np.repeat(patches.patch, 3), patches.mesh.faces.ravel()])
    pairs, index = np.unique(corner, axis=0, return_inverse=True)
    lines = [patches.mesh.path(*way) for way in patches.paths.values()]
    mesh = bf.Mesh(patches.mesh.vertices[pairs[:, 1]], index.reshape(-1, 3))
    return mesh.panel(labels=pairs[:, 0], paths=lines, title=title)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--figure")
    parser.add_argument("--finer", type=int, default=24, help="into how many pieces edges of the base mesh are cut")
    given = parser.parse_args()
    panels, common = [], []
    for name in AXES:
        mesh = animal(name)
        patches = bf.patches(mesh, landmarks(mesh), BASE)
        told(name, patches)
        common.append(patches.resample(given.finer))
        off = mesh.nearest(common[-1][0])[1].max()
        print(f"  {len(common[-1][0])} vertices of the common mesh, off the surface by {off:.1g} at most")
        panels.append(coloured(patches, name))
    for k in (1, 0):
        (a, faces), (b, same) = common[k], common[k + 1]
        assert (faces == same).all()
        half = bf.Mesh((a + b) / 2, faces)
        print(f"half way from {list(AXES)[k]} to {list(AXES)[k + 1]}: {half}, Euler characteristic {half.report.euler_characteristic}")
        panels.insert(k + 1, half.panel(title="half way"))
    if given.figure:
        bf.render(panels, file=given.figure, width=330, height=300, up="z", azimuth=35, elevation=15, bar=False)
