"""Stations of a stick model: points whose rigid motion stands for a cross-section of the airframe.

The motion of a section is the rigid motion that fits its nodes' displacements best (least squares,
equal weights); loads on the station are spread over the nodes so that they do the same work.  Both
are one matrix, which carries rigid motion exactly.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.frames import skew
from solver.gear.parameters import Gear
from solver.gear.pins import pin_load_matrix

if TYPE_CHECKING:
    from solver.fe.structure import Structure


@dataclass(frozen=True, slots=True)
class Station:
    """A node of the stick model."""

    name: str
    point: Array  #: (3,) structural axes [m]
    motion: csr_array  #: (6, n_free) translation and rotation of the section at the point
    is_fitting: bool = False  #: a gear's fitting: carries its pins' masses and no others


@dataclass(frozen=True, slots=True)
class Branch:
    """Stations in a row, each joined to the one before by a beam.

    The first belongs to another branch or is the root of all; the last takes identifying loads.
    """

    stations: tuple[str, ...]


def section_station(name: str, structure: "Structure", nodes: IntArray) -> Station:
    """Station of the section made up of ``nodes`` (k,), at their mean position.

    Raises
    ------
    ModelError
        The nodes lie on one line, or there are none.
    """
    points = structure.model.coordinates[nodes]
    if len(nodes) == 1:
        rows = 6 * int(nodes[0]) + np.arange(6)
        return Station(name, points[0], csr_array(structure.transformation[rows]))
    if len(nodes) == 0:
        raise ModelError(f"station {name} has no nodes")
    centre = points.mean(axis=0)
    levers = points - centre
    second = levers.T @ levers
    inertia = np.trace(second) * np.eye(3) - second
    if np.linalg.cond(inertia) > 1e8:
        raise ModelError(f"the nodes of station {name} lie on one line")
    coefficients = np.zeros((6, len(nodes), 3))
    coefficients[:3] = np.eye(3)[:, None, :] / len(nodes)
    coefficients[3:] = (np.linalg.inv(inertia) @ skew(levers)).transpose(1, 0, 2)
    rows = (6 * nodes[:, None] + np.arange(3)).ravel()
    return Station(
        name, centre, csr_array(coefficients.reshape(6, -1) @ structure.transformation[rows])
    )


def fitting_station(structure: "Structure", gear: Gear, pin_rows: IntArray) -> Station:
    """Station of a gear's fitting at its pivot; it follows its pins as `pin_load_matrix` says."""
    rows = (6 * pin_rows[:, None] + np.arange(6)).ravel()
    motion = pin_load_matrix(gear.pins, gear.pivot).T @ structure.transformation[rows]
    return Station(gear.name, np.asarray(gear.pivot, dtype=float), csr_array(motion), True)


def carried(motion: Array, arm: Array) -> Array:
    """Motion (6, ...) of a point at ``arm`` (3,) from the point of a rigid ``motion``."""
    moved = np.array(motion, dtype=float)
    moved[:3] -= np.tensordot(skew(arm), moved[3:], axes=1)
    return moved


def wrench_transfer(arm: Array) -> Array:
    """Matrix (6, 6) from a wrench about a point to that about one from which it lies at ``arm``."""
    transfer = np.eye(6)
    transfer[3:, :3] = skew(arm)
    return transfer
