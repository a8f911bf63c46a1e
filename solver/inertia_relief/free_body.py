"""A free structure at one loading: stiffness, inertia, rigid modes and the mean-axis frame.

The elastic displacement lives in the mean-axis (Tisserand) frame: it is M-orthogonal to the six
rigid modes.  The stiffness is singular by exactly these modes, and nothing supports the structure.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from solver.arrays import Array

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia
    from solver.fe.structure import Structure


@dataclass(frozen=True, slots=True)
class FreeBody:
    """Matrices of an unsupported structure with a given inertia."""

    stiffness: Any  #: csc (n, n), symmetric, singular by the rigid modes
    mass: Any  #: csc (n, n)
    inertia: "Inertia"
    centre_of_gravity: Array  #: (3,) [m]
    total_mass: float  #: [kg]
    gyration_radius: float  #: sqrt(trace(I) / (2 m)), scales moments against forces [m]
    rigid_modes: Array  #: (n, 6) unit translations, unit rotations about the centre of gravity
    rigid_momentum: Array  #: (n, 6) M Phi_R
    rigid_mass: Array  #: (6, 6) Phi_R' M Phi_R

    def self_equilibrated(self, loads: Array) -> Array:
        """Subtract the d'Alembert loads of rigid acceleration, ``P - M Phi m^-1 Phi' P``.

        Equation (10) of Lee et al.; ``loads`` is (n,) or (n, k).
        """
        resultant = self.rigid_modes.T @ loads
        balanced: Array = loads - self.rigid_momentum @ np.linalg.solve(self.rigid_mass, resultant)
        return balanced

    def mean_axis(self, displacement: Array) -> Array:
        """Remove the rigid content, so that the displacement is M-orthogonal to rigid modes."""
        momentum = self.rigid_momentum.T @ displacement
        elastic: Array = displacement - self.rigid_modes @ np.linalg.solve(
            self.rigid_mass, momentum
        )
        return elastic


def free_body(structure: "Structure", inertia: "Inertia | None" = None) -> FreeBody:
    """Assemble the free body of ``structure`` with ``inertia`` (its own by default)."""
    inertia = structure.inertia if inertia is None else inertia
    mass = inertia.mass_matrix()
    properties = inertia.rigid_body_properties()
    rigid_modes = structure.rigid_modes(properties.centre_of_gravity)
    momentum = mass @ rigid_modes
    return FreeBody(
        stiffness=structure.stiffness,
        mass=mass,
        inertia=inertia,
        centre_of_gravity=properties.centre_of_gravity,
        total_mass=float(properties.mass),
        gyration_radius=float(np.sqrt(np.trace(properties.inertia) / (2 * properties.mass))),
        rigid_modes=rigid_modes,
        rigid_momentum=momentum,
        rigid_mass=rigid_modes.T @ momentum,
    )
