#!/usr/bin/env python3
"""A plate of four-node shells for CalculiX (ccx; Debian: calculix-ccx).

    plate.py        writes plate.csv, what testCalculix.cpp compares with; seconds

100 x 20 x 1, 40 x 8 S4, held at x = 0; dead forces of 20 and 40 along z at the two corners of the other end, which bend
and twist it far. E = 210000, nu = 0.3; NLGEOM.
"""
import os

import ccx

LENGTH, WIDTH, ALONG, ACROSS = 100.0, 20.0, 40, 8
LOADS = (0.25, 0.5, 0.75, 1.0)


def node(i, j):
    return j * (ALONG + 1) + i + 1


def displacements():
    out = ["*NODE, NSET=NALL"]
    out += ["%d, %.10g, %.10g, 0" % (node(i, j), LENGTH * i / ALONG, WIDTH * j / ACROSS)
            for j in range(ACROSS + 1) for i in range(ALONG + 1)]
    out += ["*ELEMENT, TYPE=S4, ELSET=PLATE"]
    out += ["%d, %d, %d, %d, %d" % (j * ALONG + i + 1, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1))
            for j in range(ACROSS) for i in range(ALONG)]
    ends = [node(ALONG, 0), node(ALONG, ACROSS)]
    out += ["*NSET, NSET=ROOT"] + ["%d," % node(0, j) for j in range(ACROSS + 1)]
    out += ["*NSET, NSET=ENDS"] + ["%d," % n for n in ends] + ["*TIME POINTS, NAME=LOADS"] + ["%g" % t for t in LOADS]
    out += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "210000, 0.3", "*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL", "1",
            "*BOUNDARY", "ROOT, 1, 6", "*STEP, NLGEOM, INC=1000", "*STATIC", "0.05, 1., 1e-6, 0.05", "*CLOAD"]
    out += ["%d, 3, %g" % (n, force) for n, force in zip(ends, (20, 40))]
    out += ["*NODE PRINT, NSET=ENDS, TIME POINTS=LOADS", "U", "*END STEP"]
    rows = ccx.rows(out)
    return [[float(r[3]) for r in rows if len(r) == 4 and r[0] == str(n)] for n in ends]


if __name__ == "__main__":
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "plate.csv"), "w") as f:
        f.write("load_factor,near_uz,far_uz\n")
        for load, near, far in zip(LOADS, *displacements()):
            f.write("%g,%.7g,%.7g\n" % (load, near, far))
