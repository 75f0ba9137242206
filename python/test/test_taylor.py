"""Series against closed forms and differences."""
import math
import unittest

import numpy as np

from atrapos import Taylor

K = 12
BINOMIAL = [1.0]
for k in range(1, K + 1):
    BINOMIAL.append(BINOMIAL[-1] * (0.3 - k + 1) / k)


class Functions(unittest.TestCase):
    x = Taylor(np.r_[0.4, 1.0, np.zeros(K - 1)])  # 0.4 + a

    def close(self, series, expected):
        # Rounding of coefficients up to 0.4**-12 = 6e4.
        np.testing.assert_allclose(series.c, expected, rtol=1e-12, atol=1e-10)

    def test_of_one_variable(self):
        f = [1 / math.factorial(k) for k in range(K + 1)]
        s, c = math.sin(0.4), math.cos(0.4)
        sines = [s, c, -s, -c]
        self.close(np.exp(self.x), [math.exp(0.4) * v for v in f])
        self.close(np.sin(self.x), [sines[k % 4] * f[k] for k in range(K + 1)])
        self.close(np.cos(self.x), [sines[(k + 1) % 4] * f[k] for k in range(K + 1)])
        self.close(np.log(self.x), [math.log(0.4)] + [-(-1 / 0.4) ** k / k for k in range(1, K + 1)])
        self.close(self.x ** 0.3, [0.4**0.3 * b / 0.4**k for k, b in enumerate(BINOMIAL)])
        self.close(1 / self.x, [(-1) ** k / 0.4 ** (k + 1) for k in range(K + 1)])

    def test_identities(self):
        x = self.x
        self.close(np.exp(np.log(x)), x.c)
        self.close(np.sqrt(x) * np.sqrt(x), x.c)
        self.close(np.cosh(x) ** 2 - np.sinh(x) ** 2, np.r_[1, np.zeros(K)])
        self.close(np.tan(x) * np.cos(x), np.sin(x).c)
        self.close(np.tanh(x), (np.sinh(x) / np.cosh(x)).c)
        self.close(np.tan(np.arctan(x)), x.c)
        self.close(x**x, np.exp(x * np.log(x)).c)
        self.close(2**x, np.exp(math.log(2) * x).c)
        self.close(x**5, (x * x * x * x * x).c)
        self.close((x - x) ** 2, np.zeros(K + 1))

    def test_arrays(self):
        u = Taylor(np.random.default_rng(1).normal(size=(4, 3)))
        A = np.arange(9.0).reshape(3, 3)
        self.close(A @ u, [A @ c for c in u.c])
        self.close(u @ A, [c @ A for c in u.c])
        self.close(u @ u, np.sum(u * u).c)
        self.close(np.stack([u[0], 2 * u[1]]), [[c[0], 2 * c[1]] for c in u.c])
        self.close(np.concatenate([u, np.ones(2)])[3:], [[1, 1], [0, 0], [0, 0], [0, 0]])
        self.close(np.roll(u, 1) - u[[2, 0, 1]], np.zeros((4, 3)))
        self.close(np.ones(3) + u, (u + 1).c)
        self.close(np.array([1.0, 2, 3]) * u, (u * np.array([1.0, 2, 3])).c)
        self.close(sum(list(u)), u.sum().c)

    def test_what_has_no_series(self):
        for f in (np.abs, np.maximum, np.arcsin):
            with self.assertRaises(TypeError):
                f(self.x, self.x) if f is np.maximum else f(self.x)


if __name__ == "__main__":
    unittest.main()
