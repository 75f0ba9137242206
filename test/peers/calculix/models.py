#!/usr/bin/env python3
"""Linear displacements of models of CalculiX' own test suite (Debian: calculix-ccx, calculix-ccx-test).

    models.py [NAME...]      writes models.csv, what testCalculixModels.cpp compares with; some seconds

Each model as it is in the package, up to the end of its first step, which becomes a linear one; what is printed is
the displacement of (at most 40 of) its nodes. The models themselves are not stored here: the test reads them from the package.
"""
import gzip
import os
import sys

import ccx

PACKAGE = "/usr/share/doc/calculix-ccx-test/examples/test"
MOST_NODES = 40
MODELS = ["achtel2", "achtel29", "achtel9", "achtelcas", "achteld", "achtelg", "achtelp", "beam10p", "beam8p", "beamnlmpc", "beamnlp", "beamp", "beamp1rotate", "beampdepmpc", "beamptied1", "beamptied2", "beamptied7", "beamrb2", "c3d15", "c3d6", "mpcforce", "oneel", "planestrain",
          "planestrain2", "planestress"]
OUTPUT = ("NODEPRINT", "ELPRINT", "NODEFILE", "ELFILE", "CONTROLS")


def read(name):
    path = os.path.join(PACKAGE, name + ".inp")
    if os.path.exists(path):
        with open(path, errors="replace") as f:
            return f.read()
    with gzip.open(path + ".gz", "rt", errors="replace") as f:
        return f.read()


def keyword(line):
    return line.split(",")[0][1:].replace(" ", "").upper() if line[:1] == "*" and line[:2] != "**" else ""


def linear(text):
    """The model up to its first step's end, without NLGEOM, with all its nodes printed."""
    out, nodes, card = [], [], ""
    for line in text.splitlines():
        card = keyword(line) or card
        if keyword(line) == "STEP":
            out += ["*NSET, NSET=PRINTED"] + ["%d," % n for n in nodes] + ["*STEP"]
        elif keyword(line) == "STATIC":
            out += ["*STATIC"]
        elif keyword(line) == "ENDSTEP":
            return out + ["*NODE PRINT, NSET=PRINTED", "U", "*END STEP"]
        elif card not in OUTPUT + ("STATIC", "STEP"):
            out += [line]
            if card == "NODE" and line[:1] != "*" and line.strip():
                nodes.append(int(line.split(",")[0]))
    raise SystemExit("no step")


def displacements(name):
    rows = ccx.rows(linear(read(name)))
    return [r[:1] + [number(v) for v in r[1:]] for r in rows if len(r) == 4 and r[0].isdigit()]


def number(text):
    """Exponents of three digits have no E: -5.353076-101."""
    return text if "E" in text else "0"


def main(names):
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "models.csv"), "w") as f:
        f.write("model,node,ux,uy,uz\n")
        for name in names:
            rows = displacements(name)
            largest = max(range(len(rows)), key=lambda i: max(abs(float(v)) for v in rows[i][1:]))
            every = max(1, len(rows) // MOST_NODES)
            for i in sorted(set(range(0, len(rows), every)) | {largest}):
                f.write(",".join([name] + rows[i]) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:] or MODELS)
