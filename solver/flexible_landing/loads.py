"""Loads of a flexible landing for the analysis of stress by extended inertia relief.

That analysis is linear: loads act on the undeformed airframe, and the rigid motion in it is the one
that they give the undeformed airframe.  The flexible landing acts on deformed arms and inertia, so
its accelerations differ by a share of the size of the deflections; they are replaced by those that
balance the loads.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from solver.frames import BODY_STRUCTURAL, body_structural
from solver.inertia_relief.loads import LandingLoads, landing_loads
from solver.landing.aircraft import LandingAircraft

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe
    from solver.landing.history import LandingHistory


def flexible_landing_loads(
    airframe: "Airframe", aircraft: LandingAircraft, history: "LandingHistory"
) -> LandingLoads:
    """Turn a landing of a flexible airframe into structural loads, see `landing_loads`.

    Parameters
    ----------
    aircraft : LandingAircraft
        The rigid body that landed.
    history : LandingHistory
        Of a `FlexibleLanding`.
    """
    inertia = aircraft.inertia * np.outer(BODY_STRUCTURAL, BODY_STRUCTURAL)
    force = history.air_wrench[:, :3] + aircraft.mass * history.gravity
    moment = history.air_wrench[:, 3:] - np.cross(history.rate, history.rate @ inertia)
    for gear in history.gears:
        arm = body_structural(gear.reference_point - history.origin)
        force = force + gear.wrench[:, :3]
        moment = moment + gear.wrench[:, 3:] + np.cross(arm, gear.wrench[:, :3])
    return landing_loads(
        airframe,
        replace(
            history,
            acceleration=force / aircraft.mass,
            rate_derivative=np.asarray(np.linalg.solve(inertia, moment.T).T, dtype=np.float64),
        ),
    )
