"""The recipes in packaging/ against what they speak of: versions, CMake's options; and by conan and rattler-build themselves.

Their registries hold what the recipes need, and are not asked: to build one, this machine's own libraries stand in for that.
GitHub's workflows and all scripts are looked at, too, by actionlint and shellcheck.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
import tempfile
import venv
from functools import cache
from pathlib import Path

from common import ROOT, SCRATCH, run, say, version

TOOLS = ("conan>=2", "py-rattler-build")


def options_of_cmake() -> set[str]:
    text = "".join(file.read_text() for file in (ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake")))
    return set(re.findall(r"option\((\w+) ", text)) | {"BRUSHFIRE_QUERIES", "BRUSHFIRE_IO", "BRUSHFIRE_FIGURE"}


def check() -> None:
    packaging = ROOT / "packaging"
    manifest = json.loads((packaging / "vcpkg/ports/brushfire/vcpkg.json").read_text())
    stated = {
        "vcpkg": manifest["version"],
        "conda": re.search(r'^  version: "(.*)"', (packaging / "conda/recipe.yaml").read_text(), re.MULTILINE)[1],
    }
    wrong = {name: number for name, number in stated.items() if number != version()}
    if wrong:
        raise SystemExit(f"recipes of another version than {version()}: {wrong}")
    port = (packaging / "vcpkg/ports/brushfire/portfile.cmake").read_text()
    used = set(re.findall(r"\b(BRUSHFIRE_(?:WITH|BUILD)_\w+)", port + (packaging / "conda/recipe.yaml").read_text()))
    conan = (packaging / "conan/conanfile.py").read_text()
    used |= {f"BRUSHFIRE_WITH_{name}" for name in re.findall(r'"with_\w+": \("(\w+)"', conan)}
    if unknown := used - options_of_cmake():
        raise SystemExit(f"recipes set what CMakeLists.txt has not: {sorted(unknown)}")
    features = set(re.findall(r"^  (\w+) +BRUSHFIRE", port, re.MULTILINE))
    if features != set(manifest["features"]):
        raise SystemExit(f"vcpkg: portfile.cmake has {sorted(features)}, vcpkg.json {sorted(manifest['features'])}")
    print(f"vcpkg, conda, conan: version {version()}, {len(used)} of CMake's options")
    with tempfile.TemporaryDirectory() as home:
        run(tools() / "conan", "export", packaging / "conan", "--version", version(), CONAN_HOME=home)
    print("conan: exported")
    print("conda:", run(tools() / "python", Path(__file__).with_name("conda.py")))


@cache
def tools() -> Path:
    """Where conan and rattler-build are: in a virtual environment of their own."""
    folder = SCRATCH.parent / "recipes"
    if not (folder / "bin/conan").exists():
        venv.create(folder, with_pip=True)
        run(folder / "bin/python", "-m", "pip", "install", "-q", "--disable-pip-version-check", *TOOLS)
    return folder / "bin"


def build() -> None:
    """Each recipe to its end and its own tests, with this machine's libraries in place of those in its registry."""
    say("conan: building")
    home = SCRATCH / "conan"
    profile = home / "profiles/default"
    if not profile.exists():
        run(tools() / "conan", "profile", "detect", CONAN_HOME=str(home))
        text = (ROOT / "packaging/conan/conanfile.py").read_text()
        needed = dict(re.findall(r'"(\w+)/(?:\[>=)?(cci\.\d+|\d[\d.]*)', text))
        stand_ins = "".join(f"{name}/{least}\n" for name, least in needed.items())
        profile.write_text(profile.read_text().replace("compiler.cppstd=gnu17", "compiler.cppstd=20")
                           + f"\n[platform_requires]\n{stand_ins}")  # fmt: skip
    # A shared library, since a static one passes on what it links by the names of packages.
    run(tools() / "conan", "create", ROOT / "packaging/conan", "--version", version(), "-o", "brushfire/*:shared=True",
        CONAN_HOME=str(home))  # fmt: skip
    print("conan: built, and its test package run")
    say("conda: building")
    print("conda:", run(tools() / "python", Path(__file__).with_name("conda.py"), SCRATCH / "conda", PATH=os.environ["PATH"]))


def program(name: str) -> str | None:
    """Where it is: on the way, or in this virtual environment."""
    found = shutil.which(name) or shutil.which(name, path=Path(sys.executable).parent)
    if not found:
        print(f"(no {name} here: what it checks is not checked)")
    return found


def lint() -> None:
    if actionlint := program("actionlint"):
        run(actionlint)
        print("actionlint: nothing")
    if shellcheck := program("shellcheck"):
        scripts = run("git", "ls-files", "*.sh", "run", ".ci/run", "debian/tests/program", "debian/tests/library").split("\n")
        run(shellcheck, *scripts)
        print(f"shellcheck: nothing, in {len(scripts)} scripts")


if __name__ == "__main__":
    check()
    lint()
