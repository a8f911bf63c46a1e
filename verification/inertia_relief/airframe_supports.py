"""A whole airframe at one moment of a landing, held at one node or another.

The node takes no reaction as long as the loads balance the motion: the stress is then that of
inertia relief wherever it is held.  Leave a term of the motion out, and the support replaces it.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, IntArray
from solver.fe.structure import Structure
from solver.inertia_relief.factor import factorise
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.loads import LandingLoads, applied_shapes
from solver.inertia_relief.static import inertia_relief
from verification.inertia_relief.omitted_terms import CENTRIFUGAL, EULER

#: Inertia loads of the frame's acceleration less gravity.
ACCELERATION = slice(0, 3)


def node_freedoms(structure: Structure, place: Array) -> IntArray:
    """Six freedoms (6,) of the unconstrained node nearest to ``place`` (3,) [m]."""
    nodes, counts = np.unique(structure.free // 6, return_counts=True)
    whole = nodes[counts == 6]
    distance = np.linalg.norm(structure.model.coordinates[whole] - place, axis=1)
    node = whole[np.argmin(distance)]
    first = int(np.searchsorted(structure.free, 6 * node))
    return np.arange(first, first + 6)


@dataclass(frozen=True, slots=True)
class HeldStress:
    """Static stress of the airframe at one moment, relative to inertia relief."""

    name: str
    difference: float  #: largest of any element, relative to the largest stress
    largest: float  #: largest stress over that of inertia relief


@dataclass(frozen=True, slots=True)
class SupportStudy:
    """One moment of a landing on several supports, complete and with terms left out."""

    time: float  #: [s]
    supports: tuple[HeldStress, ...]  #: complete
    omissions: tuple[HeldStress, ...]  #: held at the node nearest to the centre of gravity


def support_study(airframe: Airframe, factors: Array, loads: LandingLoads) -> SupportStudy:
    """Solve the moment of the largest angular acceleration on supports far apart."""
    structure, recovery = airframe.structure, airframe.recovery
    body = free_body(structure, airframe.inertia(factors))
    sample = int(np.argmax(np.linalg.norm(loads.motion.rate_derivative, axis=1)))
    applied = applied_shapes(airframe) @ loads.applied_amplitudes()[sample]
    shapes = body.inertia.rigid_load_shapes(loads.motion.origin)
    amplitudes = loads.motion.inertia_amplitudes()[sample]
    rhs = applied + shapes @ amplitudes

    def stress(displacement: Array) -> Array:
        u = displacement[:, None]
        found: Array = recovery.von_mises(recovery.shell_operator @ u, recovery.beam_operator @ u)[
            :, 0
        ]
        return found

    exact = stress(inertia_relief(body).displacement(rhs))

    def compared(name: str, found: Array) -> HeldStress:
        top = exact.max()
        return HeldStress(name, float(np.abs(found - exact).max() / top), float(found.max() / top))

    coordinates = structure.model.coordinates
    places = {
        "node nearest to the centre of gravity": body.centre_of_gravity,
        "node at the wing tip": coordinates[np.argmax(coordinates[:, 1])],
        "node at the tail": coordinates[np.argmax(coordinates[:, 0])],
    }
    supports: list[HeldStress] = []
    omissions: list[HeldStress] = []
    for name, place in places.items():
        support = node_freedoms(structure, place)
        held = _Held(body, support)
        supports.append(compared(name, stress(held.displacement(rhs))))
        if omissions:
            continue
        for term, columns in (
            ("M a, the acceleration", ACCELERATION),
            ("M W' r, Euler", EULER),
            ("M W W r and w × J w, centrifugal", CENTRIFUGAL),
        ):
            partial = rhs - shapes[:, columns] @ amplitudes[columns]
            omissions.append(compared(term, stress(held.displacement(partial))))
    return SupportStudy(float(loads.time[sample]), tuple(supports), tuple(omissions))


class _Held:
    """Static solver of a body with six freedoms held, without any relief."""

    def __init__(self, body: FreeBody, support: IntArray) -> None:
        self._free = np.setdiff1d(np.arange(body.stiffness.shape[0]), support)
        self._factor = factorise(body.stiffness[self._free][:, self._free])

    def displacement(self, loads: Array) -> Array:
        solution = np.zeros_like(loads)
        solution[self._free] = self._factor.solve(np.ascontiguousarray(loads[self._free]))
        return solution
