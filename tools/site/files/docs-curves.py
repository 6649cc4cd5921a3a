"""The files that the page speaks of."""

import numpy as np
from files.cortex import write_cortex

import brushfire as bf

write_cortex()
mesh = bf.read("scan.ply")
near = mesh.distance(17) < 2
open_mesh = bf.Mesh(mesh.vertices, mesh.faces[near[mesh.faces].all(axis=1)])
open_mesh.save("part.stl")
open_mesh.save("scan.ply")
bf.write("drawn.obj", open_mesh.path(17, int(np.flatnonzero(near)[-1])))
with open("a.annot", "wb") as file, open("lh.aparc.annot", "rb") as other:
    file.write(other.read())
