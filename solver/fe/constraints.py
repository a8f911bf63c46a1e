"""Rigid bodies (RBE2) and interpolations (RBE3) as one map from free to all freedoms.

Each constraint states the freedoms of dependent nodes as a linear function of other nodes'
freedoms.  Chains (a rigid body on the reference of an interpolation, and so on) are resolved by
putting the constraints in order; loops and nodes held twice are refused.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.model import FiniteElementModel, Interpolation, RigidBody
from solver.frames import skew


@dataclass(frozen=True, slots=True)
class _Dependence:
    """Freedoms of one node (6, 6 k) from the freedoms of the k nodes it follows."""

    constraint: int
    node: int
    leaders: IntArray
    coefficients: Array


def constraint_transformation(model: FiniteElementModel) -> tuple[csr_array, IntArray]:
    """Map from free freedoms to all freedoms of all nodes.

    Returns
    -------
    transformation : (6 n, n_free) sparse array
        ``u_all = T u``; rows node by node, ux uy uz rx ry rz.
    free : (n_free,) array
        Rows of ``u_all`` that are the free freedoms, ascending.

    Raises
    ------
    ModelError
        A node is dependent twice, constraints form a loop, or the nodes of an interpolation
        lie on a line and cannot say how the reference turns; names the constraints.
    """
    dependences = _dependences(model)
    by_node: dict[int, _Dependence] = {}
    for dependence in dependences:
        other = by_node.get(dependence.node)
        if other is not None:
            raise ModelError(
                f"node {model.node_identifiers[dependence.node]} is dependent in constraints "
                f"{other.constraint} and {dependence.constraint}"
            )
        by_node[dependence.node] = dependence
    count = 6 * model.node_count
    dependent = np.zeros(count, dtype=bool)
    for node in by_node:
        dependent[6 * node : 6 * node + 6] = True
    free = np.flatnonzero(~dependent)

    step = _one_step(by_node, free, count)
    transformation = step
    for _ in range(_longest_chain(by_node, model)):
        transformation = step @ transformation
    return csr_array(transformation[:, free]), free


def _dependences(model: FiniteElementModel) -> list[_Dependence]:
    found: list[_Dependence] = []
    for body in model.rigid_bodies:
        found += _rigid(body, model.coordinates)
    for interpolation in model.interpolations:
        found.append(_weighted_mean(interpolation, model.coordinates))
    return found


def _rigid(body: RigidBody, coordinates: Array) -> list[_Dependence]:
    """u_d = u_i + theta_i x (x_d - x_i), theta_d = theta_i."""
    leader = np.array([body.independent])
    rows = []
    for node in body.dependents.tolist():
        coefficients = np.eye(6)
        coefficients[:3, 3:] = -skew(coordinates[node] - coordinates[body.independent])
        rows.append(_Dependence(body.identifier, node, leader, coefficients))
    return rows


def _weighted_mean(interpolation: Interpolation, coordinates: Array) -> _Dependence:
    """Least-squares rigid motion of the weighted nodes, carried to the reference.

    With x_c the weighted centre, r = x - x_c and J = sum w (r.r I - r r'): the motion is
    u_c = sum w u / sum w, theta = J^-1 sum w r x u (the normal equations of a rigid motion).
    """
    points = coordinates[interpolation.nodes]
    weights = np.asarray(interpolation.weights, dtype=float)
    if len(points) == 0 or not np.all(weights >= 0.0) or not weights.sum() > 0.0:
        raise ModelError(
            f"interpolation {interpolation.identifier} needs nodes with positive weights"
        )
    weights = weights / weights.sum()
    centre = weights @ points
    levers = points - centre
    second = np.einsum("k,ki,kj->ij", weights, levers, levers)
    inertia = np.trace(second) * np.eye(3) - second
    if np.linalg.cond(inertia) > 1e10:
        raise ModelError(
            f"interpolation {interpolation.identifier} has its nodes on a line or at one point; "
            "their motion does not determine the rotation of its reference"
        )
    rotation = np.linalg.solve(inertia, np.hstack(list(weights[:, None, None] * skew(levers))))
    lever = coordinates[interpolation.reference] - centre
    translation = np.hstack(list(weights[:, None, None] * np.eye(3))) - skew(lever) @ rotation
    coefficients = np.zeros((6, 6 * len(points)))
    columns = (6 * np.arange(len(points))[:, None] + np.arange(3)).ravel()
    coefficients[:3, columns] = translation
    coefficients[3:, columns] = rotation
    return _Dependence(
        interpolation.identifier, interpolation.reference, interpolation.nodes, coefficients
    )


def _one_step(by_node: dict[int, _Dependence], free: IntArray, count: int) -> csr_array:
    """Identity on free freedoms, the constraints' own equations on dependent ones."""
    rows, columns, values = [free], [free], [np.ones(len(free))]
    for node, dependence in by_node.items():
        shape = dependence.coefficients.shape
        leading = (6 * dependence.leaders[:, None] + np.arange(6)).ravel()
        rows.append(np.repeat(6 * node + np.arange(6), shape[1]))
        columns.append(np.tile(leading, shape[0]))
        values.append(dependence.coefficients.ravel())
    entries = np.concatenate(values)
    kept = entries != 0.0
    at = (np.concatenate(rows)[kept], np.concatenate(columns)[kept])
    return csr_array(coo_array((entries[kept], at), shape=(count, count)))


def _longest_chain(by_node: dict[int, _Dependence], model: FiniteElementModel) -> int:
    """Most constraints that follow one another beyond the first."""
    depth: dict[int, int] = {}

    def visit(node: int, path: tuple[int, ...]) -> int:
        if node not in by_node:
            return -1
        if node in path:
            loop = sorted({by_node[at].constraint for at in path[path.index(node) :]})
            raise ModelError(
                f"constraints {loop} depend on one another in a loop through node "
                f"{model.node_identifiers[node]}"
            )
        if node not in depth:
            leaders = by_node[node].leaders.tolist()
            depth[node] = 1 + max(visit(leader, (*path, node)) for leader in leaders)
        return depth[node]

    return max([0, *(visit(node, ()) for node in by_node)])
