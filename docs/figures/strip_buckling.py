#!/usr/bin/python3
"""Draws strip_buckling.png and strip_buckling_shape.png, after Figures 9 and 8 of the paper.

    docs/figures/strip_buckling.py RESULTS [STUDY=RESULTS ...]

The first folder is of examples/strip_buckling/tapered.yaml; the others, with a name each, are of variants of it, whose
growth is drawn beside. Prints the load at which each buckles.
"""
import csv
import pathlib
import sys

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from strip_roll_tapered import Netcdf, names

LOADS = (8, 44, 120)  # of Figure 9, MPa
PAPER, GUEYDAN = 13.1, 12.9


def table(folder):
    with open(pathlib.Path(folder) / "path.csv") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    values = np.array([[float(x) for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def growth(folder):
    """Load and deflection of the middle less that of the crest, at x = 470 mm."""
    t = table(folder)
    return t["load_factor"], t["w_0"] - t["w_100"]


def bend(load, q):
    """Load at which the slope of q changes most, of means over 1 MPa, between 5 and 25 MPa."""
    at = np.arange(5, min(25, load[-1] - 1.6), 0.1)
    mean = lambda x: np.mean([np.interp(x + d, load, q) for d in np.linspace(-0.5, 0.5, 11)], axis=0)
    return at[np.argmax(abs(mean(at + 1) - 2 * mean(at) + mean(at - 1)))]


class Shapes:
    """The middle surface at the ends of the steps."""

    def __init__(self, folder):
        f = Netcdf(pathlib.Path(folder) / "results.exo")
        self.X = np.array([f["coord" + c] for c in "xyz"]).T
        n, g = names(f, "name_nod_var"), names(f, "name_glo_var")
        self.U = np.array([f[f"vals_nod_var{n.index('displ_' + c) + 1}"] for c in "xyz"])
        self.load = f["vals_glo_var"][:, g.index("load_factor")]
        self.cells = f["connect1"] - 1

    def at(self, load):
        """Displacements between the two steps around a load."""
        i = np.clip(np.searchsorted(self.load, load), 1, len(self.load) - 1)
        s = (load - self.load[i - 1]) / (self.load[i] - self.load[i - 1])
        return ((1 - s) * self.U[:, i - 1] + s * self.U[:, i]).T


def draw_profiles(folder, studies):
    shapes = Shapes(folder)
    X = shapes.X
    row = X[X[:, 2] > X[:, 2].max() - 1e-6, 0]
    x = row[np.argmin(abs(row - 470))]
    on = np.where((abs(X[:, 0] - x) < 1e-6) & (X[:, 2] > 0))[0]
    on = on[np.argsort(X[on, 1])]
    fig, axes = plt.subplots(1, 2, figsize=(13, 4.6))
    for load in LOADS:
        axes[0].plot(X[on, 1], shapes.at(load)[on, 2], marker=".", label=f"{load} MPa")
    axes[0].set(xlabel="y (mm), from the strip's middle to its edge", ylabel="vertical displacement (mm)",
                title=f"across the strip at x = {x:.0f} mm")
    for name, result in [("256 elements", folder)] + studies:
        load, q = growth(result)
        axes[1].plot(load, q, label=name, lw=2 if result == folder else 1)
        print(f"{name:30} buckles at {bend(load, q):.1f} MPa; buckle at 20 MPa {np.interp(20, load, q):.3f} mm")
    for value, name in ((PAPER, "paper, 13.1 MPa"), (GUEYDAN, "Gueydan, 12.9 MPa")):
        axes[1].axvline(value, color="k", ls="-" if value == PAPER else ":", lw=0.8, label=name)
    axes[1].set(xlim=(0, 40), ylim=(-1.3, 0.2), xlabel="tension (MPa)", ylabel="w(y = 0) - w(y = 100) (mm)",
                title=f"growth of the buckle at x = {x:.0f} mm")
    for axis in axes:
        axis.grid(True)
        axis.legend(fontsize=8)
    fig.tight_layout()
    fig.savefig(pathlib.Path(__file__).with_name("strip_buckling.png"), dpi=100)


def draw_shape(folder, load=40, scale=40):
    """The whole strip by symmetry in y, its free part's vertical displacement enlarged."""
    shapes = Shapes(folder)
    u = shapes.at(load).copy()
    free = shapes.X[:, 0] > 0
    u[free, 2] *= scale
    x = shapes.X + u
    fig = plt.figure(figsize=(11, 6))
    axis = fig.add_subplot(projection="3d")
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    quads = x[shapes.cells[:, [0, 4, 1, 5, 2, 6, 3, 7]]]
    value = np.where(free, u[:, 2] / scale, np.nan)[shapes.cells[:, :4]].mean(1)
    norm = plt.Normalize(np.nanmin(value), np.nanmax(value))
    colors = plt.cm.viridis(norm(np.nan_to_num(value, nan=norm.vmin)))
    colors[np.isnan(value)] = (0.75, 0.75, 0.75, 1)
    for mirror in (1, -1):
        axis.add_collection3d(
            Poly3DCollection(quads * [1, mirror, 1], facecolors=colors, edgecolors="k", linewidths=0.2))
    axis.set(xlim=(-250, 1000), ylim=(-200, 200), zlim=(0, 330), xlabel="x (mm)", ylabel="y (mm)", zlabel="z (mm)")
    axis.set(yticks=(-200, 0, 200), zticks=(0, 250))
    axis.set_box_aspect((1250, 600, 330), zoom=1.15)
    axis.view_init(elev=32, azim=-50)
    fig.colorbar(plt.cm.ScalarMappable(norm, "viridis"), ax=axis, shrink=0.4, aspect=40, pad=0.02, location="bottom",
                 label=f"w of the free part at {load} MPa (mm), drawn {scale} times")
    fig.savefig(pathlib.Path(__file__).with_name("strip_buckling_shape.png"), dpi=120, bbox_inches="tight")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    draw_profiles(sys.argv[1], [tuple(a.rsplit("=", 1)) for a in sys.argv[2:]])
    draw_shape(sys.argv[1])
