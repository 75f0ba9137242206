#!/usr/bin/python3
"""Strains at which a stretched sheet of rubber begins and ceases to wrinkle, as a thin plate (numpy, scipy).

    sheet.py            writes sheet.csv, what docs/wrinkling.md compares with; minutes
    sheet.py NX NY      prints the six strains of one mesh

The quarter 100 x 50 of a sheet 200 x 100 x 0.1; W = mu/2 (J^(-2/3) I_1 - 3) + kappa/4 (J^2 - 1 - 2 ln J), mu = 1, kappa = 50; the grip
moves along x. Two problems, both with B-splines of degree 3:

- the flat sheet, in plane stress at finite strain: x(X, Y), C = F^T F, C_33 from S_33 = 0 at each point;
- a small deflection w of that. A point at z has C(z) = C + z C1 + z^2 C2 with C1 = -2 l b, C2 = l^2 b C^-1 b + 2 l (l':b) b,
  l = sqrt(C_33) the stretch of the thickness, l' its derivative by C, and b = Hessian of w less Christoffel's symbols of C times its
  gradient. With W the energy in plane stress, S = 2 W', D = 4 W'', the energy of w per undeformed area is
      t/2 S:(grad w x grad w) + t^3/12 (l^2/2 b:D:b + l^2/2 S:(b C^-1 b) + l (l':b) S:b).

Its lowest eigenvalues, against the mass int w^2, vanish at the strains sought. Kirchhoff's normals: no shear, terms of higher order in
the thickness left out. Shares no code and no element with Atrapos.
"""
import os
import sys

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl
from scipy.interpolate import BSpline
from scipy.optimize import brentq

LENGTH, WIDTH, THICKNESS, MU, KAPPA = 100.0, 50.0, 0.1, 1.0, 50.0
DEGREE, GRADING = 3, 1.5  # elements are smaller towards the grip
# Between which strains each eigenvalue, counted from the lowest, is sought.
POINTS = ((0, 0.024, 0.03), (1, 0.037, 0.047), (2, 0.06, 0.08), (2, 0.16, 0.19), (1, 0.215, 0.235), (0, 0.25, 0.265))
PAIRS = ((0, 0), (1, 1), (0, 1))  # of the three components of symmetric tensors in the plane
PLACE = {(0, 0): 0, (1, 1): 1, (0, 1): 2, (1, 0): 2}


class Splines:
    """Values and derivatives of the functions on the quarter, at all Gauss points."""

    def __init__(self, nx, ny):
        self.knots, x, X, wx = self.line(nx, LENGTH, GRADING)
        _, y, Y, wy = self.line(ny, WIDTH, 1)
        self.weights = np.outer(wx, wy).ravel()
        product = lambda i, j: sp.kron(X[i], Y[j], format="csr")
        self.N, self.d = product(0, 0), (product(1, 0), product(0, 1))
        self.dd = (product(2, 0), product(0, 2), product(1, 1))
        self.shape = (nx + DEGREE, ny + DEGREE)
        self.numbers = np.arange(np.prod(self.shape)).reshape(self.shape)

    @staticmethod
    def line(n, length, grading):
        ends = length * (1 - (1 - np.linspace(0, 1, n + 1)) ** grading)
        knots = np.r_[[0] * DEGREE, ends, [length] * DEGREE]
        at, weight = np.polynomial.legendre.leggauss(DEGREE + 1)
        x = (ends[:-1, None] + (at + 1) / 2 * np.diff(ends)[:, None]).ravel()
        splines = BSpline(knots, np.eye(n + DEGREE), DEGREE)
        values = [sp.csr_matrix((splines.derivative(k) if k else splines)(x)) for k in range(3)]
        return knots, x, values, (weight / 2 * np.diff(ends)[:, None]).ravel()


def plane_stress(C11, C22, C12):
    """S (3), D = 2 dS/dC (3 x 3, tensor components), C_33 and dC_33/dC (3) at points."""
    det, c = C11 * C22 - C12**2, 1 / (C11 * C22 - C12**2)

    def derivatives(c):  # of W by I_1 and I_3
        I1, I3 = C11 + C22 + c, det * c
        q = MU / 6 * I3 ** (-1 / 3)
        return (3 * q, -q * I1 / I3 + KAPPA / 4 * (1 - 1 / I3), -q / I3, 4 / 3 * q * I1 / I3**2 + KAPPA / 4 / I3**2)

    for _ in range(30):
        W1, W3, W13, W33 = derivatives(c)
        step = -(W1 + W3 * det) / (2 * W13 * det + W33 * det**2)
        c = c + step
        if abs(step).max() < 1e-14:
            break
    W1, W3, W13, W33 = derivatives(c)
    inverse, one, I3 = np.array([C22, C11, -C12]) / det, np.array([1 + 0 * c, 1 + 0 * c, 0 * c]), det * c
    S = 2 * (W1 * one + W3 * I3 * inverse)
    dc = -(W13 * det * one + (W13 + W33 * det) * I3 * inverse + W3 * det * inverse) / (2 * W13 * det + W33 * det**2)
    dI1, dI3 = one + dc, I3 * inverse + det * dc
    dW1, dW3I3 = W13 * dI3, (W13 * dI1 + W33 * dI3) * I3 + W3 * dI3
    D = np.empty((3, 3) + c.shape)
    for a, (i, j) in enumerate(PAIRS):
        for b, (k, m) in enumerate(PAIRS):
            both = inverse[PLACE[i, k]] * inverse[PLACE[j, m]] + inverse[PLACE[i, m]] * inverse[PLACE[j, k]]
            D[a, b] = 4 * (one[a] * dW1[b] + inverse[a] * dW3I3[b] - W3 * I3 / 2 * both)
    return S, D, c, dc


class Sheet:
    def __init__(self, nx, ny):
        self.s = s = Splines(nx, ny)
        self.n = n = s.numbers.size
        # symmetry: u at x = 0, v at y = 0; the grip: both
        held = np.r_[s.numbers[0], s.numbers[-1], n + s.numbers[:, 0], n + s.numbers[-1]]
        self.free = np.setdiff1d(np.arange(2 * n), held)
        along = np.array([s.knots[i + 1 : i + 1 + DEGREE].mean() for i in range(s.shape[0])])
        self.uniform = np.r_[np.repeat(along, s.shape[1]), np.zeros(n)]
        self.u, self.strain = np.zeros(2 * n), 0

    def gradient(self):
        u, v = self.u[: self.n], self.u[self.n :]
        X, Y = self.s.d
        return 1 + X @ u, Y @ u, X @ v, 1 + Y @ v

    def state(self):
        a, b, c, d = self.gradient()
        C = a**2 + c**2, b**2 + d**2, a * b + c * d
        return C, *plane_stress(*C)

    def membrane(self, S):
        X, Y = self.s.d
        w = self.s.weights
        mixed = X.T @ sp.diags(w * S[2]) @ Y
        return X.T @ sp.diags(w * S[0]) @ X + Y.T @ sp.diags(w * S[1]) @ Y + mixed + mixed.T

    def stretch(self, strain):
        """The flat sheet at this strain, from the one before."""
        self.u = self.u + (strain - self.strain) * self.uniform
        self.strain = strain
        X, Y = self.s.d
        f, w, dg = self.free, self.s.weights, sp.diags
        for _ in range(20):
            a, b, c, d = self.gradient()
            _, S, D, _, _ = self.state()
            B = [sp.hstack([dg(a) @ X, dg(c) @ X]), sp.hstack([dg(b) @ Y, dg(d) @ Y]),
                 sp.hstack([dg(b) @ X + dg(a) @ Y, dg(d) @ X + dg(c) @ Y])]
            r = sum(Bi.T @ (w * Si) for Bi, Si in zip(B, S))
            K = sum(B[i].T @ dg(w * D[i, j]) @ B[j] for i in range(3) for j in range(3))
            K = (K + sp.block_diag([self.membrane(S)] * 2)).tocsc()
            step = np.zeros(2 * self.n)
            step[f] = -sl.spsolve(K[f][:, f], r[f])
            self.u = self.u + step
            if abs(step).max() < 1e-11 * LENGTH:
                return
        raise RuntimeError(f"no flat sheet at {strain}")

    def lowest(self, count):
        """The lowest eigenvalues of deflections that are even in x and y and vanish with their slope at the grip."""
        C, S, D, c, dc = self.state()
        a, b, e, d = self.gradient()
        (X, Y), w, dg = self.s.d, self.s.weights, sp.diags
        stretch = np.sqrt(c)
        change, det = dc / (2 * stretch), C[0] * C[1] - C[2] ** 2
        inverse = np.array([C[1], C[0], -C[2]]) / det
        M = np.zeros((3, 3, len(c)))
        twice = (1, 1, 2)  # a component off the diagonal stands for two
        for i in range(3):
            for j in range(3):
                M[i, j] += twice[i] * twice[j] * (c * D[i, j] + stretch * (S[i] * change[j] + S[j] * change[i]))
        for i, j, k, m in np.ndindex(2, 2, 2, 2):
            M[PLACE[i, k], PLACE[m, j]] += c * S[PLACE[i, j]] * inverse[PLACE[k, m]]
        bending, area = [], a * d - b * e
        for N in self.s.dd:  # x_,ij = Gamma^k_ij x_,k
            x, y = N @ self.u[: self.n], N @ self.u[self.n :]
            bending.append(N - dg((d * x - b * y) / area) @ X - dg((a * y - e * x) / area) @ Y)
        K = THICKNESS * self.membrane(S)
        for i in range(3):
            for j in range(3):
                K = K + bending[i].T @ dg(w * THICKNESS**3 / 24 * (M[i, j] + M[j, i])) @ bending[j]
        mass = self.s.N.T @ dg(w) @ self.s.N
        nx, ny = self.s.shape
        column = -np.ones((nx, ny), int)  # even: the first two coefficients are equal
        column[1 : nx - 2, 1:] = np.arange((nx - 3) * (ny - 1)).reshape(nx - 3, ny - 1)
        column[0], column[:, 0] = column[1], column[:, 1]
        column[0, 0] = column[1, 1]
        used = column >= 0
        T = sp.csr_matrix((np.ones(used.sum()), (self.s.numbers[used], column[used])), shape=(self.n, column.max() + 1))
        below = -2e-3  # any eigenvalue here
        values = sl.eigsh((T.T @ K @ T).tocsc(), k=count, M=(T.T @ mass @ T).tocsc(), sigma=below,
                          return_eigenvectors=False)
        return np.sort(values)


def critical(nx, ny):
    sheet = Sheet(nx, ny)

    def eigenvalue(strain, number):
        sheet.stretch(strain)
        return sheet.lowest(number + 2)[number]

    found = []
    for number, low, high in POINTS:
        for strain in np.linspace(sheet.strain, low, 2 + int((low - sheet.strain) / 0.03))[1:]:
            sheet.stretch(strain)
        found.append(brentq(eigenvalue, low, high, args=(number,), xtol=1e-6))
    return found


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(*(f"{e:.5f}" for e in critical(int(sys.argv[1]), int(sys.argv[2]))))
        raise SystemExit
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "sheet.csv"), "w") as f:
        f.write("nx,ny,point,strain\n")
        for nx, ny in ((16, 24), (24, 36), (32, 48)):
            for i, strain in enumerate(critical(nx, ny)):
                f.write(f"{nx},{ny},{i + 1},{strain:.5f}\n")
