"""The files that the page's commands speak of, beside scan.ply."""

import runpy
from pathlib import Path

import numpy as np

import brushfire as bf

runpy.run_path(str(Path(__file__).with_name("README.py")))
mesh = bf.read("scan.ply")
mesh.save("part.ply")
mesh.save("plan.ply")
np.save("rooms.npy", (np.arange(mesh.face_count) < 3).astype(np.uint8))
