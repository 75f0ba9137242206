"""What a run wrote."""
import csv
import json
import pathlib

import numpy as np

from . import _atrapos

# Exodus' cells that meshio knows under other names; nodes come in the same order.
_MESHIO = {"HEX8": "hexahedron", "HEX20": "hexahedron20", "HEX27": "hexahedron27", "TET4": "tetra", "TET10": "tetra10",
           "WEDGE6": "wedge", "WEDGE15": "wedge15", "QUAD4": "quad", "QUAD8": "quad8", "QUAD9": "quad9",
           "BAR2": "line", "BAR3": "line3", "TRISHELL3": "triangle", "SHELL3": "triangle", "TRISHELL6": "triangle6", "SHELL6": "triangle6", "SHELL4": "quad", "SHELL8": "quad8", "SHELL9": "quad9", "TRI3": "triangle", "TRI6": "triangle6"}
# Of HEX20 and WEDGE15 Exodus has the edges between bottom and top before those of the top.
_ORDER = {"HEX20": [*range(12), *range(16, 20), *range(12, 16)],
          "WEDGE15": [*range(9), *range(12, 15), *range(9, 12)]}


def _table(file):
    """A CSV file as {column: array}; columns of numbers are numbers, the others texts."""
    with open(file, encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(lines))
    columns = {}
    for i, name in enumerate(rows[0]):
        values = [row[i] for row in rows[1:]]
        try:
            numbers = [float(v) if v else np.nan for v in values]
            whole = all(v.lstrip("-").isdigit() for v in values)
            columns[name] = np.array(numbers, dtype=int if whole else float)
        except ValueError:
            columns[name] = np.array(values, dtype=object)
    return columns


class Result:
    """A folder of results. Tables are dicts of numpy arrays by column:

    path: the points of all branches (step, path_length, load_factor, the monitors, negative_eigenvalues, branch,
    residual); points: limit and bifurcation points; branches; steps; events (contact).
    summary: summary.json. reached_stop, text: how the run ended; None for a folder that was only opened.
    """

    def __init__(self, folder, reached_stop=None, text=None):
        self.folder = pathlib.Path(folder)
        self.reached_stop, self.text = reached_stop, text
        if not (self.folder / "path.csv").is_file():
            raise FileNotFoundError(f"{self.folder}: no results (path.csv) there")

    def __repr__(self):
        return f"<atrapos.Result of {self.folder}: {self.text or 'as it is on disk'}>"

    def table(self, name):
        """Any table of the folder by its name without .csv."""
        return _table(self.folder / f"{name}.csv")

    path = property(lambda self: self.table("path"))
    points = property(lambda self: self.table("points"))
    branches = property(lambda self: self.table("branches"))
    steps = property(lambda self: self.table("steps"))
    events = property(lambda self: self.table("events"))
    summary = property(lambda self: json.loads((self.folder / "summary.json").read_text(encoding="utf-8")))

    def branch(self, number):
        """The rows of `path` that belong to one branch."""
        path = self.path
        mine = path["branch"] == number
        return {name: column[mine] for name, column in path.items()}

    def states(self, branch=0):
        """The states of a branch with their fields."""
        name = "results.exo" if branch == 0 else f"results_branch{branch}.exo"
        return States(self.folder / name)

    def plot(self, x=None, y="load_factor", axes=None):
        """Draws y over x (the first monitor) by matplotlib, each branch in a colour, dotted where not stable; limit
        points as circles, bifurcation points as squares. Returns the axes."""
        import matplotlib.pyplot as plt

        axes = axes or plt.subplots()[1]
        path, points = self.path, self.points
        monitors = [c for c in path if c not in ("step", "path_length", "load_factor", "negative_eigenvalues",
                                                 "branch", "residual")]
        x = x or (monitors[0] if monitors else "path_length")
        for number in np.unique(path["branch"]):
            b = self.branch(number)
            stable = b["negative_eigenvalues"] <= 0
            (line,) = axes.plot(b[x], b[y], ":", lw=1.2)
            axes.plot(b[x], np.where(stable, b[y], np.nan), "-", lw=2, color=line.get_color())
        folds = np.isin(points["kind"], ["minimum", "maximum"])
        other = np.array([":" in str(k) for k in points["kind"]], dtype=bool)  # of monitors
        for chosen, mark in ((folds, "ko"), (~folds & ~other, "ks")):
            axes.plot(points[x][chosen], points[y][chosen], mark, ms=5, fillstyle="none")
        axes.set(xlabel=x, ylabel=y)
        return axes


class States:
    """The states in a result file: states of a branch in the order of its path."""

    def __init__(self, file):
        self.file = pathlib.Path(file)
        self._file = _atrapos.ResultFile(str(file))
        self._mesh = None

    def __len__(self):
        return self._file.count

    nodal_names = property(lambda self: self._file.nodal_names)
    element_names = property(lambda self: self._file.element_names)
    global_names = property(lambda self: self._file.global_names)

    @property
    def points(self):
        """Places of the nodes at rest, [node, 3]."""
        return self._read()["points"]

    @property
    def blocks(self):
        """[{name, cell, nodes [cell, node]}], cells as Exodus calls and numbers them, nodes from 0."""
        return self._read()["blocks"]

    def _read(self):
        if self._mesh is None:
            self._mesh = _atrapos.mesh_of(str(self.file))
        return self._mesh

    def _state(self, state):
        if not -len(self) <= state < len(self):
            raise IndexError(f"{self.file} has {len(self)} states, not {state}")
        return state % len(self)

    def value(self, state, name):
        """A number of a state: load_factor, path_length, ..."""
        return self._file.global_(self._state(state), name)

    def nodal(self, state, name):
        """A nodal variable, [node]."""
        return self._file.nodal(self._state(state), name)

    def element(self, state, name):
        """An element variable, [element] over all blocks."""
        return self._file.element(self._state(state), name)

    def displacement(self, state):
        """[node, 3]; plane bodies stay in their plane."""
        columns = [self.nodal(state, f"displ_{i}") for i in "xyz" if f"displ_{i}" in self.nodal_names]
        return np.column_stack(columns + [np.zeros(len(columns[0]))] * (3 - len(columns)))

    def to_meshio(self, state, deformed=False):
        """A meshio.Mesh with all variables of a state."""
        import meshio

        cells = []
        for block in self.blocks:
            nodes = np.asarray(block["nodes"])
            order = _ORDER.get(block["cell"])
            cells.append((_MESHIO[block["cell"]], nodes[:, order] if order else nodes))
        ends = np.cumsum([len(nodes) for _, nodes in cells])[:-1]
        moved = self.displacement(state) if deformed else 0
        try:
            return meshio.Mesh(
                self.points + moved, cells,
                point_data={name: self.nodal(state, name) for name in self.nodal_names},
                cell_data={name: np.split(self.element(state, name), ends) for name in self.element_names})
        except KeyError as error:  # versions before 5.1 have no WEDGE15
            raise ValueError(f"meshio {meshio.__version__} knows no cells {error}") from None
