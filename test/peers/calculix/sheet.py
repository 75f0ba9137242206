#!/usr/bin/env python3
"""Strains at which a stretched sheet of rubber begins and ceases to wrinkle, by CalculiX (ccx; Debian: calculix-ccx).

    sheet.py            writes sheet.csv, what testWrinkling.cpp and docs/wrinkling.md compare with; minutes
    sheet.py NX NY      prints the six strains of one mesh

The quarter 100 x 50 of a sheet 200 x 100 x 0.1, NX x NY C3D20R in one layer; *HYPERELASTIC, NEO HOOKE with mu = 1, kappa = 50
(U = kappa/2 (J - 1)^2); symmetry at x = 0 and y = 0, the grip at x = 100 moves along x. At some strains next to those sought the flat
sheet, found by *STATIC with NLGEOM, has its lowest eigenvalues computed (*FREQUENCY, PERTURBATION); a strain sought is where the
polynomial through the eigenvalue nearest to zero vanishes.
"""
import os
import sys

import ccx

LENGTH, WIDTH, THICKNESS = 100.0, 50.0, 0.1
# ccx looks for the eigenvalues nearest to 1, which with this density is next to zero.
DENSITY = 1e-7
BRACKETS = ((0.0255, 0.0265), (0.0405, 0.0425), (0.064, 0.069, 0.075), (0.156, 0.17, 0.184), (0.214, 0.22, 0.227),
            (0.252, 0.256, 0.26))
ON_THE_WAY = (0.013, 0.1, 0.13)
CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
EDGES = ((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1),
         (2, 2, 1), (0, 2, 1))


def model(nx, ny, strains):
    number, out = {}, ["*NODE, NSET=NALL"]
    for k in range(3):
        for j in range(2 * ny + 1):
            for i in range(2 * nx + 1):
                if i % 2 + j % 2 + k % 2 <= 1:
                    number[i, j, k] = len(number) + 1
                    out.append("%d, %.12g, %.12g, %.12g" % (number[i, j, k], LENGTH * i / (2 * nx), WIDTH * j / (2 * ny),
                                                             THICKNESS * (k / 2 - 0.5)))
    out.append("*ELEMENT, TYPE=C3D20R, ELSET=SHEET")
    for e in range(nx * ny):
        i, j = e % nx, e // nx
        nodes = [str(number[2 * i + a, 2 * j + b, c]) for a, b, c in CORNERS + EDGES]
        out += ["%d, %s," % (e + 1, ", ".join(nodes[:10])), ", ".join(nodes[10:])]
    for name, where in (("MIDDLE", lambda i, j: i == 0), ("AXIS", lambda i, j: j == 0), ("GRIP", lambda i, j: i == 2 * nx)):
        out += ["*NSET, NSET=" + name] + ["%d," % n for (i, j, _), n in number.items() if where(i, j)]
    out += ["*MATERIAL, NAME=RUBBER", "*HYPERELASTIC, NEO HOOKE", "0.5, 0.04", "*DENSITY", "%g" % DENSITY,
            "*SOLID SECTION, ELSET=SHEET, MATERIAL=RUBBER", "*BOUNDARY", "MIDDLE, 1, 1", "AXIS, 2, 2", "GRIP, 2, 3"]
    for strain in sorted(set(strains) | set(ON_THE_WAY)):
        out += ["*STEP, NLGEOM, INC=1000", "*STATIC", "0.5, 1., 1e-6, 1.", "*BOUNDARY",
                "GRIP, 1, 1, %.10g" % (strain * LENGTH), "*END STEP"]
        if strain in strains:
            out += ["*STEP, PERTURBATION", "*FREQUENCY", "4", "*END STEP"]
    return out


def nearest_to_zero(nx, ny, strains):
    """The eigenvalue nearest to zero at each strain."""
    found, values = [], None
    for row in ccx.rows(model(nx, ny, strains), timeout=3600):
        heading = "".join(row)
        if heading == "EIGENVALUEOUTPUT":
            values = []
            found.append(values)
        elif heading.startswith("PARTICIPATION"):
            values = None
        elif values is not None and len(row) == 5 and row[0].isdigit():
            values.append(float(row[1]))
    return dict(zip(strains, (min(values, key=abs) for values in found)))


def zero(x, y):
    """Of the polynomial x(y) through the points."""
    total = 0
    for i in range(len(x)):
        term = x[i]
        for j in range(len(x)):
            if j != i:
                term *= -y[j] / (y[i] - y[j])
        total += term
    return total


def critical(nx, ny):
    brackets = BRACKETS
    for _ in range(2):  # a second time next to what the first found
        values = nearest_to_zero(nx, ny, [strain for bracket in brackets for strain in bracket])
        found = [zero(bracket, [values[strain] for strain in bracket]) for bracket in brackets]
        brackets = [(round(strain - 4e-4, 6), round(strain + 4e-4, 6)) for strain in found]
    return found


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(*("%.5f" % strain for strain in critical(int(sys.argv[1]), int(sys.argv[2]))))
        raise SystemExit
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "sheet.csv"), "w") as f:
        f.write("nx,ny,point,strain\n")
        for nx, ny in ((16, 16), (24, 24), (24, 36)):
            for i, strain in enumerate(critical(nx, ny)):
                f.write("%d,%d,%d,%.5f\n" % (nx, ny, i + 1, strain))
