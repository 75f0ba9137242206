#!/usr/bin/python3
"""Draws rubber.png: the diagrams of the decks in examples/rubber.

    python3 docs/figures/rubber.py FOLDER

FOLDER holds the result folders <deck>_results of the decks (docs/rubber.md says how to make them). Needs
python3-matplotlib.
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
COLOURS = ["#1f5fa8", "#c0392b", "#2e8b57"]


def table(file):
    with open(file) as lines:
        return list(csv.DictReader(lines))


def draw(axes, folder, x):
    """The load factor over x(row), thick where stable, with limit and bifurcation points."""
    rows, points = table(folder / "path.csv"), table(folder / "points.csv")
    for branch in sorted({int(r["branch"]) for r in rows}):
        mine = [r for r in rows if int(r["branch"]) == branch]
        xs, ys = [x(r) for r in mine], [float(r["load_factor"]) for r in mine]
        colour = COLOURS[branch % len(COLOURS)]
        axes.plot(xs, ys, ":", lw=1.2, color=colour)
        stable = [int(r["negative_eigenvalues"]) <= 0 for r in mine]
        begin = 0
        for i in range(1, len(mine) + 1):
            if i == len(mine) or stable[i] != stable[begin]:
                if stable[begin]:
                    axes.plot(xs[begin:i], ys[begin:i], "-", lw=2, color=colour)
                begin = i
    for p in points:
        if ":" not in p["kind"]:
            fold = p["kind"] in ("minimum", "maximum")
            axes.plot(x(p), float(p["load_factor"]), "ko" if fold else "ks", ms=5, fillstyle="none" if fold else "full")
    axes.grid(lw=0.3)


def main():
    results = pathlib.Path(sys.argv[1])
    figure, (balloon, biot, cook) = plt.subplots(1, 3, figsize=(13, 4), constrained_layout=True)
    draw(balloon, results / "balloon_results", lambda r: 1 + float(r["growth"]))
    stretches = [1.02 + 0.01 * i for i in range(398)]
    balloon.plot(stretches, [(1 / s - s**-7) * (1 + 0.1 * s * s) for s in stretches], "k--", lw=0.6)
    balloon.set(title="balloon (dashed: membrane)", xlabel="stretch", ylabel="p r0 / (4 h0 c1)")
    draw(biot, results / "biot_results", lambda r: float(r["crest"]) - float(r["trough"]))
    biot.set(title="Biot's half space", xlabel="height of the wave", ylabel="strain", ylim=(0.38, 0.46))
    draw(cook, results / "cook_results", lambda r: float(r["middle"]))
    cook.plot([0, 16.4326], [0, 1], "k--", lw=0.6)
    cook.set(title="Cook's membrane (dashed: linear)", xlabel="rise of the right edge", ylabel="load factor")
    figure.savefig(HERE / "rubber.png", dpi=110)


if __name__ == "__main__":
    main()
