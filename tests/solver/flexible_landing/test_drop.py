"""One gear under one elastic mode, dropped: against the same system written out by hand."""

from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp

from solver.arrays import Array
from solver.flexible_landing.modes import FlexibleAirframe
from solver.gear.oleo import gas_force, hydraulic_force, stop_force
from solver.gear.parameters import SpringBack
from solver.gear.tyre import vertical_force
from solver.landing.aircraft import LandingAircraft
from tests.solver.flexible_landing.conftest import Mini
from tests.solver.flexible_landing.flight import body_of, fly

MASS, SPEED, GRAVITY = 4000.0, 2.0, 9.80665
FREQUENCY, LOSS, SHAPE = 2 * np.pi * 6.0, 3.0, 0.012


def test_drop_on_an_elastic_mode_is_that_of_three_equations(mini: Mini) -> None:
    # Height of the airframe, modal coordinate, stroke: Newton's equations of the two masses and of
    # the mode, integrated by another scheme.
    gear = next(gear for gear in mini.aircraft.gears if gear.name == "main_left")
    gear = replace(
        gear,
        pivot=np.zeros(3),
        pins=(),
        spring_back=SpringBack.rigid(),
        tyre=replace(gear.tyre, maximum_friction=1e-12, minimum_friction=1e-12),
    )
    aircraft = LandingAircraft(MASS, np.zeros(3), np.diag([1e4, 2e4, 2.5e4]), (gear,))
    fittings = np.zeros((1, 6, 1))
    fittings[0, 2, 0] = SHAPE
    flexible = FlexibleAirframe(
        np.array([FREQUENCY]), np.array([LOSS]), fittings, np.zeros((6, 1)), np.zeros((6, 1)),
        np.zeros((0, 1, 1)), np.zeros((0, 1, 1)),
    )  # fmt: skip
    body = body_of(aircraft, flexible)
    state = np.zeros(body.first + 2)
    strut, tyre = gear.strut, gear.tyre
    state[2] = -strut.extended_length - tyre.free_radius
    state[3], state[9] = 1.0, SPEED
    flight = fly(body, state, 0.2, tolerance=1e-10)

    def push(stroke: float, rate: float) -> float:
        gas = gas_force(
            stroke, strut.pneumatic_area, strut.initial_gas_pressure, strut.initial_gas_volume,
            strut.polytropic_exponent,
        )  # fmt: skip
        oil = hydraulic_force(rate, strut.compression_coefficient, strut.rebound_coefficient)
        stop = stop_force(-stroke, -rate, strut.stop_stiffness, strut.stop_damping)
        return float(gas + oil - stop)

    def slope(_: float, values: Array) -> Array:
        depth, mode, stroke, depth_rate, mode_rate, stroke_rate = values
        force = push(stroke, stroke_rate)
        deflection = depth + SHAPE * mode - stroke
        ground = tyre.count * vertical_force(
            max(deflection, 0.0), tyre.vertical_coefficient, tyre.vertical_exponent,
            tyre.bottoming_deflection, tyre.rim_stiffness,
        )  # fmt: skip
        depth_2 = GRAVITY - force / MASS
        mode_2 = -(FREQUENCY**2) * mode - LOSS * mode_rate - SHAPE * force
        wheel_2 = GRAVITY + (force - ground) / gear.unsprung_mass
        return np.array(
            [
                depth_rate,
                mode_rate,
                stroke_rate,
                depth_2,
                mode_2,
                depth_2 + SHAPE * mode_2 - wheel_2,
            ]
        )

    time = np.linspace(0.0, 0.2, len(flight.states))
    start = np.array([0.0, 0.0, 0.0, SPEED, 0.0, 0.0])
    expected = solve_ivp(slope, (0.0, 0.2), start, "LSODA", time, rtol=1e-10, atol=1e-12).y
    forces = np.array([push(*pair) for pair in expected[[2, 5]].T])
    found = flight.gear_answers["strut_force"][:, 0]
    assert found.max() > 3e4
    assert np.abs(found - forces).max() < 1e-5 * forces.max()
    assert (
        np.abs(flight.states[:, body.first] - expected[1]).max() < 1e-6 * np.abs(expected[1]).max()
    )
    # The mode matters: it moves the fitting by millimetres.
    assert SHAPE * np.abs(expected[1]).max() > 1e-3
