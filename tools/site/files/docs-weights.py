"""The files that the page speaks of."""

import subprocess

import numpy as np

import brushfire as bf

subprocess.run(["brushfire", "shape", "terrain", "-n", "1000", "-o", "terrain.ply", "--quiet"], check=True)
land = bf.read("terrain.ply")
np.save("friction.npy", 1 + (np.arange(land.face_count) % 3))
with open("roads.txt", "w") as file:
    file.writelines(f"{a} {b} 0.5\n" for a, b, _ in np.array(land.faces)[:20])
rows, columns = 70, 80
y, x = np.mgrid[0:rows, 0:columns]
heights = 30 * np.sin(x / 9) * np.cos(y / 7)
with open("dem.asc", "w") as file:
    file.write(f"ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n")
    np.savetxt(file, heights, fmt="%.2f")
