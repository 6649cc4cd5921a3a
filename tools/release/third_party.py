"""The libraries that a wheel has in it, compiled for its target as static libraries from Debian's source packages.

Debian's sources come with their security patches, from the mirror that this machine asks anyway, and apt has checked who
signed them. Header-only ones (Boost, Eigen, fast_float, nlohmann-json, stb) are this machine's.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from common import SCRATCH, run, say
from zig import TARGETS, Target, cmake

HERE = Path(__file__).parent
RELEASE = "bookworm"  # the versions that the project is developed on
MIRROR = "http://deb.debian.org/debian"


@dataclass(frozen=True)
class Library:
    source: str  # Debian's source package
    licence: str  # SPDX
    options: tuple[str, ...] = ()
    target: str = "all"
    component: str = ""  # of what it installs; "": all


STATIC = "-DBUILD_SHARED_LIBS=OFF"
TOGETHER = ("-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=32")  # a third of the time
PLAIN_C = (Library("zlib", "Zlib"), Library("expat", "MIT"), Library("lz4", "BSD-2-Clause"))  # built together: plain_c/
LIBRARIES = (
    Library("xz-utils", "0BSD", (STATIC, "-DCREATE_XZ_SYMLINKS=OFF", "-DCREATE_LZMA_SYMLINKS=OFF", "-DBUILD_TESTING=OFF"),
            "liblzma", "liblzma_Development"),
    Library("libzip", "BSD-3-Clause", (STATIC, "-DENABLE_BZIP2=OFF", "-DENABLE_LZMA=OFF", "-DENABLE_ZSTD=OFF",
                                       "-DENABLE_COMMONCRYPTO=OFF", "-DENABLE_GNUTLS=OFF", "-DENABLE_MBEDTLS=OFF",
                                       "-DENABLE_OPENSSL=OFF", "-DENABLE_WINDOWS_CRYPTO=OFF", "-DBUILD_TOOLS=OFF",
                                       "-DBUILD_REGRESS=OFF", "-DBUILD_OSSFUZZ=OFF", "-DBUILD_EXAMPLES=OFF",
                                       "-DBUILD_DOC=OFF",
                                       # Its table of Windows' calls has one type for those of both alphabets.
                                       "-DCMAKE_C_FLAGS=-Wno-incompatible-function-pointer-types")),
    Library("draco", "Apache-2.0", (STATIC, "-DDRACO_TESTS=OFF", *TOGETHER)),
    Library("meshoptimizer", "MIT", (STATIC, "-DMESHOPT_BUILD_SHARED_LIBS=OFF")),
)  # fmt: skip


@cache
def apt() -> tuple[str, ...]:
    """An apt that knows the sources and nothing else, and leaves this machine's lists alone."""
    folder = SCRATCH.parent / "debian-sources"
    (folder / "lists/partial").mkdir(parents=True, exist_ok=True)
    (folder / "sources.list").write_text(f"deb-src {MIRROR} {RELEASE} main\n")
    options = (f"-oDir::Etc::sourcelist={folder}/sources.list", "-oDir::Etc::sourceparts=/dev/null",
               f"-oDir::State::lists={folder}/lists", "-oAPT::Sandbox::User=root")  # fmt: skip
    run("apt-get", *options, "-qq", "update")
    return options


@cache
def sources(library: Library) -> tuple[Path, str]:
    """The unpacked sources of a library, and their version."""
    folder = SCRATCH.parent / "debian-sources" / library.source
    if not (folder / "unpacked").is_dir():
        folder.mkdir(parents=True, exist_ok=True)
        run("apt-get", *apt(), "-qq", "source", "--download-only", "--only-source", library.source, cwd=folder)
        run("dpkg-source", "--no-check", "-x", next(folder.glob("*.dsc")), folder / "unpacked.part")
        (folder / "unpacked.part").rename(folder / "unpacked")
    version = re.search(r"^Version: (\S+)", next(folder.glob("*.dsc")).read_text(), re.MULTILINE)[1]
    return folder / "unpacked", version


def all_libraries() -> dict[Library, str]:
    """With the version that Debian has."""
    return {library: sources(library)[1] for library in (*PLAIN_C, *LIBRARIES)}


def install(target: Target, library: Library, name: str, versions: str, project: Path, *options: str) -> None:
    """One project into the target's folder, unless these versions of it are there."""
    prefix, folder = SCRATCH / target.name / "prefix", SCRATCH / target.name / name
    done = prefix / f"{name}.done"
    if done.exists() and done.read_text() == versions:
        return
    say(f"{target.name}: {name} {versions}")
    cmake(target, project, folder, f"-DCMAKE_INSTALL_PREFIX={prefix}", "-DCMAKE_INSTALL_LIBDIR=lib", *library.options,
          *options, targets=(library.target,))  # fmt: skip
    run("cmake", "--install", folder, *(["--component", library.component] if library.component else []))
    done.write_text(versions)


def build(target: Target) -> Path:
    """Installs all of them into one folder, which the target's toolchain file looks in."""
    prefix = SCRATCH / target.name / "prefix"
    found = {library: sources(library) for library in (*PLAIN_C, *LIBRARIES)}
    install(target, PLAIN_C[0], "plain_c", " ".join(found[library][1] for library in PLAIN_C), HERE / "plain_c",
            *(f"-D{library.source.upper()}_SOURCES={found[library][0]}" for library in PLAIN_C))  # fmt: skip
    for library in LIBRARIES:
        install(target, library, library.source, found[library][1], found[library][0])
    for shared in (*prefix.glob("lib/*.so*"), *prefix.glob("lib/*.dylib"), *prefix.glob("lib/*.dll.a"), *prefix.glob("bin/*.dll")):
        shared.unlink()
    return prefix


if __name__ == "__main__":
    import sys

    for name in sys.argv[1:]:
        print(build(TARGETS[name]))
