"""The same rigid motion described at two points of the frame."""

import numpy as np

from solver.frames import skew
from solver.inertia_relief.motion import RigidMotion, rate_products


def random_motion(seed: int, count: int = 7) -> RigidMotion:
    rng = np.random.default_rng(seed)
    return RigidMotion(*(rng.standard_normal(shape) for shape in [(3,), *[(count, 3)] * 4]))


def test_acceleration_of_another_point_follows_rigid_kinematics():
    motion = random_motion(1)
    point = np.array([3.0, -1.0, 2.0])
    moved = motion.at(point)
    arm = point - motion.origin
    for n in range(7):
        turn, turn_derivative = skew(motion.rate[n]), skew(motion.rate_derivative[n])
        expected = motion.acceleration[n] + (turn_derivative + turn @ turn) @ arm
        np.testing.assert_allclose(moved.acceleration[n], expected, rtol=1e-13)
    np.testing.assert_allclose(
        moved.at(motion.origin).acceleration, motion.acceleration, atol=1e-13
    )


def test_rate_products_reproduce_the_squared_turn_matrix():
    rate = np.array([[0.3, -0.2, 0.7]])
    xx, yy, zz, xy, xz, yz = rate_products(rate)[0]
    outer = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    turn = skew(rate[0])
    np.testing.assert_allclose(turn @ turn, outer - np.trace(outer) * np.eye(3), atol=1e-15)
