import numpy as np
import pytest

from solver.errors import ModelError
from solver.gear.parameters import Pin
from solver.gear.pins import pin_load_matrix, resultant_matrix

STIFF = np.array([2e8, 2e8, 3e8, 1e6, 1e6, 1e6])


def main_gear_pins() -> list[Pin]:
    return [
        Pin("front trunnion", np.array([10.4, -1.5, 1.5]), STIFF),
        Pin("rear trunnion", np.array([10.9, -1.5, 1.5]), STIFF),
        Pin("side brace", np.array([10.6, -0.8, 1.6]), np.array([1e7, 2e8, 2e8, 0, 0, 0])),
    ]


def test_pin_loads_balance_the_wrench_to_rounding() -> None:
    pins, point = main_gear_pins(), np.array([10.62, -1.5, 1.43])
    matrix = pin_load_matrix(pins, point)
    assert matrix.shape == (18, 6)
    wrench = np.array([3e4, -1e4, 9e4, 2e4, -7e4, 5e3])
    resultant = resultant_matrix(pins, point) @ (matrix @ wrench)
    assert np.max(np.abs(resultant - wrench)) < 1e-10 * np.max(np.abs(wrench))


def test_two_equal_pins_share_a_central_force_in_halves() -> None:
    pins = [
        Pin("left", np.array([0.0, -1.0, 0.0]), STIFF),
        Pin("right", np.array([0.0, 1.0, 0.0]), STIFF),
    ]
    loads = pin_load_matrix(pins, np.zeros(3)) @ np.array([0, 0, 100.0, 0, 0, 0])
    assert loads == pytest.approx([0, 0, 50, 0, 0, 0] * 2, abs=1e-12)


def test_pins_store_the_least_energy_of_all_loads_in_balance() -> None:
    pins, point = main_gear_pins()[:2], np.array([10.62, -1.5, 1.43])
    stiffness = np.concatenate([pin.stiffness for pin in pins])
    wrench = np.array([3e4, -1e4, 9e4, 2e4, -7e4, 5e3])
    loads = pin_load_matrix(pins, point) @ wrench
    # Any change of the loads that keeps the balance lies in the null space of the resultant.
    _, _, rows = np.linalg.svd(resultant_matrix(pins, point))
    least = np.sum(loads**2 / stiffness)
    for change in rows[6:]:
        for size in (-100.0, 100.0):
            assert np.sum((loads + size * change) ** 2 / stiffness) > least


def test_loads_do_not_depend_on_the_reference_point() -> None:
    pins, here, there = main_gear_pins(), np.zeros(3), np.array([10.62, -1.5, 1.43])
    force, moment = np.array([3e4, -1e4, 9e4]), np.array([2e4, -7e4, 5e3])
    moved = moment + np.cross(there - here, force)
    one = pin_load_matrix(pins, there) @ np.concatenate([force, moment])
    other = pin_load_matrix(pins, here) @ np.concatenate([force, moved])
    assert one == pytest.approx(other, rel=1e-8, abs=1e-5)


def test_released_freedom_carries_nothing() -> None:
    loads = pin_load_matrix(main_gear_pins(), np.array([10.62, -1.5, 1.43]))
    assert np.all(loads[15:18] == 0)


def test_pins_that_leave_a_motion_are_refused() -> None:
    hinge = np.array([1e8, 1e8, 1e8, 0, 0, 0])
    pins = [Pin("a", np.array([0.0, -1, 0]), hinge), Pin("b", np.array([0.0, 1, 0]), hinge)]
    with pytest.raises(ModelError, match="do not hold"):
        pin_load_matrix(pins, np.zeros(3))
