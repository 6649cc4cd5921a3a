"""How well Reeb graphs find poses of one shape: python benchmarks/pose_search.py FOLDER [--count 40]

FOLDER holds meshes whose names are a kind and a number: cat0.off, cat1.off, david0.off .. as those of TOSCA (80 poses of
people and animals: Bronstein, Bronstein & Kimmel 2008), which are public but not to be passed on. As many of each kind as
make up the count are taken, by name. Every pose asks for those most like it: of as many answers as there are others of
its kind, the precision is the share that are; so is that of the first answer alone.
"""

import argparse
import re
import time
from collections import defaultdict
from itertools import zip_longest
from pathlib import Path

import numpy as np

import brushfire as bf


def kind_of(file):
    return re.match(r"\D+", file.stem)[0].rstrip("-_. ")


def taken_evenly(folder, count):
    """Files of all kinds, one of each in turn."""
    kinds = defaultdict(list)
    for file in sorted(folder.iterdir()):
        if re.match(r"\D+\d+$", file.stem):
            kinds[kind_of(file)].append(file)
    turns = zip_longest(*(kinds[name] for name in sorted(kinds)))
    return sorted([file for turn in turns for file in turn if file][:count])


def similarities(graphs):
    table = np.eye(len(graphs))
    for i, graph in enumerate(graphs):
        for j in range(i):
            table[i, j] = table[j, i] = graph.similarity(graphs[j])
    return table


def precision(table, kind):
    """Of every pose: the share of its own kind among as many answers as there are others of its kind, and at first."""
    near = np.argsort(-(table - 2 * np.eye(len(kind))), axis=1, kind="stable")
    others = np.array([(kind == k).sum() - 1 for k in kind])
    tier = np.array([(kind[near[i, : others[i]]] == kind[i]).mean() for i in range(len(kind))])
    return tier, kind[near[:, 0]] == kind


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--levels", type=int, default=5)
    parser.add_argument("--samples", type=int, default=100)
    given = parser.parse_args()
    files = taken_evenly(given.folder, given.count)
    kind = np.array([kind_of(file) for file in files])
    start = time.process_time()
    graphs = [
        bf.reeb_graph(bf.read(file), given.levels, samples=given.samples, method="novotni-klein") for file in files
    ]
    seconds = time.process_time() - start
    table = similarities(graphs)
    tier, first = precision(table, kind)
    for name in dict.fromkeys(kind):
        own = kind == name
        answers = kind[np.argsort(-(table[own] - 2 * np.eye(len(kind))[own]), axis=1)[:, 0]]
        print(f"{name} ({own.sum()}): precision {tier[own].mean():.2f}, first right {first[own].mean():.2f}; ", end="")
        print("first answers: " + ", ".join(f"{a} {(answers == a).sum()}" for a in dict.fromkeys(answers)))
    print(
        f"{len(files)} poses of {len(set(kind))} kinds, {given.levels} levels, {given.samples} samples: precision "
        f"{tier.mean():.3f} (by chance {np.mean([(kind == k).sum() - 1 for k in kind]) / (len(kind) - 1):.3f}), first right "
        f"{first.mean():.3f}; a graph takes {seconds / len(files):.1f} s of processor time"
    )
