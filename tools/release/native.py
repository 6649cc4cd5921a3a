"""Wheels of this machine's own Pythons, with the system's libraries that they link put in by auditwheel."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

from common import DIST, FIRST_STEPS, SCRATCH, interpreter, run


def pythons() -> list[Path]:
    """This machine's own, and one whose wheel serves every later version, where there is one."""
    return [Path(sys.executable), *filter(None, [interpreter("3.12")])]


def wheel(of_sdist: Path, python: Path) -> tuple[Path, list[Path]]:
    """Made of the sdist, so that what it lacks is missed; and the system's libraries that are now in it."""
    folder = SCRATCH / "native"
    shutil.rmtree(folder, ignore_errors=True)
    with tarfile.open(of_sdist) as archive:
        archive.extractall(folder, filter="data")
    sources = folder / of_sdist.name.removesuffix(".tar.gz")
    # The compiler cache then knows the objects of ./run python: the same flags in a folder as deep.
    run(python, "-m", "pip", "wheel", "--disable-pip-version-check", "--no-deps", "-w", folder,
        "--config-settings=cmake.define.BRUSHFIRE_WERROR=ON", sources,
        CCACHE_BASEDIR=str(sources), CCACHE_NOHASHDIR="1", CXX=os.environ.get("CXX", "c++"))  # fmt: skip
    raw = next(folder.glob("*.whl"))
    with zipfile.ZipFile(raw) as archive:
        archive.extractall(folder / "wheel")
    needed = re.findall(r"=> (\S+)", run("ldd", next((folder / "wheel").rglob("_core*.so"))))
    run(sys.executable, "-m", "auditwheel", "repair", "--strip", "-w", folder / "audited", raw)
    repaired = next((folder / "audited").glob("*.whl"))
    with zipfile.ZipFile(repaired) as archive:
        stems = {re.split(r"-[0-9a-f]{8}", Path(name).name)[0] for name in archive.namelist() if ".libs/" in name}
    shutil.copy(repaired, DIST)
    return DIST / repaired.name, [Path(path) for path in needed if any(Path(path).name.startswith(s) for s in stems if s)]


def owner(library: Path) -> str:
    """Debian's package of a file."""
    for path in (library, library.resolve(), Path("/usr") / library.relative_to("/")):
        done = subprocess.run(["dpkg", "-S", path], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    raise SystemExit(f"no package owns {library}")


def try_out(file: Path, with_python: Path) -> None:
    """Where there is no compiler to fall back on, and nothing else of ours."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(with_python, "-m", "venv", folder / "venv")
        python = folder / "venv/bin/python"
        run(python, "-m", "pip", "install", "--disable-pip-version-check", "--only-binary", ":all:", file,
            CC="false", CXX="false")  # fmt: skip
        print(run(python, "-c", FIRST_STEPS, cwd=folder))
