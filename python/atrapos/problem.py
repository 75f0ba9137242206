"""Paths of equations written with numpy."""
import numpy as np

from . import _atrapos
from .taylor import Taylor


class Equations:
    """residual(u, lam) = 0 as the path follower asks for it: values, tangent, orders."""

    def __init__(self, residual, size, tangent=None, scale=1.0):
        self.residual, self.size, self.given, self.scale = residual, size, tangent, scale

    def _series(self, U, L):
        told = self.residual(Taylor(U), Taylor(L))
        if isinstance(told, (list, tuple)):
            told = np.stack([x if isinstance(x, Taylor) else Taylor(np.r_[x, np.zeros(len(L) - 1)]) for x in told])
        if not isinstance(told, Taylor):  # depends on nothing
            told = Taylor(np.concatenate([np.asarray(told, float)[None], np.zeros((len(L) - 1, self.size))]))
        return told.c

    def value(self, u, lam):
        return np.asarray(self.residual(u, lam), dtype=float), self.scale

    def tangent(self, u, lam):
        if self.given is not None:
            K = np.asarray(self.given(u, lam), dtype=float)
        else:
            K = np.empty((self.size, self.size))
            for j in range(self.size):
                K[:, j] = self._series(np.stack([u, np.eye(self.size)[j]]), np.array([lam, 0.0]))[1]
        F = -self._series(np.stack([u, np.zeros(self.size)]), np.array([lam, 1.0]))[1]
        return K, F

    def order(self, U, L):
        known = np.concatenate([U, np.zeros((1, self.size))]), np.append(L, 0.0)
        return -self._series(*known)[-1]


class Path:
    """A path: arrays over its points.

    u [point, unknown], load_factor, path_length, step, negative_eigenvalues (-1: not known); points: limit and
    bifurcation points as dicts (kind, step, load_factor, u); steps; reached_stop, text, factorizations, solves.
    """

    def __init__(self, told):
        for name in ("u", "load_factor", "path_length", "step", "negative_eigenvalues"):
            setattr(self, name, np.array(told[name]))
        for name in ("points", "steps", "reached_stop", "text", "factorizations", "solves"):
            setattr(self, name, told[name])

    def __repr__(self):
        return f"<atrapos.Path of {len(self.steps)} steps: {self.text}>"


def follow(residual, u, load_factor=0.0, *, stop=None, steps=1000, direction=1, order=20, accuracy=1e-6, symmetric=False,
           tangent=None, scale=1.0, points_per_step=5, on_step=None):
    """Follows residual(u, lam) = 0 from a solution, by Taylor series.

    residual(u, lam) returns n numbers (or a list of n). It is called with numpy arrays and with atrapos.Taylor of the
    same shapes, so it is made of what these have. u, load_factor: the start. stop: load factor or list of them.
    direction: 1 or -1, the sense in which the load factor changes first. accuracy: of the series, and the largest
    |residual|/scale; scale is the size of what the residual is the difference of.
    symmetric: the tangent is. tangent(u, lam): dresidual/du, where that is cheaper than n derivatives by Taylor.
    on_step: called after every step with a dict; False ends the path.
    """
    u = np.array(u, dtype=float)
    if u.ndim != 1 or u.size == 0:
        raise ValueError(f"u is a vector of at least one number, not of shape {u.shape}")
    stops = [] if stop is None else [float(s) for s in np.atleast_1d(stop)]
    equations = Equations(residual, u.size, tangent, float(scale))
    return Path(_atrapos.follow(equations, u, float(load_factor), bool(symmetric), stops, int(steps), int(order),
                                float(accuracy), float(direction), int(points_per_step), on_step))
