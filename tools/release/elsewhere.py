"""Wheels of other machines, used as if on these: aarch64 by qemu in a Debian of that kind, Windows by wine, musl in a Python of
its own.

pip chooses and unpacks for the platform that it is told of, so a wheel's tags are tried, too. Values are the same bits on
every machine: what is computed is told by a digest, which has to be that of the wheels of this machine.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import musl
import pythons
from common import FIRST_STEPS, SCRATCH, run, say
from machine import MIRROR
from zig import Target

# Coordinates are whole numbers: no mathematical library has a say in them.
FIELDS = FIRST_STEPS + """
import hashlib, pathlib, tempfile
import numpy as np
i, j = (a.ravel() for a in np.meshgrid(np.arange(40), np.arange(40)))
corner = (i + 40 * j)[(i < 39) & (j < 39)]
faces = np.concatenate([np.stack(t, 1) for t in ((corner, corner + 1, corner + 41), (corner, corner + 41, corner + 40))])
mesh = bf.Mesh(np.stack([i, j, (i * 7 + j * 13 + i * j) % 5], 1).astype(float), faces)
told = hashlib.sha256()
for method in ("windows", "exact", "carried-source", "novotni-klein", "kimmel-sethian", "dijkstra"):
    told.update(mesh.distance([0, 777], method=method, threads=2).tobytes())
told.update(np.asarray(mesh.path(0, 1599).positions).tobytes())
with tempfile.TemporaryDirectory() as folder:
    for name in ("a.ply", "a.vtp", "a.gii"):
        file = pathlib.Path(folder) / name
        values = () if name == "a.gii" else (mesh.distance(0),)  # of values GIFTI makes a file without a surface
        mesh.save(file, *values)
        mesh.save(file, *values)
        assert (bf.read(file).faces == mesh.faces).all()
        told.update(np.asarray(bf.read(file).vertices).tobytes())
    assert len(list(pathlib.Path(folder).iterdir())) == 3
print("fields:", told.hexdigest()[:16])
"""


def site(target: Target, minor: str, wheel: Path) -> Path:
    """The wheel and numpy, as pip on that machine would choose them; for wine, whose C library lacks what numpy 2.4 asks of
    it (crealf), an older one."""
    folder = SCRATCH / target.name / f"site-{minor}"
    shutil.rmtree(folder, ignore_errors=True)
    platforms = [word for tag in target.wheel.split(".") for word in ("--platform", tag)]
    newer = ["--platform", "manylinux_2_28_aarch64"] if target.wheel.startswith("manylinux") else []  # numpy's
    older = ["numpy<2"] if target.system == "Windows" else []
    run(sys.executable, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--only-binary", ":all:", "--target", folder,
        "--implementation", "cp", "--python-version", minor, *platforms, *newer, *older, wheel)  # fmt: skip
    return folder


def debian(architecture: str, release: str) -> Path:
    """A Debian of another processor with its Python, unpacked and not set up: enough for one program that is emulated."""
    folder = SCRATCH / f"debian-{release}-{architecture}"
    if not (folder / "unpacked").exists():
        shutil.rmtree(folder, ignore_errors=True)
        run("debootstrap", "--foreign", f"--arch={architecture}", "--variant=minbase", "--include=python3", release, folder, MIRROR)
        for package in sorted(folder.glob("var/cache/apt/archives/*.deb")):
            run("sh", "-ec", 'dpkg-deb --fsys-tarfile "$1" | tar -x --keep-directory-symlink -C "$2"', "sh", package, folder)
        (folder / "unpacked").touch()
    return folder


def by_qemu(target: Target, minor: str, wheel: Path) -> str | None:
    emulator = shutil.which(f"qemu-{target.processor}-static")
    if not emulator or not shutil.which("debootstrap"):
        say("(aarch64 is tried by qemu in a Debian of its own: qemu-user-static, debootstrap)")
        return None
    if minor == "3.11":
        root, program = debian("arm64", "bookworm"), "python3.11"
    else:  # a later version than the one that it was built for
        root, minor = debian("arm64", "trixie"), "3.13"
        program = "python3.13"
    said = run(emulator, "-L", root, root / "usr/bin" / program, "-c", FIELDS,
               PYTHONPATH=str(site(target, minor, wheel)), PYTHONHOME=str(root / "usr"))  # fmt: skip
    return f"by qemu, in {program}: {said}"


def by_musl(target: Target, minor: str, wheel: Path) -> str | None:
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        say("(musl is tried in a Python that is compiled in a Debian of its own: root, debootstrap)")
        return None
    minor = minor if minor == "3.11" else "3.13"  # a later version than the one that it was built for
    loader, program = musl.python(minor)
    return f"by musl, in python {minor}: {run(loader, program, '-c', FIELDS, PYTHONPATH=str(site(target, minor, wheel)))}"


def by_wine(target: Target, minor: str, wheel: Path) -> str | None:
    wine = shutil.which("wine64") or shutil.which("wine") or shutil.which("wine64", path="/usr/lib/wine")
    if not wine:
        say("(Windows is tried by wine: wine64)")
        return None
    python = pythons.from_maven(minor, "windows")
    pythons.forwarding_dll(python, minor)
    place = {"WINEPREFIX": str(SCRATCH / "wine"), "WINEDEBUG": "-all", "PYTHONHOME": f"Z:{python}",
             "PYTHONPATH": f"Z:{site(target, minor, wheel)};Z:{python}\\lib", "PYTHONUTF8": "1"}  # fmt: skip
    done = subprocess.run([wine, python / "python.exe", "-"], input=FIELDS, env=os.environ | place, capture_output=True,
                          text=True, check=False, timeout=1200)  # fmt: skip
    if done.returncode:
        raise SystemExit(f"{wheel.name} by wine:\n{done.stdout}{done.stderr}")
    return f"by wine, in python {minor}: {done.stdout.strip()}"


def by_its_own(python: Path, wheel: Path) -> str:
    """On this machine."""
    folder = SCRATCH / "own"
    shutil.rmtree(folder, ignore_errors=True)
    run(python, "-m", "venv", folder)
    run(folder / "bin/python", "-m", "pip", "install", "-q", "--disable-pip-version-check", "--only-binary", ":all:", wheel,
        CC="false", CXX="false")  # fmt: skip
    return "here: " + run(folder / "bin/python", "-c", FIELDS, cwd=folder)
