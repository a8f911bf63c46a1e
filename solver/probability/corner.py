"""Pessimistic corners: landings that, if they stay below every limit, settle the matter.

A limit that is linear in the standard normal variables is exceeded with the probability Phi(-beta),
beta the distance to its nearest point (Hasofer and Lind, "Exact and invariant second-moment code
format", Journal of the Engineering Mechanics Division 100, 1974).  Landings exceed limits in two
ways: stresses and vertical loads by sink rate and roll, side loads on the wheels by drift, by yaw
and by the hop that lets it build up.  A corner lies `DISTANCE` away in the direction of each.
A limit's own direction is at some angle to its corner's; as long as that is less than
`LARGEST_ANGLE`, its beta is at least DISTANCE cos(LARGEST_ANGLE) if the corner does not exceed it.
"""

import math
from collections.abc import Iterator

import numpy as np
from scipy.special import ndtr

from solver.arrays import Array
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.probability.variables import LandingVariables, Sensitivity

#: Of a corner from the landing as recorded, in standard deviations.
DISTANCE = 3.0
#: Between a corner's direction and that of its limits [rad].
LARGEST_ANGLE = math.acos(0.8)
#: Largest utilisation in a corner at which nothing else is asked: its steps are coarse.
CLEAR_UTILISATION = 0.98
#: Probability that clear corners leave for one contact, one limit for each.
BOUND = 2.0 * float(ndtr(-DISTANCE * math.cos(LARGEST_ANGLE)))

# Utilisation per unit of what is uncertain, of the order found by differences about firm landings
# of the example aircraft.  Only their ratios matter.
_STRESS = {"sink_rate": 0.35, "roll": 6.0, "roll_rate": 1.0}  #: [s/m], [1/rad], [s/rad]
_SIDE_LOAD = {"sink_rate": 0.35, "drift": 6.0, "yaw_rate": 7.0}  #: [s/m], [1/rad], [s/rad]
_LIFT_DECAY_START = 0.7  #: [1/s]
_FRICTION = {"stress": 0.4, "side load": 0.6}
_GEAR = np.array([0.15, 0.4, 0.15])  #: gas pressure, strut damping, tyre stiffness


def corners(
    variables: LandingVariables, contact: Contact, number: int, *, mirrored: bool = False
) -> Iterator[Array]:
    """Yield the standard normal variables (count,) of contact ``number``'s two corners.

    Stress first, then side load.  Roll, drift and yaw go the way they already are, from zero to
    starboard, or if ``mirrored`` the other way.
    """
    side = -1.0 if mirrored else 1.0
    rolling = side * math.copysign(1.0, contact.roll)
    turning = side * math.copysign(1.0, contact.drift or contact.roll)
    signs = dict.fromkeys(CONTACT_COMPONENTS, 1.0)
    signs |= {"roll": rolling, "roll_rate": rolling, "drift": turning, "yaw_rate": turning}
    for slopes, friction, decay in (
        (_STRESS, _FRICTION["stress"], 0.0),
        (_SIDE_LOAD, _FRICTION["side load"], _LIFT_DECAY_START),
    ):
        toward = variables.slopes(
            number,
            Sensitivity(
                contact=np.array(
                    [signs[name] * slopes.get(name, 0.0) for name in CONTACT_COMPONENTS]
                ),
                friction=friction,
                lift_course=np.array([decay, 0.0, 0.0]),
                gear=_GEAR,
                structural_damping=0.0,
            ),
        )
        length = float(np.linalg.norm(toward))
        yield np.asarray(toward * (DISTANCE / length)) if length > 0.0 else toward
