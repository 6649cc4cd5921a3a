"""The wheel of this machine's own Python, with the system's libraries that it links put in by auditwheel."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import tempfile
import venv
import zipfile
from pathlib import Path

from common import DIST, FIRST_STEPS, SCRATCH, run


def wheel(of_sdist: Path) -> tuple[Path, list[Path]]:
    """Made of the sdist, so that what it lacks is missed; and the system's libraries that are now in it."""
    SCRATCH.mkdir(parents=True, exist_ok=True)
    with tarfile.open(of_sdist) as archive:
        archive.extractall(SCRATCH / "native", filter="data")
    sources = SCRATCH / "native" / of_sdist.name.removesuffix(".tar.gz")
    # The compiler cache then knows the objects of ./run python: the same flags in a folder as deep.
    run(sys.executable, "-m", "pip", "wheel", "--disable-pip-version-check", "--no-deps", "-w", SCRATCH / "native",
        "--config-settings=cmake.define.BRUSHFIRE_WERROR=ON", sources,
        CCACHE_BASEDIR=str(sources), CCACHE_NOHASHDIR="1", CXX=os.environ.get("CXX", "c++"))  # fmt: skip
    raw = next((SCRATCH / "native").glob("*.whl"))
    with zipfile.ZipFile(raw) as archive:
        archive.extractall(SCRATCH / "native/wheel")
    module = next((SCRATCH / "native/wheel").rglob("_core*.so"))
    needed = re.findall(r"=> (\S+)", run("ldd", module))
    run(sys.executable, "-m", "auditwheel", "repair", "--strip", "-w", DIST, raw)
    repaired = max(DIST.glob("*.whl"), key=lambda file: file.stat().st_mtime)
    with zipfile.ZipFile(repaired) as archive:
        stems = {re.split(r"-[0-9a-f]{8}", Path(name).name)[0] for name in archive.namelist() if ".libs/" in name}
    return repaired, [Path(path) for path in needed if any(Path(path).name.startswith(stem) for stem in stems if stem)]


def owner(library: Path) -> str:
    """Debian's package of a file."""
    for path in (library, library.resolve(), Path("/usr") / library.relative_to("/")):
        done = subprocess.run(["dpkg", "-S", path], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    raise SystemExit(f"no package owns {library}")


def try_out(file: Path) -> None:
    """Where there is no compiler to fall back on, and nothing else of ours."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        venv.create(folder / "venv", with_pip=True)
        python = folder / "venv/bin/python"
        run(python, "-m", "pip", "install", "--disable-pip-version-check", "--only-binary", ":all:", file,
            CC="false", CXX="false")  # fmt: skip
        print(run(python, "-c", FIRST_STEPS, cwd=folder))
