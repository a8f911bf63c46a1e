"""Loads of a landing: axes, resultants, and the balance with the motion they cause."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from solver.errors import EquilibriumError, ModelError
from solver.frames import body_structural
from solver.inertia_relief.loads import equilibrium_residual, landing_loads
from solver.landing.history import LandingHistory
from verification.inertia_relief.winged_body import (
    WingedBody,
    balanced_landing,
    winged_body,
)

FACTORS = np.array([0.6, 0.25])


def residual(winged: WingedBody, loads, factors=FACTORS) -> float:
    body = winged.body(factors)
    motion = loads.motion.at(body.centre_of_gravity)
    return equilibrium_residual(
        body.rigid_modes.T @ winged.applied,
        loads.applied_amplitudes(),
        body.rigid_modes.T @ body.inertia.rigid_load_shapes(body.centre_of_gravity),
        motion.inertia_amplitudes(),
        body.total_mass * np.linalg.norm(motion.gravity, axis=1),
        body.gyration_radius,
    )


@pytest.mark.parametrize("seed", range(5))
def test_loads_and_the_motion_they_cause_balance_to_rounding(seed):
    winged = winged_body(6, 8)
    assert residual(winged, balanced_landing(winged, FACTORS, seed)) < 1e-13


def test_balance_does_not_depend_on_the_origin_of_the_motion():
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, 3)
    elsewhere = replace(loads, motion=loads.motion.at(np.array([40.0, -7.0, 3.0])))
    assert residual(winged, elsewhere) < 1e-12


def test_imbalance_is_refused_with_its_size_and_never_projected_away():
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, 3)
    pins = loads.pin_loads.copy()
    pins[100, 2] += 1e-6 * 9.81 * winged.body(FACTORS).total_mass
    with pytest.raises(EquilibriumError, match="at sample 100: imbalance"):
        residual(winged, replace(loads, pin_loads=pins))


def test_mass_of_another_loading_is_an_imbalance():
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, 3)
    with pytest.raises(EquilibriumError):
        residual(winged, loads, FACTORS + np.array([0.01, 0.0]))


def test_cancelling_loads_still_count_in_what_the_imbalance_is_compared_with():
    resultants = np.hstack([np.eye(6)] * 2)
    opposite = np.hstack([np.full((1, 6), 1e6), np.full((1, 6), -1e6)])
    opposite[0, 0] += 1.0
    arguments = (np.zeros((6, 12)), np.zeros((1, 12)), np.array([10.0]), 1.0)
    expected = 1.0 / (2 * 1e6 * np.sqrt(6) + 10.0)
    with pytest.raises(EquilibriumError, match=f"{expected:.3e}"):
        equilibrium_residual(resultants, opposite, *arguments)


def history_of(pin_positions, seed: int = 0) -> LandingHistory:
    """Return a landing history with random numbers, two gears with two pins and one pin."""
    rng = np.random.default_rng(seed)
    vectors = {
        name: rng.standard_normal((4, 3))
        for name in ("acceleration", "gravity", "rate", "rate_derivative")
    }
    gears = [
        SimpleNamespace(pin_positions=part, pin_loads=rng.standard_normal((4, len(part), 6)))
        for part in (pin_positions[:2], pin_positions[2:])
    ]
    return SimpleNamespace(
        time=np.arange(4) * 0.1,
        origin=np.array([5.0, 0.1, -0.4]),
        air_wrench=rng.standard_normal((4, 6)),
        gears=tuple(gears),
        **vectors,
    )


def airframe_of(coordinates) -> SimpleNamespace:
    return SimpleNamespace(pin_positions=coordinates[[3, 1, 0]])


def test_body_axes_become_structural_and_the_air_wrench_moves_to_the_structural_origin():
    coordinates = np.random.default_rng(1).standard_normal((5, 3))
    history = history_of(coordinates[[3, 1, 0]])
    loads = landing_loads(airframe_of(coordinates), history)
    np.testing.assert_array_equal(loads.motion.rate, history.rate * [-1.0, 1.0, -1.0])
    np.testing.assert_array_equal(loads.motion.gravity, history.gravity * [-1.0, 1.0, -1.0])
    second_gear = history.gears[1].pin_loads[:, 0]
    np.testing.assert_array_equal(loads.pin_loads[:, 12:15], body_structural(second_gear[:, :3]))
    np.testing.assert_array_equal(loads.pin_loads[:, 15:18], body_structural(second_gear[:, 3:]))
    force = body_structural(history.air_wrench[:, :3])
    np.testing.assert_array_equal(loads.air_loads[:, :3], force)
    # taken back to the history's origin, the moment is the history's
    back = loads.air_loads[:, 3:] - np.cross(history.origin, force)
    np.testing.assert_allclose(back, body_structural(history.air_wrench[:, 3:]), atol=1e-14)


def test_pins_away_from_their_nodes_or_of_another_number_are_refused():
    coordinates = np.random.default_rng(1).standard_normal((5, 3))
    moved = coordinates[[3, 1, 0]].copy()
    moved[2, 1] += 0.02
    with pytest.raises(ModelError, match=r"gear pin 2 is 0\.0200 m from its node"):
        landing_loads(airframe_of(coordinates), history_of(moved))
    with pytest.raises(ModelError, match="the landing has 4 gear pins, the airframe 3"):
        landing_loads(airframe_of(coordinates), history_of(coordinates[:4]))


def test_a_landing_can_be_cut_at_a_time():
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, 0, duration=0.2)
    part = loads.until(0.1)
    assert part.time[-1] == pytest.approx(0.1)
    assert len(part.pin_loads) == len(part.air_loads) == len(part.motion.rate) == len(part.time)
