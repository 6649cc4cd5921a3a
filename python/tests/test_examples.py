"""Every example runs and says what it is meant to say."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"
EXPECTED = {
    "cortex.py": r"\d+ vertices in the medial wall.*mm at most",
    "distance.py": r"farthest from vertex 0: vertex \d+ at .*two targets.*novotni-klein ",
    "farthest_points.py": r"sample: \[0, \d+.*within \d\.\d+.*covering radius",
    "flattening.py": r"become 8\d\d.*stress 0\.[01].*uv\.glb: \d+ bytes.*middle \[0\.5, 0\.5\]",
    "isolines.py": r"curves at \d+ levels.*along the arcs.*picture of \d+ x \d+",
    "many_meshes.py": r"pose3\.npy: 288 x 288 float32.*mean geodesic error 0\.0",
    "morph.py": r"8 patches, 12 paths.*0 paths without room.*one connectivity for both: True",
    "path.py": r"length (\d+\.\d+).*pieces \1, distance field \1.*\(length\).*pulled straight",
    "shape_search.py": r"caterpillar, pose 1: 0 loop\(s\); nearest caterpillar.*ring: 1 loop",
    "sparse_matrix.py": r"1800 rows.*symmetric to [\d.]+e-1[0-9].*\(1800, 1800\)",
    "surface_fit.py": r"misfit \d\d\.\d\d, fitted 0\.0.*heights off by 0\.1",
}


def test_every_example_is_tested():
    assert {p.name for p in EXAMPLES.glob("*.py")} == set(EXPECTED) | {"shapes.py"}


@pytest.mark.parametrize("name", EXPECTED)
def test_example(name):
    if name == "cortex.py" and not all(importlib.util.find_spec(m) for m in ("nilearn", "nibabel")):
        pytest.skip("nilearn and nibabel are not installed")
    ended = subprocess.run([sys.executable, EXAMPLES / name], check=False, capture_output=True, text=True, timeout=120)
    assert ended.returncode == 0, ended.stderr
    assert re.search(EXPECTED[name], ended.stdout, re.DOTALL), ended.stdout
