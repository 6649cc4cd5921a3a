"""zig (from PyPI) as the C++ compiler for machines that are not this one: it brings their C libraries along."""

from __future__ import annotations

import subprocess
import sys
import venv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from common import SCRATCH, run

VERSION = "0.15.2"
CMAKE = "3.31.6"  # knows Python's stable ABI, which Debian 12's does not


@dataclass(frozen=True)
class Target:
    name: str  # of folders, and of this target in words
    triple: str  # zig's
    system: str  # CMake's
    processor: str
    wheel: str  # the platform tag
    module: str = ".so"  # how Python's modules end there


TARGETS = {
    target.name: target
    for target in (
        Target("manylinux-x86_64", "x86_64-linux-gnu.2.17", "Linux", "x86_64", "manylinux2014_x86_64.manylinux_2_17_x86_64"),
        Target("manylinux-aarch64", "aarch64-linux-gnu.2.17", "Linux", "aarch64", "manylinux2014_aarch64.manylinux_2_17_aarch64"),
        Target("musllinux-x86_64", "x86_64-linux-musl", "Linux", "x86_64", "musllinux_1_2_x86_64"),
        Target("musllinux-aarch64", "aarch64-linux-musl", "Linux", "aarch64", "musllinux_1_2_aarch64"),
        Target("macos-arm64", "aarch64-macos.11.0", "Darwin", "arm64", "macosx_11_0_arm64"),
        Target("macos-x86_64", "x86_64-macos.11.0", "Darwin", "x86_64", "macosx_11_0_x86_64"),
        Target("windows-x86_64", "x86_64-windows-gnu", "Windows", "AMD64", "win_amd64", ".pyd"),
    )
}


@cache
def zig() -> Path:
    """The program, of a virtual environment of its own."""
    folder = SCRATCH.parent / "zig"
    if not (folder / "bin/python").exists():
        venv.create(folder, with_pip=True)
    wanted = (f"ziglang=={VERSION}", f"cmake=={CMAKE}")
    if (folder / "installed").exists() and (folder / "installed").read_text() == " ".join(wanted):
        return next(folder.glob("lib/python*/site-packages/ziglang/zig"))
    run(folder / "bin/python", "-m", "pip", "install", "-q", "--disable-pip-version-check", *wanted)
    (folder / "installed").write_text(" ".join(wanted))
    return next(folder.glob("lib/python*/site-packages/ziglang/zig"))


# zig's own linker for macOS reads no file of names that Python will have, and ends with a segmentation fault where a module
# is linked as a bundle with undefined names (ziglang/zig, issue 25451). Python loads a dynamic library just as well.
LINK_FOR_MACOS = """#!/bin/sh
for argument do
  shift
  case $argument in
    -bundle) argument=-dynamiclib ;;
    -Wl,@*.sym) argument=-Wl,-undefined,dynamic_lookup ;;
  esac
  set -- "$@" "$argument"
done
exec "$@"
"""


def write_script(script: Path, text: str) -> None:
    """Only if it has changed: a compiler cache goes by its date."""
    if not script.exists() or script.read_text() != text:
        script.write_text(text)
        script.chmod(0o755)


def toolchain(target: Target) -> Path:
    """CMake's toolchain file, beside the commands that it names. Headers that compile anywhere come from this machine."""
    folder = SCRATCH / target.name / "zig"
    folder.mkdir(parents=True, exist_ok=True)
    for name, command in {
        "cc": f"cc -target {target.triple}", "c++": f"c++ -target {target.triple}", "ar": "ar", "ranlib": "ranlib",
        "rc": "rc", "dlltool": "dlltool",
    }.items():  # fmt: skip
        write_script(folder / f"zig-{name}", f'#!/bin/sh\nexec "{zig()}" {command} "$@"\n')
    write_script(folder / "zig-link", LINK_FOR_MACOS)
    file = folder / "toolchain.cmake"
    found = SCRATCH / target.name / "prefix"
    # What is not hidden dyld shares with modules of others, also where it is of another libc++.
    macos = f"""set(CMAKE_CXX_LINKER_LAUNCHER {folder}/zig-link)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)"""
    static = " -DXML_STATIC -DLZMA_API_STATIC" if target.system == "Windows" else ""  # their headers speak of DLLs otherwise
    file.write_text(f"""set(CMAKE_SYSTEM_NAME {target.system})
set(CMAKE_SYSTEM_PROCESSOR {target.processor})
set(CMAKE_C_COMPILER {folder}/zig-cc)
set(CMAKE_CXX_COMPILER {folder}/zig-c++)
set(CMAKE_AR {folder}/zig-ar CACHE FILEPATH "")
set(CMAKE_RANLIB {folder}/zig-ranlib CACHE FILEPATH "")
set(CMAKE_C_COMPILER_AR {folder}/zig-ar CACHE FILEPATH "")
set(CMAKE_CXX_COMPILER_AR {folder}/zig-ar CACHE FILEPATH "")
set(CMAKE_C_COMPILER_RANLIB {folder}/zig-ranlib CACHE FILEPATH "")
set(CMAKE_CXX_COMPILER_RANLIB {folder}/zig-ranlib CACHE FILEPATH "")
set(CMAKE_RC_COMPILER {folder}/zig-rc)
set(CMAKE_INSTALL_NAME_TOOL /bin/true CACHE FILEPATH "")
set(CMAKE_OSX_SYSROOT "" CACHE STRING "")
set(CMAKE_OSX_DEPLOYMENT_TARGET "" CACHE STRING "")
set(CMAKE_FIND_ROOT_PATH {found})
set(CMAKE_PREFIX_PATH {found})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
{macos if target.system == "Darwin" else ""}
# Boost 1.74 derives from a template that the standard has dropped, and libc++ with it.
set(CMAKE_CXX_FLAGS_INIT "-D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION{static}")
""")
    return file


def cmake(target: Target, source: Path, build: Path, *options: str, targets: tuple[str, ...] = ()) -> None:
    """Configures and builds in release mode."""
    launcher = [f"-DCMAKE_{language}_COMPILER_LAUNCHER=ccache" for language in ("C", "CXX")]
    if subprocess.run(["sh", "-c", "command -v ccache"], capture_output=True, check=False).returncode:
        launcher = []
    program = zig().parents[4] / "bin/cmake"
    run(program, "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_TOOLCHAIN_FILE={toolchain(target)}", *launcher, *options)  # fmt: skip
    run(program, "--build", build, *(f"--target={name}" for name in targets), "--", "-k0",
        CCACHE_COMPILERTYPE="clang", CCACHE_COMPILERCHECK="content")  # fmt: skip


if __name__ == "__main__":
    print(zig(), *(toolchain(TARGETS[name]) for name in sys.argv[1:]), sep="\n")
