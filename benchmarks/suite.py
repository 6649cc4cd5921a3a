"""The standard comparison: every mesh of the list below, our methods and the peers, into one JSON file.

    python suite.py results.json [--only MESH,MESH] [options of peers.py that apply to all, such as --core or --other]

Meshes come from a package or are made (meshes.py). Those that cannot be had are left out, and said to be.
"""

import argparse
import os
import tempfile
import time
from pathlib import Path

import meshes
import peers

MARCHING = "novotni-klein,novotni-klein:float64,carried-source,kimmel-sethian,novotni-klein-2002,dijkstra"
WINDOWS = "windows:1e-2,windows:1e-3,windows:1e-4,windows:1e-5,exact"
FAST = "meshlib,pymeshlab,gc-fmm"
ALL = {"methods": f"{MARCHING},{WINDOWS}"}
SMALL = ALL | {"peers": f"{FAST},gc-heat,pygeodesic,gdist,igl-exact", "rounds": 5}
SCAN = ALL | {"peers": f"{FAST},gc-heat,pygeodesic", "rounds": 5}
STRETCHED = ALL | {"peers": f"{FAST},pygeodesic", "rounds": 3, "patience": 10}
LARGE = ALL | {"peers": FAST, "rounds": 5, "patience": 300, "once": "windows:1e-5,exact,vtp,novotni-klein-2002"}
# Ten minutes with everything that is installed first, on two cores that do nothing else: three meshes, few rounds.
QUICK = ALL | {"peers": f"{FAST},gc-heat,pygeodesic", "rounds": 2, "patience": 20, "once": "pygeodesic,gc-heat"}

SUITE = {
    "fandisk": SMALL,
    "man": SCAN,
    "bunny": SCAN,
    "armadillo": SCAN,
    "refined_elephant": SCAN,
    "folded-sphere": SCAN,
    "grid100": SMALL,
    "fandisk-x10": STRETCHED,
    "bunny-x10": STRETCHED,
    "grid100-shear": STRETCHED,
    "bunny-s2": LARGE | {"refine": 2},
    "armadillo-s2": LARGE | {"refine": 2},
    "refined_elephant-s2": LARGE | {"refine": 2},
    "fandisk-s4": LARGE | {"refine": 4},
}
QUICK_SUITE = {"fandisk": QUICK, "bunny": QUICK, "grid100-shear": QUICK | {"patience": 10}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", type=Path)
    parser.add_argument("--only", help="names of the suite, separated by commas")
    parser.add_argument("--quick", action="store_true", help="three meshes, few rounds")
    chosen, passed_on = parser.parse_known_args()
    suite = QUICK_SUITE if chosen.quick else SUITE
    begin = time.monotonic()
    for name in chosen.only.split(",") if chosen.only else suite:
        settings = dict(suite[name])
        base = name.removesuffix(f"-s{settings['refine']}") if "refine" in settings else name
        with tempfile.TemporaryDirectory() as folder:
            mesh = meshes.find(base, folder)
            if mesh is None:
                print(f"{name}: left out, CGAL's demonstration data (Debian's libcgal-demo) is not at hand")
                continue
            arguments = [str(mesh), "--json", str(chosen.json)]
            for option, value in settings.items():
                arguments += [f"--{option}", str(value)]
            peers.run(peers.parse([*arguments, *passed_on]))  # the last one of an option counts
    used = os.times()
    print(f"\nMeasured in {time.monotonic() - begin:.0f} s, {used.children_user + used.children_system:.0f} s of them processor time.")


if __name__ == "__main__":
    main()
