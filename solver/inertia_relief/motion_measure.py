"""How much a motion of the airframe matters: by its strain energy, and by stress in every element.

Strain energy alone forgets slender parts: a frame or a floor beam may carry a fifth of the largest
stress and no energy to speak of.  Directions that are to be left out are measured by both.
"""

from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array, Single
from solver.fe.stress import BEAM_ROWS, SHELL_ROWS

if TYPE_CHECKING:
    from solver.fe.stress import StressRecovery

#: An element counts by its own stress in landings, or by this share of the most stressed one's.
LEAST_STRESSED = 0.1
#: Elements that are looked at; of larger airframes evenly chosen ones.
MOST_ELEMENTS = 10_000
#: Elements that are worked on at once.
_TOGETHER = 512


def motion_measure(recovery: "StressRecovery", basis: Array, covariance: Array) -> Array:
    """Matrix N (m, m) in whose norm ``z' N z`` the mean square of motion in landings is two.

    One half is the strain energy, relative to its mean.  The other is the sum of the squares of
    all stresses, each relative to its element's root mean square over the landings, or to a share
    of the largest one (`LEAST_STRESSED`), and the sum again relative to its mean.

    Parameters
    ----------
    basis : (n, m) array
        K-orthonormal.
    covariance : (m, m) array
        Of the coordinates over usual landings; not zero.
    """
    energy: Array = np.eye(len(covariance)) / np.trace(covariance)
    single = covariance.astype(np.float32)
    parts = _stresses(recovery, basis)
    squares = [
        np.einsum("erk,erk->e", part, (part.reshape(-1, len(single)) @ single).reshape(part.shape))
        for part in parts
    ]
    largest = max((float(part.max()) for part in squares), default=0.0)
    if largest <= 0.0:
        return energy
    stress = np.zeros_like(covariance)
    for part, square in zip(parts, squares, strict=True):
        weights = 1.0 / np.sqrt(np.maximum(square, LEAST_STRESSED**2 * largest))
        weighed = (part * weights[:, None, None]).reshape(-1, len(covariance))
        stress += weighed.T @ weighed
    measure: Array = energy + stress / np.sum(stress * covariance)
    return measure


def _stresses(recovery: "StressRecovery", basis: Array) -> list[Single]:
    """Stresses (k, rows, m) of elements for unit coordinates, some elements at a time [Pa]."""
    every = max(1, -(-(recovery.n_shells + recovery.n_beams) // MOST_ELEMENTS))
    parts = []
    for operator, height in (
        (recovery.shell_operator, SHELL_ROWS),
        (recovery.beam_operator, BEAM_ROWS),
    ):
        elements = np.arange(0, operator.shape[0] // height, every)
        for first in range(0, len(elements), _TOGETHER):
            some = elements[first : first + _TOGETHER]
            rows = operator[(height * some[:, None] + np.arange(height)).ravel()]
            parts.append(np.asarray(rows @ basis, np.float32).reshape(len(some), height, -1))
    return parts
