"""The conda recipe by rattler-build, in whose Python this runs: conda.py [FOLDER]

All outputs are rendered, with conda-forge's pins. With a folder the library's is built, tested and packed there: a channel of
empty packages has the names that the recipe asks for, and this machine's compiler and libraries are what is found.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

from rattler_build import EnvironmentIsolation, Stage0Recipe, ToolConfiguration, VariantConfig

RECIPE = Path(__file__).parents[2] / "packaging/conda/recipe.yaml"
PINS = {"c_stdlib": ["sysroot"], "c_stdlib_version": ["2.17"], "cxx_compiler": ["gxx"], "python": ["3.12"]}


def empty_package(name: str, version: str, channel: Path) -> None:
    recipe = channel / "recipes" / name / "recipe.yaml"
    recipe.parent.mkdir(parents=True)
    recipe.write_text(f"package:\n  name: {name}\n  version: '{version}'\nbuild:\n  noarch: generic\n  script: []\n"
                      "about:\n  summary: stands in\n")  # fmt: skip
    for variant in Stage0Recipe.from_file(recipe).render():
        variant.run_build(output_dir=channel, channels=[channel.as_uri()])


def main() -> None:
    rendered = Stage0Recipe.from_file(RECIPE).render(VariantConfig(PINS))
    outputs = [variant.recipe.to_dict() for variant in rendered]
    print("rendered", *(output["package"]["name"] for output in outputs))
    if len(sys.argv) == 1:
        return
    channel = Path(sys.argv[1]).absolute()
    shutil.rmtree(channel, ignore_errors=True)
    (channel / "noarch").mkdir(parents=True)
    (channel / "noarch/repodata.json").write_text('{"info": {"subdir": "noarch"}, "packages": {}, "packages.conda": {}}')
    needed = outputs[0]["requirements"]
    for requirement in [*needed["build"], *needed["host"]]:
        name, *version = requirement.split()
        empty_package(name, re.sub(r"[^\d.]|\.\*", "", version[0]) if version else "1", channel)
    result = rendered[0].run_build(ToolConfiguration(test_strategy="native"), output_dir=channel, channels=[channel.as_uri()],
                                   env_isolation=EnvironmentIsolation.NONE)  # fmt: skip
    print("built and tested", *(Path(package).name for package in result.packages))


if __name__ == "__main__":
    main()
