"""From what a record says about mass, fuel and payload to the loading state that meets it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from solver.aircraft.mass_states import MassStates, WeighedGroup
from solver.arrays import Array, BoolArray
from solver.errors import RecordError

#: Recorded and modelled gross mass may differ by this share before the record is refused.
MASS_TOLERANCE = 0.01


@dataclass(frozen=True, slots=True)
class Loading:
    """A loading state found for a record."""

    factors: Array  #: (n_groups,) tanks, then bays
    mass: float  #: gross, with the unsprung masses [kg]
    centre_of_gravity: Array  #: (3,) gross, struts extended, structural axes [m]
    fuel: dict[str, float]  #: [kg]
    payload: dict[str, float]  #: [kg]
    notes: tuple[str, ...]  #: what was assumed and what does not agree


def fill_factors(
    states: MassStates[WeighedGroup], fuel: Mapping[str, float], payload: Mapping[str, float]
) -> Array:
    """Fill factors (n_groups,) of stated masses [kg]; defaults where nothing is stated.

    Raises
    ------
    RecordError
        Unknown name, or a mass outside 0 to capacity; names field, value and range.
    """
    stated = _stated(states, fuel, payload)
    return np.where(np.isnan(stated), states.default_masses, stated) / states.capacities


def find_loading(
    states: MassStates[WeighedGroup],
    mass: float | None = None,
    centre_of_gravity: float | None = None,
    fuel: Mapping[str, float] | None = None,
    payload: Mapping[str, float] | None = None,
) -> Loading:
    """Find the loading state that meets what a record says.

    In this order: stated fuel and payload are kept; other tanks and bays start at their default
    fill; if the gross mass is stated, the other bays take up the difference, and what they cannot
    hold goes to the other tanks; if the centre of gravity is stated, mass is shifted towards it at
    constant total, first among the bays not stated, then also between them and the tanks unless
    any of these is stated (which would load one wing more than the other).

    Parameters
    ----------
    mass : float, optional
        Gross mass with the unsprung masses [kg].
    centre_of_gravity : float, optional
        Station of the gross centre of gravity, struts extended [m].
    fuel, payload : mapping, optional
        Masses by tank and bay name [kg].

    Raises
    ------
    RecordError
        Unknown name, mass outside 0 to capacity, or a gross mass that the groups that are left
        cannot make up within 1 %.
    """
    stated = _stated(states, fuel or {}, payload or {})
    capacities = states.capacities
    masses = np.where(np.isnan(stated), states.default_masses, stated)
    split = len(states.definition.tanks)
    tanks = np.arange(len(masses)) < split
    free_tanks, free_bays = np.isnan(stated) & tanks, np.isnan(stated) & ~tanks
    notes = _default_notes(states, free_tanks, free_bays, solved=mass is not None)
    if mass is not None:
        masses = _meet_mass(states, mass, masses, free_tanks, free_bays, notes)
    if centre_of_gravity is not None:
        stations = np.array([group.moments.first[0] for group in states.groups]) / capacities
        no_tank_stated = bool(np.all(free_tanks[tanks]))
        for free in (free_bays, free_bays | (free_tanks & no_tank_stated)):
            gross, centre = states.gross(masses / capacities)
            change = gross * (centre_of_gravity - float(centre[0]))
            masses = balance(masses, capacities, stations, free, change)
        _note_centre(states, centre_of_gravity, masses / capacities, notes)
    gross, centre = states.gross(masses / capacities)
    names = [group.name for group in states.groups]
    return Loading(
        factors=masses / capacities,
        mass=gross,
        centre_of_gravity=centre,
        fuel=dict(zip(names[:split], masses[:split].tolist(), strict=True)),
        payload=dict(zip(names[split:], masses[split:].tolist(), strict=True)),
        notes=tuple(notes),
    )


def stated_masses(groups: Sequence[WeighedGroup], masses: Mapping[str, float], field: str) -> Array:
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


def _stated(
    states: MassStates[WeighedGroup], fuel: Mapping[str, float], payload: Mapping[str, float]
) -> Array:
    split = len(states.definition.tanks)
    return np.concatenate(
        [
            stated_masses(states.groups[:split], fuel, "fuel"),
            stated_masses(states.groups[split:], payload, "payload"),
        ]
    )


def _default_notes(
    states: MassStates[WeighedGroup], free_tanks: BoolArray, free_bays: BoolArray, *, solved: bool
) -> list[str]:
    notes = []
    for kind, free in (("fuel", free_tanks), ("payload", free_bays)):
        names = [group.name for group, is_free in zip(states.groups, free, strict=True) if is_free]
        if names:
            how = "default fill, adjusted to the gross mass" if solved else "default fill"
            notes.append(f"{kind} not stated for {', '.join(names)}: {how}")
    return notes


def _meet_mass(
    states: MassStates[WeighedGroup],
    mass: float,
    masses: Array,
    free_tanks: BoolArray,
    free_bays: BoolArray,
    notes: list[str],
) -> Array:
    capacities = states.capacities
    left = mass - states.gross(masses / capacities)[0]
    for free in (free_bays, free_tanks):
        masses, left = spread(left, masses, capacities, free)
    if not abs(left) <= MASS_TOLERANCE * mass:
        free = free_tanks | free_bays
        lowest = states.gross(np.where(free, 0.0, masses) / capacities)[0]
        highest = states.gross(np.where(free, capacities, masses) / capacities)[0]
        span = f"{lowest:.0f} to {highest:.0f} kg" if free.any() else f"{lowest:.0f} kg"
        raise RecordError(
            f"mass = {mass:g} kg cannot be met: with the stated fuel and payload the aircraft "
            f"weighs {span}"
        )
    if abs(left) > 1e-6 * mass:
        notes.append(
            f"stated mass {mass:.0f} kg differs by {left:+.0f} kg from the sum of empty "
            "aircraft, fuel and payload; the sum is used"
        )
    return masses


def _note_centre(
    states: MassStates[WeighedGroup], wanted: float, factors: Array, notes: list[str]
) -> None:
    found = float(states.gross(factors)[1][0])
    reference = states.definition.reference
    if abs(found - wanted) > 1e-3 * reference.mean_chord:
        notes.append(
            f"stated centre of gravity {wanted:.3f} m "
            f"({100 * reference.chord_fraction(wanted):.1f} % MAC) cannot be met with this "
            f"loading; {found:.3f} m ({100 * reference.chord_fraction(found):.1f} % MAC) is used"
        )
