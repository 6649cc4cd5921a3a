"""./run release [PART...]: what a version is handed out as, in dist/; of one commit the same bytes each time.

Without a word: sources, wheel, bill, sums. The others take long, or root and a network:

  sources  source tarball, sdist, npm tarball (where ./run web has built the WebAssembly)
  wheel    wheels of this machine's Python, and of 3.12 and later where there is a 3.12; audited, used without a compiler
  cross    wheels for other machines, by zig: cross manylinux-x86_64 musllinux-aarch64 ...; all of them without a name
  debs     Debian packages from clean machines of bookworm and trixie, lintian's words, symbols and ABI: debs trixie
  clean    those in dist/ on bare machines: installed, the first tutorial run, timed: clean deb-trixie wheel npm ...
  again    sources and wheels twice: the same bytes?
  recipes  the recipes in packaging/ against what they speak of; workflows by actionlint, scripts by shellcheck;
           recipes build: conan's and conda's to their ends, on this machine's libraries
  bill     SBOM (CycloneDX) and a list of licences of what the wheels have in them
  sums     SHA256SUMS of all of it
"""

from __future__ import annotations

import hashlib
import os
import shutil
import sys
from pathlib import Path

import bill
import native
import sources
import third_party
from common import DIST, SCRATCH, commit_date, run, version

PARTS = ("sources", "wheel", "cross", "debs", "clean", "again", "recipes", "bill", "sums")


def wheel() -> list[Path]:
    sdist, wheels = sources.sdist(), []
    for python in native.pythons():
        made, libraries = native.wheel(sdist, python)
        (SCRATCH / "libraries.txt").write_text("\n".join(map(str, libraries)))
        native.try_out(made, python)
        wheels.append(made)
    return wheels


def libraries() -> list[Path]:
    file = SCRATCH / "libraries.txt"
    if not file.exists():
        raise SystemExit("the bill is that of the wheel: ./run release wheel first")
    return [Path(line) for line in file.read_text().split("\n") if line]


def sums() -> None:
    files = sorted(file for file in DIST.rglob("*") if file.is_file() and file.name != "SHA256SUMS")
    lines = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.relative_to(DIST)}\n" for file in files]
    (DIST / "SHA256SUMS").write_text("".join(lines))
    for file in files:
        print(f"{file.stat().st_size / 1e6:8.2f} MB  dist/{file.relative_to(DIST)}")


def do(part: str, names: list[str]) -> None:
    if part == "sources":
        sources.all_of_them()
    elif part == "wheel":
        wheel()
    elif part == "cross":
        import wheels

        for name in names or wheels.TARGETS:
            print(*wheels.build(wheels.TARGETS[name]), sep="\n")
    elif part == "debs":
        import debs

        for release in names or debs.PROFILES:
            print(*debs.build(release), sep="\n")
    elif part == "clean":
        import clean

        clean.try_all(names)
    elif part == "again":
        sources.again(sources.all_of_them)
        sources.again(wheel)
    elif part == "recipes":
        import recipes

        recipes.check()
        recipes.lint()
        if "build" in names:
            recipes.build()
    elif part == "bill":
        if list(DIST.glob("*manylinux2014*.whl")):
            bill.write_cross(third_party.all_libraries())
        bill.write(libraries())
    else:
        sums()


def main() -> None:
    words = sys.argv[1:]
    for word in words[:1]:
        if word not in PARTS:
            raise SystemExit(__doc__)
    print("brushfire", version())
    DIST.mkdir(exist_ok=True)
    os.environ["SOURCE_DATE_EPOCH"] = commit_date()
    if run("git", "status", "--porcelain"):
        print("(the tree is not clean: the source tarball is that of the last commit, the packages are not)")
    if not words:
        shutil.rmtree(DIST)
        DIST.mkdir()
        for part in ("sources", "wheel", "bill", "sums"):
            do(part, [])
        return
    do(words[0], words[1:])


if __name__ == "__main__":
    main()
