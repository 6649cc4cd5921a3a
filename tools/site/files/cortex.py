"""A cortex that is none, in FreeSurfer's and GIFTI's files: a dented sphere in millimetres with a medial wall."""

import nibabel
import numpy as np

import brushfire as bf


def write_cortex() -> None:
    scan = bf.read("scan.ply")
    V, F = 60 * np.array(scan.vertices), np.array(scan.faces)
    mesh = bf.Mesh(V, F)
    mesh.save("cortex.gii")
    nibabel.freesurfer.write_geometry("lh.white", V, F)
    wall = mesh.distance(int(V[:, 0].argmin()), radius=20.0) < np.inf
    labels = 1 + mesh.voronoi(mesh.farthest_points(6).vertices).source
    names = ["unknown", "precentral", "postcentral", "insula", "cuneus", "lingual", "fusiform"]
    colours = np.array([[20 * k, 250 - 30 * k, 90 + 20 * k, 0, 0] for k in range(len(names))])
    nibabel.freesurfer.write_annot("lh.aparc.annot", np.where(wall, 0, labels), colours, names, fill_ctab=True)
    nibabel.freesurfer.write_morph_data("lh.thickness", np.where(wall, 0, 2.5 + 0.3 * np.sin(V[:, 1] / 9)))
    with open("seeds.txt", "w") as file:
        file.writelines(f"{v}\n" for v in np.flatnonzero(labels == 1)[[0, -1]])
    open_vertices = np.flatnonzero(~wall)
    with open("cortex.label", "w") as file:
        file.write(f"#!ascii label\n{len(open_vertices)}\n")
        file.writelines(f"{v} {V[v, 0]:.3f} {V[v, 1]:.3f} {V[v, 2]:.3f} 0.0\n" for v in open_vertices)
