#!/usr/bin/python3
"""Draws metal.png: the decks in examples/plasticity.

    python3 docs/figures/metal.py FOLDER

FOLDER holds the result folders <deck>_results of the decks (docs/metal.md says how to make them). Needs
python3-matplotlib.
"""
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
CALCULIX = HERE.parents[1] / "test/accept/data/ccx_metal/necking.csv"


def table(file):
    with open(file) as lines:
        return list(csv.DictReader(lines))


def column(rows, name):
    return [float(r[name]) for r in rows]


def main():
    results = pathlib.Path(sys.argv[1])
    figure, axes = plt.subplots(1, 3, figsize=(13, 4), constrained_layout=True)
    sphere, strip, neck = axes
    rows = table(results / "sphere_results/path.csv")
    sphere.plot(column(rows, "outside"), column(rows, "load_factor"), "-", color="#1f5fa8")
    c = [1 + 0.01 * i for i in range(84)]
    outside = [100 * 0.7 * 20 * x**3 / (200000 * 4) for x in c]
    sphere.plot(outside, [2 * math.log(x) + 2 / 3 * (1 - x**3 / 8) for x in c], "ko", ms=2.5, markevery=6)
    sphere.set(title="thick sphere (dots: Hill)", xlabel="outer radius grows by (mm)", ylabel="pressure / yield stress")
    rows = table(results / "springback_results/path.csv")
    for branch, colour in enumerate(["#1f5fa8", "#c0392b", "#2e8b57", "#8e44ad"]):
        mine = [r for r in rows if int(r["branch"]) == branch]
        strip.plot(column(mine, "tip"), column(mine, "load_factor"), "-", color=colour)
    strip.set(title="bent, let go, bent back, let go", xlabel="tip (mm)", ylabel="load / load of first yield")
    rows, calculix = table(results / "necking_results/path.csv"), table(CALCULIX)
    neck.plot([2 * x for x in column(rows, "load_factor")], column(rows, "force"), "-", color="#1f5fa8")
    neck.plot([2 * x for x in column(calculix, "load_factor")], column(calculix, "force"), "ko", ms=2.5)
    neck.set(title="necking bar (dots: CalculiX)", xlabel="elongation (mm)", ylabel="force (kN)", ylim=(0, 82))
    for a in axes:
        a.grid(lw=0.3)
    figure.savefig(HERE / "metal.png", dpi=110)


if __name__ == "__main__":
    main()
