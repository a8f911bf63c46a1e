"""Rotation of a fitting against an independent library and against its own derivatives."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from solver.arrays import Array
from solver.flexible_landing.fitting import put_rotation, tangent_rate
from solver.frames import skew

#: On both sides of the change from series to closed form, and beyond.
ANGLES = [0.0, 1e-3, 0.0099, 0.0101, 0.3, 2.0]


def rotation(theta: Array) -> tuple[Array, Array]:
    turn, tangent = np.zeros((3, 3)), np.zeros((3, 3))
    put_rotation(tuple(theta), turn, tangent)
    return turn, tangent


@pytest.mark.parametrize("angle", ANGLES)
def test_matrix_is_that_of_the_rotation_vector(angle: float) -> None:
    theta = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    expected = Rotation.from_rotvec(theta).as_matrix()
    assert np.abs(rotation(theta)[0] - expected).max() < 1e-14


@pytest.mark.parametrize("angle", ANGLES)
def test_tangent_gives_the_angular_velocity(angle: float) -> None:
    theta = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    rate = np.array([0.3, 0.7, -0.2])
    step = 1e-5
    change = rotation(theta + step * rate)[0] - rotation(theta - step * rate)[0]
    spin = change / (2 * step) @ rotation(theta)[0].T
    # Central differences are off by the square of the step.
    assert np.abs(spin - skew(rotation(theta)[1] @ rate)).max() < 1e-9


@pytest.mark.parametrize("angle", ANGLES)
def test_bias_is_the_change_of_the_tangent(angle: float) -> None:
    theta = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    rate = np.array([0.3, 0.7, -0.2])
    step = 1e-5
    ahead, behind = (rotation(theta + s * step * rate)[1] @ rate for s in (1.0, -1.0))
    assert np.abs((ahead - behind) / (2 * step) - tangent_rate(tuple(theta), tuple(rate))).max() < (
        1e-9
    )
