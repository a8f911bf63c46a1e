"""True tangent stiffness, element by element from differences of the internal forces.

The elements know their nodes only through positions and turns, so that every element may be given
nodes of its own; all elements are then disturbed in the same freedom at once.  Rows are forces and
moments on nodes, columns their displacements and spins.  The matrix is not symmetric away from
equilibrium, as spins do not commute.
"""

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array, csc_array

from solver.arrays import Array
from solver.frames import rotation_matrix
from solver.nonlinear.configuration import Configuration
from solver.nonlinear.elements import CorotationalElements, element_products
from solver.nonlinear.rotations import exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure

#: Disturbance of a rotation [rad]; of a displacement, the same share of an element's extent.
_DISTURBANCE = 1e-6


def tangent_stiffness(
    elements: CorotationalElements,
    at: Configuration,
    own_axes: bool = False,
    two_sided: bool = False,
) -> csc_array:
    """Assemble the tangent (6 n, 6 n) of `CorotationalElements.static_loads` [N/m, N, N m].

    Parameters
    ----------
    own_axes : bool
        Forces and displacements of every node in axes that have turned with it, instead of
        inertial ones.
    two_sided : bool
        Differences to both sides, right to about 1e-9 instead of 1e-6, at twice the cost.
    """
    rows, columns, values = [], [], []
    for index, group in enumerate(elements.groups):
        count, width = group.nodes.shape
        if count == 0:
            continue
        matrices = _element_tangents(elements, index, at, two_sided)
        if own_axes:
            turns = np.repeat(at.rotations[group.nodes], 2, axis=1)
            matrices = _turned_back(matrices.reshape(count, 2 * width, 3, 2 * width, 3), turns)
        freedoms = (6 * group.nodes[:, :, None] + np.arange(6)).reshape(count, 6 * width)
        rows.append(np.repeat(freedoms, 6 * width, axis=1).ravel())
        columns.append(np.tile(freedoms, (1, 6 * width)).ravel())
        values.append(matrices.ravel())
    indices = (np.concatenate(rows), np.concatenate(columns))
    size = 6 * len(at.positions)
    return csc_array(coo_array((np.concatenate(values), indices), shape=(size, size)))


def free_tangent(structure: NonlinearStructure, at: Configuration) -> csc_array:
    """Tangent (6 nf, 6 nf) of the free nodes' loads, each in its own axes; symmetric part.

    Left out is what the turning of the constraints' arms adds, forces on dependent nodes times
    these arms.
    """
    transformation = structure.constraints.transfer(at, structure.free_nodes)
    everywhere = tangent_stiffness(structure.elements, at, own_axes=True)
    tangent = csc_array(transformation.T @ everywhere @ transformation)
    return csc_array(0.5 * (tangent + tangent.T))


def _element_tangents(
    elements: CorotationalElements, index: int, at: Configuration, two_sided: bool
) -> Array:
    """Tangents (m, 6 k, 6 k) of one group of elements."""
    group = elements.groups[index]
    count, width = group.nodes.shape
    own = replace(group, nodes=np.arange(count * width, dtype=np.int64).reshape(count, width))
    positions, rotations = at.positions[group.nodes.ravel()], at.rotations[group.nodes.ravel()]
    spread = np.ptp(positions.reshape(count, width, 3), axis=1).max(axis=1)
    reach = _DISTURBANCE * np.repeat(spread, width)

    def loads(moved: Configuration) -> Array:
        deformations = own.deformations(moved)
        forces = element_products(group.stiffness, deformations)
        out = np.zeros((count * width, 6))
        own.add_loads(moved, deformations, forces, out)
        return out.reshape(count, 6 * width)

    rest = loads(Configuration(positions, rotations))
    tangents = np.empty((count, 6 * width, 6 * width))
    for column in range(6 * width):
        size = reach[::width, None] if column % 6 < 3 else _DISTURBANCE
        ahead = loads(_disturbed(positions, rotations, column, width, reach, 1.0))
        if two_sided:
            behind = loads(_disturbed(positions, rotations, column, width, reach, -1.0))
            tangents[:, :, column] = (ahead - behind) / (2.0 * size)
        else:
            tangents[:, :, column] = (ahead - rest) / size
    return tangents


def _disturbed(
    positions: Array, rotations: Array, column: int, width: int, reach: Array, sign: float
) -> Configuration:
    """Nodes with one freedom of every element disturbed."""
    corner, component = divmod(column, 6)
    chosen = slice(corner, None, width)
    if component < 3:
        moved = positions.copy()
        moved[chosen, component] += sign * reach[chosen]
        return Configuration(moved, rotations)
    vector = np.zeros((1, 3))
    vector[0, component - 3] = sign * _DISTURBANCE
    turned = rotations.copy()
    turned[chosen] = rotation_matrix(exponential_quaternions(vector))[0] @ rotations[chosen]
    return Configuration(positions, turned)


def _turned_back(matrices: Array, turns: Array) -> Array:
    """Blocks (m, b, 3, b, 3) turned into the axes of ``turns`` (m, b, 3, 3) on both sides."""
    half = np.einsum("mbki,mbkcl->mbicl", turns, matrices)
    back: Array = np.einsum("mbicl,mclj->mbicj", half, turns)
    return back
