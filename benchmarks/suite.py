"""The standard comparison: every mesh of the list below, our methods and the peers, into one JSON file.

    python suite.py results.json [--only MESH,MESH] [options of peers.py that apply to all, such as --core or --other]

Meshes are taken from the shared data directory beside the project (with its exact fields) where there is one, from
Debian's libcgal-demo otherwise; those that are in neither are left out, and said to be.
"""

import argparse
import tarfile
import tempfile
from pathlib import Path

import peers

SHARED = Path(__file__).resolve().parents[2] / "shared"
DEMO = Path("/usr/share/doc/libcgal-demo/data.tar.gz")

MARCHING = "novotni-klein,novotni-klein:float64,kimmel-sethian,novotni-klein-2002,dijkstra"
WINDOWS = "windows:1e-2,windows:1e-3,windows:1e-4,windows:1e-5,exact"
FAST = "meshlib,pymeshlab,gc-fmm"
ALL = {"methods": f"{MARCHING},{WINDOWS}"}
SMALL = ALL | {"peers": f"{FAST},gc-heat,pygeodesic,gdist,igl-exact", "rounds": 5}
SCAN = ALL | {"peers": f"{FAST},gc-heat,pygeodesic", "rounds": 5}
STRETCHED = ALL | {"peers": f"{FAST},pygeodesic", "rounds": 3, "patience": 10}
LARGE = ALL | {"peers": FAST, "rounds": 5, "patience": 300, "once": "windows:1e-5,exact,vtp,novotni-klein-2002"}

SUITE = {
    "fandisk": SMALL,
    "rocker-arm": SMALL,
    "man": SCAN,
    "stanford-bunny": SCAN,
    "armadillo": SCAN,
    "refined_elephant": SCAN,
    "horse": SCAN,
    "grid100": SMALL,
    "fertility-x10": STRETCHED,
    "rocker-arm-x10": STRETCHED,
    "grid100-shear": STRETCHED,
    "stanford-bunny-s2": LARGE | {"refine": 2},
    "armadillo-s2": LARGE | {"refine": 2},
    "horse-s2": LARGE | {"refine": 2},
    "refined_elephant-s2": LARGE | {"refine": 2},
    "fandisk-s4": LARGE | {"refine": 4},
}


def find(name, folder):
    """The file of a mesh, or None."""
    shared = SHARED / "meshes" / f"{name}.ply"
    if shared.exists():
        return shared
    if DEMO.exists():
        with tarfile.open(DEMO) as archive:
            member = f"data/meshes/{name}.off"
            if member in archive.getnames():
                archive.extract(member, folder)
                return Path(folder) / member
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", type=Path)
    parser.add_argument("--only", help="names of the suite, separated by commas")
    chosen, passed_on = parser.parse_known_args()
    for name in chosen.only.split(",") if chosen.only else SUITE:
        settings = dict(SUITE[name])
        base = name.removesuffix(f"-s{settings['refine']}") if "refine" in settings else name
        with tempfile.TemporaryDirectory() as folder:
            mesh = find(base, folder)
            if mesh is None:
                print(f"{name}: left out, its file is neither in the shared data nor in libcgal-demo")
                continue
            truth = SHARED / "truth" / f"{base}.0.npy"
            if truth.exists() and "refine" not in settings:
                settings["truth"] = truth
            arguments = [str(mesh), "--json", str(chosen.json), *passed_on]
            for option, value in settings.items():
                arguments += [f"--{option}", str(value)]
            peers.run(peers.parse(arguments))


if __name__ == "__main__":
    main()
