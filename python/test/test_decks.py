"""Decks from Python: what the command writes, as arrays."""
import unittest

import numpy as np

import atrapos
from folders import InFolder

BAR = {
    "mesh": {"file": "bar.exo", "generate": {"shape": "box", "lengths": [2, 1, 1], "divisions": [2, 1, 1], "cell": "HEX20"}},
    "materials": {"rubber": {"law": "neo_hookean", "youngs_modulus": 1.0, "poissons_ratio": 0.3, "blocks": ["body"]}},
    "supports": {"left": {"set": "x_min", "x": 0}, "front": {"set": "y_min", "y": 0}, "below": {"set": "z_min", "z": 0},
                 "right": {"set": "x_max", "x": {"per_load_factor": 1}}},
    "path": {"order": 6, "accuracy": 1e-8, "stop": {"load_factor": np.float64(2)}},
    "output": {"points_per_step": 3, "monitors": {"end": {"type": "displacement", "set": "x_max_y_min_z_min", "component": "x"},
                                                  "force": {"type": "reaction", "support": "right", "component": "x"}}},
}


class Decks(InFolder):
    def test_run_of_a_dict(self):
        seen = []
        result = atrapos.run(BAR, "bar", on_step=lambda step: seen.append((step["step"], step["end"])))
        self.assertTrue(result.reached_stop, result.text)
        path = result.path
        np.testing.assert_allclose(path["end"], path["load_factor"], atol=1e-12)
        self.assertEqual(path["step"].dtype, int)
        self.assertEqual(len(seen), result.summary["steps"])
        self.assertAlmostEqual(seen[-1][1], 2, delta=1e-12)
        self.assertEqual(len(result.branches["branch"]), 1)
        states = result.states()
        self.assertEqual(len(states), len(seen) + 1)
        self.assertAlmostEqual(states.value(-1, "load_factor"), 2)
        # Homogeneous: displacements follow the places.
        np.testing.assert_allclose(states.displacement(-1)[:, 0], states.points[:, 0], atol=1e-9)
        stress = states.element(-1, "stress_xx")
        np.testing.assert_allclose(stress, stress[0], rtol=1e-9)
        self.assertEqual(states.blocks[0]["nodes"].shape, (2, 20))
        with self.assertRaises(IndexError):
            states.nodal(len(states), "displ_x")

    def test_ended_by_the_callback_and_gone_on_with(self):
        whole = atrapos.run(BAR, "whole")
        part = atrapos.run(BAR, "part", on_step=lambda step: step["step"] < 2)
        self.assertFalse(part.reached_stop)
        self.assertEqual(part.path["step"].max(), 2)
        rest = atrapos.run(BAR, restart="part")
        self.assertTrue(rest.reached_stop, rest.text)
        np.testing.assert_array_equal(rest.path["force"], whole.path["force"])

    def test_model_problem(self):
        result = atrapos.run({"problem": {"name": "von_mises_truss"}}, "truss")
        folds = result.points["load_factor"][np.isin(result.points["kind"], ["maximum", "minimum"])]
        np.testing.assert_allclose(np.abs(folds), 0.38490017946, rtol=1e-7)

    def test_errors_are_one_line(self):
        wrong = {**BAR, "materials": {"rubber": {**BAR["materials"]["rubber"], "poissons_ratio": 0.7}}}
        with self.assertRaisesRegex(atrapos.DeckError, "poissons_ratio") as caught:
            atrapos.run(wrong, "wrong")
        self.assertNotIn("\n", str(caught.exception))
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaises(TypeError):
            atrapos.write({"a": object()}, "deck.yaml")
        with self.assertRaises(FileNotFoundError):
            atrapos.Result("nowhere")
        with self.assertRaises(ZeroDivisionError):  # of the callback
            atrapos.run(BAR, "bar", on_step=lambda step: 1 / 0)

    def test_check(self):
        self.assertIn("HEX20", atrapos.check(BAR))

    def test_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is not installed")
        mesh = atrapos.run(BAR, "bar").states().to_meshio(-1, deformed=True)
        self.assertIsInstance(mesh, meshio.Mesh)
        self.assertAlmostEqual(mesh.points[:, 0].max(), 4, delta=1e-9)
        # Nodes 17 to 20 in VTK's order are halfway up; Exodus has them before those of the top.
        cell, low = mesh.cells[0].data[0], atrapos.Result("bar").states().points
        np.testing.assert_allclose(low[cell[16:], 2], 0.5)
        np.testing.assert_allclose(low[cell[12:16], 2], 1)


if __name__ == "__main__":
    unittest.main()
