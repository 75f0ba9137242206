#!/usr/bin/python3
"""Draws examples_path.png: the diagrams of the decks in examples/path.

    python3 docs/figures/examples_path.py FOLDER

FOLDER holds the result folders <deck>_results of all decks (docs/examples_path.md says how to make them). Prints the
table of points that the page quotes. Needs python3-matplotlib.
"""
import csv
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
# Deck -> monitor along the axis of abscissas.
PANELS = [("stvk_bar", "shortening"), ("von_mises_truss", "sinking"), ("truss_on_spring", "load_point"),
          ("sway_truss", "sway"), ("lee_frame", "v"), ("bratu_1d", "middle"), ("bratu_2d", "middle"),
          ("euler_column", "tip_rotation"), ("euler_column_imperfect", "tip_rotation"), ("shallow_arch", "mode_1"),
          ("shallow_arch_imperfect", "mode_1"), ("pitchfork", "mode_1"), ("pitchfork_side_branch", "mode_1"),
          ("transcritical", "mode_1"), ("two_modes", "mode_1"), ("square_plate", "mode_x"),
          ("strut_on_foundation", "mode_1"), ("branch_trap", "mode_1"), ("euler_column_solid", "top_uz"),
          ("arch_solid", "sinking"), ("hill_top", "sway"), ("three_modes", "mode_1"),
          ("euler_column_both", "tip_rotation"), ("partial_follower", "tip_uz"), ("euler_column_crooked", "top_uz")]
COLOURS = ["#1f5fa8", "#c0392b", "#2e8b57", "#8e44ad", "#d68910", "#117a8b", "#7f8c8d", "#b03a6f", "#5d6d1e"]


def table(file):
    with open(file) as lines:
        return list(csv.DictReader(lines))


def draw(axes, folder, monitor):
    rows, points = table(folder / "path.csv"), table(folder / "points.csv")
    for branch in sorted({int(r["branch"]) for r in rows}):
        mine = [r for r in rows if int(r["branch"]) == branch]
        x, y = [float(r[monitor]) for r in mine], [float(r["load_factor"]) for r in mine]
        stable = [int(r["negative_eigenvalues"]) <= 0 for r in mine]
        colour = COLOURS[branch % len(COLOURS)]
        axes.plot(x, y, ":", lw=1, color=colour)
        begin = 0
        for i in range(1, len(mine) + 1):
            if i == len(mine) or stable[i] != stable[begin]:
                if stable[begin]:
                    axes.plot(x[begin:i], y[begin:i], "-", lw=1.6, color=colour)
                begin = i
    for p in points:
        if ":" in p["kind"]:
            continue  # of a monitor
        fold = p["kind"] in ("minimum", "maximum")
        axes.plot(float(p[monitor]), float(p["load_factor"]), "ko" if fold else "ks", ms=4,
                  fillstyle="none" if fold else "full")
    axes.set_xlabel(monitor, fontsize=7, labelpad=1)


def main():
    results = pathlib.Path(sys.argv[1])
    panels = [(d, m) for d, m in PANELS if (results / f"{d}_results" / "summary.json").exists()]
    missing = [d for d, _ in PANELS if d not in dict(panels)]
    if missing:
        sys.exit("no results of " + ", ".join(missing))
    figure, grid = plt.subplots(5, 5, figsize=(14.5, 13.5), constrained_layout=True)
    for axes in grid.flat[len(panels):]:
        axes.axis("off")
    for axes, (deck, monitor) in zip(grid.flat, panels):
        folder = results / f"{deck}_results"
        draw(axes, folder, monitor)
        axes.set_title(deck, fontsize=8)
        axes.tick_params(labelsize=6)
        axes.grid(lw=0.3)
        summary = json.loads((folder / "summary.json").read_text())
        kinds = [p["kind"] for p in summary["points"]]
        loads = ", ".join(f"{p['load_factor']:.10g}" for p in summary["points"])
        print(f"| {deck} | {summary['limit_points']} | {len(kinds)}{': ' + loads if loads else ''} | "
              f"{len(summary['branches'])} | {summary['steps']} | {summary['factorizations']} | "
              f"{summary['worst_residual']:.1e} |")
    figure.savefig(HERE / "examples_path.png", dpi=110)


main()
