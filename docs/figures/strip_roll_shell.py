#!/usr/bin/python3
"""Draws strip_roll_shell.png: contact forces of three stations of the strip over the load factor, as the paper's Figure 4,
and the strip's tip against the elastica.

    python3 docs/figures/strip_roll_shell.py SHELL NU0

with the result folders of examples/strip_roll/shell.yaml as it is and with poissons_ratio 0; prints the deviations that
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
ROOT = HERE.parents[1]


def number(text):
    try:
        return float(text)
    except ValueError:
        return np.nan


def table(file):
    rows = [r for r in csv.reader(open(file)) if r and not r[0].startswith("#")]
    values = np.array([[number(x) for x in r] for r in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def main(shell, nu0):
    stations = table(ROOT / "packages" / "contact" / "test" / "data" / "roll_41_stations_alpha1e3_eta1e-2.csv")
    everywhere = table(ROOT / "test" / "accept" / "data" / "r1_x200_A.csv")
    runs = {"nu = 0.3": table(shell + "/path.csv"), "nu = 0": table(nu0 + "/path.csv")}
    figure, (forces, tip) = plt.subplots(1, 2, figsize=(11, 4.4))
    for station, colour in ((200, "#1f5fa8"), (210, "#e08214"), (220, "#c0392b")):
        run = runs["nu = 0.3"]
        forces.plot(run["load_factor"], run[f"force_{station}"], color=colour, lw=1.3, label=f"s = {station} mm")
        forces.plot(stations["lambda"], stations[f"R_s{station}"], "o", color=colour, ms=3, mfc="none")
        run = runs["nu = 0"]
        forces.plot(run["load_factor"], run[f"force_{station}"], "--", color=colour, lw=0.9)
        inside = (stations["lambda"] > 0) & (stations["lambda"] <= 2)
        difference = np.interp(stations["lambda"], run["load_factor"], run[f"force_{station}"]) - stations[f"R_s{station}"]
        relative = abs(difference[inside]) / stations["R_sum_signed"][inside]
        print(f"station {station}: off by {100 * relative.max():.2f} % of the sum of forces at most (nu = 0)")
    forces.set_xlim(0, 0.25)
    forces.set_ylim(-1, 23)
    forces.set_xlabel("load factor")
    forces.set_ylabel("contact force, N")
    forces.set_title("three stations (lines: nu = 0.3, dashed: nu = 0, circles: elastica)")
    inside = everywhere["lambda"] <= 2
    tip.plot(everywhere["lambda"][inside], everywhere["uz_tip"][inside], color="#c8c8c8", lw=6, label="elastica, hard contact everywhere")
    tip.plot(stations["lambda"], stations["uz_tip"], "o", color="#555555", ms=3, mfc="none", label="elastica, 41 stations")
    for name, colour in (("nu = 0.3", "#1f5fa8"), ("nu = 0", "#e08214")):
        tip.plot(runs[name]["load_factor"], runs[name]["tip_uz"], color=colour, lw=1.2, label=name)
    tip.set_xscale("log")
    tip.set_xlim(3e-4, 2)
    tip.set_xlabel("load factor")
    tip.set_ylabel("tip_uz, mm")
    tip.set_title("tip deflection")
    for axes in (forces, tip):
        axes.grid(alpha=0.4)
        axes.legend(fontsize=8)
    run, inside = runs["nu = 0"], (stations["lambda"] > 0) & (stations["lambda"] <= 2)
    for monitor, column in (("tip_ux", "ux_tip"), ("tip_uz", "uz_tip")):
        difference = abs(np.interp(stations["lambda"], run["load_factor"], run[monitor]) - stations[column])[inside]
        print(f"{monitor}: off by {difference.max():.3f} mm at most (nu = 0)")
    figure.tight_layout()
    figure.savefig(HERE / "strip_roll_shell.png", dpi=80)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
