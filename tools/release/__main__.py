"""./run release: what a version is handed out as, in dist/; of one commit the same bytes each time.

Source tarball, sdist, wheel (its libraries put in by auditwheel), npm tarball (where ./run web has built the WebAssembly), an
SBOM of what is in the wheel (CycloneDX), and SHA256SUMS. Then the wheel is installed in an empty environment, and used.
"""

from __future__ import annotations

import gzip
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import venv
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
DIST = ROOT / "dist"
SCRATCH = ROOT / "build/dist"
# Headers that are compiled in, and the licences of what Debian's packages hold.
HEADERS = ("libboost-dev", "libstb-dev", "libfast-float-dev")
LICENCES = {
    "libboost-dev": "BSL-1.0",
    "libstb-dev": "MIT OR Unlicense",
    "libfast-float-dev": "Apache-2.0 OR MIT OR BSL-1.0",
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
}
FIRST_STEPS = """
import brushfire as bf
square = bf.Mesh([[0, 0], [3, 0], [3, 4], [0, 4]], [[0, 1, 2], [0, 2, 3]])
assert square.distance(0, method="exact").tolist() == [0, 3, 5, 4]
assert square.path(0, 2).length == 5
print("brushfire", bf.__version__, "computes")
"""


def run(*command: str | Path, cwd: Path = ROOT, **more: str) -> str:
    done = subprocess.run(command, cwd=cwd, env=os.environ | more, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout.strip()


def version() -> str:
    """That of CMakeLists.txt; where else one is stated it has to be the same."""
    stated = {
        "CMakeLists.txt": re.search(r"project\(brushfire VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
        "js/package.json": json.loads((ROOT / "js/package.json").read_text())["version"],
        "CITATION.cff": re.search(r"^version: (\S+)", (ROOT / "CITATION.cff").read_text(), re.MULTILINE)[1],
    }
    if len(set(stated.values())) != 1:
        raise SystemExit(f"versions differ: {stated}")
    return stated["CMakeLists.txt"]


def source_tarball(name: str) -> None:
    """What git knows of the commit, and nothing that only lies about."""
    command = ["git", "archive", f"--prefix={name}/", "HEAD"]
    tar = subprocess.run(command, cwd=ROOT, check=True, capture_output=True).stdout
    with (
        (DIST / f"{name}-source.tar.gz").open("wb") as raw,
        gzip.GzipFile(filename="", mode="wb", fileobj=raw, mtime=0) as packed,
    ):
        packed.write(tar)


def sdist() -> Path:
    run(sys.executable, "-m", "build", "--sdist", "--outdir", DIST)
    return next(DIST.glob("brushfire-*[0-9].tar.gz"))


def wheel(of_sdist: Path) -> tuple[Path, list[Path]]:
    """Made of the sdist, so that what it lacks is missed; and the system's libraries that are now in it."""
    with tarfile.open(of_sdist) as archive:
        archive.extractall(SCRATCH, filter="data")
    sources = SCRATCH / of_sdist.name.removesuffix(".tar.gz")
    # The compiler cache then knows the objects of ./run python.
    run(sys.executable, "-m", "pip", "wheel", "--disable-pip-version-check", "--no-deps", "-w", SCRATCH, sources,
        CCACHE_BASEDIR=str(sources), CCACHE_NOHASHDIR="1", CXX=os.environ.get("CXX", "c++"))  # fmt: skip
    raw = next(SCRATCH.glob("*.whl"))
    with zipfile.ZipFile(raw) as archive:
        archive.extractall(SCRATCH / "wheel")
    module = next((SCRATCH / "wheel").rglob("_core*.so"))
    needed = re.findall(r"=> (\S+)", run("ldd", module))
    run(sys.executable, "-m", "auditwheel", "repair", "--strip", "-w", DIST, raw)
    repaired = next(DIST.glob("*.whl"))
    with zipfile.ZipFile(repaired) as archive:
        stems = {re.split(r"-[0-9a-f]{8}", Path(name).name)[0] for name in archive.namelist() if ".libs/" in name}
    return repaired, [Path(path) for path in needed if any(Path(path).name.startswith(stem) for stem in stems if stem)]


def npm_tarball() -> None:
    if not (ROOT / "js/lib/brushfire.wasm").exists() or not shutil.which("npm"):
        print("(no npm tarball: ./run web builds what it holds)")
        return
    run("npm", "pack", "--pack-destination", DIST, cwd=ROOT / "js")


def owner(library: Path) -> str:
    """Debian's package of a file."""
    for path in (library, library.resolve(), Path("/usr") / library.relative_to("/")):
        done = subprocess.run(["dpkg", "-S", path], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    raise SystemExit(f"no package owns {library}")


def component(package: str) -> dict:
    licence = next((LICENCES[key] for key in sorted(LICENCES, reverse=True) if package.startswith(key)), None)
    if licence is None:
        raise SystemExit(f"tools/release.py does not know the licence of {package}")
    installed = run("dpkg-query", "-W", "-f=${Version}", package)
    return {
        "type": "library",
        "name": package,
        "version": installed,
        "purl": f"pkg:deb/debian/{package}@{installed}",
        "licenses": [{"expression": licence}],
    }


def sbom(of_version: str, libraries: list[Path]) -> None:
    packages = sorted({*HEADERS, *map(owner, libraries)})
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "component": {
                "type": "library",
                "name": "brushfire",
                "version": of_version,
                "licenses": [{"expression": "MIT"}],
            }
        },
        "components": [component(package) for package in packages],
    }
    (DIST / f"brushfire-{of_version}.cdx.json").write_text(json.dumps(document, indent=1) + "\n")


def try_wheel(file: Path) -> None:
    """Where there is no compiler to fall back on, and nothing else of ours."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        venv.create(folder / "venv", with_pip=True)
        python = folder / "venv/bin/python"
        run(
            python,
            "-m",
            "pip",
            "install",
            "--disable-pip-version-check",
            "--only-binary",
            ":all:",
            file,
            CC="false",
            CXX="false",
        )
        print(run(python, "-c", FIRST_STEPS, cwd=folder))


def main() -> None:
    now = version()
    shutil.rmtree(DIST, ignore_errors=True)
    shutil.rmtree(SCRATCH, ignore_errors=True)
    DIST.mkdir()
    SCRATCH.mkdir(parents=True)
    os.environ["SOURCE_DATE_EPOCH"] = run("git", "log", "-1", "--format=%ct")
    if run("git", "status", "--porcelain"):
        print("(the tree is not clean: the source tarball is that of the last commit, the packages are not)")
    source_tarball(f"brushfire-{now}")
    made, libraries = wheel(sdist())
    npm_tarball()
    sbom(now, libraries)
    files = sorted(DIST.iterdir())
    sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files]
    (DIST / "SHA256SUMS").write_text("".join(sums))
    for file in files:
        print(f"{file.stat().st_size / 1e6:8.2f} MB  dist/{file.name}")
    try_wheel(made)


if __name__ == "__main__":
    main()
