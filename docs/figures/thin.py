#!/usr/bin/python3
"""Draws thin.png: the diagrams of the decks in examples/thin.

    python3 docs/figures/thin.py FOLDER

FOLDER holds the result folders <deck>_results of the decks. Needs python3-matplotlib.
"""
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from rubber import draw  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent


def arc(height, half=50, shear=0.4, bulk=400, thickness=0.5, prestress=0.01):
    """The pressure of an arc of neo-Hookean rubber of this height (docs/theory/thin.md)."""
    angle = 2 * math.atan(height / half)
    stretch, first = angle / math.sin(angle), bulk - 2 * shear / 3
    t = 1 / stretch
    for _ in range(50):
        t -= (shear * (t * t - 1) + first * math.log(stretch * t)) / (2 * shear * t + first / t)
    force = shear * (stretch - 1 / stretch) + first * math.log(stretch * t) / stretch
    return thickness * (force + prestress * stretch) * math.sin(angle) / half


def main():
    results = pathlib.Path(sys.argv[1])
    figure, (inflated, bars, dome) = plt.subplots(1, 3, figsize=(13, 4), constrained_layout=True)
    draw(inflated, results / "inflated_results", lambda r: float(r["height"]))
    heights = [1 + i for i in range(80)]
    inflated.plot(heights, [arc(h) / 0.01 for h in heights], "k--", lw=0.8)
    inflated.set(title="inflated membrane (dashed: closed form)", xlabel="height, mm", ylabel="pressure, 0.01 MPa")
    draw(bars, results / "two_bars_results", lambda r: -float(r["sinking"]))
    bars.set(title="two bars", xlabel="sinking, m", ylabel="load, MN")
    draw(dome, results / "dome_results", lambda r: -float(r["displacement"]))
    dome.set(title="star dome", xlabel="sinking of the apex, cm", ylabel="load, kN")
    figure.savefig(HERE / "thin.png", dpi=90)


if __name__ == "__main__":
    main()
