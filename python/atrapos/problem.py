"""Paths of equations written with numpy."""
import numpy as np

from . import _atrapos
from .sparsity import Sparsity, is_sparse
from .taylor import Taylor


class Equations:
    """residual(u, lam) = 0 as the path follower asks for it: values, tangent, orders."""

    def __init__(self, residual, size, tangent, scale, sparsity):
        self.residual, self.size, self.given, self.scale, self.sparsity = residual, size, tangent, scale, sparsity
        if tangent is None:
            group = sparsity.groups()
            self.directions = np.zeros((group.max() + 1, size))
            self.directions[group, np.arange(size)] = 1
            self.direction_of = group[sparsity.columns]

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
            values = self.sparsity.values(self.given(u, lam))
        else:
            still = np.array([lam, 0.0])
            columns = np.array([self._series(np.stack([u, d]), still)[1] for d in self.directions])
            values = columns[self.direction_of, self.sparsity.row]
        return values, self.load(u, lam)

    def load(self, u, lam):
        """-dresidual/dlam."""
        return -self._series(np.stack([u, np.zeros(self.size)]), np.array([lam, 1.0]))[1]

    def order(self, U, L):
        known = np.concatenate([U, np.zeros((1, self.size))]), np.append(L, 0.0)
        return -self._series(*known)[-1]


class Carried:
    """The same equations with the load factor itself as a last unknown, for paths that begin where it moves no other."""

    def __init__(self, equations):
        self.inner = equations
        self.rows = np.append(equations.sparsity.rows, len(equations.sparsity.columns) + 1)
        self.columns = np.append(equations.sparsity.columns, equations.size)

    def value(self, u, lam):
        r, scale = self.inner.value(u[:-1], lam)
        return np.append(r, u[-1] - lam), scale

    def tangent(self, u, lam):
        values, F = self.inner.tangent(u[:-1], lam)
        return np.append(values, 1.0), np.append(F, 1.0)

    def order(self, U, L):
        return np.append(self.inner.order(U[:, :-1], L), 0.0)


class Path:
    """A path: arrays over its points.

    u [point, unknown], load_factor, path_length, step, negative_eigenvalues (-1: not known); points: limit and
    bifurcation points as dicts (kind, step, load_factor, u); steps; reached_stop, text, factorizations, solves.
    Of a branch parent is the path that it leaves, and branches are those that leave this one; where one is not followed
    its arrays are empty and text says why (closed, joined, notStable, noStart).
    """

    def __init__(self, told):
        for name in ("u", "load_factor", "path_length", "step", "negative_eigenvalues"):
            setattr(self, name, np.array(told[name]))
        for name in ("points", "steps", "reached_stop", "text", "factorizations", "solves"):
            setattr(self, name, told[name])
        self.parent, self.branches = None, []

    def __repr__(self):
        return f"<atrapos.Path of {len(self.steps)} steps: {self.text}>"


def follow(residual, u, load_factor=0.0, *, stop=None, steps=1000, direction=1, order=20, accuracy=1e-6, symmetric=False,
           tangent=None, sparsity=None, scale=1.0, points_per_step=5, branches="none", on_step=None):
    """Follows residual(u, lam) = 0 from a solution, by Taylor series.

    residual(u, lam) returns n numbers (or a list of n). It is called with numpy arrays and with atrapos.Taylor of the
    same shapes, so it is made of what these have. u, load_factor: the start. stop: load factor or list of them.
    direction: 1 or -1, the sense in which the load factor changes first. accuracy: of the series, and the largest
    |residual|/scale; scale is the size of what the residual is the difference of.
    symmetric: the tangent is. sparsity: a matrix (scipy.sparse, or an array) that is not zero where dresidual/du may be;
    its derivatives are then made by groups of columns. tangent(u, lam): dresidual/du, a matrix of either kind, where that
    is cheaper; where it is sparse and sparsity is not given, all tangents have entries where that of the start has.
    branches: `none`, `stable` or `all`, which branches are followed from bifurcation points.
    on_step: called after every step with a dict; False ends everything.
    Returns the first path; Path.branches has those that leave it. Where the load factor does not move the unknowns at the
    start, as in a straight column, path lengths have its changes in them too.
    """
    u = np.array(u, dtype=float)
    if u.ndim != 1 or u.size == 0:
        raise ValueError(f"u is a vector of at least one number, not of shape {u.shape}")
    if sparsity is None and tangent is not None:
        first = tangent(u, float(load_factor))
        sparsity = first if is_sparse(first) else None
    places = Sparsity(u.size, sparsity)
    options = _atrapos.FollowOptions()
    options.stops = [] if stop is None else [float(s) for s in np.atleast_1d(stop)]
    options.steps, options.order, options.points = int(steps), int(order), int(points_per_step)
    options.accuracy, options.direction, options.branches = float(accuracy), float(direction), branches
    equations = Equations(residual, u.size, tangent, float(scale), places)
    rows, columns, start, carried = places.rows, places.columns, u, not equations.load(u, float(load_factor)).any()
    if carried:
        equations = Carried(equations)
        rows, columns, start = equations.rows, equations.columns, np.append(u, float(load_factor))
    told = _atrapos.follow(equations, start, float(load_factor), bool(symmetric), rows, columns, options, on_step)
    if carried:
        for own in told:
            own["u"] = [row[:-1] for row in own["u"]]
            for point in own["points"]:
                point["u"] = point["u"][:-1]
    paths = [Path(path) for path in told]
    for path, own in zip(paths, told):
        if own["parent"] >= 0:
            path.parent = paths[own["parent"]]
            path.parent.branches.append(path)
    return paths[0]
