#!/usr/bin/python3
"""Writes CalculiX' decks of the necking bar and of Cook's membrane of metal, and reads its results.

    python3 make_deck.py necking 5 15 0.002 > necking.inp; ccx necking; python3 make_deck.py read necking.dat > necking.csv
    python3 make_deck.py cook 8 8 0.02 > cook.inp; ccx cook; tail -1 cook.dat
"""
import math
import re
import sys


def quadrilateral(corners, nx, ny):
    """Nodes {(i, j) of half cells: number} and places, elements of eight nodes, on bilinear coordinates."""
    number, place, cells = {}, [], []

    def node(i, j):
        if (i, j) not in number:
            number[i, j] = len(number) + 1
            s, t = i / (2 * nx), j / (2 * ny)
            shape = [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t]
            place.append([sum(w * c[k] for w, c in zip(shape, corners)) for k in range(2)])
        return number[i, j]

    around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
    for b in range(ny):
        for a in range(nx):
            cells.append([node(2 * a + i, 2 * b + j) for i, j in around])
    return number, place, cells


def body(corners, nx, ny, kind):
    number, place, cells = quadrilateral(corners, nx, ny)
    lines = ["*NODE"] + [f"{n + 1},{x:.12g},{y:.12g},0" for n, (x, y) in enumerate(place)]
    lines += [f"*ELEMENT,TYPE={kind},ELSET=BODY"]
    lines += [",".join(map(str, [e + 1] + cell)) for e, cell in enumerate(cells)]
    lines += ["*MATERIAL,NAME=METAL", "*ELASTIC", "206.9,0.29", "*PLASTIC"]
    for k in range(400):
        g = 4 * (k / 399) ** 2.5
        lines.append(f"{0.45 + 0.265 * (1 - math.exp(-16.93 * g)) + 0.12924 * g:.12g},{g:.12g}")
    lines += ["*SOLID SECTION,ELSET=BODY,MATERIAL=METAL"] + (["1"] if kind == "CPE8R" else [])
    return number, lines


def node_set(name, nodes):
    return [f"*NSET,NSET={name}"] + [str(n) for n in nodes]


def necking(nx, ny, increment):
    number, lines = body([(0, 0), (6.298, 0), (6.413, 26.667), (0, 26.667)], nx, ny, "CAX8R")
    lines += node_set("END", [n for (_, j), n in number.items() if j == 2 * ny])
    lines += node_set("MIDDLE", [n for (_, j), n in number.items() if j == 0])
    lines += node_set("AXIS", [n for (i, _), n in number.items() if i == 0])
    lines += node_set("NECK", [number[2 * nx, 0]])
    lines += ["*BOUNDARY", "MIDDLE,2,2", "AXIS,1,1", "END,1,1", "*STEP,NLGEOM,INC=10000", "*STATIC"]
    lines += [f"{increment},1,1e-6,{increment}", "*BOUNDARY", "END,2,2,7", "*NODE PRINT,NSET=END,TOTALS=ONLY", "RF"]
    return lines + ["*NODE PRINT,NSET=NECK", "U", "*END STEP"]


def cook(nx, ny, increment):
    number, lines = body([(0, 0), (48, 44), (48, 60), (0, 44)], nx, ny, "CPE8R")
    lines += node_set("LEFT", [n for (i, _), n in number.items() if i == 0])
    lines += node_set("CORNER", [number[2 * nx, 2 * ny]])
    lines += ["*BOUNDARY", "LEFT,1,2", "*STEP,NLGEOM,INC=10000", "*STATIC", f"{increment},1,1e-6,{increment}", "*CLOAD"]
    load = [0.0] * (2 * ny + 1)
    for b in range(ny):
        for j, part in enumerate((1 / 6, 2 / 3, 1 / 6)):
            load[2 * b + j] += part * 5 / ny
    lines += [f"{number[2 * nx, j]},2,{force:.12g}" for j, force in enumerate(load)]
    return lines + ["*NODE PRINT,NSET=CORNER", "U", "*END STEP"]


def read(file):
    """Load factor (half the elongation), force of the whole bar (CalculiX' wedge is 2 degrees), radial displacement."""
    lines = ["load_factor,force,neck"]
    for block in open(file).read().split("total force")[1:]:
        time = float(re.search(r"time\s+(\S+)", block).group(1))
        force = [x for x in block.split("\n") if x.strip()][1].split()[1]
        neck = re.search(r"NECK and time\s+\S+\s+\d+\s+(\S+)", block).group(1)
        if abs(20 * time - round(20 * time)) < 1e-6:
            lines.append(f"{7 * time:.4g},{float(force) * 180:.5f},{float(neck):.6f}")
    return lines


if __name__ == "__main__":
    what = sys.argv[1]
    if what == "read":
        print("\n".join(read(sys.argv[2])))
    else:
        make = {"necking": necking, "cook": cook}[what]
        print("\n".join(make(int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])))
