"""Paths of equations in numpy against known points."""
import unittest

import numpy as np
import scipy.sparse

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
        self.assertRegex(path.text, "came back to its start")
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

    def test_branches_of_a_pitchfork(self):
        def residual(u, lam):
            return [u[0] * (u[0] ** 2 - u[1] + 1), u[1] - lam]
        path = atrapos.follow(residual, [0.0, 0.0], stop=2, branches="all")
        self.assertEqual(len(path.branches), 2)
        ends = []
        for branch in path.branches:
            self.assertIs(branch.parent, path)
            self.assertTrue(branch.reached_stop, branch.text)
            np.testing.assert_allclose(branch.u[:, 0] ** 2, branch.load_factor - 1, atol=1e-5)
            ends.append(branch.u[-1, 0])
        np.testing.assert_allclose(sorted(ends), [-1, 1], atol=1e-5)
        self.assertEqual(atrapos.follow(residual, [0.0, 0.0], stop=2).branches, [])
        with self.assertRaisesRegex(ValueError, "branches: 'some'; expected none, stable or all"):
            atrapos.follow(residual, [0.0, 0.0], stop=2, branches="some")

    def test_column_that_is_straight_at_first(self):
        # The load factor moves nothing until it buckles, at 1: u = lam sin u.
        for tangent in (None, lambda u, lam: [[1 - lam * np.cos(u[0])]]):
            path = atrapos.follow(lambda u, lam: [u[0] - lam * np.sin(u[0])], [0.0], stop=2, branches="all", tangent=tangent)
            (point,) = [p for p in path.points if p["kind"] == "bifurcation"]
            self.assertAlmostEqual(point["load_factor"], 1, delta=1e-6)
            self.assertEqual(point["u"].shape, (1,))
            ends = sorted(b.u[-1, 0] for b in path.branches)
            np.testing.assert_allclose(ends, [-1.895494267, 1.895494267], atol=1e-5)  # of u = 2 sin u

    def test_sparsity_gives_the_same_path_for_fewer_derivatives(self):
        n, seen = 39, []

        def residual(u, lam):
            seen.append(getattr(u, "order", 0))
            return bratu(n)(u, lam)
        places = np.abs(np.subtract.outer(np.arange(n), np.arange(n))) <= 1
        paths, calls = [], []
        for sparsity in (None, places, scipy.sparse.csr_matrix(places)):
            seen.clear()
            paths.append(atrapos.follow(residual, np.zeros(n), symmetric=True, steps=3, scale=10.0, sparsity=sparsity))
            calls.append(seen.count(1))
        for path in paths[1:]:
            np.testing.assert_allclose(path.u, paths[0].u, rtol=1e-9, atol=1e-12)
        self.assertLess(calls[1], calls[0] / 4)  # three groups in place of 39 columns
        self.assertEqual(calls[1], calls[2])

    def test_fold_on_the_square_with_a_sparse_tangent(self):
        # Laplace u + lam exp(u) = 0: the fold is at 6.808124423 (docs/theory, Bratu); differences of second order.
        errors = []
        for n in (15, 31):
            line = scipy.sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
            one = scipy.sparse.identity(n)
            A = scipy.sparse.csr_matrix(scipy.sparse.kron(line, one) + scipy.sparse.kron(one, line)) * (n + 1) ** 2
            path = atrapos.follow(lambda u, lam: atrapos.linear(lambda v: A @ v, u) - lam * np.exp(u), np.zeros(n * n),
                                  tangent=lambda u, lam: A - lam * scipy.sparse.diags(np.exp(u)), symmetric=True, steps=5,
                                  order=12, scale=100.0)
            (fold,) = [p["load_factor"] for p in path.points if p["kind"] == "limit"]
            errors.append(fold - 6.808124423)
        self.assertLess(abs(errors[1]), 0.02)
        self.assertAlmostEqual(np.log2(errors[0] / errors[1]), 2, delta=0.1)

    def test_entries_beside_the_sparsity_are_told(self):
        def residual(u, lam):
            return np.stack([u[0] + u[1] - lam, u[1] - lam])
        for tangent in ([[1.0, 1.0], [0.0, 1.0]], scipy.sparse.csr_matrix([[1.0, 1.0], [0.0, 1.0]])):
            with self.assertRaisesRegex(ValueError, "entries where sparsity"):
                atrapos.follow(residual, [0.0, 0.0], stop=1, sparsity=np.eye(2), tangent=lambda u, lam: tangent)
        with self.assertRaisesRegex(ValueError, "2 x 2, not of 3 x 3"):
            atrapos.follow(residual, [0.0, 0.0], stop=1, sparsity=np.eye(3))

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
