"""Cuts through an envelope that a reader can take in: one landing, and the limit along one line."""

from dataclasses import replace

import numpy as np

from solver.aircraft.loading import Loading, find_loading
from solver.arrays import Array
from solver.envelope.domain import COORDINATES, coordinates_of
from solver.envelope.envelope import Envelope, LimitSinkRate
from solver.landing.contact import Contact, Lift

#: Above the attitude at which the main wheels touch alone [rad].
_USUAL_PITCH = np.deg2rad(3.0)


def usual_contact(envelope: Envelope) -> Contact:
    """Return a contact without roll, drift or rates, a little nose up, weight carried by lift."""
    domain = envelope.domain
    column = dict(zip(COORDINATES, zip(domain.low, domain.high, strict=True), strict=True))
    return Contact(
        sink_rate=float(column["sink_rate"][0]),
        ground_speed=float(sum(column["ground_speed"]) / 2.0),
        pitch=float(column["pitch"][0] + _USUAL_PITCH),
        lift=Lift(fraction=1.0),
    )


def loading_at(envelope: Envelope, mass: float | None = None, fuel: float | None = None) -> Loading:
    """Find the loading that a record gets which says no more than mass and fuel [kg].

    Raises
    ------
    RecordError
        No loading meets both.
    """
    states = envelope.mass_states
    tanks = states.definition.tanks
    capacity = sum(tank.capacity for tank in tanks)
    shares = {} if fuel is None else {t.name: fuel * t.capacity / capacity for t in tanks}
    return find_loading(states, mass, None, shares)


def limit_at(
    envelope: Envelope,
    loading: Loading,
    utilisation: float = 1.0,
    *,
    roll: float = 0.0,
    pitch: float | None = None,
    lift_fraction: float = 1.0,
) -> LimitSinkRate:
    """Limit sink rate of the usual contact with another attitude [rad] or lift."""
    usual = usual_contact(envelope)
    contact = replace(
        usual,
        roll=roll,
        pitch=usual.pitch if pitch is None else pitch,
        lift=Lift(fraction=lift_fraction),
    )
    return envelope.course(coordinates_of(contact, loading)).limit_sink_rate(utilisation)


def as_rows(limits: list[LimitSinkRate]) -> Array:
    """Value, low and high [m/s] of limits, (n, 3)."""
    return np.array([(limit.value, limit.low, limit.high) for limit in limits])
