"""The files that the page speaks of."""

import subprocess

import numpy as np

import brushfire as bf

subprocess.run(["brushfire", "shape", "terrain", "-n", "1000", "-o", "terrain.ply", "--quiet"], check=True)
land = bf.read("terrain.ply")
np.save("friction.npy", 1 + (np.arange(land.face_count) % 3))
with open("roads.txt", "w") as file:
    file.writelines(f"{a} {b} 0.5\n" for a, b, _ in np.array(land.faces)[:20])
