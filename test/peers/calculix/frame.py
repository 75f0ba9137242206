#!/usr/bin/env python3
"""A right-angled frame of solids for CalculiX (ccx; Debian: calculix-ccx).

    frame.py [DIVISIONS]        writes frame.csv, what testCalculix.cpp compares with; a minute

A strip 10 wide (z) and 1 thick whose middle surface runs from (100, 0) to (0, 0) and on to (0, 100); the corner is a
block. C3D20R, DIVISIONS (40) along each leg, 2 across, one through the thickness. Held at (100, 0), a dead force of 40
along z at the other end, at z = 0, 5 and 10 as 1 : 2 : 1. E = 210000, nu = 0.3; NLGEOM.
"""
import os
import sys

import ccx

LENGTH, WIDTH, HALF, FORCE, ACROSS = 100.0, 10.0, 0.5, 40.0, 2
LOADS = (0.25, 0.5, 0.75, 1.0)


def cells(divisions):
    along = [HALF + (LENGTH - HALF) * i / divisions for i in range(divisions + 1)]
    legs = list(zip(along, along[1:]))
    return ([(a, b, -HALF, HALF) for a, b in legs] + [(-HALF, HALF, -HALF, HALF)] + [(-HALF, HALF, a, b) for a, b in legs])


def model(divisions):
    nodes, elements = {}, []

    def node(x, y, z):
        return nodes.setdefault((round(x, 7), round(y, 7), round(z, 7)), len(nodes) + 1)

    for k in range(ACROSS):
        z = [WIDTH * (k + s / 2) / ACROSS for s in range(3)]
        for x0, x1, y0, y1 in cells(divisions):
            corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
            edges = [((x0 + x1) / 2, y0), (x1, (y0 + y1) / 2), ((x0 + x1) / 2, y1), (x0, (y0 + y1) / 2)]
            elements.append([node(*p, z[0]) for p in corners] + [node(*p, z[2]) for p in corners]
                            + [node(*p, z[0]) for p in edges] + [node(*p, z[2]) for p in edges]
                            + [node(*p, z[1]) for p in corners])
    return nodes, elements


def displacements(divisions):
    nodes, elements = model(divisions)
    out = ["*NODE, NSET=NALL"] + ["%d, %.10g, %.10g, %.10g" % (n, *x) for x, n in nodes.items()]
    out += ["*ELEMENT, TYPE=C3D20R, ELSET=ALL"]
    for e, n in enumerate(elements):
        out += [", ".join(map(str, [e + 1] + n[:15])) + ",", ", ".join(map(str, n[15:]))]
    out += ["*NSET, NSET=ROOT"] + ["%d," % n for x, n in nodes.items() if x[0] == LENGTH]
    ends = [nodes[(0.0, LENGTH, z)] for z in (0.0, WIDTH / 2, WIDTH)]
    out += ["*NSET, NSET=TIP", "%d," % ends[1], "*TIME POINTS, NAME=LOADS"] + ["%g" % t for t in LOADS]
    out += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "210000, 0.3", "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL", "*BOUNDARY",
            "ROOT, 1, 3", "*STEP, NLGEOM, INC=1000", "*STATIC", "0.02, 1., 1e-6, 0.02", "*CLOAD"]
    out += ["%d, 3, %g" % (n, FORCE * share) for n, share in zip(ends, (0.25, 0.5, 0.25))]
    out += ["*NODE PRINT, NSET=TIP, TIME POINTS=LOADS", "U", "*END STEP"]
    rows = ccx.rows(out, timeout=1200)
    return [[float(v) for v in r[1:]] for r in rows if len(r) == 4 and r[0] == str(ends[1])]


if __name__ == "__main__":
    divisions = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "frame.csv"), "w") as f:
        f.write("load_factor,ux,uy,uz\n")
        for load, u in zip(LOADS, displacements(divisions)):
            f.write(",".join(["%g" % load] + ["%.7g" % v for v in u]) + "\n")
