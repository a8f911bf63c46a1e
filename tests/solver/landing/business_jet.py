"""The example business jet as a rigid airframe on three gears, for the landing tests."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from app.cli.landing_file import LandingFile
from solver.gear.parameters import Gear, Pin, SpringBack
from solver.landing.aircraft import Aerodynamics, LandingAircraft

EXAMPLE = Path(__file__).parents[3] / "examples" / "landing_level_10fps.json"

#: Fore-aft frequency of the legs [Hz].
FORE_AFT = 25.0


def landing_file() -> LandingFile:
    return LandingFile.model_validate_json(EXAMPLE.read_bytes())


def rigid_legged() -> LandingAircraft:
    """As in the example file: rigid legs, no aerodynamics but the lift."""
    description = landing_file().aircraft_description
    assert description is not None
    return description.aircraft()


def with_pins(gear: Gear) -> Gear:
    """Three pins around the pivot."""
    stiffness = np.array([2e8, 2e8, 3e8, 1e6, 1e6, 1e6])
    offsets = {"front": (-0.25, 0.0, 0.05), "rear": (0.25, 0.0, 0.05), "brace": (0.0, 0.5, 0.1)}
    return replace(
        gear,
        pins=tuple(
            Pin(name, gear.pivot + np.array(offset), stiffness) for name, offset in offsets.items()
        ),
    )


def springy(gear: Gear, **changes: Any) -> Gear:
    spring = SpringBack.from_frequency(
        FORE_AFT, gear.unsprung_mass, gear.strut.extended_length - 0.08
    )
    return replace(
        with_pins(gear),
        spring_back=replace(spring, **changes),
        tyre=replace(gear.tyre, wheel_transverse_inertia=None),
    )


def business_jet(aerodynamics: Aerodynamics | None = None) -> LandingAircraft:
    """With spring-back, pins, and the usual damping."""
    plain = rigid_legged()
    return replace(
        plain,
        gears=tuple(springy(gear) for gear in plain.gears),
        aerodynamics=aerodynamics
        or Aerodynamics.from_coefficients(
            area=47.9,
            span=19.3,
            chord=2.674,
            drag_coefficient=0.12,
            roll_damping_derivative=-0.45,
            pitch_damping_derivative=-18.0,
            yaw_damping_derivative=-0.12,
        ),
    )
