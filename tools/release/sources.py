"""Source tarball, sdist and npm tarball: what others build from. Of one commit the same bytes each time."""

from __future__ import annotations

import gzip
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from common import DIST, ROOT, VIEWER, commit_date, run, say, version


def source_tarball() -> Path:
    """What git knows of the commit, and nothing that only lies about."""
    name = f"brushfire-{version()}"
    file = DIST / f"{name}-source.tar.gz"
    tar = subprocess.run(["git", "archive", f"--prefix={name}/", "HEAD"], cwd=ROOT, check=True, capture_output=True).stdout
    with file.open("wb") as raw, gzip.GzipFile(filename="", mode="wb", fileobj=raw, mtime=0) as packed:
        packed.write(tar)
    return file


def sdist() -> Path:
    """From a folder that has what git knows and the viewer, no more: the walk over this one would follow the links of the
    machines in build/ to all of this machine's files."""
    with tempfile.TemporaryDirectory() as name:
        for file in [*run("git", "ls-files").splitlines(), *([VIEWER.relative_to(ROOT)] if VIEWER.exists() else [])]:
            copy = Path(name) / file
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / file, copy)
        run(sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", DIST, name)
    return DIST / f"brushfire-{version()}.tar.gz"


def npm_tarball() -> Path | None:
    """Where ./run web has built what it holds."""
    if not (ROOT / "js/lib/brushfire.wasm").exists() or not shutil.which("npm"):
        say("(no npm tarball: ./run web builds what it holds)")
        return None
    run("npm", "pack", "--pack-destination", DIST, cwd=ROOT / "js")
    return DIST / f"brushfire-{version()}.tgz"


def all_of_them() -> list[Path]:
    os.environ["SOURCE_DATE_EPOCH"] = commit_date()
    return [file for file in (source_tarball(), sdist(), npm_tarball()) if file]


def again(build: Callable[[], list[Path]]) -> None:
    """Builds twice, and says whether every byte is the same."""
    before = {file: hashlib.sha256(file.read_bytes()).hexdigest() for file in build()}
    for file in before:
        file.unlink()
    for file in build():
        same = hashlib.sha256(file.read_bytes()).hexdigest() == before[file]
        print(f"{file.name}: {'the same bytes' if same else 'DIFFERENT'}")
        if not same:
            raise SystemExit(1)
