"""Loading states: which tanks and bays hold how much, and what the aircraft then weighs.

Mass is affine in the fill factors: M(f) = M_empty + sum of f_j M_j, with M_j that of a full tank or
bay.  So are mass, first and second moments about the structural origin, from which the rigid-body
properties of any state follow at once.
"""

from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from solver.aircraft.definition import AircraftDefinition, MassGroup
from solver.arrays import Array
from solver.fe.inertia import Inertia, MassProperties
from solver.fe.model import PointMasses


@dataclass(frozen=True, slots=True)
class MassMoments:
    """Mass and its moments about the structural origin."""

    mass: float  #: [kg]
    first: Array  #: (3,) integral of r dm [kg m]
    second: Array  #: (3, 3) inertia tensor about the origin [kg m2]

    @classmethod
    def of(cls, inertia: Inertia) -> "MassMoments":
        """Moments of a part of the airframe."""
        return cls.of_properties(inertia.rigid_body_properties())

    @classmethod
    def of_properties(cls, body: MassProperties) -> "MassMoments":
        """Moments of a rigid body (parallel axes)."""
        centre = body.centre_of_gravity
        return cls(body.mass, body.mass * centre, body.inertia + body.mass * _parallel_axes(centre))

    def plus(self, factor: float, other: "MassMoments") -> "MassMoments":
        """Sum with ``factor`` times another part."""
        return MassMoments(
            self.mass + factor * other.mass,
            self.first + factor * other.first,
            self.second + factor * other.second,
        )

    def properties(self) -> MassProperties:
        """Mass, centre of gravity, inertia about it."""
        centre = self.first / self.mass
        return MassProperties(self.mass, centre, self.second - self.mass * _parallel_axes(centre))


@dataclass(frozen=True, slots=True)
class WeighedGroup:
    """A tank or payload bay as far as the weight of the aircraft goes."""

    definition: MassGroup
    moments: MassMoments  #: of the full group

    @property
    def name(self) -> str:
        """Name of the tank or bay."""
        return self.definition.name

    @property
    def capacity(self) -> float:
        """Mass of the full group [kg]."""
        return self.moments.mass


@dataclass(frozen=True, slots=True)
class LoadedGroup(WeighedGroup):
    """A tank or payload bay of the airframe."""

    point_masses: PointMasses  #: of the full group
    inertia: Inertia  #: of the full group


Group = TypeVar("Group", bound=WeighedGroup, covariant=True)


@dataclass(frozen=True, slots=True)
class MassStates(Generic[Group]):
    """All loading states of one aircraft."""

    definition: AircraftDefinition
    empty: MassMoments  #: operating empty, without the unsprung masses
    groups: tuple[Group, ...]  #: tanks, then bays

    @property
    def capacities(self) -> Array:
        """Masses of the full groups (n_groups,) [kg]."""
        return np.array([group.capacity for group in self.groups])

    @property
    def default_masses(self) -> Array:
        """Masses assumed where a record says nothing (n_groups,) [kg]."""
        return self.capacities * [group.definition.default_fill for group in self.groups]

    def properties(self, factors: Array) -> MassProperties:
        """Rigid-body properties of the loaded airframe without the unsprung masses."""
        moments = self.empty
        for factor, group in zip(factors, self.groups, strict=True):
            moments = moments.plus(float(factor), group.moments)
        return moments.properties()

    def gross(self, factors: Array) -> tuple[float, Array]:
        """Gross mass [kg] and centre of gravity (3,) [m], with the unsprung masses, extended."""
        body = self.properties(factors)
        mass, moment = body.mass, body.mass * body.centre_of_gravity
        for gear in self.definition.gears:
            axle = gear.pivot + gear.strut.extended_length * gear.axis
            mass, moment = mass + gear.unsprung_mass, moment + gear.unsprung_mass * axle
        return mass, moment / mass


def _parallel_axes(offset: Array) -> Array:
    """Inertia of a unit mass at ``offset`` about the origin."""
    return np.asarray(float(offset @ offset) * np.eye(3) - np.outer(offset, offset))
