"""The structural model as data: what a bulk-data file says, with node numbers turned into rows.

Nothing here computes; `structure.py` assembles it.  Coordinates are structural axes, SI units.
Every ``nodes`` array holds row indices into ``coordinates``, never file identifiers; properties
and materials are looked up by their file identifier.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray


@dataclass(frozen=True, slots=True)
class Material:
    """Isotropic elastic material (MAT1)."""

    identifier: int
    young_modulus: float  #: E [Pa]
    shear_modulus: float  #: G [Pa]
    poisson_ratio: float
    density: float  #: [kg/m3]


@dataclass(frozen=True, slots=True)
class ShellProperty:
    """Homogeneous shell section (PSHELL)."""

    identifier: int
    material: int
    thickness: float  #: [m]
    nonstructural_mass: float = 0.0  #: [kg/m2]


@dataclass(frozen=True, slots=True)
class BeamProperty:
    """Prismatic beam section (PBAR, PBARL) about its own centroid and principal element axes.

    Element x runs along the beam, the x-y plane holds the orientation vector.  ``inertia_1`` is
    the second moment for bending in the x-y plane (about z), ``inertia_2`` for the x-z plane.
    """

    identifier: int
    material: int
    area: float  #: [m2]
    inertia_1: float  #: [m4]
    inertia_2: float  #: [m4]
    torsion_constant: float  #: J [m4]
    stress_points: Array  #: (4, 2) y and z of the stress points C, D, E, F [m]
    torsion_radius: float = 0.0  #: torsional shear stress is torque * radius / J [m]
    shear_factor_1: float = 0.0  #: K1; 0 means no shear flexibility in the x-y plane
    shear_factor_2: float = 0.0  #: K2
    nonstructural_mass: float = 0.0  #: [kg/m]
    shape: str = ""  #: PBARL cross-section type the figures come from; empty for PBAR
    dimensions: tuple[float, ...] = ()  #: DIM1, DIM2, ... of that type [m]


@dataclass(frozen=True, slots=True)
class Shells:
    """Quadrilaterals (m, 4) or triangles (m, 3)."""

    identifiers: IntArray  #: (m,)
    nodes: IntArray  #: (m, 3) or (m, 4) node rows, counter-clockwise about the shell normal
    properties: IntArray  #: (m,) property identifiers


@dataclass(frozen=True, slots=True)
class Beams:
    """Two-node beams whose ends may be offset from their nodes."""

    identifiers: IntArray  #: (m,)
    nodes: IntArray  #: (m, 2)
    properties: IntArray  #: (m,)
    orientations: Array  #: (m, 3) vector in the element x-y plane
    offsets: Array  #: (m, 2, 3) from node to beam end, structural axes [m]


@dataclass(frozen=True, slots=True)
class PointMasses:
    """Rigidly attached lumped masses (CONM2)."""

    identifiers: IntArray  #: (m,)
    nodes: IntArray  #: (m,)
    masses: Array  #: (m,) [kg]
    offsets: Array  #: (m, 3) from the node to the mass [m]
    inertias: Array  #: (m, 3, 3) tensor about the mass's own centre, +integral(r2 I - r r') [kg m2]


@dataclass(frozen=True, slots=True)
class RigidBody:
    """Six freedoms of each dependent node follow one node as a rigid body (RBE2, 123456)."""

    identifier: int
    independent: int
    dependents: IntArray


@dataclass(frozen=True, slots=True)
class Interpolation:
    """One node follows the weighted mean motion of others (RBE3, reference 123456, others 123)."""

    identifier: int
    reference: int
    nodes: IntArray
    weights: Array


@dataclass(frozen=True, slots=True)
class FiniteElementModel:
    """Everything a bulk-data file says about an unsupported structure."""

    node_identifiers: IntArray  #: (n,) ascending
    coordinates: Array  #: (n, 3) [m]
    materials: Mapping[int, Material]
    shell_properties: Mapping[int, ShellProperty]
    beam_properties: Mapping[int, BeamProperty]
    quads: Shells
    triangles: Shells
    beams: Beams
    point_masses: PointMasses
    rigid_bodies: tuple[RigidBody, ...] = ()
    interpolations: tuple[Interpolation, ...] = ()

    @property
    def node_count(self) -> int:
        """Number of nodes."""
        return len(self.node_identifiers)

    @property
    def element_identifiers(self) -> IntArray:
        """Identifiers of all stressed elements in the solver's element order.

        Quadrilaterals first, then triangles, then beams; every per-element array of the solver
        has this order.
        """
        return np.concatenate(
            [self.quads.identifiers, self.triangles.identifiers, self.beams.identifiers]
        )

    @property
    def element_properties(self) -> IntArray:
        """Property identifier of every stressed element, same order."""
        return np.concatenate(
            [self.quads.properties, self.triangles.properties, self.beams.properties]
        )
