"""Paths of equations in numpy against known points."""
import unittest

import numpy as np

import atrapos


def bratu(n):
    """u'' + lam exp(u) = 0, u = 0 at both ends, by differences of second order."""
    h = 1 / (n + 1)

    def residual(u, lam):
        zero = np.zeros(1)
        wide = np.concatenate([zero, u, zero])
        return -(wide[2:] - 2 * u + wide[:-2]) / h**2 - lam * np.exp(u)
    return residual


class Paths(unittest.TestCase):
    def test_fold_of_bratu_with_the_order_of_the_differences(self):
        errors = []
        for n in (19, 39):
            path = atrapos.follow(bratu(n), np.zeros(n), symmetric=True, steps=4, scale=10.0)
            self.assertTrue(path.reached_stop, path.text)
            folds = [p for p in path.points if p["kind"] == "limit"]
            self.assertEqual(len(folds), 1)
            errors.append(folds[0]["load_factor"] - 3.513830719)
            self.assertEqual(path.negative_eigenvalues[-1], 1)
            residual = max(np.abs(bratu(n)(u, lam)).max() for u, lam in zip(path.u, path.load_factor))
            self.assertLess(residual, 1e-4)
        self.assertAlmostEqual(errors[0] / errors[1], 4, delta=0.1)

    def test_circle_all_around(self):
        # Past its limit points, once.
        path = atrapos.follow(lambda u, lam: [u[0] ** 2 + lam**2 - 1], [0.6], 0.8, steps=20, accuracy=1e-9)
        np.testing.assert_allclose(path.u[:, 0] ** 2 + path.load_factor**2, 1, atol=1e-8)
        limits = [p["load_factor"] for p in path.points if p["kind"] == "limit"]
        np.testing.assert_allclose(limits, [1, -1], atol=1e-9)
        self.assertTrue(path.reached_stop)
        self.assertRegex(path.text, "closed: step [0-9]+ comes to the state with which step 1 began")
        self.assertLess(len(path.steps), 20)

    def test_pitchfork_is_found(self):
        path = atrapos.follow(lambda u, lam: [u[0] * (u[0] ** 2 - u[1] + 1), u[1] - lam], [0.0, 0.0], stop=2)
        (point,) = [p for p in path.points if p["kind"] == "bifurcation"]
        self.assertAlmostEqual(point["load_factor"], 1, delta=1e-6)

    def test_given_tangent_and_callback(self):
        seen = []
        path = atrapos.follow(lambda u, lam: [u[0] ** 3 + u[0] - lam], [0.0], stop=10,
                              tangent=lambda u, lam: [[3 * u[0] ** 2 + 1]], on_step=lambda s: seen.append(s["load_factor"]))
        self.assertAlmostEqual(path.u[-1, 0], 2, delta=1e-6)
        self.assertEqual(len(seen), len(path.steps))
        ended = atrapos.follow(lambda u, lam: [u[0] - lam], [0.0], stop=1e9, on_step=lambda s: False)
        self.assertEqual(len(ended.steps), 1)

    def test_errors_of_the_residual_come_through(self):
        def wrong(u, lam):
            raise RuntimeError("mine")
        with self.assertRaisesRegex(RuntimeError, "mine"):
            atrapos.follow(wrong, [0.0], stop=1)
        with self.assertRaises(ValueError):
            atrapos.follow(lambda u, lam: [u[0], u[0]], [0.0], stop=1)
        with self.assertRaises(ValueError):
            atrapos.follow(lambda u, lam: u, [[0.0]], stop=1)


if __name__ == "__main__":
    unittest.main()
