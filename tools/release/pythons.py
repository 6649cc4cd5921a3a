"""The Pythons that wheels are built for: their headers, and on Windows what a module is linked with.

On Linux this machine's own. For macOS and Windows those that Maven Central hands out for Java programs
(org.bytedeco:cpython): whole Pythons, so that Windows' can be run by wine, too. There is none for Apple's own processors;
headers of the limited API are the same on both.
"""

from __future__ import annotations

import shutil
import zipfile
from pathlib import Path

from common import SCRATCH, interpreter, run
from zig import TARGETS, Target, zig

MAVEN = {"3.11": "3.11.3-1.5.9", "3.12": "3.12.1-1.5.10"}


def from_maven(minor: str, system: str) -> Path:
    """The unpacked folder of a Python of that version for `windows` or `macosx`, both of x86_64."""
    folder = SCRATCH / "pythons" / f"{minor}-{system}"
    if not folder.exists():
        if not shutil.which("mvn"):
            raise SystemExit(f"a Python {minor} for {system} comes from Maven Central, which mvn asks (Debian: maven)")
        jar = f"cpython-{MAVEN[minor]}-{system}-x86_64.jar"
        run("mvn", "-q", "-B", "dependency:copy", f"-Dartifact=org.bytedeco:cpython:{MAVEN[minor]}:jar:{system}-x86_64",
            f"-DoutputDirectory={folder.parent}")  # fmt: skip
        with zipfile.ZipFile(folder.parent / jar) as archive:
            archive.extractall(f"{folder}.part")
        (Path(f"{folder}.part") / "org/bytedeco/cpython" / f"{system}-x86_64").rename(folder)
        shutil.rmtree(f"{folder}.part")
    return folder


def forwarding_dll(python: Path, minor: str) -> None:
    """python3.dll, which modules of the stable ABI ask for and Maven's 3.12 lacks: each name of its import library is
    looked up in the version's own DLL."""
    made = python / "python3.dll"
    if made.exists():
        return
    archive = (python / "libs/python3.lib").read_bytes()
    member = archive[68 : 68 + int(archive[56:66])]  # the first: how many symbols, their places, their names
    count = int.from_bytes(member[:4], "big")
    symbols = {name.decode() for name in member[4 + 4 * count :].split(b"\0")[:count]}
    names = sorted(name.removeprefix("__imp_") for name in symbols if name.startswith("__imp_"))
    lines = [f"  {name} = python{minor.replace('.', '')}.{name}\n" for name in names]
    (python / "python3.def").write_text("LIBRARY python3\nEXPORTS\n" + "".join(lines))
    (python / "empty.c").write_text("int empty;\n")
    run(zig(), "cc", "-target", TARGETS["windows-x86_64"].triple, "-shared", "-o", made, python / "empty.c",
        python / "python3.def")  # fmt: skip


def options(target: Target, minor: str) -> list[str]:
    """CMake's, of a Python whose modules are built here and run on the target."""
    here = interpreter(minor)
    if here is None:
        raise SystemExit(f"{target.name}: no Python {minor} with headers here")
    if target.system == "Linux":
        include = Path(run(here, "-c", "import sysconfig; print(sysconfig.get_path('include'))"))
    elif target.system == "Darwin":
        include = from_maven(minor, "macosx") / f"include/python{minor}"
    else:
        include = from_maven(minor, "windows") / "include"
    found = [f"-DPython_EXECUTABLE={here}", f"-DPython_INCLUDE_DIR={include}"]
    if target.system == "Windows":
        libraries = include.parent / "libs"
        found += [f"-DPython_LIBRARY={libraries}/python{minor.replace('.', '')}.lib",
                  f"-DPython_SABI_LIBRARY={libraries}/python3.lib"]  # fmt: skip
    return found
