"""Energy and momentum of a motion, and what loads and gravity did to them."""

from dataclasses import dataclass, field

import numpy as np

from solver.arrays import Array
from solver.nonlinear.midpoint import Motion
from solver.nonlinear.structure import NonlinearStructure


def kinetic_energy(structure: NonlinearStructure, motion: Motion) -> float:
    """Of mass points and rotary bodies [J]."""
    points = np.vdot(motion.velocities, structure.points.mass @ motion.velocities)
    bodies = np.einsum("ki,kij,kj->", motion.rates, structure.rotary.inertia, motion.rates)
    return 0.5 * float(points + bodies)


def momenta(structure: NonlinearStructure, motion: Motion) -> Array:
    """Momentum and angular momentum about the origin (6,) [N s, N m s]."""
    points = structure.points.mass @ motion.velocities
    spins = structure.rotary.momentum(motion.at.rotations, motion.rates)
    angular = np.cross(motion.places, points).sum(axis=0) + spins.sum(axis=0)
    return np.concatenate([points.sum(axis=0), angular])


@dataclass(frozen=True, slots=True)
class Account:
    """Sums since the start of a run."""

    load_work: float = 0.0  #: of applied loads [J]
    gravity_work: float = 0.0  #: [J]
    elastic_work: float = 0.0  #: of the elements' forces, damping included [J]
    damping_work: float = 0.0  #: lost to the mass-proportional damping [J]
    impulse: Array = field(default_factory=lambda: np.zeros(6))  #: of loads and gravity

    def values(self) -> Array:
        """All sums in one array (10,)."""
        works = [self.load_work, self.gravity_work, self.elastic_work, self.damping_work]
        return np.concatenate([works, self.impulse])

    @classmethod
    def of(cls, values: Array) -> "Account":
        """Undo `values`."""
        loads, gravity, elastic, damping = values[:4].tolist()
        return cls(loads, gravity, elastic, damping, values[4:].copy())
