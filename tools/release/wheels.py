"""Wheels for machines that are not this one: the sdist compiled by zig, its libraries inside of the module.

A wheel is what scikit-build-core would make of the same sources: its metadata is asked of it. On Linux auditwheel says
whether the platform tag is kept. dist/BUILT.txt says which of them have been run, and which this machine cannot run.
"""

from __future__ import annotations

import base64
import hashlib
import platform
import re
import shutil
import sys
import tarfile
import time
import zipfile
from pathlib import Path

import elsewhere
import pythons
import third_party
from common import DIST, ROOT, SCRATCH, VIEWER, commit_date, interpreter, run, say, version
from zig import TARGETS, Target, cmake

HEADERS = ("boost", "fast_float", "nlohmann", "stb", "eigen3")
# The interpreter whose headers a build takes, and what its wheels are called. 3.12's stable ABI is that of all later ones.
FLAT_LOOKUP = -2  # the library of names that are looked for everywhere (BIND_SPECIAL_DYLIB_FLAT_LOOKUP)
PYTHONS = {"cp311": ("3.11", "cp311-cp311"), "abi3": ("3.12", "cp312-abi3")}


def unpacked_sdist() -> Path:
    """So that what the sdist lacks is missed."""
    folder = SCRATCH / f"brushfire-{version()}"
    with tarfile.open(DIST / f"brushfire-{version()}.tar.gz") as archive:
        for member in archive.getmembers():  # what has not changed keeps its date: nothing is compiled twice
            file = SCRATCH / member.name
            if member.isfile() and not (file.exists() and file.read_bytes() == archive.extractfile(member).read()):
                archive.extract(member, SCRATCH, filter="data")
    return folder


def link_headers(prefix: Path) -> None:
    """Of this machine's headers those that compile anywhere: its include folder as a whole would bring its C library along."""
    for name in HEADERS:
        link = prefix / "include" / name
        if not link.is_symlink():
            link.symlink_to(Path("/usr/include") / name)


def module_name(target: Target, abi: str) -> str:
    if target.system == "Windows":
        return "_core.pyd" if abi == "abi3" else "_core.cp311-win_amd64.pyd"
    if abi == "abi3":
        return "_core.abi3.so"
    libc = "musl" if "musl" in target.triple else "gnu"
    return "_core.cpython-311-darwin.so" if target.system == "Darwin" else f"_core.cpython-311-{target.processor}-linux-{libc}.so"


def module(target: Target, abi: str, sources: Path) -> Path:
    """The compiled module. Both ABIs are built in one folder: the library is compiled once."""
    nanobind = run(sys.executable, "-c", "import nanobind; print(nanobind.cmake_dir())")
    build = SCRATCH / target.name / "build"
    options = [*pythons.options(target, PYTHONS[abi][0]), f"-Dnanobind_DIR={nanobind}", f"-Dnanobind_ROOT={nanobind}",
               "-DCMAKE_SHARED_LINKER_FLAGS=-s", "-DCMAKE_MODULE_LINKER_FLAGS=-s",
               "-DBRUSHFIRE_TOGETHER=ON", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON"]  # fmt: skip
    defines = re.search(r"\[tool.scikit-build.cmake.define\]\n(.*?)\n\n", (ROOT / "pyproject.toml").read_text(), re.DOTALL)[1]
    options += [f"-D{name}={value}" for name, value in re.findall(r'^(\w+) = "(\w+)"', defines, re.MULTILINE)]
    cmake(target, sources, build, "-UPython*", "-U_Python*", "-UNB_*", *options, targets=("_core",))
    made = [file for file in build.rglob("_core*") if file.suffix in (".so", ".pyd", ".dylib", ".dll")]
    return max(made, key=lambda file: file.stat().st_mtime)


def metadata(sources: Path) -> dict[str, bytes]:
    """The files of dist-info but WHEEL and RECORD, as scikit-build-core writes them."""
    folder = SCRATCH / "metadata"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    run(sys.executable, "-c", "import sys; from scikit_build_core.build import prepare_metadata_for_build_wheel as p; "
        "p(sys.argv[1])", folder, cwd=sources)  # fmt: skip
    info = next(folder.iterdir())
    files = {f"{info.name}/{file.relative_to(info).as_posix()}": file.read_bytes() for file in sorted(info.rglob("*")) if file.is_file()}
    for library in third_party.all_libraries():
        copyright = third_party.sources(library)[0] / "debian/copyright"
        files[f"{info.name}/licenses/linked/{library.source}.txt"] = copyright.read_bytes()
    return {name: data for name, data in files.items() if Path(name).name not in ("WHEEL", "RECORD")}


def pack(target: Target, abi: str, compiled: Path, sources: Path) -> Path:
    """The wheel, with the commit's date in all of it."""
    tag = PYTHONS[abi][1]
    files = {f"brushfire/{file.relative_to(sources / 'python/brushfire').as_posix()}": file.read_bytes()
             for file in sorted((sources / "python/brushfire").rglob("*"))
             if file.is_file() and "__pycache__" not in file.parts}  # fmt: skip
    if VIEWER.exists():
        files["brushfire/viewer.html"] = VIEWER.read_bytes()
    files[f"brushfire/{module_name(target, abi)}"] = compiled.read_bytes()
    files |= metadata(sources)
    info = f"brushfire-{version()}.dist-info"
    tags = "".join(f"Tag: {tag}-{platform}\n" for platform in target.wheel.split("."))
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: brushfire tools/release\nRoot-Is-Purelib: false\n{tags}".encode()
    rows = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
            for name, data in files.items()]  # fmt: skip
    files[f"{info}/RECORD"] = ("\n".join([*rows, f"{info}/RECORD,,"]) + "\n").encode()
    date = time.gmtime(int(commit_date()))[:6]
    wheel = DIST / f"brushfire-{version()}-{tag}-{target.wheel}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, date)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o100644 << 16
            archive.writestr(entry, data)
    return wheel


def build(target: Target, abis: tuple[str, ...] = tuple(PYTHONS)) -> list[Path]:
    sources = unpacked_sdist()
    link_headers(third_party.build(target))
    wheels = []
    for abi in abis:
        say(f"{target.name}: {abi}")
        wheels.append(pack(target, abi, module(target, abi, sources), sources))
        if target.system == "Linux" and "gnu" in target.triple:
            audit(wheels[-1])
        if target.system == "Darwin":
            audit_for_macos(wheels[-1], target)
        if abi == "abi3":
            run(sys.executable, "-m", "abi3audit", "--strict", wheels[-1])
        note(wheels[-1], try_out(target, wheels[-1], PYTHONS[abi][0]))
    return wheels


def try_out(target: Target, wheel: Path, minor: str) -> str | None:
    """How it has been run, and what that printed; None where this machine cannot."""
    if target.name == f"manylinux-{platform.machine()}":
        return elsewhere.by_its_own(interpreter(minor), wheel)
    if target.name == "manylinux-aarch64":
        return elsewhere.by_qemu(target, minor, wheel)
    if target.name == f"musllinux-{platform.machine()}":
        return elsewhere.by_musl(target, minor, wheel)
    return elsewhere.by_wine(target, minor, wheel) if target.system == "Windows" else None


def note(wheel: Path, told: str | None) -> None:
    """In dist/BUILT.txt: what has been made, whether it has been run, and that all compute the same."""
    file = DIST / "BUILT.txt"
    others = [line for line in file.read_text().splitlines() if not line.startswith(wheel.name)] if file.exists() else []
    lines = sorted([*others, f"{wheel.name}: built, {' '.join(told.split()) if told else 'not run'}"])
    file.write_text("\n".join(lines) + "\n")
    if len(set(re.findall(r"fields: \w+", "\n".join(lines)))) > 1:
        raise SystemExit("wheels compute other bits on other machines:\n" + "\n".join(lines))


def audit(wheel: Path) -> None:
    said = run(sys.executable, "-m", "auditwheel", "show", wheel)
    if "manylinux_2_17" not in said.replace("\n", " "):
        raise SystemExit(said)


def audit_for_macos(wheel: Path, target: Target) -> None:
    """What nothing here can run is looked at: for which processor and which macOS, what it is linked with, and that
    of names that are looked up when it is loaded all are Python's, since the linker lets anything pass there."""
    import lief  # others than the wheels for macOS do without

    with zipfile.ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".so"))
        module = lief.MachO.parse(list(archive.read(name))).at(0)
    libraries = [library.name for library in module.libraries][1:]  # the first is its own name
    dynamic = [binding.symbol.name for binding in module.bindings if binding.has_symbol and binding.library_ordinal == FLAT_LOOKUP]
    found = {
        "processor": module.header.cpu_type.name.lower(),
        "macOS": ".".join(map(str, module.build_version.minos[:2])),
        "libraries": libraries,
        "exports": [symbol.name for symbol in module.exported_symbols if symbol.name.startswith("_PyInit")],
        "names from nowhere": sorted({name for name in dynamic if not name.startswith(("_Py", "__Py"))}),
    }
    wanted = {"processor": target.processor, "macOS": "11.0", "libraries": ["/usr/lib/libSystem.B.dylib"], "exports": ["_PyInit__core"],
              "names from nowhere": []}  # fmt: skip
    if found != wanted or not dynamic:
        raise SystemExit(f"{wheel.name}: {found} instead of {wanted}")
