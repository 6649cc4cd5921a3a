"""Distances on the cortex that do not pass through the medial wall, on fsaverage5 as it comes with nilearn.

pip install nibabel nilearn
"""

import importlib.util
from pathlib import Path

import nibabel
import numpy as np

import brushfire as bf

folder = Path(importlib.util.find_spec("nilearn").submodule_search_locations[0]) / "datasets/data/fsaverage5"
whole = bf.from_any(nibabel.load(folder / "pial_left.gii.gz"))
cortex = nibabel.load(folder / "thick_left.gii.gz").agg_data() > 0  # the medial wall has no thickness
print(f"{whole}: {np.count_nonzero(~cortex)} vertices in the medial wall")

# A face is open where its three vertices are. Vertices keep their numbers; those of the wall read +inf.
mesh = whole.masked(cortex)
seed = int(np.flatnonzero(cortex)[0])
through = whole.distance(seed, method="exact")
around = mesh.distance(seed, method="exact")
reached = np.isfinite(around)
longer = around[reached] - through[reached]
print(f"from vertex {seed}: {np.count_nonzero(reached)} reached, {np.count_nonzero(longer > 1e-6)} of them are farther")
print(f"away when the wall is closed, by {longer.max():.1f} mm at most")

near = mesh.distances_within(10.0, np.flatnonzero(cortex)[::20], method="exact")
print(f"{near.nnz / near.shape[0]:.0f} vertices within 10 mm of a cortical vertex on average")
