"""The mini aircraft at one loading, rigid and flexible."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from solver.arrays import Array
from solver.fe.inertia import Inertia
from solver.flexible_landing.full_airframe import dense_modes, modes_of_structure
from solver.flexible_landing.modes import FlexibleAirframe, residual_basis
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.loads import applied_shapes
from solver.landing.aircraft import LandingAircraft
from tests.solver.aircraft.mini import write_mini_aircraft


@dataclass(frozen=True)
class Mini:
    """A small aircraft, everything about it found by dense algebra."""

    airframe: Airframe
    factors: Array
    inertia: Inertia
    aircraft: LandingAircraft
    shapes: Array  #: (n_free, m) modes of unit mass
    modes: FlexibleAirframe  #: all of them
    flexible: FlexibleAirframe  #: the lowest, with residual vectors of the fittings


@pytest.fixture(scope="session")
def mini(tmp_path_factory: pytest.TempPathFactory) -> Mini:
    airframe = load_airframe(write_mini_aircraft(tmp_path_factory.mktemp("mini")))
    factors = np.array([0.5, 0.5, 0.7])[: len(airframe.groups)]
    inertia = airframe.inertia(factors)
    aircraft = airframe.landing_aircraft(factors)
    damping = airframe_damping(airframe)
    modes = modes_of_structure(
        airframe.structure, inertia, applied_shapes(airframe), aircraft, damping
    )
    return Mini(
        airframe,
        factors,
        inertia,
        aircraft,
        dense_modes(airframe.structure, inertia)[1],
        modes,
        modes.transformed(residual_basis(modes, 12), damping),
    )


@pytest.fixture(scope="session")
def lossless(mini: Mini) -> tuple[LandingAircraft, FlexibleAirframe]:
    """The mini aircraft with nothing that dissipates."""
    gears = tuple(
        replace(
            gear,
            spring_back=replace(gear.spring_back, damping_ratio=0.0),
            strut=replace(
                gear.strut, compression_coefficient=0.0, rebound_coefficient=0.0, stop_damping=0.0
            ),
        )
        for gear in mini.aircraft.gears
    )
    still_air = replace(
        mini.aircraft.aerodynamics,
        drag_area=0.0,
        roll_damping=0.0,
        pitch_damping=0.0,
        yaw_damping=0.0,
    )
    aircraft = replace(mini.aircraft, gears=gears, aerodynamics=still_air)
    return aircraft, replace(mini.flexible, damping=np.zeros(mini.flexible.size))
