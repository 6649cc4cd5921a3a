"""Debian packages, built in clean machines of bookworm and trixie from the source tarball, looked at by lintian."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

from common import DIST, VIEWER, say, version
from machine import Machine

# Bookworm has no nanobind, so no python3-brushfire: the wheel serves there.
PROFILES = {"bookworm": "nopython", "trixie": ""}


def build(release: str) -> list[Path]:
    """The packages of one release, in dist/debian/RELEASE; with lintian's words beside them."""
    out = DIST / "debian" / release
    former = out / "libbrushfire1.abi"
    before = former.read_bytes() if former.exists() else None
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    machine = Machine(release, f"debs-{release}")
    machine.take(DIST / f"brushfire-{version()}-source.tar.gz")
    profile = PROFILES[release]
    say(f"{release}: installing what the packages are built with")
    machine.install("build-essential", "debhelper", "lintian", "abigail-tools", "ccache")
    machine.inside(f"cd /root && tar -xf *-source.tar.gz && mv brushfire-{version()} brushfire")
    if VIEWER.exists():
        page = machine.folder / "root/brushfire/web/dist-single"
        page.mkdir()
        shutil.copy(VIEWER, page)
    machine.inside("cd /root/brushfire && apt-get -qq build-dep -y --no-install-recommends ./", DEB_BUILD_PROFILES=profile)
    say(f"{release}: building the packages")
    launcher = {"CMAKE_CXX_COMPILER_LAUNCHER": "ccache", "CCACHE_DIR": "/var/cache/ccache", "CCACHE_NOHASHDIR": "1",
                "CCACHE_BASEDIR": "/root/brushfire"} if machine.cache else {}  # fmt: skip
    machine.inside(f"cd /root/brushfire && dpkg-buildpackage -b -us -uc -j{os.cpu_count()}", DEB_BUILD_PROFILES=profile, **launcher)
    said = machine.inside("cd /root && lintian --allow-root --info --display-info brushfire_*.changes || true")
    (out / "lintian.txt").write_text(said or "(nothing)\n")
    found = sorted(machine.folder.glob("root/*.deb"))
    for file in found:
        if "-dbgsym_" not in file.name:
            shutil.copy(file, out)
    interface(machine, out)
    if before is not None:
        compare(machine, before, out)
    machine.remove()
    say(f"{release}: {len(found)} packages; lintian: {len(re.findall('^[EW]:', said, re.MULTILINE))} errors and warnings")
    return sorted(out.glob("*.deb"))


def interface(machine: Machine, out: Path) -> None:
    """What the next version's ABI is compared with: the exported functions' names, and types as abidw describes them."""
    library = "debian/tmp/usr/lib/*/libbrushfire.so." + version()
    names = machine.inside(f"cd /root/brushfire && nm -DC --defined-only {library} | cut -c18- | sort")
    (out / "symbols.txt").write_text(names)
    machine.inside(
        f"cd /root/brushfire && abidw --headers-dir debian/tmp/usr/include --drop-private-types --no-show-locs "
        f"--out-file /root/libbrushfire1.abi {library}"
    )
    shutil.copy(machine.folder / "root/libbrushfire1.abi", out)


def compare(machine: Machine, before: bytes, out: Path) -> None:
    """The library's ABI with that of the build which stood in dist/ before: what abidiff says, in abidiff.txt."""
    (machine.folder / "root/before.abi").write_bytes(before)
    # Of its status 1 and 2 say that it failed, 4 and 8 what it found.
    said = machine.inside("cd /root && { abidiff before.abi libbrushfire1.abi || [ $(($? & 3)) = 0 ]; }")
    (out / "abidiff.txt").write_text(said or "(no difference)\n")
    say(f"{machine.release}: abidiff: {said.strip() or 'no difference'}"[:500])
