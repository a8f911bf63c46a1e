"""A contact in the middle of a simulated landing, as a record of it would tell."""

from dataclasses import replace

import numpy as np

from solver.frames import body_structural, euler_from_quaternion, rotation_matrix
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.history import LandingHistory
from solver.landing.records import GRAVITY


def contact_during(
    aircraft: LandingAircraft, history: LandingHistory, sample: int, lift: Lift
) -> Contact:
    """State of the whole aircraft's centre of gravity at a sample of a landing.

    Parameters
    ----------
    aircraft : LandingAircraft
        That landed.
    history : LandingHistory
    sample : int
        As main wheels touch.
    lift : Lift
        Of the landing; what is left of it, with what the nose wheel carries, is the fraction here.
    """
    turn = rotation_matrix(history.attitude[sample])
    roll, pitch, heading = (float(a) for a in euler_from_quaternion(history.attitude[sample]))
    arm = body_structural(aircraft.total_centre_of_gravity - aircraft.centre_of_gravity)
    rate = history.rate[sample]
    ahead, aside, down = turn @ (history.velocity[sample] + np.cross(rate, arm))
    noses = [history.gears[index] for index in aircraft.nose_gears]
    carried = -sum(float(gear.ground_force[sample, 2]) for gear in noses)
    up = carried - float((turn @ history.air_wrench[sample, :3])[2])
    time = float(history.time[sample])
    return Contact(
        sink_rate=float(down),
        ground_speed=float(np.hypot(ahead, aside)),
        pitch=pitch,
        roll=roll,
        drift=heading - float(np.arctan2(aside, ahead)),
        pitch_rate=float(rate[1]),
        roll_rate=float(rate[0]),
        yaw_rate=float(rate[2]),
        lift=replace(lift.seen_from(time), fraction=up / (aircraft.total_mass * GRAVITY)),
        time=time,
        nose_wheel_down=carried > 0.0,
    )
