"""Loading states: which tanks and bays hold how much, and what the aircraft then weighs.

Mass is affine in the fill factors: M(f) = M_empty + sum of f_j M_j, with M_j that of a full tank or
bay.  So are mass, first and second moments about the structural origin, from which the rigid-body
properties of any state follow at once.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from solver.aircraft.definition import MassGroup
from solver.arrays import Array, BoolArray
from solver.errors import RecordError
from solver.fe.inertia import Inertia, MassProperties

#: Recorded and modelled gross mass may differ by this share before the record is refused.
MASS_TOLERANCE = 0.01


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
class LoadedGroup:
    """A tank or payload bay of the airframe."""

    definition: MassGroup
    inertia: Inertia  #: of the full group
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
class Loading:
    """A loading state found for a record."""

    factors: Array  #: (n_groups,) tanks, then bays
    mass: float  #: gross, with the unsprung masses [kg]
    centre_of_gravity: Array  #: (3,) gross, struts extended, structural axes [m]
    fuel: dict[str, float]  #: [kg]
    payload: dict[str, float]  #: [kg]
    notes: tuple[str, ...]  #: what was assumed and what does not agree


def stated_masses(groups: Sequence[LoadedGroup], masses: Mapping[str, float], field: str) -> Array:
    """Masses (n_groups,) [kg] that a record states, NaN where it says nothing.

    Raises
    ------
    RecordError
        A name is unknown, or a mass is not from zero to the capacity.
    """
    stated = np.full(len(groups), math.nan)
    rows = {group.name: row for row, group in enumerate(groups)}
    for name, mass in masses.items():
        if name not in rows:
            known = ", ".join(rows) or "none"
            raise RecordError(f"{field}.{name}: unknown; this aircraft has {known}")
        capacity = groups[rows[name]].definition.capacity
        if not 0.0 <= mass <= capacity:
            raise RecordError(f"{field}.{name} = {mass} kg is outside 0 to {capacity:g} kg")
        stated[rows[name]] = min(mass, groups[rows[name]].capacity)
    return stated


def spread(amount: float, masses: Array, capacities: Array, free: BoolArray) -> tuple[Array, float]:
    """Put ``amount`` [kg] (negative: take) into the free groups; returns masses and what is left.

    Each takes in proportion to the room it has (gives in proportion to what it holds), so that
    port and starboard stay alike and all are full, or empty, at the same moment.
    """
    room = np.where(free, capacities - masses if amount > 0 else masses, 0.0)
    total = float(room.sum())
    moved = math.copysign(min(abs(amount), total), amount)
    if total > 0.0:
        masses = masses + room * (moved / total)
    return masses, amount - moved


def balance(
    masses: Array, capacities: Array, stations: Array, free: BoolArray, moment: float
) -> Array:
    """Shift mass among the free groups to change their moment, total kept, as little as possible.

    Parameters
    ----------
    moment : float
        Wanted change of the sum of mass times station [kg m].

    Returns
    -------
    (n_groups,) array
        New masses within 0 to capacity.  Where the change cannot be reached in full, as much of it
        as the least-squares shift allows (groups that meet a bound stay there).
    """
    masses = masses.copy()
    active = free.copy()
    while active.sum() >= 2 and abs(moment) > 1e-9:
        lever = np.where(active, stations - stations[active].mean(), 0.0)
        square = float(lever @ lever)
        if square == 0.0:
            break
        step = lever * (moment / square)
        with np.errstate(divide="ignore", invalid="ignore"):
            limits = np.where(
                step > 0, (capacities - masses) / step, np.where(step < 0, -masses / step, np.inf)
            )
        share = float(min(1.0, limits[active].min()))
        masses = np.clip(masses + share * step, 0.0, capacities)
        moment *= 1.0 - share
        if share >= 1.0:
            break
        active = active & (limits > share * (1 + 1e-12))
    return masses


def _parallel_axes(offset: Array) -> Array:
    """Inertia of a unit mass at ``offset`` about the origin."""
    return np.asarray(float(offset @ offset) * np.eye(3) - np.outer(offset, offset))
