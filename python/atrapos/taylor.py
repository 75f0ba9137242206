"""Truncated Taylor series of numpy arrays."""
import numpy as np


def _powers(a, p):
    """Coefficients of a**p, p real: a b' = p a' b."""
    b = np.zeros_like(a)
    b[0] = a[0] ** p
    for k in range(1, len(a)):
        for i in range(1, k + 1):
            b[k] += (p * i - (k - i)) * a[i] * b[k - i]
        b[k] /= k * a[0]
    return b


def _exp(a):
    b = np.zeros_like(a)
    b[0] = np.exp(a[0])
    for k in range(1, len(a)):
        for i in range(1, k + 1):
            b[k] += i * a[i] * b[k - i] / k
    return b


def _integral(start, rate):
    """b with b_0 = start and b' = rate, of which the last order is not needed."""
    b = np.zeros_like(rate)
    b[0] = start
    for k in range(1, len(rate)):
        b[k] = rate[k - 1] / k
    return b


def _rate(a):
    """a', its last order zero."""
    b = np.zeros_like(a)
    for k in range(len(a) - 1):
        b[k] = (k + 1) * a[k + 1]
    return b


def _pair(a, sign, first, second):
    """s' = a' c, c' = sign a' s: sine and cosine (sign -1), hyperbolic ones (+1)."""
    s, c = np.zeros_like(a), np.zeros_like(a)
    s[0], c[0] = first(a[0]), second(a[0])
    for k in range(1, len(a)):
        for i in range(1, k + 1):
            s[k] += i * a[i] * c[k - i] / k
            c[k] += sign * i * a[i] * s[k - i] / k
    return s, c


def _product(a, b):
    c = np.zeros((len(a),) + np.broadcast_shapes(a.shape[1:], b.shape[1:]))
    for k in range(len(a)):
        for i in range(k + 1):
            c[k] += a[i] * b[k - i]
    return c


def _quotient(a, b):
    c = np.zeros((len(a),) + np.broadcast_shapes(a.shape[1:], b.shape[1:]))
    for k in range(len(a)):
        c[k] = a[k]
        for i in range(1, k + 1):
            c[k] -= b[i] * c[k - i]
        c[k] /= b[0]
    return c


class Taylor:
    """A numpy array whose entries are truncated Taylor series: c[k] are its coefficients of order k.

    Sums, products, quotients, powers, exp, log, sqrt, sin, cos, tan, sinh, cosh, tanh, arctan, matrix products with
    arrays and slices work as with arrays, and numpy's stack, concatenate, sum, roll, diff, reshape, ... too.
    Comparisons and absolute values do not: a series has none.
    """

    __slots__ = ("c",)

    def __init__(self, c):
        self.c = np.asarray(c, dtype=float)

    shape = property(lambda self: self.c.shape[1:])
    ndim = property(lambda self: self.c.ndim - 1)
    size = property(lambda self: self.c[0].size)
    T = property(lambda self: _each(np.transpose, self))
    order = property(lambda self: len(self.c) - 1, doc="the highest order")

    def __len__(self):
        if self.ndim == 0:
            raise TypeError("a series of one number has no length")
        return self.shape[0]

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __getitem__(self, key):
        return Taylor(self.c[(slice(None),) + (key if isinstance(key, tuple) else (key,))])

    def __repr__(self):
        return f"Taylor({self.c!r})"

    def reshape(self, *shape):
        return _each(np.reshape, self, shape[0] if len(shape) == 1 else shape)

    def sum(self, axis=None):
        return _each(np.sum, self, axis)

    def _with(self, other):
        """Another operand with the same orders; None where it is none."""
        if isinstance(other, Taylor):
            return other.c
        if not isinstance(other, (int, float, np.ndarray, np.number, list, tuple)):
            return None
        c = np.zeros(self.c.shape[:1] + np.shape(other))
        c[0] = other
        return c

    def __array_ufunc__(self, ufunc, method, *inputs, **kwargs):
        if method != "__call__" or kwargs or ufunc.__name__ not in _UFUNCS:
            raise TypeError(f"no series of numpy.{ufunc.__name__}")
        orders = next(x for x in inputs if isinstance(x, Taylor))
        c = [orders._with(x) for x in inputs]
        if any(x is None for x in c):
            return NotImplemented
        if ufunc.__name__ == "power" and not isinstance(inputs[1], Taylor):
            return inputs[0] ** inputs[1]
        if ufunc is not np.matmul:  # arrays broadcast behind the axis of orders
            ndim = max(x.ndim for x in c)
            c = [x.reshape(x.shape[:1] + (1,) * (ndim - x.ndim) + x.shape[1:]) for x in c]
        return Taylor(_UFUNCS[ufunc.__name__](*c))

    def __array_function__(self, func, types, args, kwargs):
        if func in (np.stack, np.concatenate, np.hstack, np.vstack, np.column_stack):
            first = next(x for x in args[0] if isinstance(x, Taylor))
            parts = [first._with(x) for x in args[0]]
            return Taylor([func([p[k] for p in parts], *args[1:], **kwargs) for k in range(len(first.c))])
        if func in _LINEAR and isinstance(args[0], Taylor):
            return _each(func, args[0], *args[1:], **kwargs)
        if func is np.dot:
            return np.matmul(*args)
        raise TypeError(f"no series of numpy.{func.__name__}")

    def __pow__(self, p):
        if isinstance(p, Taylor):
            return np.exp(p * np.log(self))
        if float(p).is_integer() and 0 <= p <= 64:  # also where the base is zero
            result, base, n = Taylor(self._with(np.ones(self.shape))), self, int(p)
            while n:
                if n & 1:
                    result = result * base
                n >>= 1
                if n:
                    base = base * base
            return result
        return Taylor(_powers(self.c, float(p)))

    def __rpow__(self, base):
        return np.exp(np.log(base) * self)

    def __neg__(self):
        return Taylor(-self.c)

    def __pos__(self):
        return self


def _each(function, series, *args, **kwargs):
    """A linear function of arrays, order by order."""
    return Taylor([function(c, *args, **kwargs) for c in series.c])


_LINEAR = {np.sum, np.mean, np.roll, np.diff, np.reshape, np.transpose, np.ravel, np.cumsum, np.flip, np.trace,
           np.squeeze, np.expand_dims, np.broadcast_to, np.gradient, np.pad, np.tile, np.repeat, np.trapz}


def linear(function, x):
    """function(x) of a linear function of arrays, as `lambda v: A @ v` of a sparse matrix A: of series order by order."""
    return _each(function, x) if isinstance(x, Taylor) else function(x)


def _matmul(a, b):
    return np.stack([sum(np.matmul(a[i], b[k - i]) for i in range(k + 1)) for k in range(len(a))])


def _tan(a):
    s, c = _pair(a, -1, np.sin, np.cos)
    return _quotient(s, c)


def _tanh(a):
    s, c = _pair(a, 1, np.sinh, np.cosh)
    return _quotient(s, c)


_UFUNCS = {
    "add": lambda a, b: a + b, "subtract": lambda a, b: a - b, "multiply": _product, "divide": _quotient,
    "negative": lambda a: -a, "positive": lambda a: a, "square": lambda a: _product(a, a),
    "reciprocal": lambda a: _quotient(np.concatenate([np.ones_like(a[:1]), np.zeros_like(a[1:])]), a),
    "sqrt": lambda a: _powers(a, 0.5), "cbrt": lambda a: _powers(a, 1 / 3),
    "power": lambda a, b: _exp(_product(b, _integral(np.log(a[0]), _quotient(_rate(a), a)))),
    "exp": _exp, "log": lambda a: _integral(np.log(a[0]), _quotient(_rate(a), a)),
    "sin": lambda a: _pair(a, -1, np.sin, np.cos)[0], "cos": lambda a: _pair(a, -1, np.sin, np.cos)[1],
    "sinh": lambda a: _pair(a, 1, np.sinh, np.cosh)[0], "cosh": lambda a: _pair(a, 1, np.sinh, np.cosh)[1],
    "tan": _tan, "tanh": _tanh, "matmul": _matmul,
    "arctan": lambda a: _integral(np.arctan(a[0]), _quotient(_rate(a), _one_more(_product(a, a)))),
}


def _one_more(a):
    a = a.copy()
    a[0] += 1
    return a


def _operator(ufunc, reversed_=False):
    def apply(self, other):
        return ufunc(other, self) if reversed_ else ufunc(self, other)
    return apply


for _name, _ufunc in (("add", np.add), ("sub", np.subtract), ("mul", np.multiply), ("truediv", np.divide),
                      ("matmul", np.matmul)):
    setattr(Taylor, f"__{_name}__", _operator(_ufunc))
    setattr(Taylor, f"__r{_name}__", _operator(_ufunc, True))
