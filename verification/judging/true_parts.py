"""Parts of what the landing really was, given to an estimate one at a time or together.

The state of a contact is what a recording tells of; these are the things it does not, in the order
in which an operator could come to know them.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace
from enum import StrEnum

from solver.arrays import Array
from solver.gear.parameters import Gear
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from verification.judging.flight import FlownLanding


class Part(StrEnum):
    """What may be known besides the contacts."""

    LOADING = "fuel and payload"
    LIFT = "course of the lift"
    FRICTION = "runway friction"
    GAS_PRESSURE = "gas pressure"
    TYRES = "tyre stiffness"
    DAMPING = "strut damping"


_OF_STRUT = {
    Part.GAS_PRESSURE: ("initial_gas_pressure",),
    Part.DAMPING: ("compression_coefficient", "rebound_coefficient", "seal_friction"),
}
_OF_TYRE = {
    Part.TYRES: ("vertical_coefficient",),
    Part.FRICTION: ("maximum_friction", "minimum_friction"),
}


@dataclass(frozen=True, slots=True)
class Belief:
    """A landing as somebody believes it was."""

    aircraft: LandingAircraft
    fills: Array  #: (n_groups,) of tanks and bays
    contacts: tuple[Contact, ...]


def with_truth(belief: Belief, flown: FlownLanding, parts: Collection[Part]) -> Belief:
    """Belief with some parts as they really were.

    With all of them what is left to be wrong are the contacts' states, and that a landing is taken
    for one contact after the other.
    """
    aircraft, fills = belief.aircraft, belief.fills
    gears = tuple(
        _with_true(gear, real, parts)
        for gear, real in zip(aircraft.gears, flown.aircraft.gears, strict=True)
    )
    if Part.LOADING in parts:
        aircraft, fills = flown.aircraft, flown.fills
    contacts = belief.contacts
    if Part.LIFT in parts:
        contacts = tuple(
            replace(contact, lift=_true_lift(contact, flown.contact.lift)) for contact in contacts
        )
    return Belief(replace(aircraft, gears=gears), fills, contacts)


def _with_true(gear: Gear, real: Gear, parts: Collection[Part]) -> Gear:
    strut = [name for part in parts for name in _OF_STRUT.get(part, ())]
    tyre = [name for part in parts for name in _OF_TYRE.get(part, ())]
    return replace(
        gear,
        strut=replace(gear.strut, **{name: getattr(real.strut, name) for name in strut}),
        tyre=replace(gear.tyre, **{name: getattr(real.tyre, name) for name in tyre}),
    )


def _true_lift(contact: Contact, real: Lift) -> Lift:
    """Course that the lift really took, seen from a contact; how much there was is its state."""
    return replace(real.seen_from(contact.time), fraction=contact.lift.fraction)
