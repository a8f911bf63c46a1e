"""Lowest modes of a large structure by block Lanczos iteration on the shifted inverse.

Some vectors go through the factors together, which reads them once, and all that keeps the basis
orthogonal are products of matrices; a vector at a time would wait for memory in both.  The basis is
kept orthogonal to all of itself, so that no mode is found twice and nothing is ever restarted.

Source: Grimes, Lewis and Simon, "A shifted block Lanczos algorithm for solving sparse symmetric
generalized eigenproblems", SIAM J. Matrix Anal. Appl. 15 (1994).
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.linalg import eigh

from solver.arrays import Array
from solver.errors import ModelError

#: Vectors of a block; more than the six rigid modes, which all have the same eigenvalue.
WIDTH = 8
#: Residual of every mode wanted, relative to its eigenvalue; eigenvalues are off by its square.
TOLERANCE = 1e-9
#: Blocks between one look at the residuals and the next.
_LOOK = 8
#: Vectors that the iteration may take for each mode wanted, and for some more: the last of few
#: modes need the same start as the last of many.
_LONGEST, _MORE = 8, 20
#: Below this size the matrices are taken whole.
_DENSE = 1500


def largest_modes(
    solve: Callable[[Array], Array], mass: Any, count: int, matrix: Any
) -> tuple[Array, Array]:
    """Largest eigenvalues and M-orthonormal vectors of ``A^-1 M``.

    Parameters
    ----------
    solve : callable
        Gives ``A^-1 b`` for b (n, k).
    mass : (n, n) sparse array
        M, symmetric and semidefinite.
    count : int
        How many are wanted, less than n.
    matrix : (n, n) sparse array
        A, symmetric and positive definite.

    Returns
    -------
    (count,) array, (n, count) array
        Eigenvalues, largest first, and vectors.

    Raises
    ------
    ModelError
        The iteration does not converge.
    """
    size = mass.shape[0]
    if size <= max(_DENSE, _LONGEST * (count + _MORE)):
        values, vectors = eigh(
            mass.toarray(), matrix.toarray(), subset_by_index=[size - count, size - 1]
        )
        values, vectors = values[::-1], vectors[:, ::-1]
        return values, vectors / np.sqrt(values)  # from A-orthonormal
    longest = -(-_LONGEST * (count + _MORE) // WIDTH)
    # column after column; pages that are never reached take no memory
    basis = np.empty((size, WIDTH * (longest + 1)), order="F")
    projected = np.zeros((WIDTH * longest,) * 2)
    start = np.random.default_rng(15).standard_normal((size, WIDTH))
    basis[:, :WIDTH], _ = _orthonormal(solve(mass @ start), mass)
    for block in range(longest):
        first, last = WIDTH * block, WIDTH * (block + 1)
        known = basis[:, :last]
        rest = solve(mass @ known[:, first:])
        for _ in range(2):
            along = known.T @ (mass @ rest)
            projected[:last, first:last] += along
            rest -= known @ along
        following, coupling = _orthonormal(rest, mass)
        basis[:, last : last + WIDTH] = following
        if block % _LOOK == 0 and last >= 2 * count:
            upper = projected[:last, :last]
            values, turn = np.linalg.eigh((upper + upper.T) / 2)
            values, turn = values[: -count - 1 : -1], turn[:, : -count - 1 : -1]
            residuals = np.linalg.norm(coupling @ turn[first:], axis=0)
            if np.all(residuals <= TOLERANCE * values):
                return values, known @ turn
        if block + 1 < longest:
            projected[last : last + WIDTH, first:last] = coupling
    raise ModelError(f"{count} modes did not converge in {WIDTH * longest} Lanczos vectors")


def _orthonormal(vectors: Array, mass: Any) -> tuple[Array, Array]:
    """M-orthonormal Q and R (WIDTH, WIDTH) with ``Q R`` the vectors, by Cholesky twice."""
    total: Array = np.eye(vectors.shape[1])
    for _ in range(2):
        gram: Array = vectors.T @ (mass @ vectors)
        upper = np.linalg.cholesky((gram + gram.T) / 2).T
        turned: Array = np.linalg.solve(upper.T, vectors.T)
        vectors, total = turned.T, upper @ total
    return vectors, total
