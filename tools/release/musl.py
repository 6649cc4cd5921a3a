"""Pythons for musl, in which musllinux wheels are run here: Debian's sources, compiled by musl's gcc in a trixie, whose musl
knows the relocations (DT_RELR) that are in numpy's wheel; bookworm's does not."""

from __future__ import annotations

import shutil
from pathlib import Path

from common import SCRATCH, say
from machine import MIRROR, Machine

SUITES = {"3.11": "bookworm", "3.13": "trixie"}
# The kernel's headers are this Debian's, behind those of musl; and gcc is not asked what it is made for.
COMPILER = """#!/bin/sh
if [ "$1" = --print-multiarch ]; then echo x86_64-linux-musl; exit; fi
exec musl-gcc -idirafter /usr/include -idirafter /usr/include/x86_64-linux-gnu "$@"
"""


def python(minor: str) -> tuple[Path, Path]:
    """The loader that runs it, which is musl itself, and the program."""
    folder = SCRATCH / f"musl-python-{minor}"
    if not folder.exists():
        say(f"musl: compiling Python {minor}")
        shutil.copytree(compiled(minor), folder, symlinks=True)
    return folder / "libc.so", folder / f"bin/python{minor}"


def compiled(minor: str) -> Path:
    machine = Machine("trixie", f"musl-{minor}")
    machine.install("build-essential", "musl-tools")
    machine.inside(f"echo 'deb-src {MIRROR} {SUITES[minor]} main' > /etc/apt/sources.list.d/sources.list && apt-get -qq update && "
                   f"cd /root && apt-get -qq source python{minor}")  # fmt: skip
    compiler = machine.folder / "root/cc"
    compiler.write_text(COMPILER)
    compiler.chmod(0o755)
    machine.inside("mkdir /root/build && cd /root/build && "
                   "CC=/root/cc ../python3*/configure --prefix=/root/python --without-ensurepip --disable-test-modules && "
                   "make -j$(nproc) && make install && cp /usr/lib/x86_64-linux-musl/libc.so /root/python")  # fmt: skip
    return machine.folder / "root/python"
