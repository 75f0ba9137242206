#!/usr/bin/python3
"""Draws strip_roll.png: the strip on the roll over the elastica with hard contact.

    python3 docs/figures/strip_roll.py COARSE FINE NU03

with the result folders of examples/strip_roll/{solid,solid_fine,solid_nu03}.yaml; prints the errors that
docs/strip_roll.md quotes. Needs python3-matplotlib.
"""
import csv
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parents[1] / "test" / "accept" / "data"


def number(text):
    try:
        return float(text)
    except ValueError:
        return np.nan


def table(file):
    rows = [r for r in csv.reader(open(file)) if r and not r[0].startswith("#")]
    values = np.array([[number(x) for x in r] for r in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def main(coarse, fine, nu03):
    ref = table(DATA / "r1_x200_B.csv")
    runs = {"10 mm cells": (table(coarse + "/path.csv"), "#1f5fa8"),
            "5 mm cells": (table(fine + "/path.csv"), "#e08214"),
            "10 mm cells, nu = 0.3": (table(nu03 + "/path.csv"), "#c0392b")}
    figure, ((uz, force), (touch, error)) = plt.subplots(2, 2, figsize=(11, 8.2))
    inside = ref["lambda"] <= 0.25
    for axes, column in ((uz, "uz_tip"), (force, "N_total"), (touch, "uz_tip")):
        axes.plot(ref["lambda"][inside], ref[column][inside], color="#c8c8c8", lw=6, label="elastica, hard contact")
        # Plate instead of beam bending: the same curve with loads and forces divided by 0.91.
        scale = 1 if column == "uz_tip" else 1 / 0.91
        lam = ref["lambda"] / 0.91
        axes.plot(lam[lam <= 0.25], scale * ref[column][lam <= 0.25], color="#e8c4c0", lw=4, label="the same, plate bending")
    for name, (run, colour) in runs.items():
        lam = run["load_factor"]
        uz.plot(lam, run["tip_uz"], color=colour, lw=1.2, label=name)
        force.plot(lam, run["contact_force"], color=colour, lw=1.2, label=name)
        near = lam <= 0.006
        touch.plot(lam[near], run["tip_uz"][near], ".-", color=colour, ms=2, lw=1.2, label=name)
        if "nu" not in name:
            difference = run["tip_uz"] - np.interp(lam, ref["lambda"], ref["uz_tip"])
            error.plot(lam, difference, color=colour, lw=1.2, label=name)
            worst = np.argmax(abs(difference))
            print(f"{name}: largest error {abs(difference[worst]):.3f} mm at load factor {lam[worst]:.4f}, "
                  f"worst residual {run['residual'].max():.2e}")
    crossings = table(DATA / "r1_x200_B_node_crossing.csv")
    for name, (run, _) in runs.items():
        if "nu" in name:
            continue
        here = crossings["lambda_beam"] <= 0.25
        difference = np.interp(crossings["lambda_beam"][here], run["load_factor"], run["tip_uz"]) - crossings["uz_tip"][here]
        print(name, "at the crossings:", np.array2string(difference, precision=4))
    touch.set_xlim(0, 0.006)
    touch.set_ylim(-26, 0)
    for axes, title, label in ((uz, "tip deflection", "tip_uz, mm"), (force, "total force on the roll", "N"),
                               (touch, "touching the roll", "tip_uz, mm"), (error, "tip_uz minus elastica", "mm")):
        axes.set_title(title)
        axes.set_xlabel("load factor")
        axes.set_ylabel(label)
        axes.grid(alpha=0.4)
        axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(HERE / "strip_roll.png", dpi=80)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
