"""Torsion of a closed square box against Bredt, the case in which folds of shells decide.

Walls in shear turn in their plane by half of what their neighbours' edges turn by.  An element
that ties its rotation about the normal to the former, and neighbours that tie the same rotation
of the same nodes to the latter, work against each other where no further element lies between.
"""

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from solver.arrays import Array, BoolArray
from solver.fe.model import FiniteElementModel
from solver.fe.structure import build_structure
from verification.peers.panels import ALUMINIUM, GAUGE, SIDE, box_beam

#: Bays of the box; torsion is measured over its middle half.
BAYS = 20


def bredt_stiffness() -> float:
    """G J of the thin-walled square box, 4 A^2 G t / perimeter (R. Bredt, 1896) [N m2]."""
    return ALUMINIUM.shear_modulus * GAUGE * SIDE**3


def measured_stiffness(
    model: FiniteElementModel, fineness: int, stiffness: object | None = None
) -> float:
    """Torque over rate of twist in the middle half of a box clamped at one end [N m2].

    Parameters
    ----------
    stiffness : (n_free, n_free) sparse array, optional
        In place of the solver's; the model has no links, so that all freedoms are free.
    """
    matrix = build_structure(model).stiffness if stiffness is None else stiffness
    along = model.coordinates[:, 0]
    arms = model.coordinates[:, 1:] - SIDE / 2
    on_rim = np.isclose(np.abs(arms).max(axis=1), SIDE / 2)
    free = np.repeat(along > 1e-9, 6)
    loads = _shear_flow(model, on_rim, fineness)
    moved = np.zeros(len(free))
    moved[free] = splu(csc_matrix(matrix)[free][:, free]).solve(loads.ravel()[free])
    displacement = moved.reshape(-1, 6)
    length = BAYS * SIDE

    def twist(station: float) -> float:
        section = on_rim & np.isclose(along, station)
        y, z = arms[section].T
        turned = y * displacement[section, 2] - z * displacement[section, 1]
        return float(turned.sum() / (y * y + z * z).sum())

    rate = (twist(0.75 * length) - twist(0.25 * length)) / (0.5 * length)
    return 1.0 / rate


def _shear_flow(model: FiniteElementModel, on_rim: BoolArray, fineness: int) -> Array:
    """Lump the shear flow of a unit torque at the nodes of the free end (n, 6)."""
    loads = np.zeros((model.node_count, 6))
    end = np.flatnonzero(on_rim & np.isclose(model.coordinates[:, 0], BAYS * SIDE))
    arms = model.coordinates[end][:, 1:] - SIDE / 2
    around = end[np.argsort(np.arctan2(arms[:, 1], arms[:, 0]))]
    flow = 1.0 / (2.0 * SIDE * SIDE)
    for first, second in zip(around, np.roll(around, -1), strict=True):
        force = flow * (model.coordinates[second] - model.coordinates[first]) / 2.0
        loads[first, :3] += force
        loads[second, :3] += force
    assert len(around) == 4 * fineness
    return loads


def box(fineness: int, has_ribs: bool) -> FiniteElementModel:
    """Box of `BAYS` bays."""
    return box_beam(BAYS, fineness, has_ribs)
