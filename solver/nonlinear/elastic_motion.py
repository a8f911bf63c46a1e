"""What of a motion is not rigid: momenta less those of a rigid body with the same sums.

The mass-proportional damping brakes this part alone; without it in the sums, the damping has
neither force nor moment.  In the linear analysis it is the velocity in the mean-axis frame.
"""

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.nonlinear.inertia import RotaryBodies


@numba.njit(cache=True, error_model="numpy")
def _sums(places: Array, weights: Array, moments: Array, momenta: Array) -> tuple[Array, Array]:
    """Inertia tensor and angular momentum of mass points about their centre, and the centre.

    Rows of the first result: inertia (3), of the second: centre, momentum, angular momentum.
    """
    inertia, vectors = np.zeros((3, 3)), np.zeros((3, 3))
    mass = 0.0
    for p in range(len(places)):
        mass += weights[p]
        for i in range(3):
            vectors[0, i] += moments[p, i]
            vectors[1, i] += momenta[p, i]
    for i in range(3):
        vectors[0, i] /= mass
    arm, part = np.empty(3), np.empty(3)
    for p in range(len(places)):
        trace = 0.0
        for i in range(3):
            arm[i] = places[p, i] - vectors[0, i]
            part[i] = moments[p, i] - weights[p] * vectors[0, i]
            trace += arm[i] * part[i]
        for i in range(3):
            inertia[i, i] += trace
            for j in range(3):
                inertia[i, j] -= arm[i] * part[j]
        vectors[2, 0] += arm[1] * momenta[p, 2] - arm[2] * momenta[p, 1]
        vectors[2, 1] += arm[2] * momenta[p, 0] - arm[0] * momenta[p, 2]
        vectors[2, 2] += arm[0] * momenta[p, 1] - arm[1] * momenta[p, 0]
    return inertia, vectors


@numba.njit(cache=True, error_model="numpy")
def _subtract_rigid(
    weights: Array, moments: Array, velocity: Array, rate: Array, momenta: Array
) -> None:
    """Take the momenta of a rigid motion, ``velocity`` being that of the origin, in place."""
    for p in range(len(momenta)):
        x, y, z = moments[p, 0], moments[p, 1], moments[p, 2]
        momenta[p, 0] -= weights[p] * velocity[0] + rate[1] * z - rate[2] * y
        momenta[p, 1] -= weights[p] * velocity[1] + rate[2] * x - rate[0] * z
        momenta[p, 2] -= weights[p] * velocity[2] + rate[0] * y - rate[1] * x


@numba.njit(cache=True, error_model="numpy")
def _turned_inertia(nodes: IntArray, inertia: Array, rotations: Array, out: Array) -> None:
    """Inertia tensors (k, 3, 3) of rotary bodies in inertial axes."""
    half = np.empty((3, 3))
    for k in range(len(nodes)):
        turn = rotations[nodes[k]]
        for i in range(3):
            for j in range(3):
                half[i, j] = (
                    turn[i, 0] * inertia[k, 0, j]
                    + turn[i, 1] * inertia[k, 1, j]
                    + turn[i, 2] * inertia[k, 2, j]
                )
        for i in range(3):
            for j in range(3):
                out[k, i, j] = (
                    half[i, 0] * turn[j, 0] + half[i, 1] * turn[j, 1] + half[i, 2] * turn[j, 2]
                )


def turned_inertia(rotary: RotaryBodies, rotations: Array) -> Array:
    """Inertia tensors (k, 3, 3) of rotary bodies in inertial axes, nodes turned (n, 3, 3)."""
    out = np.empty_like(rotary.inertia)
    _turned_inertia(rotary.nodes, rotary.inertia, rotations, out)
    return out


def elastic_momenta(
    rotary: RotaryBodies,
    rotations: Array,
    places: Array,
    weights: Array,
    moments: Array,
    momenta: Array,
    rates: Array,
) -> tuple[Array, Array]:
    """Momenta (p, 3) and spins (k, 3) less those of the rigid motion with the same sums.

    Parameters
    ----------
    rotations : (n, 3, 3) array
    places : (p, 3) array
        Of the mass points [m].
    weights : (p,) array
        Row sums of the points' masses [kg].
    moments, momenta : (p, 3) arrays
        The points' masses times their places and times their velocities.
    rates : (k, 3) array
        Of the rotary bodies, body axes [rad/s].
    """
    spins = rotary.momentum(rotations, rates)
    bodies = turned_inertia(rotary, rotations)
    inertia, (centre, momentum, angular) = _sums(places, weights, moments, momenta)
    rate = np.linalg.solve(inertia + bodies.sum(axis=0), angular + spins.sum(axis=0))
    velocity = momentum / weights.sum() - np.cross(rate, centre)
    elastic = momenta.copy()
    _subtract_rigid(weights, moments, velocity, rate, elastic)
    return elastic, spins - bodies @ rate
