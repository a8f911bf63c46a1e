"""Masses of the example aircraft: budget, design loadings, and what they should add up to."""

import math

# Design masses [kg].
MAXIMUM_TAKEOFF, MAXIMUM_LANDING = 13743.0, 12292.0
OPERATING_EMPTY, MAXIMUM_ZERO_FUEL = 8235.0, 9435.0
FORWARD_LIMIT, AFT_LIMIT = 9.6326, 10.0872  #: stations of the centre-of-gravity range [m]

# Reference loading at the maximum landing mass: full payload, the rest fuel.
FUEL_CAPACITY = 2545.5  #: of each wing tank [kg]
TANK_SPAN = (1.0, 8.6)  #: |y| [m]
PAYLOAD_BAYS = (  #: name, capacity [kg], stations [m]
    ("cabin-forward", 480.0, 4.2, 7.7),
    ("cabin-aft", 480.0, 7.7, 11.2),
    ("baggage", 240.0, 11.6, 12.8),
)
REFERENCE_FUEL_SHARE = (MAXIMUM_LANDING - MAXIMUM_ZERO_FUEL) / (2 * FUEL_CAPACITY)
REFERENCE_CENTRE = (9.9, 1.95)  #: station and height of the centre of gravity, struts extended
REFERENCE_PITCH_INERTIA = 125_300.0  #: of the whole aircraft about it, target [kg m2]

# Unsprung parts, not in the finite-element model: mass [kg], axle (x, |y|, z) [m].
UNSPRUNG = ((28.0, (2.2219, 0.0, 0.224155)), (95.0, (10.6219, 1.5, 0.27559)),
            (95.0, (10.6219, -1.5, 0.27559)))  # fmt: skip
UNSPRUNG_MASS = math.fsum(mass for mass, _ in UNSPRUNG)

# Equipment with a place of its own [kg]; assumed.
ENGINE_MASS, ENGINE_INERTIA = 650.0, (65.0, 210.0, 210.0)  #: each, with nacelle [kg, kg m2]
MAIN_UPPER_STRUT, NOSE_UPPER_STRUT = 135.0, 45.0  #: each, with braces and actuators
WING_LEADING_EDGE, WING_TRAILING_EDGE, WING_SYSTEMS = 65.0, 160.0, 45.0  #: each side
WINGLET = 8.0  #: each tip, with light and static dischargers
TAIL_EDGES, FIN_EDGES = 48.0, 62.0  #: each side; elevators, rudder and their actuators
