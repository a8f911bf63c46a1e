"""Gears of the example aircraft, as the definition file states them.

Business-jet struts and tyres of assumed but consistent data: tyres of the 22x5.75-12 and 18x4.4
class, static load, preload and static gas pressure in the usual ranges.
"""

from solver.aircraft.bizjet import dimensions as dim

#: Type: sections and their keys, in the units the definition file names.
GEAR_TYPES: dict[str, dict[str, dict[str, float | int | str]]] = {
    "main": {
        "strut": {
            "length_m": 1.15,
            "stroke_m": 0.38,
            "pneumatic_area_m2": 0.00539,
            "gas_pressure_pa": 2.58e6,
            "gas_volume_m3": 0.002234,
            "polytropic_exponent": 1.1,
            "compression_damping_n_s2_m2": 10_000.0,
            "rebound_damping_n_s2_m2": 40_000.0,
        },
        "tyre": {
            "designation": "22x5.75-12 12PR class",
            "count": 2,
            "free_radius_m": 0.27559,
            "width_m": 0.141605,
            "stiffness_n_m_r": 3137586.387933475,
            "exponent": 1.3329835268010592,
            "bottoming_deflection_m": 0.07239,
            "wheel_inertia_kg_m2": 1.1,
            "slip_stiffness_n": 315823.7346834955,
            "cornering_stiffness_n_rad": 189494.24081009728,
            "friction_maximum": 0.8,
            "friction_minimum": 0.5,
        },
        "spring_back": {"frequency_hz": 25.0, "damping_ratio": 0.04},
    },
    "nose": {
        "strut": {
            "length_m": 1.05,
            "stroke_m": 0.32,
            "pneumatic_area_m2": 0.0022,
            "gas_pressure_pa": 1.6e6,
            "gas_volume_m3": 0.00077,
            "polytropic_exponent": 1.1,
            "compression_damping_n_s2_m2": 5_000.0,
            "rebound_damping_n_s2_m2": 20_000.0,
        },
        "tyre": {
            "designation": "18x4.4 12PR class",
            "count": 1,
            "free_radius_m": 0.224155,
            "width_m": 0.10922,
            "stiffness_n_m_r": 3722023.3510080962,
            "exponent": 1.4021295255876343,
            "bottoming_deflection_m": 0.051435,
            "wheel_inertia_kg_m2": 0.35,
            "slip_stiffness_n": 193497.64026383174,
            "cornering_stiffness_n_rad": 116098.58415829904,
            "friction_maximum": 0.8,
            "friction_minimum": 0.5,
        },
        "spring_back": {"frequency_hz": 25.0, "damping_ratio": 0.04},
    },
}
UNSPRUNG_MASS = {"main": 95.0, "nose": 28.0}  #: [kg]

#: Design limit loads at the ground of one gear [N]: vertical, drag, side.  The largest of the
#: design cases of `solver.sizing.iteration_cases`: main gear 123 kN (taxi, 2 g at take-off mass),
#: 58 kN (spin-up at 10 ft/s), 35 kN (side load); nose gear 42 kN and 23 kN (three wheels at
#: 10 ft/s), 10 kN (nose-wheel yaw); all but the first with 5 % to spare.
LIMITS = {"main": (123e3, 61e3, 37e3), "nose": (44e3, 24.5e3, 12e3)}

#: Pins: forces in the plane of the hinge and, but for the brace, along it; the hinge turns freely,
#: bushings hold the other rotations weakly.  Translations [N/m], rotations [N m/rad].
MAIN_PINS = {
    "trunnion-forward": ([3e8, 3e8, 3e8], [0.0, 5e4, 5e4]),
    "trunnion-aft": ([3e8, 3e8, 3e8], [0.0, 5e4, 5e4]),
    "side-brace": ([2e7, 3e8, 3e8], [0.0, 2e4, 2e4]),
}
NOSE_PINS = {
    "trunnion-left": ([2e8, 2e8, 2e8], [3e4, 0.0, 3e4]),
    "trunnion-right": ([2e8, 2e8, 2e8], [3e4, 0.0, 3e4]),
    "drag-brace-left": ([2e8, 2e7, 2e8], [1e4, 0.0, 1e4]),
    "drag-brace-right": ([2e8, 2e7, 2e8], [1e4, 0.0, 1e4]),
}


def gear_pivots() -> dict[str, tuple[str, tuple[float, float, float]]]:
    """Name, then type and pivot, of every gear in the order of the definition."""
    x, y, z = dim.MAIN_PIVOT
    return {
        "nose": ("nose", dim.NOSE_PIVOT),
        "main_left": ("main", (x, -y, z)),
        "main_right": ("main", (x, y, z)),
    }
