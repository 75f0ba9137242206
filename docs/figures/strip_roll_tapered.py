#!/usr/bin/python3
"""Draws strip_roll_tapered.png, after Figures 5 and 6 of the paper: how far the strip goes down along its two edges and
its middle line, over a cylinder and over a tapered roll.

    docs/figures/strip_roll_tapered.py CYLINDER_RESULTS TAPERED_RESULTS

The first folder is of tapered.yaml with a cylinder in place of the tapered roll, the second of tapered.yaml. Dots are its
nodes, lines are solids in CalculiX, test/accept/data/ccx_tapered_roll.
"""
import pathlib
import sys

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LINES = {-10: "edge on the cylinder, y = -10", 0: "middle, y = 0", 10: "edge over the cone, y = 10"}


class Netcdf:
    """Variables of a classic or 64-bit-offset netCDF file, what Exodus writes."""

    TYPES = {1: "i1", 2: "S1", 3: ">i2", 4: ">i4", 5: ">f4", 6: ">f8"}

    def __init__(self, file):
        self.data = pathlib.Path(file).read_bytes()
        if self.data[:3] != b"CDF" or self.data[3] not in (1, 2):
            raise SystemExit(f"{file}: is not a classic netCDF file")
        self.offset_size = 4 * self.data[3]
        self.at = 4
        self.records = self.integer()
        self.dimensions = self.list(lambda: (self.name(), self.integer()))
        self.list(self.attribute)
        self.variables = {v[0]: v[1:] for v in self.list(self.variable)}
        record = [v[2] for v in self.variables.values() if self.is_record(v)]
        self.record_size = sum(record)

    def integer(self, size=4):
        self.at += size
        return int.from_bytes(self.data[self.at - size:self.at], "big")

    def name(self):
        length = self.integer()
        text = self.data[self.at:self.at + length].decode()
        self.at += -(-length // 4) * 4
        return text

    def list(self, item):
        self.integer()  # the tag
        return [item() for _ in range(self.integer())]

    def attribute(self):
        self.name()
        kind, count = self.integer(), self.integer()
        self.at += -(-count * np.dtype(self.TYPES[kind]).itemsize // 4) * 4

    def variable(self):
        name = self.name()
        dimensions = [self.integer() for _ in range(self.integer())]
        self.list(self.attribute)
        kind, size = self.integer(), self.integer()
        return name, dimensions, kind, size, self.integer(self.offset_size)

    def is_record(self, variable):
        return bool(variable[0]) and self.dimensions[variable[0][0]][1] == 0

    def __getitem__(self, name):
        dimensions, kind, _, begin = self.variables[name]
        shape = [self.dimensions[d][1] for d in dimensions]
        dtype = np.dtype(self.TYPES[kind])
        if not self.is_record(self.variables[name]):
            return np.frombuffer(self.data, dtype, int(np.prod(shape)), begin).reshape(shape)
        count = int(np.prod(shape[1:]))
        rows = [np.frombuffer(self.data, dtype, count, begin + r * self.record_size) for r in range(self.records)]
        return np.array(rows).reshape([self.records] + shape[1:])


def names(file, variable):
    return [b"".join(row).decode().rstrip("\0 ") for row in file[variable]]


def profiles(folder):
    """x and vertical displacement of the middle surface along the lines at the end of the path."""
    f = Netcdf(pathlib.Path(folder) / "results.exo")
    x, y, z = (f["coord" + c] for c in "xyz")
    u = {n: f[f"vals_nod_var{i + 1}"][-1] for i, n in enumerate(names(f, "name_nod_var"))}
    result = {}
    for place in LINES:
        on = np.where((abs(y - place) < 1e-6) & (abs(z) < 1e-9))[0]
        on = on[np.argsort(x[on])]
        result[place] = x[on], u["displ_z"][on]
    return result


def reference(roll):
    """The same of CalculiX at load factor 0.25."""
    file = pathlib.Path(__file__).parents[2] / "test/accept/data/ccx_tapered_roll" / f"{roll}.csv"
    rows = np.array([line.split(",") for line in open(file) if line[0].isdigit()], float)
    rows = rows[rows[:, 0] == 0.25]
    result = {}
    for place in LINES:
        on = rows[rows[:, 2] == place]
        on = on[np.argsort(on[:, 1])]
        result[place] = on[:, 1], on[:, 5]
    return result


def main(cylinder, tapered):
    fig, axes = plt.subplots(1, 3, figsize=(15, 4.2))
    rolls = ("cylinder", "tapered")
    shell = [profiles(cylinder), profiles(tapered)]
    solid = [reference(roll) for roll in rolls]
    for axis, result, lines, title in zip(axes, shell, solid, ("cylinder", "tapered roll")):
        for color, (place, label) in zip(("C0", "C1", "C2"), LINES.items()):
            for (x, w), style in ((result[place], "o"), (lines[place], "-")):
                near = (x > 150) & (x < 260)
                axis.plot(x[near], w[near], style, ms=4, color=color, label=label if style == "o" else None)
        axis.set(xlabel="x (mm)", ylabel="vertical displacement (mm)", title=title)
        axis.legend(fontsize=8)
        axis.grid(True)
    for color, roll, a, b in zip(("C0", "C3"), rolls, shell, solid):
        for result, style, name in ((a, "o", "20 shells"), (b, "-", "CalculiX")):
            (x, right), (_, left) = result[-10], result[10]
            axes[2].plot(x, left - right, style, ms=3, color=color, label=f"{roll}, {name}")
    axes[2].set(xlabel="x (mm)", ylabel="difference (mm)", title="edge y = 10 less edge y = -10")
    axes[2].legend(fontsize=8)
    axes[2].grid(True)
    fig.tight_layout()
    fig.savefig(pathlib.Path(__file__).with_suffix(".png"), dpi=110)
    for name, result, lines in zip(rolls, shell, solid):
        for place in LINES:
            x, w = result[place]
            xr, wr = lines[place]
            e = w - np.interp(x, xr, wr)
            print(f"{name:9} y = {place:3}: w(400) = {w[-1]:.3f}, CalculiX {wr[-1]:.3f}; "
                  f"largest difference up to x = 260: {abs(e[x <= 260]).max():.3f}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
