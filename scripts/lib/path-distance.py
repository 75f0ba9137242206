#!/usr/bin/python3
"""path-distance.py PATH.CSV OTHER.CSV: how far OTHER's points lie from PATH, where the two have other points.

Every column of numbers but the residual and counts, over its largest value; PATH between its points by polynomials of
degree 7 in the path length through the 8 nearest ones. Prints the median and the largest distance, and the same of PATH's
own points when each is left out: what the interpolation (over twice the spacing) can tell at most.
"""
import sys

import numpy as np

COUNTS = ("step", "branch", "negative_eigenvalues", "residual")
NEAREST = 8


def read(file):
    with open(file, encoding="utf-8") as lines:
        names = lines.readline().strip().split(",")
        rows = [line.strip().split(",") for line in lines]
    kept = [i for i, name in enumerate(names) if name not in COUNTS]
    points = np.array([[float(row[i]) for i in kept] for row in rows if all(row[i] for i in kept)])
    length = points[:, [names[i] for i in kept].index("path_length")]
    # One point where steps meet.
    first = np.concatenate([[True], np.diff(length) > 0])
    return points[first], length[first]


def between(nodes, values, at):
    """Lagrange's polynomial through values at nodes."""
    total = np.zeros(values.shape[1])
    for i, node in enumerate(nodes):
        others = np.delete(nodes, i)
        total += values[i] * np.prod((at - others) / (node - others))
    return total


def distance(points, length, point, at):
    """From the point to the curve near the path length `at`: golden section over the spacing on both sides."""
    first = min(max(np.searchsorted(length, at) - NEAREST // 2, 0), len(length) - NEAREST)
    nodes, values = length[first : first + NEAREST], points[first : first + NEAREST]
    off = lambda s: np.max(np.abs(between(nodes, values, s) - point))
    spacing = np.max(np.diff(nodes))
    low, high = at - spacing, at + spacing
    ratio = (np.sqrt(5) - 1) / 2
    for _ in range(80):
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, b) if off(a) < off(b) else (a, high)
    return min(off((low + high) / 2), off(at))


def main():
    points, length = read(sys.argv[1])
    other, otherLength = read(sys.argv[2])
    scale = np.max(np.abs(points), axis=0)
    scale[scale == 0] = 1
    points, other = points / scale, other / scale
    inside = (otherLength >= length[0]) & (otherLength <= length[-1])
    off = [distance(points, length, p, s) for p, s in zip(other[inside], otherLength[inside])]
    own = [
        distance(np.delete(points, i, axis=0), np.delete(length, i), points[i], length[i])
        for i in range(NEAREST // 2, len(length) - NEAREST // 2)
    ]
    print(f"median {np.median(off):.1e}, largest {max(off):.1e} (left out: median {np.median(own):.1e}, largest {max(own):.1e})")


main()
