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

#: Vectors of the basis that are worked on at once.
_TOGETHER = 64


def projected_inertia(inertia: "Inertia", basis: Array) -> tuple[Array, Array]:
    """Mass (m, m) and the twelve rate operators (12, m, m) in ``basis`` (n, m).

    The operators stand in the order of `RigidMotion.rate_coefficients`: gyroscopic 3 (on the
    velocity), Euler 3 and centrifugal 6 (on the displacement).
    """
    size = basis.shape[1]
    products = _point_products(inertia, basis)
    rotation = np.asarray(inertia.rotary_interpolation @ basis).reshape(-1, 3, size)
    flat, rotary = rotation.reshape(3 * len(rotation), size), inertia.rotary

    def operator(direction: Array, bodies: Array) -> Array:
        total: Array = np.einsum("ab,abij->ij", direction, products)
        for first in range(0, size, _TOGETHER):
            part = slice(first, first + _TOGETHER)
            moments = np.matmul(bodies, rotation[:, :, part])
            total[:, part] += flat.T @ moments.reshape(len(flat), moments.shape[2])
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


def _point_products(inertia: "Inertia", basis: Array) -> Array:
    """Products ``Y_a' m Y_b`` (3, 3, m, m) of the points' motion in every two directions.

    Some columns at a time: there are several points at a node, and the motion of all of them in
    the whole basis would take more memory than the basis does.
    """
    size = basis.shape[1]
    freedoms = np.unique(inertia.interpolation.indices)
    moving = inertia.interpolation
    if len(freedoms) < len(basis) // 2:  # the mass of a tank is at few nodes
        moving, basis = moving[:, freedoms], basis[freedoms]
    directions = [moving[axis::3] for axis in range(3)]
    products = np.empty((3, 3, size, size))
    for first in range(0, size, _TOGETHER):
        part = slice(first, first + _TOGETHER)
        for b in range(3):
            weighted = inertia.scalar_mass @ (directions[b] @ basis[:, part])
            for a in range(b + 1):
                products[a, b, :, part] = basis.T @ (directions[a].T @ weighted)
    for b in range(3):
        for a in range(b):
            products[b, a] = products[a, b].T
    return products
