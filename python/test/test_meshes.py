"""Meshes of VTK by meshio: nodes in order, names, sides."""
import os
import subprocess
import sys
import unittest

import meshio  # setup installs it
import numpy as np

import atrapos
from folders import InFolder

BOX = {"shape": "box", "lengths": [2, 1, 1], "divisions": [2, 2, 2]}
PLANE = {"shape": "rectangle", "lengths": [2, 1], "divisions": [2, 1]}
# A face at x = 2 of cells of degree 1 and 2, and the line and the point of that kind.
SIDES = {"tetra": "triangle", "tetra10": "triangle6", "hexahedron": "quad", "hexahedron20": "quad8", "triangle": "line", "triangle6": "line3", "quad": "line", "quad8": "line3"}


def generated(cell, plane):
    """The mesh of `atrapos mesh` as meshio has it, through a run that does next to nothing."""
    shape = {**(PLANE if plane else BOX), "cell": cell}
    hold = {"hold": {"set": "x_min", "x": 0, "y": 0, **({} if plane else {"z": 0})}}
    deck = {"mesh": {"file": "made.exo", "generate": shape}, **({"plane": {"kind": "strain"}} if plane else {}),
            "materials": {"m": {"law": "saint_venant_kirchhoff", "youngs_modulus": 1, "poissons_ratio": 0, "blocks": ["body"]}},
            "supports": hold, "loads": {"pull": {"type": "surface", "set": "x_max", "total": [1e-9, 0, 0]}},
            "path": {"stop": {"steps": 1, "load_factor": 1}}}
    mesh = atrapos.run(deck, "made").states().to_meshio(0)
    return meshio.Mesh(mesh.points, mesh.cells)


def sides_at(mesh, x):
    """Faces (edges in a plane) of the mesh's cells at this x, as cells of their own."""
    cell = mesh.cells[0]
    # Of a cell of degree 2 the nodes at x are the corners and the nodes between them, in VTK's order.
    rows = [[n for n in nodes if abs(mesh.points[n, 0] - x) < 1e-12] for nodes in cell.data]
    rows = [row for row in rows if row]
    kind = SIDES[cell.type]
    size = meshio._mesh.num_nodes_per_cell[kind]
    return meshio.CellBlock(kind, np.array([row for row in rows if len(row) == size]))


class Meshes(InFolder):
    def pull(self, plane, side):
        """Uniform tension by traction on the side: displacements are linear, with twisted cells they are not."""
        # Without Poisson's ratio a clamped end disturbs nothing, and it holds all that cells of 2 x 2 x 2 points leave free.
        held = {"left": {"set": "left", "x": 0, "y": 0, **({} if plane else {"z": 0})}}
        deck = {"mesh": {"file": "part.exo"}, **({"plane": {"kind": "strain"}} if plane else {}),
                "materials": {"m": {"law": "neo_hookean", "youngs_modulus": 1, "poissons_ratio": 0, "blocks": ["core"]}},
                "supports": held, "loads": {"pull": {"type": "surface", "set": side, "traction": [0.1, 0, 0]}},
                "path": {"accuracy": 1e-8, "stop": {"load_factor": 1}}}
        states = atrapos.run(deck, "pulled").states()
        u = states.displacement(-1)
        stretch = 1 + u[:, 0].max() / 2
        self.assertGreater(stretch, 1.05)
        np.testing.assert_allclose(u[:, 0], (stretch - 1) * states.points[:, 0], atol=1e-8)
        np.testing.assert_allclose(u[:, 1], 0, atol=1e-7)

    def through(self, cell, plane, ending):
        mesh = generated(cell, plane)
        left = np.flatnonzero(mesh.points[:, 0] == 0)
        right = sides_at(mesh, 2)
        cells = [mesh.cells[0], right, meshio.CellBlock("vertex", left.reshape(-1, 1))]
        sets = {"core": 0, "right side": 1, "left": 2}
        group = [np.full(len(block.data), i) for i, block in enumerate(cells)]
        meshio.Mesh(mesh.points, cells, cell_data={"group": group}).write("part" + ending)
        read = meshio.read("part" + ending)
        # VTK has numbers, names are those of a set of cells.
        names = {name: [np.flatnonzero(values == i) for values in read.cell_data["group"]] for name, i in sets.items()}
        told = atrapos.import_mesh(meshio.Mesh(read.points, read.cells, cell_sets=names), "part.exo")
        self.assertIn("block 'core'", told)
        self.pull(plane, "right side")

    def test_cells_in_space(self):
        for cell in ("HEX8", "HEX20", "TET4", "TET10"):
            with self.subTest(cell):
                self.through(cell, False, ".vtu")

    def test_cells_in_a_plane(self):
        for cell in ("QUAD4", "QUAD8", "TRI3", "TRI6"):
            with self.subTest(cell):
                self.through(cell, True, ".vtk")

    def test_wedges_are_not_twisted(self):
        # meshio 5.0 knows no wedges of degree 2.
        mesh = generated("WEDGE6", False)
        deck = {"mesh": {"file": "part.exo"},
                "materials": {"m": {"law": "neo_hookean", "youngs_modulus": 1, "poissons_ratio": 0.3, "blocks": ["body"]}},
                "supports": {"all": {"set": "points", "x": {"per_load_factor": "0.1*x"}, "y": 0, "z": 0}},
                "path": {"stop": {"load_factor": 1}}}
        outer = np.flatnonzero(((mesh.points == 0) | (mesh.points == [2, 1, 1])).any(axis=1))
        cells = mesh.cells + [meshio.CellBlock("vertex", outer.reshape(-1, 1))]
        meshio.Mesh(mesh.points, cells).write("part.vtu")
        atrapos.import_mesh("part.vtu", "part.exo")
        states = atrapos.run(deck, "held").states()
        np.testing.assert_allclose(states.displacement(-1)[:, 0], 0.1 * states.points[:, 0], atol=1e-8)
        stress = states.element(-1, "stress_xx")
        np.testing.assert_allclose(stress, stress[0], rtol=1e-7)

    def test_faces_and_edges_of_shells_take_loads(self):
        points = [[x, y, 0] for y in (0, 1) for x in (0, 1, 2)]
        cells = [("quad", [[0, 1, 4, 3], [1, 2, 5, 4]]), ("line", [[2, 5]]), ("vertex", [[0], [3]])]
        told = atrapos.import_mesh(meshio.Mesh(points, cells), "part.exo", shells=True)
        self.assertIn("2 node sets, 2 side sets", told)
        deck = {"mesh": {"file": "part.exo"},
                "materials": {"m": {"law": "saint_venant_kirchhoff", "youngs_modulus": 1e6, "poissons_ratio": 0, "blocks": ["body"]}},
                "shells": {"sections": {"all": {"blocks": ["body"], "thickness": 0.1}}},
                "supports": {"held": {"set": "points", "condition": "clamped"}},
                "loads": {"push": {"type": "surface", "set": "body", "pressure": 3e-3},
                          "pull": {"type": "edge", "set": "lines", "total": [5e-3, 0, 0]}},
                "path": {"stop": {"load_factor": 1}},
                "output": {"monitors": {name: {"type": "reaction", "support": "held", "component": name} for name in ("x", "z")}}}
        path = atrapos.run(deck, "pushed").path
        # The pressure acts against z, from where the nodes go round counter-clockwise.
        self.assertAlmostEqual(path["z"][-1], 2 * 3e-3, delta=1e-7)
        self.assertAlmostEqual(path["x"][-1], -5e-3, delta=1e-7)

    def test_groups_of_an_array_on_the_command_line(self):
        points = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]
        cells = [("quad", [[0, 1, 4, 3], [1, 2, 5, 4]]), ("line", [[1, 4], [2, 5]])]
        meshio.Mesh(points, cells, cell_data={"material": [[7, 3], [3, 5]]}).write("two.vtu")
        done = subprocess.run([sys.executable, "-m", "atrapos.from_meshio", "two.vtu", "--groups", "material"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        for part in ("two.exo: 6 nodes", "'material_7'", "'material_3'", "2 node sets, 1 side set"):
            # The line between the two blocks is no border of the body.
            self.assertIn(part, done.stdout)

    def test_refusals_are_one_line(self):
        pyramid = meshio.Mesh(np.eye(5, 3), [("pyramid", [[0, 1, 2, 3, 4]])])
        with self.assertRaisesRegex(atrapos.MeshError, "^cells pyramid have no equal; expected tetra, [^\n]*$"):
            atrapos.import_mesh(pyramid, "p.exo")
        with self.assertRaisesRegex(atrapos.MeshError, "no such array; they have none$"):
            atrapos.import_mesh(pyramid, "p.exo", groups="material")
        self.assertEqual(os.listdir("."), [])


if __name__ == "__main__":
    unittest.main()
