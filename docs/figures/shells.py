#!/usr/bin/python3
"""Draws shells_paths.png and shells_shapes.png from runs of examples/shells/*.yaml.

    python3 docs/figures/shells.py FOLDER

FOLDER has the result folders <deck>_results of all decks. Prints the values and deviations that docs/shells.md quotes.
Needs python3-matplotlib and python3-scipy.
"""
import csv
import pathlib
import sys

import matplotlib
import numpy as np
from scipy.io import netcdf_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parents[1] / "packages" / "solid" / "test" / "data"
TOP = (4, 16, 5, 17, 6, 18, 7, 19)  # outline of a HEX20's top face

# deck: title, table, [monitor, sign, label], mirror planes of the shape
NONLINEAR = {
    "end_shear": ("cantilever, end shear", "sze31_end_shear.csv", [("tip_ux", -1, "-u"), ("tip_uz", 1, "w")], ""),
    "end_moment": ("cantilever, end moment", "sze32_end_moment.csv", [("tip_ux", -1, "-u"), ("tip_uz", 1, "w")], ""),
    "slit_annulus": ("slit annulus", "sze33_slit_annulus.csv", [("inner_uz", 1, "inner w"), ("outer_uz", 1, "outer w")], ""),
    "hemisphere_hole": ("hemisphere with hole", "sze34_hemisphere18.csv", [("pulled_ux", 1, "pulled u"), ("pushed_uy", -1, "pushed -v")], "xy"),
    "hinged_roof_12.7": ("hinged roof, 12.7", "sze38_roof_iso_h12p7.csv", [("centre_uz", -1, "-w")], "xy"),
    "hinged_roof_6.35": ("hinged roof, 6.35", "sze38_roof_iso_h6p35.csv", [("centre_uz", -1, "-w")], "xy"),
}
LINEAR = {  # title, monitor, quoted value per load factor, mirror planes, magnification
    "scordelis_lo": ("Scordelis-Lo roof", "edge_uz", -0.3024, "xy", 1e5),
    "pinched_cylinder": ("pinched cylinder", "under_force", -1.8248e-5, "xyz", 4e6),
    "hemisphere": ("hemisphere, linear", "pulled_ux", 0.0935, "xy", 2e3),
    "morley": ("Morley's plate", "centre_uz", -4.0786e-4 * 1e-10 * 12 * 0.91 / 1e-9, "", 4e4),
    "morley_equal": ("Morley's plate", "centre_uz", -4.0786e-4 * 1e-7 * 12 * 0.91 / 1e-6, "", 4e4),
}


def path(folder):
    rows = [r for r in csv.reader(open(folder / "path.csv")) if r and not r[0].startswith("#")]
    values = np.array([[float(x) for x in r] for r in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def table(name):
    rows = [r for r in csv.reader(open(DATA / name)) if r and not r[0].startswith("#")]
    return np.array([[float(x) for x in r] for r in rows])


def faces(folder, scale):
    """Top faces [element][8][3] before and after, and the size of the displacement of each."""
    file = netcdf_file(folder / "results.exo", "r", mmap=False)
    names = [b"".join(n).split(b"\0")[0].decode().strip() for n in file.variables["name_nod_var"].data]
    x = np.stack([file.variables["coord" + c].data for c in "xyz"], axis=1).astype(float)
    u = np.stack([file.variables[f"vals_nod_var{names.index('displ_' + c) + 1}"].data[-1] for c in "xyz"], axis=1)
    cells = file.variables["connect1"].data[:, TOP] - 1
    return x[cells], (x + scale * u)[cells], np.linalg.norm(u[cells], axis=2).mean(axis=1)


def mirrored(polygons, planes):
    for plane in planes:
        flip = np.ones(3)
        flip["xyz".index(plane)] = -1
        polygons = np.concatenate([polygons, polygons * flip])
    return polygons


def draw_shape(axes, folder, title, planes, scale=1.0, zoom=1.4):
    before, after, size = faces(folder, scale)
    copies = 2 ** len(planes)
    before, after = mirrored(before, planes), mirrored(after, planes)
    colours = plt.cm.viridis(np.tile(size / max(size.max(), 1e-300), copies))
    axes.add_collection3d(Poly3DCollection(after, facecolors=colours, edgecolors="k", linewidths=0.15))
    axes.add_collection3d(Poly3DCollection(before, facecolors=(0, 0, 0, 0), edgecolors=(0.6, 0.6, 0.6, 0.5), linewidths=0.2))
    points = np.concatenate([before.reshape(-1, 3), after.reshape(-1, 3)])
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, (high - low).max() / 2
    for i, limits in enumerate((axes.set_xlim, axes.set_ylim, axes.set_zlim)):
        limits(middle[i] - half, middle[i] + half)
    axes.set_box_aspect((1, 1, 1), zoom=zoom)
    axes.set_axis_off()
    axes.view_init(24, -60)
    axes.set_title(title, fontsize=9, y=0.92)


def main(folder):
    figure, axes = plt.subplots(2, 3, figsize=(11, 7))
    for (name, (title, reference, monitors, _)), a in zip(NONLINEAR.items(), axes.flat):
        run, points = path(folder / (name + "_results")), table(reference)
        for i, (monitor, sign, label) in enumerate(monitors):
            colour = ("#1f5fa8", "#e08214")[i]
            a.plot(sign * run[monitor], run["load_factor"], color=colour, lw=1.3, label=label)
            a.plot(points[:, 1 + i], points[:, 0], "o", color=colour, ms=3, mfc="none")
            if len(monitors) > 1:
                deviation = abs(np.interp(points[:, 0], run["load_factor"], sign * run[monitor]) - points[:, 1 + i])
                print(f"{name} {monitor}: {100 * deviation.max() / abs(points[:, 1 + i]).max():.2f} % of the largest value")
        turns = [j for j in range(1, len(run["load_factor"]) - 1)
                 if (run["load_factor"][j] - run["load_factor"][j - 1]) * (run["load_factor"][j + 1] - run["load_factor"][j]) < 0]
        print(f"{name}: {int(run['step'][-1])} steps", *(f"turns at load factor {run['load_factor'][j]:.5f}" for j in turns))
        a.set_title(title)
        a.set_ylabel("load factor")
        a.grid(alpha=0.4)
        a.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(HERE / "shells_paths.png", dpi=80)

    figure = plt.figure(figsize=(13, 5.6))
    for i, (name, (title, monitor, quoted, planes, scale)) in enumerate(LINEAR.items()):
        run = path(folder / (name + "_results"))
        value = run[monitor][-1] / run["load_factor"][-1]
        print(f"{name}: {value:.6g} per load factor, {100 * (value / quoted - 1):+.2f} % of {quoted:.6g}")
        if name == "morley_equal":  # the same shape
            continue
        draw_shape(figure.add_subplot(2, 5, 1 + i, projection="3d"), folder / (name + "_results"), f"{title} (x {scale:.0e})", planes, scale,
                   0.85 if planes == "xyz" else 1.3)
    for i, (name, (title, _, _, planes)) in enumerate(NONLINEAR.items()):
        draw_shape(figure.add_subplot(2, 5, 5 + i, projection="3d"), folder / (name + "_results"), title, planes,
                   zoom=1.1 if "roof" in name or name == "slit_annulus" else 1.4)
    figure.subplots_adjust(0, 0, 1, 0.98, 0.02, 0.05)
    figure.savefig(HERE / "shells_shapes.png", dpi=90)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
