"""True tangent stiffness, element by element from differences of the internal forces.

The elements know their nodes only through positions and turns, so that every element may be given
nodes of its own; all elements are then disturbed in the same freedom at once.  Rows are forces and
moments on nodes, columns their displacements and spins in inertial axes.  The matrix is not
symmetric away from equilibrium, as spins do not commute.
"""

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array, csc_array

from solver.arrays import Array, IntArray
from solver.frames import rotation_matrix
from solver.nonlinear.configuration import Configuration
from solver.nonlinear.elements import CorotationalElements
from solver.nonlinear.rotations import exponential_quaternions

#: Disturbance of a rotation [rad]; of a displacement, the same share of the structure's elements.
_DISTURBANCE = 1e-6


def tangent_stiffness(
    elements: CorotationalElements, at: Configuration, node_count: int
) -> csc_array:
    """Assemble the tangent (6 n, 6 n) of `CorotationalElements.static_loads`, without constraints.

    [N/m, N, N m]
    """
    rows, columns, values = [], [], []
    for index, group in enumerate(elements.groups):
        count, width = group.nodes.shape
        if count == 0:
            continue
        matrices = _element_tangents(elements, index, at)
        freedoms = (6 * group.nodes[:, :, None] + np.arange(6)).reshape(count, 6 * width)
        rows.append(np.repeat(freedoms, 6 * width, axis=1).ravel())
        columns.append(np.tile(freedoms, (1, 6 * width)).ravel())
        values.append(matrices.ravel())
    indices = (np.concatenate(rows), np.concatenate(columns))
    size = 6 * node_count
    return csc_array(coo_array((np.concatenate(values), indices), shape=(size, size)))


def _element_tangents(elements: CorotationalElements, index: int, at: Configuration) -> Array:
    """Tangents (m, 6 k, 6 k) of one group of elements."""
    group = elements.groups[index]
    count, width = group.nodes.shape
    own = replace(group, nodes=np.arange(count * width, dtype=np.int64).reshape(count, width))
    positions, rotations = at.positions[group.nodes.ravel()], at.rotations[group.nodes.ravel()]
    spread = np.ptp(positions.reshape(count, width, 3), axis=1).max(axis=1)
    reach = _DISTURBANCE * np.repeat(spread, width)
    tangents = np.empty((count, 6 * width, 6 * width))
    for column in range(6 * width):
        sides = []
        for sign in (1.0, -1.0):
            moved = _disturbed(positions, rotations, column, width, sign, reach)
            deformations = own.deformations(moved)
            forces = _forces(group.stiffness, deformations)
            loads = np.zeros((count * width, 6))
            own.add_loads(moved, deformations, forces, loads)
            sides.append(loads.reshape(count, 6 * width))
        size = reach[::width, None] if column % 6 < 3 else _DISTURBANCE
        tangents[:, :, column] = (sides[0] - sides[1]) / (2.0 * size)
    return tangents


def _disturbed(
    positions: Array, rotations: Array, column: int, width: int, sign: float, reach: Array
) -> Configuration:
    """Nodes with one freedom of every element disturbed."""
    corner, component = divmod(column, 6)
    chosen: IntArray = np.arange(corner, len(positions), width)
    if component < 3:
        moved = positions.copy()
        moved[chosen, component] += sign * reach[chosen]
        return Configuration(moved, rotations)
    vector = np.zeros((1, 3))
    vector[0, component - 3] = sign * _DISTURBANCE
    turned = rotations.copy()
    turned[chosen] = rotation_matrix(exponential_quaternions(vector))[0] @ rotations[chosen]
    return Configuration(positions, turned)


def _forces(stiffness: Array, deformations: Array) -> Array:
    forces: Array = np.einsum("mij,mj->mi", stiffness, deformations)
    return forces
