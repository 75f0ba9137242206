#!/usr/bin/python3
"""Draws wrinkling.png: the wrinkled sheet at three strains, and the height of its wrinkles over the strain.

    docs/figures/wrinkling.py RESULTS

The folder is that of a run of examples/shells/wrinkling_sheet.yaml. The marks are the first and last strain of
the finest meshes of test/peers/calculix/sheet.csv and test/peers/splines/sheet.csv.
"""
import csv
import pathlib
import sys

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

from strip_roll_tapered import Netcdf, names

HERE = pathlib.Path(__file__).resolve().parent
STRAINS, SCALE = (0.03, 0.1, 0.25), 20


def rows(file):
    with open(file) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def peers(code):
    """First and last strain, of the finest mesh."""
    points = rows(HERE.parents[1] / "test/peers" / code / "sheet.csv")[-6:]
    return [float(points[0]["strain"]), float(points[-1]["strain"])]


def states(folder, branch):
    file = Netcdf(pathlib.Path(folder) / f"results_branch{branch}.exo")
    X = np.array([file["coord" + c] for c in "xyz"]).T
    nodal, whole = names(file, "name_nod_var"), names(file, "name_glo_var")
    U = np.array([file[f"vals_nod_var{nodal.index('displ_' + c) + 1}"] for c in "xyz"])
    return X, U, file["vals_glo_var"][:, whole.index("load_factor")], file["connect1"] - 1


def sheet(axis, folder, branch, strain, height):
    """The whole sheet by its symmetries, between two states of the branch, seen at a slant; deflections enlarged."""
    X, U, load, cells = states(folder, branch)
    load = load[:int(np.argmax(load)) + 1]  # a branch may pass the last point, and come back
    i = int(np.clip(np.searchsorted(load, strain), 1, len(load) - 1))
    s = (strain - load[i - 1]) / (load[i] - load[i - 1])
    x = X + ((1 - s) * U[:, i - 1] + s * U[:, i]).T
    quarter = x[cells[:, [0, 4, 1, 5, 2, 6, 3, 7]]] * [1, 1, SCALE]
    whole = np.concatenate([quarter * [mx, my, 1] for mx in (1, -1) for my in (1, -1)])
    whole = whole[np.argsort(-whole[:, :, 1].mean(1))]  # the nearest last
    normal = np.cross(whole[:, 4] - whole[:, 0], whole[:, 6] - whole[:, 2])
    normal *= np.sign(normal[:, 2:]) / np.linalg.norm(normal, axis=1)[:, None]
    light = np.clip(normal @ (np.array([0, -1, 1.2]) / np.hypot(1, 1.2)), 0, 1) ** 2
    seen = np.stack([whole[:, :, 0] + 0.35 * whole[:, :, 1], 0.45 * whole[:, :, 1] + whole[:, :, 2]], axis=2)
    colors = plt.cm.bone(0.15 + 0.8 * light)
    axis.add_collection(PolyCollection(seen, facecolors=colors, edgecolors=colors, linewidths=0.3))
    axis.set(xlim=(-145, 145), ylim=(-29, 29), aspect="equal")
    axis.set_axis_off()
    axis.set_title(f"strain {strain:g}: {height:.2f} mm high", fontsize=10, pad=2)


def draw(folder):
    path = rows(pathlib.Path(folder) / "path.csv")
    branches = sorted({int(r["branch"]) for r in path} - {0})
    fig = plt.figure(figsize=(13, 5.6))
    axis = fig.add_axes([0.57, 0.1, 0.41, 0.86])
    for branch in [0] + branches:
        own = [r for r in path if int(r["branch"]) == branch]
        x, y = np.array([[float(r["load_factor"]), float(r["wrinkle"])] for r in own]).T
        for i, strain in enumerate(STRAINS if branch == branches[-1] else ()):
            there = int(np.argmax(x)) + 1
            height = abs(np.interp(strain, x[:there], y[:there]))
            sheet(fig.add_axes([0.0, 0.67 - 0.325 * i, 0.5, 0.28]), folder, branch, strain, height)
        stable = np.array([r["negative_eigenvalues"] == "0" for r in own])
        color = "k" if branch == 0 else f"C{branch - 1}"
        label = "flat" if branch == 0 else f"wrinkled, branch {branch}"
        axis.plot(x, np.where(stable, y, np.nan), color=color, lw=2, label=label)
        axis.plot(x, np.where(stable, np.nan, y), ":", color=color, lw=1.5)
    for code, name, mark in (("calculix", "CalculiX, C3D20R", "s"), ("splines", "thin plate, B-splines", "x")):
        axis.plot(peers(code), [0, 0], mark, color="C3" if mark == "s" else "C2", mfc="none", ms=10, label=name)
    axis.set(xlabel="strain", ylabel="deflection of the sheet's middle (mm)", xlim=(0, 0.3))
    axis.grid(True)
    axis.legend(loc="upper right", fontsize=9)
    fig.savefig(HERE / "wrinkling.png", dpi=100)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    draw(sys.argv[1])
