"""Compile the landing's kernels before anybody waits for them."""

import numpy as np

from solver.gear.parameters import Gear, SpringBack, Strut, Tyre
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing


def compile_kernels() -> None:
    """Compile, or load from the cache, everything that `simulate_landing` runs.

    Takes some 15 s the first time on a machine and well below a second from then on.
    """
    strut = Strut(
        pneumatic_area=5e-3,
        initial_gas_pressure=2e6,
        initial_gas_volume=2e-3,
        polytropic_exponent=1.1,
        compression_coefficient=1e4,
        rebound_coefficient=4e4,
        full_stroke=0.3,
        extended_length=1.0,
    )
    tyre = Tyre(
        free_radius=0.3,
        vertical_coefficient=3e6,
        vertical_exponent=1.3,
        longitudinal_stiffness=3e5,
        cornering_stiffness=2e5,
        maximum_friction=0.8,
        minimum_friction=0.5,
        width=0.15,
        wheel_inertia=1.0,
    )
    spring_back = SpringBack(stiffness=2e6)
    gears = tuple(
        Gear(name, strut, tyre, spring_back, 100.0, np.array([x, y, 0.0]))
        for name, x, y in (("nose", -5.0, 0.0), ("left", 1.0, -1.5), ("right", 1.0, 1.5))
    )
    aircraft = LandingAircraft(1e4, np.zeros(3), np.diag([8e4, 1e5, 1.6e5]), gears)
    simulate_landing(
        aircraft, Contact(sink_rate=1.0, ground_speed=50.0), SimulationOptions(time_limit=0.01)
    )
