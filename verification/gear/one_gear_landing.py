"""The drop test done by the landing simulation: one gear under one mass, tyre without friction."""

from dataclasses import replace

import numpy as np

from solver.arrays import Array
from solver.gear.drop_test import DropTestParameters
from solver.gear.parameters import Gear, SpringBack, Strut, Tyre, hydraulic_coefficient
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Slowest admissible ground speed; without friction it does nothing [m/s].
GROUND_SPEED = 5.0
#: Inertia at which the airframe does not turn [kg m2].
INERTIA = 1e6
NEGLIGIBLE = 1e-9


def strut_of(given: DropTestParameters, stop_stiffness: float | None = None) -> Strut:
    """Strut of a drop test; its stop's stiffness is the solver's own unless given [N/m]."""
    coefficient = hydraulic_coefficient(
        given.fluid_density, given.hydraulic_area, given.discharge_coefficient, given.orifice_area
    )
    strut = Strut(
        pneumatic_area=given.pneumatic_area,
        initial_gas_pressure=given.initial_gas_pressure,
        initial_gas_volume=given.initial_gas_volume,
        polytropic_exponent=given.polytropic_exponent,
        compression_coefficient=coefficient,
        rebound_coefficient=coefficient,
        full_stroke=0.99 * given.stroke_limit,
        extended_length=1.0,
    )
    return strut if stop_stiffness is None else replace(strut, stop_stiffness=stop_stiffness)


def one_gear_landing(
    given: DropTestParameters,
    duration: float,
    stop_stiffness: float | None = None,
    tolerance: float = 1e-6,
    interval: float = 1e-3,
) -> LandingHistory:
    """Drop the gear in the landing simulation, lift and weight as in the test.

    Raises
    ------
    SimulationDivergedError
        The energy account does not close.
    """
    tyre = Tyre(
        free_radius=0.3429,  # half of the 27 in of its name
        vertical_coefficient=given.tyre_coefficient,
        vertical_exponent=given.tyre_exponent,
        longitudinal_stiffness=NEGLIGIBLE,
        cornering_stiffness=NEGLIGIBLE,
        maximum_friction=NEGLIGIBLE,
        minimum_friction=NEGLIGIBLE,
        width=0.2,
        wheel_inertia=1.0,
    )
    gear = Gear(
        "gear", strut_of(given, stop_stiffness), tyre, SpringBack.rigid(), given.lower_mass,
        np.zeros(3),
    )  # fmt: skip
    aircraft = LandingAircraft(given.upper_mass, np.zeros(3), INERTIA * np.eye(3), (gear,))
    lift = Lift(LiftModel.HELD, fraction=given.lift_ratio)
    return simulate_landing(
        aircraft,
        Contact(given.contact_speed, GROUND_SPEED, lift=lift),
        SimulationOptions(
            output_interval=interval,
            time_limit=duration,
            tolerance=tolerance,
            stop_when_settled=False,
        ),
    )


def ground_force(history: LandingHistory) -> Array:
    """Vertical force of the ground (nt,) [N]."""
    return -history.gears[0].ground_force[:, 2]
