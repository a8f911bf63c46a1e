"""The W terms of eq (15) in reduced coordinates, as pseudo loads of a motion already known.

All twelve operators act in one matrix product per sweep, in single precision: the terms are a small
share of the response and each sweep brings a smaller one.  A product of one rate coefficient and
one coordinate enters only if its part in the loads matters: the root of the sum of squares of the
bounds of those left out is less than a stated norm.  Slow motion under small rates needs few of
the 12 (6 + m) products.
"""

import numba
import numpy as np

from solver.arrays import Array, IntArray, Single
from solver.inertia_relief.loading import ReducedLoading

#: Every so many samples the motion is looked at to see which coordinates matter.
_FIRST_LOOK = 8
#: How much farther than there they may move between those samples.
_CAUTION = np.float32(2.0)


@numba.njit(cache=True)
def _products(
    coefficients: Single,
    displacement: Single,
    velocity: Single,
    terms: IntArray,
    coordinates: IntArray,
    out: Single,
) -> None:  # pragma: no cover - compiled
    """Histories (k, nt) of a coefficient times the field it acts on."""
    for k in range(len(terms)):
        term, i = terms[k], coordinates[k]
        if term < 3:
            for n in range(out.shape[1]):
                out[k, n] = coefficients[term, n] * velocity[i, n]
        else:
            for n in range(out.shape[1]):
                out[k, n] = coefficients[term, n] * displacement[i, n]


@numba.njit(cache=True)
def _columns(
    operators: Single, weights: Single, terms: IntArray, coordinates: IntArray, out: Single
) -> None:  # pragma: no cover - compiled
    """Weighted sums (k, M) of some columns of several sets of operators."""
    for k in range(len(terms)):
        for i in range(out.shape[1]):
            out[k, i] = 0.0
        for part in range(len(weights)):
            weight, column = weights[part], operators[part, terms[k], coordinates[k]]
            if weight != 0.0:
                for i in range(out.shape[1]):
                    out[k, i] += weight * column[i]


class RateLoads:
    """Pseudo loads of one landing's rates on modal motions of one loading.

    Parameters
    ----------
    coefficients : (12, nt) array
        See `RigidMotion.rate_coefficients`.
    negligible : float
        Largest norm of the loads that may be left out.
    """

    def __init__(
        self, loading: ReducedLoading, coefficients: Array, negligible: float = 0.0
    ) -> None:
        self._loading = loading
        self._modes = loading.modes_with_rigid
        self._coefficients = coefficients.astype(np.float32)
        self._negligible = negligible / 2  # half before and half after the motion is known
        self._weights = np.abs(coefficients).max(axis=1)[:, None] * loading.rate_norms

    def of(self, displacement: Array | Single, velocity: Array | Single) -> Single:
        """Modal pseudo loads (m, nt) of the modal motion (m, nt), [1/s] for the velocity."""
        moved, moving = (
            displacement.astype(np.float32, copy=False),
            velocity.astype(np.float32, copy=False),
        )
        # between the samples looked at first the coordinates may move somewhat farther
        farthest = _CAUTION * np.abs(self._modes @ moved[:, ::_FIRST_LOOK]).max(axis=1)
        fastest = _CAUTION * np.abs(self._modes @ moving[:, ::_FIRST_LOOK]).max(axis=1)
        rows = np.unique(self._significant(farthest, fastest)[1])
        if len(rows) == 0:
            return np.zeros(displacement.shape, dtype=np.float32)
        moved, moving = self._modes[rows] @ moved, self._modes[rows] @ moving
        farthest[:], fastest[:] = 0.0, 0.0
        farthest[rows], fastest[rows] = np.abs(moved).max(axis=1), np.abs(moving).max(axis=1)
        terms, coordinates = self._significant(farthest, fastest)
        products = np.empty((len(terms), displacement.shape[1]), dtype=np.float32)
        at = np.searchsorted(rows, coordinates)
        _products(self._coefficients, moved, moving, terms, at, products)
        columns = self._columns(terms, coordinates)
        # in whichever order costs less: few terms go through the modes before they meet time
        loads: Single = np.linalg.multi_dot([self._modes.T, columns.T, products])
        return np.negative(loads, out=loads)

    def _significant(self, farthest: Single, fastest: Single) -> tuple[IntArray, IntArray]:
        """Terms and coordinates of the products whose bounds together matter.

        ``farthest`` and ``fastest`` (6 + m,) are the largest displacements and velocities.  What
        is known to be zero is left out, too.
        """
        bounds = self._weights.copy()
        bounds[:3] *= fastest
        bounds[3:] *= farthest
        order = np.argsort(bounds, axis=None)
        # what is left out adds up like noise: many small parts that know nothing of each other
        added = np.sqrt(np.cumsum(bounds.ravel()[order] ** 2))
        kept = order[np.searchsorted(added, self._negligible, side="right") :]
        terms, coordinates = np.unravel_index(np.sort(kept), bounds.shape)
        return terms, coordinates

    def _columns(self, terms: IntArray, coordinates: IntArray) -> Single:
        """Columns (k, 6 + m) of the loaded airframe's operators."""
        model = self._loading.model
        total = np.empty((len(terms), 6 + model.size), dtype=np.float32)
        weights = self._loading.weights.astype(np.float32)
        _columns(np.asarray(model.rate_operators), weights, terms, coordinates, total)
        return total
