"""Dimensions of the EBJ-19 example aircraft: where its structure lies, and nothing else.

Structural axes: x aft of the nose, y starboard, z up from the ground line with extended gears.
A generic midsize business jet put together from published figures and assumptions; NOT a model of a
certified aeroplane.  ``docs/example-aircraft.md`` says for every figure which it is.
"""

import math

import numpy as np

from solver.arrays import Array

# Wing planform (trapezoidal reference wing through the fuselage).
WING_AREA = 47.9  #: [m2]
WING_SPAN = 19.3  #: [m]
WING_ROOT_CHORD = 3.6768  #: at the plane of symmetry [m]
WING_TIP_CHORD = 1.2869  #: [m]
WING_APEX = 8.0701  #: leading edge at the plane of symmetry [m]
WING_SWEEP = math.radians(16.0)  #: of the leading edge
WING_DIHEDRAL = math.radians(3.0)
WING_THICKNESS = 0.125  #: t/c
MEAN_CHORD = 2.6737  #: [m]
MEAN_CHORD_LEADING_EDGE = 9.2316  #: [m]
FRONT_SPAR, REAR_SPAR = 0.15, 0.60  #: of every box, fraction of the chord
HALF_SPAN = WING_SPAN / 2

# Fuselage.
FUSELAGE_RADIUS = 0.975  #: of the cylindrical part [m]
FUSELAGE_HEIGHT = 2.15  #: of its axis [m]
NOSE_CAP, NOSE_END, TAIL_START, TAIL_CAP = 0.40, 3.40, 12.90, 18.40  #: stations [m]
TAIL_RADIUS = 0.28  #: at the tail cap [m]
FORWARD_PRESSURE_BULKHEAD, AFT_PRESSURE_BULKHEAD = 1.40, TAIL_START

# Lines along the fuselage, angle from the keel.
KEEL_WEB = math.radians(15.0)  #: walls of the nose gear bay
FLOOR = math.asin(0.8)  #: floor, upper skin of the centre box, side-of-body joint
PYLON_LOWER, PYLON_UPPER = math.radians(95.4), math.radians(109.5)
FIN_ROOT = math.radians(166.0)

SIDE_OF_BODY = FUSELAGE_RADIUS * 0.8  #: y of the wing joint [m]
FLOOR_HEIGHT = FUSELAGE_HEIGHT - FUSELAGE_RADIUS * 0.6  #: z in the cylindrical part [m]

# Landing gears.
MAIN_PIVOT = (10.6219, 1.5, 1.42559)  #: z: axle at the free tyre radius, 1.15 m below
NOSE_PIVOT = (2.2219, 0.0, 1.274155)
GEAR_RIBS = (1.35, 1.65)  #: y of the ribs that hold the trunnion fittings [m]
BRACE_FITTING = (SIDE_OF_BODY, 1.08)  #: y range of the side-brace fitting on the rear spar [m]
GEAR_BEAM_END = 2.75  #: y where the gear beam meets the rear spar [m]
GEAR_BEAM_STATION = 11.20  #: of the gear beam at the side of body [m]
GEAR_BEAM_KINK_STATION = 11.10  #: at the outboard gear rib [m]
NOSE_TRUNNION_STATION, NOSE_BRACE_STATION = 2.2219, 2.80

# Engines and pylons.
PYLON_FRONT, PYLON_REAR, PYLON_TIP = 13.40, 14.30, 1.30  #: stations, y [m]
ENGINE_CENTRE = (13.75, 1.75, 2.36)  #: centre of gravity, starboard [m]

# Fin and tailplane (T-tail).
FIN_FRONT, FIN_REAR = 15.08, 16.52  #: stations of the spars at the root [m]
FIN_TIP_HEIGHT, FIN_TIP_LEADING_EDGE, FIN_TIP_CHORD = 5.60, 16.90, 1.90
FIN_THICKNESS, TAIL_THICKNESS = 0.12, 0.11  #: t/c
FIN_ROOT_HEIGHT = 3.05  #: z, for the planform [m]
FIN_ROOT_LEADING_EDGE, FIN_ROOT_CHORD = 14.60, 3.20
TAIL_HALF_SPAN, TAIL_TIP_CHORD, TAIL_TIP_LEADING_EDGE = 3.20, 0.85, 18.35


def wing_leading_edge(y: Array | float) -> Array:
    """Station of the wing's leading edge at span position ``y`` >= 0 [m]."""
    return np.asarray(WING_APEX + np.asarray(y) * math.tan(WING_SWEEP))


def wing_chord(y: Array | float) -> Array:
    """Chord of the wing [m]."""
    taper = (WING_ROOT_CHORD - WING_TIP_CHORD) / HALF_SPAN
    return np.asarray(WING_ROOT_CHORD - taper * np.asarray(y))


def wing_station(y: Array | float, fraction: Array | float) -> Array:
    """Station of a chord fraction of the wing [m]."""
    return np.asarray(wing_leading_edge(y) + np.asarray(fraction) * wing_chord(y))


def wing_height(y: Array | float) -> Array:
    """Height of the wing's chord plane [m]; set so that the rear spar holds the gear's pivot."""
    return np.asarray(1.41 + (np.asarray(y) - MAIN_PIVOT[1]) * math.tan(WING_DIHEDRAL))


def half_thickness(fraction: Array | float) -> Array:
    """Half the thickness of a symmetric section per chord and t/c.

    NACA four-digit thickness law (Jacobs, Ward and Pinkerton, NACA Report 460, 1933).
    """
    x = np.asarray(fraction)
    return np.asarray(
        5 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)
    )


def fuselage_radius(station: Array | float) -> Array:
    """Radius of the circular cross-section: elliptic nose, cylinder, tapered tail [m]."""
    x = np.asarray(station, dtype=float)
    nose = np.sqrt(1 - (np.clip(NOSE_END - x, 0, None) / NOSE_END) ** 2)
    aft = np.clip((x - TAIL_START) / (TAIL_CAP - TAIL_START), 0, None)
    return np.asarray(FUSELAGE_RADIUS * nose - (FUSELAGE_RADIUS - TAIL_RADIUS) * aft**1.5)


def fuselage_axis(station: Array | float) -> Array:
    """Height of the section's centre: the nose droops, the tail rises [m]."""
    x = np.asarray(station, dtype=float)
    lost = FUSELAGE_RADIUS - fuselage_radius(x)
    return np.asarray(FUSELAGE_HEIGHT + np.where(x > NOSE_END, 0.75, -0.25) * lost)


def box_fraction(divisions: int) -> Array:
    """Chord fractions of the box's chordwise divisions, front spar to rear spar."""
    return np.linspace(FRONT_SPAR, REAR_SPAR, divisions + 1)


def centre_box_stations(divisions: int) -> Array:
    """Stations of the centre box, which is not swept [m]."""
    return wing_station(SIDE_OF_BODY, box_fraction(divisions))


def wing_lower_at_body(station: Array | float) -> Array:
    """Height of the box's lower skin at the side of body, constant across the centre box [m]."""
    ends = wing_station(SIDE_OF_BODY, np.array([FRONT_SPAR, REAR_SPAR]))
    x = np.clip(np.asarray(station, dtype=float), ends[0], ends[1])
    chord = wing_chord(SIDE_OF_BODY)
    fraction = (x - wing_leading_edge(SIDE_OF_BODY)) / chord
    depth = half_thickness(fraction) * WING_THICKNESS * chord
    return np.asarray(wing_height(SIDE_OF_BODY) - depth)
