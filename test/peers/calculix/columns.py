#!/usr/bin/env python3
"""Thin-walled columns for CalculiX (ccx; Debian: calculix-ccx): buckling loads and deflections of cantilevers.

    columns.py          writes columns.csv, what testCalculix.cpp compares with; a minute

S8R, the same meshes as testCalculix.cpp makes; t = 1, L = 300, E = 210000. CalculiX expands shells to solids and
ties those of different directions by rigid bodies at the nodes that they share. nu = 0.3 for the cantilevers and 0
for buckling: *BUCKLE is linear before it, and walls whose ends cannot widen bulge before they buckle.
"""
import os

import ccx

LENGTH, ALONG, E, THICKNESS = 300.0, 18, 210000.0, 1.0

# Walls in the x-y plane: (from, to, elements).
SECTIONS = {
    "box": [((0, 0), (100, 0), 6), ((100, 0), (100, 50), 6), ((100, 50), (0, 50), 6), ((0, 50), (0, 0), 6)],
    "square": [((0, 0), (100, 0), 6), ((100, 0), (100, 100), 6), ((100, 100), (0, 100), 6), ((0, 100), (0, 0), 6)],
    "angle": [((60, 0), (0, 0), 4), ((0, 0), (0, 60), 4)],
    "tee": [((-50, 0), (0, 0), 4), ((0, 0), (50, 0), 4), ((0, 0), (0, 60), 4)],
    "i": [((-30, 0), (0, 0), 3), ((0, 0), (30, 0), 3), ((0, 0), (0, 100), 6), ((-30, 100), (0, 100), 3),
          ((0, 100), (30, 100), 3)],
    "panel": [((0, 0), (60, 0), 4), ((60, 0), (120, 0), 4), ((120, 0), (180, 0), 4), ((60, 0), (60, 20), 2),
              ((120, 0), (120, 20), 2)],
    "y": [((0, 0), (50, 0), 4), ((0, 0), (-25, 43.30127018922193), 4), ((0, 0), (-25, -43.30127018922193), 4)],
}


def mesh(walls):
    nodes, elements = {}, []

    def node(x, y, z):
        return nodes.setdefault((round(x, 6), round(y, 6), round(z, 6)), len(nodes) + 1)

    for (x0, y0), (x1, y1), count in walls:
        def at(i, j):
            s = i / (2 * count)
            return node(x0 + s * (x1 - x0), y0 + s * (y1 - y0), j * LENGTH / (2 * ALONG))
        for e in range(count):
            for k in range(ALONG):
                i, j = 2 * e, 2 * k
                elements.append([at(i, j), at(i + 2, j), at(i + 2, j + 2), at(i, j + 2), at(i + 1, j),
                                 at(i + 2, j + 1), at(i + 1, j + 2), at(i, j + 1)])
    return nodes, elements


def model(walls, nu):
    nodes, elements = mesh(walls)
    out = ["*NODE, NSET=NALL"]
    out += ["%d, %.12g, %.12g, %.12g" % (n, *x) for x, n in nodes.items()]
    out += ["*ELEMENT, TYPE=S8R, ELSET=WALLS"]
    out += [", ".join(map(str, [e + 1] + n)) for e, n in enumerate(elements)]
    for name, z in (("FOOT", 0.0), ("HEAD", LENGTH)):
        out += ["*NSET, NSET=" + name]
        out += ["%d," % n for x, n in nodes.items() if x[2] == z]
    out += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "%g, %g" % (E, nu), "*SHELL SECTION, ELSET=WALLS, MATERIAL=STEEL",
            "%g" % THICKNESS]
    head = [n for x, n in nodes.items() if x[2] == LENGTH]
    return out, nodes, head


def buckling(walls):
    out, _, head = model(walls, 0.0)
    out += ["*BOUNDARY", "FOOT, 1, 3", "HEAD, 1, 2"]
    for n in head[1:]:
        out += ["*EQUATION", "2", "%d, 3, 1., %d, 3, -1." % (n, head[0])]
    out += ["*STEP", "*BUCKLE", "3", "*CLOAD", "%d, 3, -1." % head[0], "*END STEP"]
    return [float(r[1]) for r in ccx.rows(out) if len(r) == 2 and r[0].isdigit()][:3]


def deflection(walls):
    out, nodes, _ = model(walls, 0.3)
    # A force of (1, 2, 0) at the end of the first wall; all of it clamped at the foot.
    n = nodes[(float(walls[0][1][0]), float(walls[0][1][1]), LENGTH)]
    out += ["*NSET, NSET=TIP", "%d," % n, "*BOUNDARY", "FOOT, 1, 6", "*STEP", "*STATIC", "*CLOAD", "TIP, 1, 1.", "TIP, 2, 2.",
            "*NODE PRINT, NSET=TIP", "U", "*END STEP"]
    return [[float(v) for v in r[1:4]] for r in ccx.rows(out) if len(r) == 4 and r[0] == str(n)][0]


if __name__ == "__main__":
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "columns.csv"), "w") as f:
        f.write("section,buckling1,buckling2,buckling3,ux,uy,uz\n")
        for name, walls in SECTIONS.items():
            f.write(",".join([name] + ["%.8g" % v for v in buckling(walls) + deflection(walls)]) + "\n")
