#!/usr/bin/python3
"""Draws failure_map.png from the table that `atrapos map` writes, and prints the tables of docs/failure_map.md.

    python3 docs/figures/failure_map.py map.csv

A panel a problem: orders from left to right, delta from top to bottom, in each cell the polynomial (left) and the rational
series (right), coloured by how the run ended, with its number of steps. Needs python3-matplotlib.
"""
import collections
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
COLOURS = {"end": "#cfe8cf", "ended": "#f6d55c", "limit": "#f2c6a0", "residual": "#b39ddb", "jumped": "#e57373",
           "turned": "#c2185b"}


def main():
    with open(sys.argv[1]) as lines:
        rows = list(csv.DictReader(lines))
    problems = list(dict.fromkeys(r["problem"] for r in rows))
    orders = list(dict.fromkeys(r["order"] for r in rows))
    deltas = list(dict.fromkeys(r["delta"] for r in rows))
    columns = 4
    height = math.ceil(len(problems) / columns)
    figure, grid = plt.subplots(height, columns, figsize=(14, 2.6 * height), constrained_layout=True)
    for axes in grid.flat[len(problems):]:
        axes.axis("off")
    for axes, problem in zip(grid.flat, problems):
        for row in (r for r in rows if r["problem"] == problem):
            x, y = orders.index(row["order"]), deltas.index(row["delta"])
            left = x + (0.5 if row["pade"] != "off" else 0)
            axes.add_patch(plt.Rectangle((left, y), 0.5, 1, facecolor=COLOURS[row["outcome"]], edgecolor="white"))
            axes.text(left + 0.25, y + 0.5, row["steps"], ha="center", va="center", fontsize=5)
        axes.set_xlim(0, len(orders))
        axes.set_ylim(len(deltas), 0)
        axes.set_xticks([i + 0.5 for i in range(len(orders))], orders, fontsize=6)
        axes.set_yticks([i + 0.5 for i in range(len(deltas))], deltas, fontsize=6)
        axes.set_title(problem, fontsize=8)
    handles = [plt.Rectangle((0, 0), 1, 1, facecolor=c) for c in COLOURS.values()]
    figure.legend(handles, COLOURS, loc="outside lower center" if hasattr(figure, "_outside") else "lower right", ncols=3,
                  fontsize=8)
    figure.savefig(HERE / "failure_map.png", dpi=110)

    print("| problem | runs | " + " | ".join(COLOURS) + " | bifurcation points missed (runs) |")
    for problem in problems:
        mine = [r for r in rows if r["problem"] == problem]
        counts = collections.Counter(r["outcome"] for r in mine)
        missed = sum(r["outcome"] == "end" and int(r["points"]) < int(r["points_expected"]) for r in mine)
        print(f"| {problem} | {len(mine)} | " + " | ".join(str(counts[o]) for o in COLOURS) + f" | {missed} |")
    for setting in (("10", "1e-06"), ("20", "1e-06"), ("20", "1e-10"), ("30", "1e-06")):
        print(f"\nK = {setting[0]}, delta = {setting[1]}: steps (factorizations) polynomial / rational")
        for problem in problems:
            pair = {r["pade"]: r for r in rows
                    if r["problem"] == problem and (r["order"], r["delta"]) == setting}
            if "off" in pair and "automatic" in pair:
                off, on = pair["off"], pair["automatic"]
                print(f"| {problem} | {off['steps']} ({off['factorizations']}) | {on['steps']} "
                      f"({on['factorizations']}) | {float(off['worst_residual']):.0e} / "
                      f"{float(on['worst_residual']):.0e} | {off['outcome']} / {on['outcome']} |")
    bad = [r for r in rows if r["outcome"] not in ("end",)]
    print("\nruns that do not reach the end:")
    for r in bad:
        print(f"{r['problem']} K {r['order']} delta {r['delta']} {r['pade']}: {r['outcome']}, {r['steps']} steps: {r['reason']}")


main()
