"""Where all nodes of a structure are, and how they have turned since the beginning."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.frames import rotation_matrix
from solver.nonlinear.rotations import composed


@dataclass(frozen=True, slots=True)
class Configuration:
    """Placed nodes, dependent ones included, in inertial axes."""

    positions: Array  #: (n, 3) [m]
    rotations: Array  #: (n, 3, 3) turn of every node since the beginning


@dataclass(frozen=True, slots=True)
class Pose:
    """Positions and turns of all nodes as the state of motion keeps them.

    Rows of dependent nodes are without meaning until constraints have placed them.
    """

    positions: Array  #: (n, 3) [m]
    quaternions: Array  #: (n, 4) unit, turn of every node since the beginning

    def moved(self, translations: Array, turns: Array) -> "Pose":
        """Pose after ``translations`` (n, 3) [m] and further turns by unit quaternions (n, 4)."""
        return Pose(self.positions + translations, composed(turns, self.quaternions))

    def rigidly_moved(self, turn: Array, translation: Array) -> "Pose":
        """Pose after a turn of all by a unit quaternion (4,) about the origin, and a shift."""
        matrix = rotation_matrix(turn)
        turns = np.broadcast_to(turn, self.quaternions.shape)
        return Pose(self.positions @ matrix.T + translation, composed(turns, self.quaternions))

    def rotations(self) -> Array:
        """Rotation matrices (n, 3, 3)."""
        return rotation_matrix(self.quaternions)


def initial_pose(coordinates: Array) -> Pose:
    """Pose of nodes that have not moved from ``coordinates`` (n, 3) [m]."""
    quaternions = np.zeros((len(coordinates), 4))
    quaternions[:, 0] = 1.0
    return Pose(np.array(coordinates, dtype=np.float64), quaternions)
