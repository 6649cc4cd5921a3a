"""Packages in clean places: installed on a bare Debian as a user would, the first tutorial run there, and both timed.

A place has what debootstrap's smallest kind has: no compiler, no Python, no Node. The code is that of the documentation,
and what it prints is compared with what the documentation says.
"""

from __future__ import annotations

import itertools
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from common import DIST, ROOT, SCRATCH, say, version
from machine import Machine

sys.path.insert(0, str(ROOT / "tools/site"))
from pages import Block, blocks_of, compare, make_scan  # noqa: E402

START, PATHS, BROWSER = (ROOT / "docs" / page for page in ("index.md", "tutorials/paths.md", "tutorials/browser.md"))
MARK = "--- the next block ---"


@dataclass(frozen=True)
class Place:
    kind: str  # deb, wheel, cross or npm
    release: str
    packages: str  # glob in dist/
    before: str  # what the distribution brings, not timed
    install: str
    tutorials: tuple[tuple[str, tuple[Path, ...], str], ...]  # language, pages, command

    @property
    def name(self) -> str:
        return f"{self.kind}-{self.release}"


APT = "apt-get -qq install -y --no-install-recommends"
SHELL = ("sh", (START, PATHS), "bash -euo pipefail block.sh")
VENV = "venv/bin/pip install --disable-pip-version-check --only-binary :all: --find-links /root/packages brushfire"
WHEELS = (("wheel", "*.whl"), ("cross", "*-manylinux2014_x86_64*.whl"))  # pip takes the one for the newer system first
NODE = ("js", (BROWSER,), "for block in block-*.mjs; do node $block; done")


def python(program: str) -> tuple[str, tuple[Path, ...], str]:
    return "python", (START, PATHS), f"{program} block.py"


PLACES = (
    Place("deb", "bookworm", "debian/bookworm/*.deb", ":", f"{APT} /root/packages/*.deb", (SHELL,)),
    Place("deb", "trixie", "debian/trixie/*.deb", ":", f"{APT} /root/packages/*.deb", (SHELL, python("python3"))),
    *(Place(kind, release, found, f"{APT} python3-venv && ! command -v cc", f"python3 -m venv venv && {VENV}",
            (python("venv/bin/python"),)) for kind, found in WHEELS for release in ("bookworm", "trixie")),
    *(Place("npm", release, "*.tgz", f"{APT} npm", "npm install --no-audit --no-fund /root/packages/*.tgz", (NODE,))
      for release in ("bookworm", "trixie")),
)  # fmt: skip


def written(language: str, blocks: list[Block], folder: Path) -> None:
    """The blocks as a user would type them: one session of a shell or of Python, a file each for Node."""
    if language == "js":
        before = ""
        shown = itertools.count()
        for block in blocks:
            if block.hidden:
                before += block.text + "\n"
            else:
                (folder / f"block-{next(shown):02}.mjs").write_text(f"{before}console.log('{MARK}');\n{block.text}\n")
        return
    mark = f"print('{MARK}')" if language == "python" else f"echo '{MARK}'"
    suffix, first = ("py", "import brushfire as bf\n") if language == "python" else ("sh", "")
    (folder / f"block.{suffix}").write_text(first + "".join(f"{mark}\n{block.text}\n" for block in blocks))


def tutorial(machine: Machine, language: str, pages: tuple[Path, ...], command: str) -> float:
    """Its seconds. Where something else is printed than the page says, the release ends."""
    blocks = [block for page in pages for block in blocks_of(page) if block.language == language and block.reason is None]
    written(language, blocks, machine.folder / "root/tutorial")
    printed = machine.inside(f"cd /root/tutorial && {command}", told=True).split(MARK + "\n")[1:]
    shown = [block for block in blocks if not block.hidden]
    if len(printed) != len(shown):
        raise SystemExit(f"{len(shown)} blocks of {language}, {len(printed)} have run")
    for block, said in zip(shown, printed):
        if block.expected is not None:
            compare(block.expected, said)
    machine.log.append(f"({len(shown)} blocks of {' and '.join(page.name for page in pages)}; what they print is right)\n")
    return machine.seconds


def try_out(place: Place) -> str:
    """A row of the table; the log is dist/clean/KIND-RELEASE.txt."""
    machine = Machine(place.release, f"clean-{place.name}")
    packages, home = machine.folder / "root/packages", machine.folder / "root/tutorial"
    packages.mkdir()
    home.mkdir()
    found = sorted(DIST.glob(place.packages))
    if not found:
        raise SystemExit(f"{place.name}: there is no dist/{place.packages}")
    for file in found:
        shutil.copy(file, packages)
    make_scan(home / "scan.ply")
    machine.inside("apt-get -qq update")
    machine.inside("date --utc; cat /etc/debian_version /proc/loadavg; dpkg-query -W | wc -l; ! command -v cc python3 node", told=True)
    machine.inside(place.before, told=place.before != ":")
    machine.inside(f"cd /root/tutorial && {place.install}", told=True)
    row = [place.kind, place.release, f"{machine.seconds:.0f} s"]
    row.append(f"{sum(tutorial(machine, *words) for words in place.tutorials):.1f} s")
    if place.kind == "deb":
        used(machine)
    (DIST / "clean").mkdir(exist_ok=True)
    (DIST / f"clean/{place.name}.txt").write_text("\n".join(machine.log))
    machine.remove()
    return "| " + " | ".join(row) + " |"


def used(machine: Machine) -> None:
    """debian/tests: the program by itself; the library from a program that is compiled against it."""
    machine.take(ROOT / "debian/tests/program", ROOT / "debian/tests/library")
    machine.inside(f"{APT} g++ pkg-config", told=True)
    for test in ("program", "library"):
        machine.inside(f"mkdir -p /tmp/{test} && AUTOPKGTEST_TMP=/tmp/{test} sh /root/{test}", told=True)


def try_all(names: list[str]) -> None:
    SCRATCH.mkdir(parents=True, exist_ok=True)
    rows = []
    for place in PLACES:
        if not names or place.name in names or place.kind in names or place.release in names:
            say(f"{place.name}: brushfire {version()} on a bare machine")
            rows.append(try_out(place))
    print("| package | on a bare | installed in | first tutorial in |\n|---|---|--:|--:|", *rows, sep="\n")
