"""The files that the README's commands speak of, beside scan.ply."""

import runpy
from pathlib import Path

import numpy as np
from files.cortex import write_cortex

import brushfire as bf

write_cortex()
mesh = bf.read("scan.ply")
np.save("heat.npy", mesh.distance(0, method="exact") * 1.005)
mesh.save("scan.obj")
with open("landmarks.txt", "w") as file:
    file.write("0\n300\n600@0.05  # starts later\n")
with open("seam.txt", "w") as file:
    file.writelines(f"{a} {b}\n" for a, b, _ in np.array(mesh.faces)[:5])
runpy.run_path(str(Path(__file__).with_name("docs-weights.py")))
