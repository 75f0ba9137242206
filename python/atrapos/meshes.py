"""Meshes of VTK and of whatever else meshio reads, made into meshes for decks.

The way is an input file as Abaqus has them, which `atrapos import` takes: meshio's own Exodus has neither names of blocks
nor side sets nor Exodus' order of nodes.
"""
import pathlib
import re
import subprocess
import tempfile

import numpy as np

from . import _atrapos
from .command import program

# meshio's cells whose nodes Abaqus has in the same order: the element in space, in a plane.
_SOLID = {"tetra": "C3D4", "tetra10": "C3D10", "wedge": "C3D6", "hexahedron": "C3D8",
          "hexahedron20": "C3D20R"}
_PLANE = {"triangle": "CPS3", "triangle6": "CPS6", "quad": "CPS4", "quad8": "CPS8R"}
_SHELL = {"triangle": "S3", "triangle6": "S6", "quad": "S4R", "quad8": "S8R"}
# Corners of the faces S1, S2, ...
_FACES = {"tetra": [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)],
          "wedge": [(0, 1, 2), (3, 4, 5), (0, 1, 3, 4), (1, 2, 4, 5), (0, 2, 3, 5)],
          "hexahedron": [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 4, 5), (1, 2, 5, 6), (2, 3, 6, 7), (0, 3, 4, 7)],
          "triangle": [(0, 1), (1, 2), (0, 2)], "quad": [(0, 1), (1, 2), (2, 3), (0, 3)]}
_CORNERS = {"line": 2, "triangle": 3, "quad": 4, "tetra": 4, "wedge": 6, "hexahedron": 8}
_KINDS = {0: "points", 1: "lines", 2: "faces"}


def _corners(cell_type):
    return re.sub(r"\d+$", "", cell_type)


def _groups(mesh, array):
    """For every block of cells the name of each cell's group, None where it has none."""
    names = [np.full(len(block.data), None, dtype=object) for block in mesh.cells]
    if array is not None:
        if array not in mesh.cell_data:
            raise _atrapos.MeshError(f"--groups {array}: the cells have no such array; they have "
                                     f"{', '.join(sorted(mesh.cell_data)) or 'none'}")
        for own, values in zip(names, mesh.cell_data[array]):
            whole = np.asarray(values, dtype=float)
            if whole.ndim != 1 or (whole != np.round(whole)).any():
                raise _atrapos.MeshError(f"--groups {array}: expected one whole number a cell")
            own[:] = [f"{array}_{int(value)}" for value in whole]
        return names
    for name, members in mesh.cell_sets.items():
        for own, cells in zip(names, members):
            if cells is not None:
                own[np.asarray(cells, dtype=int)] = name
    return names


def _lines(numbers):
    """Numbers as an input file has them, ten a line."""
    texts = [str(n) for n in numbers]
    return ",\n".join(", ".join(texts[i:i + 10]) for i in range(0, len(texts), 10)) + "\n"


def _input_file(mesh, groups, shells):
    """The text of an input file of the cells of the highest dimension, sets for the others."""
    dimension = max((block.dim for block in mesh.cells), default=0)
    points = np.asarray(mesh.points, dtype=float)
    points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
    known = _SOLID if dimension == 3 else _SHELL if shells or np.any(points[:, 2] != 0) else _PLANE
    text = ["*NODE\n"] + [f"{n}, {x[0]!r}, {x[1]!r}, {x[2]!r}\n" for n, x in enumerate(points.tolist(), 1)]
    element, elements, faces = 0, {}, {}
    for block, names in zip(mesh.cells, groups):
        if block.dim < dimension:
            continue
        if block.type not in known:
            raise _atrapos.MeshError(f"cells {block.type} have no equal; expected {', '.join(known)}")
        for name in dict.fromkeys(names):
            text.append(f"*ELEMENT, TYPE={known[block.type]}, ELSET=\"{name or 'body'}\"\n")
            for nodes in block.data[[n == name for n in names]]:
                element += 1
                elements.setdefault(name or "body", []).append(element)
                text.append(_lines([element, *(nodes + 1)]))
                for side, corners in enumerate(_FACES[_corners(block.type)], 1):
                    faces.setdefault(frozenset(nodes[list(corners)].tolist()), []).append((element, side))
    sides, nodes_of = {}, {name: np.asarray(nodes) for name, nodes in mesh.point_sets.items()}
    for block, names in zip(mesh.cells, groups):
        if block.dim == dimension:
            continue
        for nodes, name in zip(block.data, names):
            name = name or _KINDS[block.dim]
            nodes_of[name] = np.append(nodes_of.get(name, np.zeros(0, dtype=int)), nodes)
            if block.dim == dimension - 1:
                corners = nodes[:_CORNERS[_corners(block.type)]]
                # Between two cells a face is no border of the body: its nodes are a set, and that is all.
                of = faces.get(frozenset(corners.tolist()), [])
                sides.setdefault(name, []).extend(of if len(of) == 1 else [])
    for name, nodes in nodes_of.items():
        text.append(f"*NSET, NSET=\"{name}\"\n" + _lines(np.unique(nodes) + 1))
    label = "E" if known is _SHELL else "S"  # edges of shells, whose S1 and S2 are faces
    for name, own in sides.items():
        text.append(f"*SURFACE, NAME=\"{name}\"\n" + "".join(f"{e}, {label}{s}\n" for e, s in own) if own else "")
    if known is _SHELL:
        for name, own in elements.items():
            text.append(f"*SURFACE, NAME=\"{name}\"\n" + "".join(f"{e}, SPOS\n" for e in own))
    return "".join(text)


def import_mesh(source, file, groups=None, shells=False):
    """Writes the Exodus mesh `file` of `source`, a file that meshio reads or a meshio.Mesh.

    Cells of the highest dimension are elements. Blocks are the mesh's sets of cells, or with `groups` those with the same whole
    number in that array of cell data. Cells of lower dimension become node sets, and side sets where they are sides of the body,
    by the same names (`faces`, `lines`, `points` without). Quadrilaterals in z = 0 are plane bodies, with `shells` shells, whose
    blocks are side sets too: the faces from which the cells' nodes go round counter-clockwise.
    Returns what `atrapos import` says; raises MeshError, one line, of what has no equal.
    """
    import meshio

    if not isinstance(source, meshio.Mesh):
        try:
            source = meshio.read(source)
        except (meshio.ReadError, KeyError, SystemExit) as error:  # KeyError: of cells that it does not know
            raise _atrapos.MeshError(f"{source}: meshio cannot read it: {error}") from None
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder) / (pathlib.Path(file).stem + ".inp")
        model.write_text(_input_file(source, _groups(source, groups), shells), encoding="utf-8")
        done = subprocess.run([program(), "import", model, "-o", file], capture_output=True, text=True)
    if done.returncode:
        raise _atrapos.MeshError(done.stderr.strip())
    return "".join(line for line in done.stdout.splitlines(True) if not line.startswith(folder))
