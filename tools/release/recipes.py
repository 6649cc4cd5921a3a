"""The recipes in packaging/ against what they speak of: versions, CMake's options; and by their own tools where these are.

GitHub's workflows and all scripts, too, by actionlint and shellcheck.
"""

from __future__ import annotations

import json
import re
import shutil
import sys
import tempfile
from pathlib import Path

from common import ROOT, run, version


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
    if conan := program("conan"):
        with tempfile.TemporaryDirectory() as home:
            run(conan, "export", packaging / "conan", "--version", version(), CONAN_HOME=home)
        print("conan: exported")


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
