"""What is linked into the packages, and under which licences: CycloneDX for machines, a list for people."""

from __future__ import annotations

import json
from importlib import metadata
from pathlib import Path

import zig
from common import DIST, run, version
from native import owner
from third_party import Library

# Headers that are compiled in, and the licences of what Debian's packages hold.
HEADERS = ("libboost-dev", "libstb-dev", "libfast-float-dev", "nlohmann-json3-dev", "libeigen3-dev")
LICENCES = {
    "libboost-dev": "BSL-1.0",
    "libstb-dev": "MIT OR Unlicense",
    "libfast-float-dev": "Apache-2.0 OR MIT OR BSL-1.0",
    "nlohmann-json3-dev": "MIT",
    "libeigen3-dev": "MPL-2.0",
    "zlib1g": "Zlib",
    "libexpat1": "MIT",
    "liblz4-1": "BSD-2-Clause",
    "liblzma5": "0BSD",
    "libzip": "BSD-3-Clause",
    "libdraco": "Apache-2.0",
    "libmeshoptimizer": "MIT",
    "libbz2-1.0": "bzip2-1.0.6",
    "libzstd1": "BSD-3-Clause",
    "libssl3": "Apache-2.0",
    "libgnutls30": "LGPL-2.1-or-later",
    "libnettle8": "LGPL-3.0-or-later OR GPL-2.0-or-later",
}


def component(package: str) -> dict:
    licence = next((LICENCES[key] for key in sorted(LICENCES, reverse=True) if package.startswith(key)), None)
    if licence is None:
        raise SystemExit(f"tools/release/bill.py does not know the licence of {package}")
    installed = run("dpkg-query", "-W", "-f=${Version}", package)
    return {
        "type": "library",
        "name": package,
        "version": installed,
        "purl": f"pkg:deb/debian/{package}@{installed}",
        "licenses": [{"expression": licence}],
    }


def write(libraries: list[Path]) -> None:
    """Of the native wheel: the system's libraries in it, and the headers."""
    write_components("", [component(package) for package in sorted({*HEADERS, *map(owner, libraries)})])


def write_cross(libraries: dict[Library, str]) -> None:
    """Of the wheels that are built by zig: what is compiled from Debian's sources, and zig's own libc++."""
    built = [{"type": "library", "name": library.source, "version": version,
              "purl": f"pkg:deb/debian/{library.source}@{version}?arch=source",
              "licenses": [{"expression": library.licence}]} for library, version in libraries.items()]  # fmt: skip
    runtime = {"type": "library", "name": "libc++, libunwind, compiler-rt", "version": f"of zig {zig.VERSION}",
               "licenses": [{"expression": "Apache-2.0 WITH LLVM-exception"}]}  # fmt: skip
    write_components("-cross", [*map(component, HEADERS), *built, runtime])


def nanobind() -> dict:
    """In every wheel, with the hash table that it carries along (tsl::robin_map, MIT)."""
    installed = metadata.version("nanobind")
    return {"type": "library", "name": "nanobind", "version": installed, "purl": f"pkg:pypi/nanobind@{installed}",
            "licenses": [{"expression": "BSD-3-Clause AND MIT"}]}  # fmt: skip


def write_components(suffix: str, components: list[dict]) -> None:
    components = [*components, nanobind()]
    ours = {"type": "library", "name": "brushfire", "version": version(), "licenses": [{"expression": "MIT"}]}
    font = {"type": "file", "name": "DejaVu Sans, a part of it", "licenses": [{"license": {"name": "Bitstream Vera"}}]}
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": ours},
        "components": [*components, font],
    }
    (DIST / f"brushfire-{version()}{suffix}.cdx.json").write_text(json.dumps(document, indent=1) + "\n")
    lines = [f"{part['name']:24} {part.get('version', ''):28} {licence_of(part)}" for part in (ours, *components, font)]
    (DIST / f"LICENCES{suffix}.txt").write_text("\n".join(lines) + "\n")


def licence_of(part: dict) -> str:
    stated = part["licenses"][0]
    return stated.get("expression") or stated["license"]["name"]
