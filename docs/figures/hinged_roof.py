#!/usr/bin/python3
"""Draws hinged_roof.png: all branches of examples/path/hinged_roof.yaml, the load over three displacements.

    python3 docs/figures/hinged_roof.py RESULTS

RESULTS is the deck's result folder. Thick: stable; dotted: not. Squares: bifurcation points, circles: limit points of
the load. Needs python3-matplotlib.
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
COLOURS = ["black", "#c0392b", "#1f5fa8", "#2e8b57", "#d68910", "#8e44ad", "#117a8b", "#b03a6f", "#7f8c8d"]
LOAD = 3000  # N at load factor 1
# Column, label, factor, range of abscissas, range of loads
PANELS = [("centre_uz", "centre goes down by [mm]", -1, None, None),
          ("centre_uz", "centre goes down by [mm]: where it branches", -1, (8.5, 23.5), (-450, 650)),
          ("edge_uz", "middle of the free edge goes down by [mm]", -1, (-3, 32), (-450, 650)),
          ("sway", "centre sways by [mm]", 1, None, (-450, 650))]


def table(file):
    with open(file) as lines:
        return list(csv.DictReader(lines))


def draw(axes, rows, points, monitor, factor):
    for branch in sorted({int(r["branch"]) for r in rows}, reverse=True):
        mine = [r for r in rows if int(r["branch"]) == branch]
        x = [factor * float(r[monitor]) for r in mine]
        y = [LOAD * float(r["load_factor"]) for r in mine]
        stable = [int(r["negative_eigenvalues"]) == 0 for r in mine]
        colour = COLOURS[branch % len(COLOURS)]
        label = "symmetric path" if branch == 0 else f"branch {branch}"
        axes.plot(x, y, lw=0.9, ls=(0, (1.5, 1.5)), color=colour, label=label)
        for i in range(1, len(mine)):
            if stable[i] and stable[i - 1]:
                axes.plot(x[i - 1:i + 1], y[i - 1:i + 1], "-", lw=2.4, color=colour, solid_capstyle="round")
    for p in points:
        if ":" in p["kind"]:
            continue  # of a monitor
        fold = p["kind"] in ("minimum", "maximum")
        axes.plot(factor * float(p[monitor]), LOAD * float(p["load_factor"]), "o" if fold else "s",
                  ms=5 if fold else 4.5, mfc="none" if fold else "black", mec="black", mew=0.8)


def main():
    folder = pathlib.Path(sys.argv[1])
    rows, points = table(folder / "path.csv"), table(folder / "points.csv")
    figure, grid = plt.subplots(2, 2, figsize=(12, 9.5), constrained_layout=True)
    for axes, (monitor, label, factor, across, loads) in zip(grid.flat, PANELS):
        draw(axes, rows, points, monitor, factor)
        axes.set_xlabel(label)
        axes.set_ylabel("load [N]")
        axes.grid(lw=0.3)
        if across:
            axes.set_xlim(across)
        if loads:
            axes.set_ylim(loads)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    grid[0, 0].legend(handles[::-1], labels[::-1], fontsize=8, loc="upper left")
    figure.savefig(HERE / "hinged_roof.png", dpi=100)


main()
