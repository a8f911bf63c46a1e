"""Projection of inertia and of all its rate terms on a basis, through the mass points.

Every operator of `Inertia` is a sum over direction pairs a, b of ``D_ab Y_a' m Y_b`` with Y the
points' motion in the basis, so nine dense products serve mass, gyroscopic, Euler and centrifugal
terms together.  Rotary bodies add their own small blocks.
"""

from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array
from solver.fe.inertia import GENERATORS, RATE_PRODUCTS

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia


def projected_inertia(inertia: "Inertia", basis: Array) -> tuple[Array, Array]:
    """Mass (m, m) and the twelve rate operators (12, m, m) in ``basis`` (n, m).

    The operators stand in the order of `RigidMotion.rate_coefficients`: gyroscopic 3 (on the
    velocity), Euler 3 and centrifugal 6 (on the displacement).
    """
    size = basis.shape[1]
    motion = np.asarray(inertia.interpolation @ basis).reshape(-1, 3, size)
    products = np.empty((3, 3, size, size))
    for b in range(3):
        weighted = inertia.scalar_mass @ motion[:, b]
        for a in range(b + 1):
            products[a, b] = motion[:, a].T @ weighted
            products[b, a] = products[a, b].T
    rotation = np.asarray(inertia.rotary_interpolation @ basis).reshape(-1, 3, size)
    rotary = inertia.rotary

    def operator(direction: Array, bodies: Array) -> Array:
        points = np.einsum("ab,abij->ij", direction, products)
        moments = np.matmul(bodies, rotation).reshape(-1, size)
        total: Array = points + rotation.reshape(-1, size).T @ moments
        return total

    mass = operator(np.eye(3), rotary)
    gyroscopic = [operator(2.0 * turn, rotary @ turn + turn @ rotary) for turn in GENERATORS]
    euler = [operator(turn, rotary @ turn) for turn in GENERATORS]
    centrifugal = []
    for i, j in RATE_PRODUCTS:
        a, b = GENERATORS[i], GENERATORS[j]
        if i == j:
            centrifugal.append(operator(a @ b, a @ rotary @ b))
        else:
            centrifugal.append(operator(a @ b + b @ a, a @ rotary @ b + b @ rotary @ a))
    return (mass + mass.T) / 2, np.stack([*gyroscopic, *euler, *centrifugal])
