"""Source tarball, sdist and npm tarball: what others build from. Of one commit the same bytes each time."""

from __future__ import annotations

import gzip
import shutil
import subprocess
import sys
from pathlib import Path

from common import DIST, ROOT, run, say, version


def source_tarball() -> Path:
    """What git knows of the commit, and nothing that only lies about."""
    name = f"brushfire-{version()}"
    file = DIST / f"{name}-source.tar.gz"
    tar = subprocess.run(["git", "archive", f"--prefix={name}/", "HEAD"], cwd=ROOT, check=True, capture_output=True).stdout
    with file.open("wb") as raw, gzip.GzipFile(filename="", mode="wb", fileobj=raw, mtime=0) as packed:
        packed.write(tar)
    return file


def sdist() -> Path:
    run(sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", DIST)
    return DIST / f"brushfire-{version()}.tar.gz"


def npm_tarball() -> Path | None:
    """Where ./run web has built what it holds."""
    if not (ROOT / "js/lib/brushfire.wasm").exists() or not shutil.which("npm"):
        say("(no npm tarball: ./run web builds what it holds)")
        return None
    run("npm", "pack", "--pack-destination", DIST, cwd=ROOT / "js")
    return DIST / f"brushfire-{version()}.tgz"
