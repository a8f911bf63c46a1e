"""Rigid bodies (RBE2) and interpolations (RBE3) at finite rotation.

A rigid body's nodes stand at turned arms from their leader.  The reference of an interpolation
stands at a turned arm from the weighted centre of its leaders, and turns by the rotation R that
fits their initial levers r to the present ones y best, ``sum w (R r) x y = 0`` (weighted polar
decomposition).  To first order this is the least-squares motion of the linear model, and a rigid
motion of any size is followed exactly.  Forces go back by the exact gradient: nothing is neglected.
"""

from dataclasses import dataclass

import numba
import numpy as np
from scipy.sparse import coo_array, csr_array

from solver.arrays import Array, IntArray
from solver.fe.model import FiniteElementModel, Interpolation
from solver.nonlinear.configuration import Configuration, Pose
from solver.nonlinear.rotations import solved, turn_further

#: Iterations of the polar decomposition; it converges quadratically from a leader's own turn.
_MOST_ITERATIONS = 50
_CONVERGED = 1e-14  #: change of the turn [rad]


@dataclass(frozen=True, slots=True)
class FiniteConstraints:
    """Constraints in an order in which leaders are placed before those that follow them."""

    nodes: IntArray  #: (c,) dependent nodes
    is_rigid: IntArray  #: (c,) 1: rigid body on one leader, 0: interpolation
    arms: Array  #: (c, 3) from leader or weighted centre to the node, initial axes [m]
    starts: IntArray  #: (c + 1,) first leader of each
    leaders: IntArray  #: (l,) nodes
    weights: Array  #: (l,) sum 1 for each constraint
    levers: Array  #: (l, 3) from the weighted centre to each leader, initial axes [m]

    def placed(self, pose: Pose) -> Configuration:
        """Place the dependent nodes of a pose."""
        positions, rotations = pose.positions.copy(), pose.rotations()
        _place(
            self.nodes,
            self.is_rigid,
            self.arms,
            self.starts,
            self.leaders,
            self.weights,
            self.levers,
            positions,
            rotations,
        )
        return Configuration(positions, rotations)

    def carry_back(self, at: Configuration, loads: Array) -> None:
        """Move loads (n, 6) from dependent nodes to their leaders, in place [N, N m]."""
        _carry_back(
            self.nodes,
            self.is_rigid,
            self.arms,
            self.starts,
            self.leaders,
            self.weights,
            self.levers,
            at.positions,
            at.rotations,
            loads,
        )

    def transfer(self, at: Configuration, free_nodes: IntArray) -> csr_array:
        """Motion (6 n, 6 nf) of all nodes from that of the free ones, to first order.

        Displacements and spins of every node stand in axes that have turned with it.
        """
        count = len(at.positions)
        blocks = np.zeros((len(self.leaders), 6, 6))
        _linearised(
            self.nodes,
            self.is_rigid,
            self.arms,
            self.starts,
            self.leaders,
            self.weights,
            self.levers,
            at.positions,
            at.rotations,
            blocks,
        )
        nodes = np.repeat(self.nodes, np.diff(self.starts))
        halves = (len(self.leaders), 2, 3, 2, 3)
        turned = np.einsum(
            "kji,kajbl,klm->kaibm",
            at.rotations[nodes],
            blocks.reshape(halves),
            at.rotations[self.leaders],
        ).reshape(-1, 6, 6)
        free = (6 * free_nodes[:, None] + np.arange(6)).ravel()
        rows = np.repeat(6 * nodes[:, None] + np.arange(6), 6, axis=1).ravel()
        columns = np.tile(6 * self.leaders[:, None] + np.arange(6), (1, 6)).ravel()
        entries = np.concatenate([np.ones(len(free)), turned.ravel()])
        indices = (np.concatenate([free, rows]), np.concatenate([free, columns]))
        step = csr_array(coo_array((entries, indices), shape=(6 * count, 6 * count)))
        whole = step
        # leaders that are dependent themselves take another step for every link of their chain
        for _ in range(np.isin(self.leaders, self.nodes).sum()):
            whole = csr_array(step @ whole)
        return csr_array(whole[:, free])


def finite_constraints(model: FiniteElementModel) -> FiniteConstraints:
    """Constraints of a model that `solver.fe.constraints.constraint_transformation` accepts."""
    entries: dict[int, tuple[bool, Array, IntArray, Array, Array]] = {}
    for body in model.rigid_bodies:
        for node in body.dependents.tolist():
            arm = model.coordinates[node] - model.coordinates[body.independent]
            leader = np.array([body.independent], dtype=np.int64)
            entries[node] = (True, arm, leader, np.ones(1), np.zeros((1, 3)))
    for interpolation in model.interpolations:
        entries[interpolation.reference] = _interpolation(interpolation, model.coordinates)
    ordered: list[int] = []
    placed: set[int] = set()

    def visit(node: int) -> None:
        if node in entries and node not in placed:
            placed.add(node)
            for leader in entries[node][2].tolist():
                visit(leader)
            ordered.append(node)

    for node in entries:
        visit(node)
    chosen = [entries[node] for node in ordered]
    return FiniteConstraints(
        nodes=np.array(ordered, dtype=np.int64),
        is_rigid=np.array([entry[0] for entry in chosen], dtype=np.int64),
        arms=np.array([entry[1] for entry in chosen], dtype=np.float64).reshape(-1, 3),
        starts=np.concatenate([[0], np.cumsum([len(entry[2]) for entry in chosen])]).astype(
            np.int64
        ),
        leaders=np.concatenate([np.zeros(0, np.int64), *(entry[2] for entry in chosen)]),
        weights=np.concatenate([np.zeros(0), *(entry[3] for entry in chosen)]),
        levers=np.concatenate([np.zeros((0, 3)), *(entry[4] for entry in chosen)]),
    )


def _interpolation(
    interpolation: Interpolation, coordinates: Array
) -> tuple[bool, Array, IntArray, Array, Array]:
    weights = np.asarray(interpolation.weights, dtype=np.float64)
    weights = weights / weights.sum()
    points = coordinates[interpolation.nodes]
    centre = weights @ points
    arm = coordinates[interpolation.reference] - centre
    return False, arm, np.asarray(interpolation.nodes, dtype=np.int64), weights, points - centre


@numba.njit(cache=True, error_model="numpy")
def _turned(matrix: Array, vector: Array, out: Array) -> None:
    for i in range(3):
        out[i] = matrix[i, 0] * vector[0] + matrix[i, 1] * vector[1] + matrix[i, 2] * vector[2]


@numba.njit(cache=True, error_model="numpy")
def _balance(
    leaders: IntArray,
    weights: Array,
    levers: Array,
    centre: Array,
    positions: Array,
    turn: Array,
    inertia: Array,
    excess: Array,
) -> None:
    """Matrix A = sum w (a.y I - a y') and vector sum w a x y, with a = R r."""
    lever, present = np.empty(3), np.empty(3)
    inertia[:], excess[:] = 0.0, 0.0
    for k in range(len(leaders)):
        _turned(turn, levers[k], lever)
        along = 0.0
        for i in range(3):
            present[i] = positions[leaders[k], i] - centre[i]
            along += lever[i] * present[i]
        for i in range(3):
            inertia[i, i] += weights[k] * along
            for j in range(3):
                inertia[i, j] -= weights[k] * lever[i] * present[j]
        excess[0] += weights[k] * (lever[1] * present[2] - lever[2] * present[1])
        excess[1] += weights[k] * (lever[2] * present[0] - lever[0] * present[2])
        excess[2] += weights[k] * (lever[0] * present[1] - lever[1] * present[0])


@numba.njit(cache=True, error_model="numpy")
def _centre(leaders: IntArray, weights: Array, positions: Array, centre: Array) -> None:
    centre[:] = 0.0
    for k in range(len(leaders)):
        for i in range(3):
            centre[i] += weights[k] * positions[leaders[k], i]


@numba.njit(cache=True, error_model="numpy")
def _place(
    nodes: IntArray,
    is_rigid: IntArray,
    arms: Array,
    starts: IntArray,
    leaders: IntArray,
    weights: Array,
    levers: Array,
    positions: Array,
    rotations: Array,
) -> None:
    """Put dependent nodes in place, one after another."""
    centre, arm, excess, step = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    inertia, turn = np.empty((3, 3)), np.empty((3, 3))
    for c in range(len(nodes)):
        part = slice(starts[c], starts[c + 1])
        first = leaders[starts[c]]
        turn[:] = rotations[first]
        if is_rigid[c]:
            centre[:] = positions[first]
        else:
            _centre(leaders[part], weights[part], positions, centre)
            for _ in range(_MOST_ITERATIONS):
                _balance(
                    leaders[part],
                    weights[part],
                    levers[part],
                    centre,
                    positions,
                    turn,
                    inertia,
                    excess,
                )
                solved(inertia, excess, step)
                turn_further(step, turn)
                if abs(step[0]) + abs(step[1]) + abs(step[2]) < _CONVERGED:
                    break
        _turned(turn, arms[c], arm)
        for i in range(3):
            positions[nodes[c], i] = centre[i] + arm[i]
        rotations[nodes[c]] = turn


@numba.njit(cache=True, error_model="numpy")
def _carry_back(
    nodes: IntArray,
    is_rigid: IntArray,
    arms: Array,
    starts: IntArray,
    leaders: IntArray,
    weights: Array,
    levers: Array,
    positions: Array,
    rotations: Array,
    loads: Array,
) -> None:
    """Carry loads of dependent nodes to their leaders, last placed first."""
    centre, arm, couple, share = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    inertia, excess = np.empty((3, 3)), np.empty(3)
    for c in range(len(nodes) - 1, -1, -1):
        part = slice(starts[c], starts[c + 1])
        turn = rotations[nodes[c]]
        load = loads[nodes[c]]
        _turned(turn, arms[c], arm)
        couple[0] = load[3] + arm[1] * load[2] - arm[2] * load[1]
        couple[1] = load[4] + arm[2] * load[0] - arm[0] * load[2]
        couple[2] = load[5] + arm[0] * load[1] - arm[1] * load[0]
        if is_rigid[c]:
            leader = leaders[starts[c]]
            for i in range(3):
                loads[leader, i] += load[i]
                loads[leader, 3 + i] += couple[i]
        else:
            _centre(leaders[part], weights[part], positions, centre)
            _balance(
                leaders[part],
                weights[part],
                levers[part],
                centre,
                positions,
                turn,
                inertia,
                excess,
            )
            solved(inertia, couple, share)
            for k in range(starts[c], starts[c + 1]):
                _turned(turn, levers[k], arm)
                w, at = weights[k], leaders[k]
                loads[at, 0] += w * (load[0] + share[1] * arm[2] - share[2] * arm[1])
                loads[at, 1] += w * (load[1] + share[2] * arm[0] - share[0] * arm[2])
                loads[at, 2] += w * (load[2] + share[0] * arm[1] - share[1] * arm[0])
        loads[nodes[c], :] = 0.0


@numba.njit(cache=True, error_model="numpy")
def _linearised(
    nodes: IntArray,
    is_rigid: IntArray,
    arms: Array,
    starts: IntArray,
    leaders: IntArray,
    weights: Array,
    levers: Array,
    positions: Array,
    rotations: Array,
    blocks: Array,
) -> None:
    """Motion of each dependent node from unit motions of its leaders, (l, 6, 6)."""
    centre, arm, excess = np.empty(3), np.empty(3), np.empty(3)
    couple, spin, inertia = np.empty(3), np.empty(3), np.empty((3, 3))
    for c in range(len(nodes)):
        part = slice(starts[c], starts[c + 1])
        turn = rotations[nodes[c]]
        if not is_rigid[c]:
            _centre(leaders[part], weights[part], positions, centre)
            _balance(
                leaders[part],
                weights[part],
                levers[part],
                centre,
                positions,
                turn,
                inertia,
                excess,
            )
        for k in range(starts[c], starts[c + 1]):
            for column in range(6):
                spin[:] = 0.0
                if is_rigid[c]:
                    share = 1.0
                    if column >= 3:
                        spin[column - 3] = 1.0
                elif column < 3:
                    share = weights[k]
                    _turned(turn, levers[k], arm)
                    # lever x unit displacement
                    couple[column] = 0.0
                    couple[(column + 1) % 3] = share * arm[(column + 2) % 3]
                    couple[(column + 2) % 3] = -share * arm[(column + 1) % 3]
                    solved(inertia, couple, spin)
                else:
                    continue
                _turned(turn, arms[c], arm)
                blocks[k, 0, column] = spin[1] * arm[2] - spin[2] * arm[1]
                blocks[k, 1, column] = spin[2] * arm[0] - spin[0] * arm[2]
                blocks[k, 2, column] = spin[0] * arm[1] - spin[1] * arm[0]
                if column < 3:
                    blocks[k, column, column] += share
                blocks[k, 3:, column] = spin
