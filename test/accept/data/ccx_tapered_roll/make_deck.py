#!/usr/bin/python3
"""Writes a CalculiX deck of the strip on a roll (paper 4.1): C3D20R solids on a finely meshed rigid roll.

    make_deck.py cylinder|tapered [CELLS_ALONG CELLS_ACROSS] > strip.inp
    ccx strip                           writes strip.dat
    make_deck.py profile strip.dat > profile.csv

The strip is 400 x 20 x 0.8 mm with its middle surface at z = 0, clamped at x = 0, with a dead load of 25 N downward over its
end face: load factor 0.25. The axis of the roll is at x = 200, z = -54; its radius of 49.6 mm makes the middle surface bend
around 50 mm. Tapered: the radius grows by tan 0.1 from y = 5 on, a sharp vertex.
"""
import math
import sys

LENGTH, WIDTH, THICKNESS = 400.0, 20.0, 0.8
RADIUS, AXIS_X, AXIS_Z = 49.6, 200.0, -54.0
FORCE = 25.0
TIMES = (0.08, 0.2, 0.4, 1.0)  # load factors 0.02, 0.05, 0.1, 0.25
PROFILES = {"y_min": 0.0, "y_mid": 0.5, "y_max": 1.0}


class Lattice:
    """Nodes at corners and halfway along edges of a box of cells, on a lattice of half cells."""

    def __init__(self, cells, first):
        self.size, self.first, self.ids = [2 * n + 1 for n in cells], first, {}
        for i in range(self.size[0]):
            for j in range(self.size[1]):
                for k in range(self.size[2]):
                    if i % 2 + j % 2 + k % 2 < 2:
                        self.ids[i, j, k] = first + len(self.ids)


def strip(along, across):
    cells = (along, across, 1)
    nodes = Lattice(cells, 1)
    print("*NODE, NSET=STRIP")
    for (i, j, k), n in nodes.ids.items():
        x = LENGTH * i / (2 * along), WIDTH * (j / (2 * across) - 0.5), THICKNESS * (k / 2 - 0.5)
        print(f"{n}, " + ", ".join(f"{c:.9g}" for c in x))
    # CalculiX' order: corners, edges of the bottom, of the top, vertical edges.
    order = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2),
             (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
             (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]
    print("*ELEMENT, TYPE=C3D20R, ELSET=STRIP")
    element, force = 0, {}
    for a in range(along):
        for b in range(across):
            element += 1
            ids = [nodes.ids[2 * a + i, 2 * b + j, k] for i, j, k in order]
            print(f"{element}, " + ", ".join(map(str, ids[:10])) + ",")
            print(", ".join(map(str, ids[10:])))
            if a == along - 1:  # a uniform load on an eight-node face
                corners, sides = (1, 2, 5, 6), (9, 13, 17, 18)
                for n, share in [(c, -1 / 12) for c in corners] + [(s, 1 / 3) for s in sides]:
                    force[ids[n]] = force.get(ids[n], 0) - FORCE * share / across
    print("*SURFACE, NAME=LOWER, TYPE=ELEMENT")  # where the strip may touch up to load factor 0.25
    for e in range(1, element + 1):
        if 160 <= LENGTH * ((e - 1) // across) / along < 270:
            print(f"{e}, S1")
    print("*NSET, NSET=CLAMP")
    for (i, j, k), n in nodes.ids.items():
        if i == 0:
            print(n)
    print("*NSET, NSET=PROFILES")
    for (i, j, k), n in nodes.ids.items():
        if k == 1 and i % 2 == 0 and j / (2 * across) in PROFILES.values():
            print(n)
    return element, nodes.first + len(nodes.ids), force


def roll(tapered, element, node):
    """One layer of C3D8 below its surface, half a degree each, whose nodes are held."""
    ys = [-12.0, 5.0, 12.0]
    angles = [math.radians(a / 2) for a in range(-30, 141)]
    at = {}
    print("*NODE, NSET=ROLL")
    for i, angle in enumerate(angles):
        for j, y in enumerate(ys):
            for k in (0, 1):
                r = RADIUS + (math.tan(0.1) * max(0.0, y - 5.0) if tapered else 0.0) - (2.0 if k == 0 else 0.0)
                at[i, j, k] = node
                print(f"{node}, {AXIS_X + r * math.sin(angle):.9g}, {y:.9g}, {AXIS_Z + r * math.cos(angle):.9g}")
                node += 1
    print("*ELEMENT, TYPE=C3D8, ELSET=ROLL")
    for i in range(len(angles) - 1):
        for j in range(len(ys) - 1):
            element += 1
            corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
            print(f"{element}, " + ", ".join(str(at[i + a, j + b, k]) for k in (0, 1) for a, b in corners))
    print("*SURFACE, NAME=ROLL, TYPE=ELEMENT\nROLL, S2")


def deck(kind, along=80, across=4):
    print(f"** strip on a roll: {kind}, {along} x {across} x 1 C3D20R; written by make_deck.py")
    element, node, force = strip(along, across)
    roll(kind == "tapered", element, node)
    print("*BOUNDARY\nCLAMP, 1, 3\nROLL, 1, 3")
    print("*MATERIAL, NAME=STEEL\n*ELASTIC\n220000., 0.3")
    print("*SOLID SECTION, ELSET=STRIP, MATERIAL=STEEL\n*SOLID SECTION, ELSET=ROLL, MATERIAL=STEEL")
    print("*SURFACE INTERACTION, NAME=PENALTY\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.e4")
    print("*CONTACT PAIR, INTERACTION=PENALTY, TYPE=SURFACE TO SURFACE\nLOWER, ROLL")
    print("*TIME POINTS, NAME=TIMES\n" + ", ".join(map(str, TIMES)))
    print("*STEP, NLGEOM, INC=2000\n*STATIC\n0.002, 1., 1e-7, 0.03")
    print("*CLOAD")
    for n, f in force.items():
        print(f"{n}, 3, {f:.12g}")
    print("*NODE PRINT, NSET=PROFILES, TIME POINTS=TIMES\nU")
    print("*END STEP")


def profile(dat, along=80, across=4):
    """x, y of the undeformed middle surface, load factor, displacements."""
    place = {n: p for p, n in Lattice((along, across, 1), 1).ids.items()}
    print("# CalculiX, see README.md: displacements of the middle surface, mm\nload_factor,x,y,ux,uy,uz")
    time = None
    for line in open(dat):
        words = line.split()
        if "time" in words:
            time = float(words[-1])
        elif len(words) == 4 and time:
            i, j, _ = place[int(words[0])]
            u = ",".join(f"{float(w):.6f}" for w in words[1:])
            print(f"{0.25 * time:.6g},{LENGTH * i / (2 * along):.6g},{WIDTH * (j / (2 * across) - 0.5):.6g},{u}")


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in ("cylinder", "tapered", "profile"):
        raise SystemExit(__doc__)
    if sys.argv[1] == "profile":
        profile(sys.argv[2], *map(int, sys.argv[3:]))
    else:
        deck(sys.argv[1], *map(int, sys.argv[2:]))
