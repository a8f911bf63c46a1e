"""The frame that follows an airframe's nodes best: where it is and how it stands."""

import numpy as np

from solver.arrays import Array
from solver.nonlinear.midpoint import Motion
from solver.nonlinear.structure import NonlinearStructure


def mean_frame(
    structure: NonlinearStructure, motion: Motion, initial: Array
) -> tuple[Array, Array]:
    """Centre of gravity (3,) [m] and turn (3, 3) of the rigid body that fits the mass points best.

    Weighted polar decomposition of the points' places against their ``initial`` ones (p, 3); for
    small deformations it is the mean-axis frame of the translations.
    """
    mass = structure.points.mass
    weights = np.asarray(mass.sum(axis=1)).ravel()
    total = weights.sum()
    centre, first = weights @ motion.places / total, weights @ initial / total
    moments = (mass @ (motion.places - centre)).T @ (initial - first)
    left, _, right = np.linalg.svd(moments)
    sign = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    return centre, (left * sign) @ right
