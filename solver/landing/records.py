"""The aircraft in the form the compiled equations read: records of numbers in body axes.

Positions are relative to the airframe's centre of gravity, which is the origin of the equations.
"""

from typing import Any, TypeAlias

import numpy as np

from solver.arrays import Array
from solver.frames import BODY_STRUCTURAL, body_structural
from solver.gear.parameters import METERING_POINTS, Gear
from solver.landing.aircraft import LandingAircraft

#: One row of a structured array; its fields are known to the compiler, not to the type checker.
Record: TypeAlias = Any

#: A structured array, one record per row.
Records: TypeAlias = Any

#: Standard acceleration of gravity (ISO 80000-3) [m/s2].
GRAVITY = 9.80665

#: One gear.  Names as in `solver.gear.parameters`; forces and stiffnesses of the tyre per tyre,
#: wheel inertias of the whole axle.
GEAR_RECORD = np.dtype(
    [
        ("pivot", np.float64, 3),
        ("down", np.float64, 3),  # from pivot to axle, leg not swung
        ("forward", np.float64, 3),  # in the plane of the swing
        ("lateral", np.float64, 3),  # axle, to starboard
        ("unsprung_mass", np.float64),
        ("pneumatic_area", np.float64),
        ("initial_gas_pressure", np.float64),
        ("initial_gas_volume", np.float64),
        ("polytropic_exponent", np.float64),
        ("compression_coefficient", np.float64),
        ("rebound_coefficient", np.float64),
        ("full_stroke", np.float64),
        ("extended_length", np.float64),
        ("stop_stiffness", np.float64),
        ("stop_damping", np.float64),
        ("seal_friction", np.float64),
        ("friction_speed", np.float64),
        ("metering_count", np.int64),
        ("metering_stroke", np.float64, METERING_POINTS),
        ("metering_ratio", np.float64, METERING_POINTS),
        ("free_radius", np.float64),
        ("crown_radius", np.float64),
        ("tyre_count", np.float64),
        ("vertical_coefficient", np.float64),
        ("vertical_exponent", np.float64),
        ("bottoming_deflection", np.float64),
        ("rim_stiffness", np.float64),
        ("vertical_damping", np.float64),
        ("longitudinal_stiffness", np.float64),
        ("cornering_stiffness", np.float64),
        ("maximum_friction", np.float64),
        ("minimum_friction", np.float64),
        ("width", np.float64),
        ("rolling_resistance", np.float64),
        ("rolling_share", np.float64),
        ("spin_inertia", np.float64),
        ("transverse_inertia", np.float64),
        ("swings", np.bool_),
        ("two_tube", np.bool_),
        ("swing_stiffness", np.float64),
        ("swing_damping_ratio", np.float64),
        ("cylinder_rigidity", np.float64),
        ("piston_rigidity", np.float64),
        ("cylinder_length", np.float64),
        ("attachment_stiffness", np.float64),
    ]
)

#: The airframe and its air loads.
AIRFRAME_RECORD = np.dtype(
    [
        ("mass", np.float64),
        ("inertia", np.float64, (3, 3)),
        ("lift_point", np.float64, 3),
        ("centre_of_gravity", np.float64, 3),  # of the whole aircraft, struts extended
        ("total_mass", np.float64),
        ("gravity", np.float64),
        ("air_density", np.float64),
        ("drag_area", np.float64),
        ("lift_slope_area", np.float64),
        ("contact_angle_of_attack", np.float64),  # at which the input's lift holds [rad]
        ("damping", np.float64, 3),  # about the body axes [m4]
        ("yaw_stiffness", np.float64),  # [m3/rad]
    ]
)


def gear_record(gear: Gear, origin: Array) -> Record:
    """Gear as a `GEAR_RECORD`; ``origin`` is the airframe's centre of gravity (structural axes)."""
    record: Record = np.zeros(1, dtype=GEAR_RECORD)[0]
    down = body_structural(gear.axis / np.linalg.norm(gear.axis))
    starboard = np.array([0.0, 1.0, 0.0])
    lateral = starboard - down * (down @ starboard)
    lateral = lateral / np.linalg.norm(lateral)
    strut, tyre, spring = gear.strut, gear.tyre, gear.spring_back
    values = {
        "pivot": body_structural(gear.pivot - origin),
        "down": down,
        "lateral": lateral,
        "forward": np.cross(lateral, down),
        "unsprung_mass": gear.unsprung_mass,
        "metering_count": len(strut.metering),
        "crown_radius": tyre.tread_radius,
        "tyre_count": tyre.count,
        "rim_stiffness": tyre.rim_stiffness,
        "spin_inertia": tyre.count * tyre.wheel_inertia,
        "transverse_inertia": tyre.count * tyre.transverse_inertia,
        "swings": spring.enabled,
        "two_tube": spring.enabled and spring.is_two_tube,
        "swing_stiffness": spring.stiffness,
        "swing_damping_ratio": spring.damping_ratio,
    }
    known = set(GEAR_RECORD.names or ())
    for part in (strut, tyre, spring):
        for name in part.__slots__:
            if name in known and name not in values:
                values[name] = getattr(part, name)
    for name, value in values.items():
        record[name] = value
    for index, (stroke, ratio) in enumerate(strut.metering):
        record["metering_stroke"][index] = stroke
        record["metering_ratio"][index] = ratio
    return record


def airframe_record(aircraft: LandingAircraft) -> Record:
    """Airframe as an `AIRFRAME_RECORD`, the angle of attack left for the initial state to fill."""
    record: Record = np.zeros(1, dtype=AIRFRAME_RECORD)[0]
    aerodynamics = aircraft.aerodynamics
    record["mass"] = aircraft.mass
    record["inertia"] = aircraft.inertia * np.outer(BODY_STRUCTURAL, BODY_STRUCTURAL)
    lift_point = aerodynamics.lift_point
    if lift_point is None:
        lift_point = aircraft.total_centre_of_gravity
    record["lift_point"] = body_structural(lift_point - aircraft.centre_of_gravity)
    record["centre_of_gravity"] = body_structural(
        aircraft.total_centre_of_gravity - aircraft.centre_of_gravity
    )
    record["total_mass"] = aircraft.total_mass
    record["gravity"] = GRAVITY
    record["air_density"] = aerodynamics.air_density
    record["drag_area"] = aerodynamics.drag_area
    record["lift_slope_area"] = aerodynamics.lift_slope_area
    record["damping"] = (
        aerodynamics.roll_damping,
        aerodynamics.pitch_damping,
        aerodynamics.yaw_damping,
    )
    record["yaw_stiffness"] = aerodynamics.yaw_stiffness
    return record
