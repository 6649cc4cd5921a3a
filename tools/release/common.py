"""What all parts of ./run release need: folders, commands that stop the release when they fail, the version."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
DIST = ROOT / "dist"
SCRATCH = ROOT / "build/dist"
VIEWER = ROOT / "web/dist-single/index.html"  # of `brushfire view`; ./run web builds it
FIRST_STEPS = """
import brushfire as bf
square = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
assert square.distance(0, method="exact").tolist() == [0, 3, 5, 4]
assert square.path(0, 2).length == 5
print("brushfire", bf.__version__, "computes")
"""


def run(*command: str | Path, cwd: Path = ROOT, **more: str) -> str:
    """Its output; where it fails, all of it and the end."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=os.environ | more, capture_output=True, text=True,
                          check=False)  # fmt: skip
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout.strip()


def say(*words: object) -> None:
    print(*words, file=sys.stderr, flush=True)


def interpreter(minor: str) -> Path | None:
    """A Python of that version with its headers; those that are on the way come first."""
    found = [shutil.which(f"python{minor}"), *(Path.home() / ".pyenv/versions").glob(f"{minor}.*/bin/python{minor}")]
    for python in filter(None, found):
        done = subprocess.run([python, "-c", "import sysconfig, pathlib; p = sysconfig.get_path('include'); "
                               "assert (pathlib.Path(p) / 'Python.h').exists(); print(p)"],
                              capture_output=True, text=True, check=False)  # fmt: skip
        if done.returncode == 0:
            return Path(python)
    return None


def version() -> str:
    """That of CMakeLists.txt; where else one is stated it has to be the same."""
    stated = {
        "CMakeLists.txt": re.search(r"project\(brushfire VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
        "js/package.json": json.loads((ROOT / "js/package.json").read_text())["version"],
        "CITATION.cff": re.search(r"^version: (\S+)", (ROOT / "CITATION.cff").read_text(), re.MULTILINE)[1],
        "debian/changelog": re.match(r"brushfire \(([0-9.]+)-", (ROOT / "debian/changelog").read_text())[1],
    }
    if len(set(stated.values())) != 1:
        raise SystemExit(f"versions differ: {stated}")
    return stated["CMakeLists.txt"]


def commit_date() -> str:
    return run("git", "log", "-1", "--format=%ct")
