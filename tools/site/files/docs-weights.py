"""The files that the page speaks of."""

import subprocess

import numpy as np

import brushfire as bf

subprocess.run(["brushfire", "shape", "terrain", "-n", "1000", "-o", "terrain.ply", "--quiet"], check=True)
land = bf.read("terrain.ply")
np.save("friction.npy", 1 + (np.arange(land.face_count) % 3))
with open("roads.txt", "w") as file:
    file.writelines(f"{a} {b} 0.5\n" for a, b, _ in np.array(land.faces)[:20])
# A grid of heights, and the heights themselves, which the page reads as terrain.ply from there on.
rows, columns = np.mgrid[:80, :80]
heights = 15 * np.sin(columns / 9) * np.cos(rows / 11)
with open("dem.asc", "w") as file:
    file.write("ncols 80\nnrows 80\nxllcorner 0\nyllcorner 0\ncellsize 10\n")
    np.savetxt(file, heights, fmt="%.3f")
