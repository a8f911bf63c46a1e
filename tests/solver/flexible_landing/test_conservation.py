"""Momentum and energy of a flexible aircraft on its moving gears."""

import numpy as np
import pytest

from solver.flexible_landing.energy import energies
from solver.flexible_landing.modes import FlexibleAirframe
from solver.frames import BODY_STRUCTURAL, rotation_matrix
from solver.landing.aircraft import LandingAircraft
from solver.landing.coupling import GEAR_ANSWER
from tests.solver.flexible_landing.conftest import Mini
from tests.solver.flexible_landing.flight import body_of, fly, momenta, moving_state

Lossless = tuple[LandingAircraft, FlexibleAirframe]


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("order", ["all terms", "first order"])
def test_momentum_is_conserved_without_outer_forces(
    lossless: Lossless, seed: int, order: str
) -> None:
    # With or without the second-order terms the equations are those of one Lagrangian.
    aircraft, flexible = lossless
    body = body_of(
        aircraft, flexible if order == "all terms" else flexible.without_second_order(), gravity=0.0
    )
    state = moving_state(body, seed, height=100.0)
    flight = fly(body, state, 0.1)
    (linear, angular), (linear_end, angular_end) = momenta(flight, 0), momenta(flight, -1)
    assert np.linalg.norm(linear_end - linear) < 1e-8 * np.linalg.norm(linear)
    assert np.linalg.norm(angular_end - angular) < 1e-7 * np.linalg.norm(angular)
    # The structure and the legs turn the airframe to and fro meanwhile.
    assert np.ptp(flight.states[:, 10:13], axis=0).min() > 1e-3


@pytest.mark.parametrize("seed", [3, 4])
def test_energy_is_conserved_without_losses(lossless: Lossless, seed: int) -> None:
    aircraft, flexible = lossless
    body = body_of(aircraft, flexible)
    flight = fly(body, moving_state(body, seed, height=100.0), 0.1)
    exchanged = np.ptp(flight.stored[:, 2:], axis=0).sum()
    assert exchanged > 1e3
    assert np.ptp(flight.stored.sum(axis=1)) < 1e-5 * exchanged


def test_kinetic_energy_is_that_of_all_mass_points(mini: Mini) -> None:
    # The definition: mass points and rotary bodies of the finite-element model, one by one.
    body = body_of(mini.aircraft, mini.modes, gravity=0.0)
    generator = np.random.default_rng(7)
    size = mini.modes.size
    state = moving_state(body, 5, height=100.0)
    q = generator.standard_normal(size) / mini.modes.circular_frequency * 30.0
    q_rate = 10.0 * generator.standard_normal(size)
    state[body.first :] = np.concatenate([q, q_rate])
    turn = rotation_matrix(state[3:7])
    velocity = BODY_STRUCTURAL * (turn.T @ state[7:10])
    rate = BODY_STRUCTURAL * state[10:13]
    inertia, shapes = mini.inertia, mini.shapes
    displaced = (inertia.interpolation @ (shapes @ q)).reshape(-1, 3)
    moving = (inertia.interpolation @ (shapes @ q_rate)).reshape(-1, 3)
    levers = inertia.points - mini.aircraft.centre_of_gravity + displaced
    speeds = velocity + np.cross(rate, levers) + moving
    expected = 0.5 * np.einsum("pi,pi->", speeds, inertia.scalar_mass @ speeds)
    turned = (inertia.rotary_interpolation @ (shapes @ q)).reshape(-1, 3)
    turning = (inertia.rotary_interpolation @ (shapes @ q_rate)).reshape(-1, 3)
    spins = rate + turning + np.cross(rate, turned)
    expected += 0.5 * np.einsum("pi,pij,pj->", spins, inertia.rotary, spins)
    # The gears' own kinetic energy is left out: no mass, no inertia.
    weightless = body.local.copy()
    for name in ("unsprung_mass", "transverse_inertia", "spin_inertia"):
        weightless[name] = 0.0
    answers = np.zeros(len(weightless), dtype=GEAR_ANSWER)
    found = np.zeros(7)
    energies(state, body.airframe, weightless, body.modes, answers, found)
    assert found[0] == pytest.approx(expected, rel=1e-10)
    # The parts that rotation and deformation share are not lost in the speed over ground.
    rigid = 0.5 * mini.aircraft.mass * velocity @ velocity
    assert abs(expected - rigid - 0.5 * q_rate @ q_rate) > 1e2
