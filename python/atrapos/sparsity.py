"""Where a tangent has entries, and its columns in groups."""
import numpy as np


def is_sparse(matrix):
    return hasattr(matrix, "tocsr")


class Sparsity:
    """The places of a matrix of n x n, by rows: `rows` (where each begins, n + 1) and `columns`."""

    def __init__(self, size, places=None):
        if places is None:
            row, column = (x.ravel() for x in np.indices((size, size)))
        elif is_sparse(places):
            own = places.tocoo()
            row, column = own.row, own.col
        else:
            row, column = np.nonzero(np.asarray(places))
        shape = (size, size) if places is None else np.shape(places)
        if shape != (size, size):
            raise ValueError(f"sparsity is a matrix of {size} x {size}, not of {' x '.join(map(str, shape))}")
        # The diagonal is there, so that no row is empty.
        keys = np.unique(np.concatenate([row * size + column, np.arange(size) * (size + 1)]).astype(np.int64))
        self.size, self.row, self.columns = size, keys // size, keys % size
        self.rows = np.searchsorted(self.row, np.arange(size + 1))

    def groups(self):
        """Columns of which no two have entries in one row: their derivatives come from one direction together (Curtis,
        Powell and Reid 1974). [column] its group, greedily in their order."""
        if len(self.columns) == self.size**2:
            return np.arange(self.size)
        members = [np.zeros(self.size, dtype=bool)]  # [group][row]: taken
        group = np.empty(self.size, dtype=int)
        by_column = np.argsort(self.columns, kind="stable")
        ends = np.searchsorted(self.columns[by_column], np.arange(self.size + 1))
        for j in range(self.size):
            own = self.row[by_column[ends[j]:ends[j + 1]]]
            group[j] = next((g for g, taken in enumerate(members) if not taken[own].any()), len(members))
            if group[j] == len(members):
                members.append(np.zeros(self.size, dtype=bool))
            members[group[j]][own] = True
        return group

    def values(self, matrix):
        """Those of a matrix at the places, in their order; ValueError where it has others."""
        if is_sparse(matrix):
            csr = matrix.tocsr()
            values = np.asarray(csr[self.row, self.columns], dtype=float).ravel()
            there = csr.count_nonzero()
        else:
            dense = np.asarray(matrix, dtype=float)
            if dense.shape != (self.size, self.size):
                raise ValueError("the tangent is not a square matrix of the unknowns")
            values = dense[self.row, self.columns]
            there = np.count_nonzero(dense)
        if there != np.count_nonzero(values):
            raise ValueError("the tangent has entries where sparsity (or the first tangent) has none")
        return values
