"""Peaks of every gear in one contact against its design limit loads."""

import numpy as np

from solver.aircraft.definition import GearDefinition
from solver.assessment import GearLoad
from solver.landing.history import GearHistory, LandingHistory


def gear_loads(
    definitions: tuple[GearDefinition, ...], history: LandingHistory, contact: int
) -> tuple[GearLoad, ...]:
    """Peak loads, stroke and bounces of each gear.

    Vertical, drag and side loads are those at the ground, where the design limits are stated (14
    CFR 25.471 to 25.485). The spring-back force is the largest forward force of the gear on the
    airframe: at the ground the longitudinal force hardly turns, at the fitting it does.

    Parameters
    ----------
    definitions : tuple of GearDefinition
        Gears of the aircraft, in the order of ``history.gears``.
    history : LandingHistory
        One simulated contact.
    contact : int
        Its index in the record.
    """
    return tuple(
        _gear_load(definition, gear, history, contact)
        for definition, gear in zip(definitions, history.gears, strict=True)
    )


def _gear_load(
    definition: GearDefinition, gear: GearHistory, history: LandingHistory, contact: int
) -> GearLoad:
    aft, starboard, down = gear.ground_force.T * np.array([[-1.0], [1.0], [1.0]])
    vertical = -down
    peak = int(np.argmax(vertical))
    drag = float(max(aft.max(), 0.0))
    side = float(np.abs(starboard).max())
    stays = sum(1 for stay in history.contacts if stay.gear == gear.name)
    limits = definition.limits
    return GearLoad(
        gear=gear.name,
        contact=contact,
        vertical_force=float(vertical[peak]),
        vertical_time=float(history.time[peak]),
        drag_force=drag,
        spring_back_force=float(max(gear.wrench[:, 0].max(), 0.0)),
        side_force=side,
        stroke=float(gear.stroke.max()),
        tyre_deflection=float(gear.tyre_deflection.max()),
        stroke_utilisation=float(gear.stroke.max()) / definition.strut.full_stroke,
        utilisation=max(
            float(vertical[peak]) / limits.vertical, drag / limits.drag, side / limits.side
        ),
        bounces=max(stays - 1, 0),
    )
