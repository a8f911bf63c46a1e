"""What a point of a rigid body feels: closed forms, and independence of the frame."""

from dataclasses import replace

import numpy as np
import pytest

from solver.flight_data.lever import rise, rise_rate
from solver.flight_data.motion import Motion, height_at, specific_force_at, velocity_at
from solver.frames import quaternion_from_euler, rotation_matrix

G = 9.80665


def still(count: int = 5) -> Motion:
    zero = np.zeros((count, 3))
    return Motion(
        time=np.arange(count) * 0.01,
        origin=np.array([9.0, 0.0, 2.0]),
        position=zero,
        velocity=zero,
        acceleration=zero,
        attitude=np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
        rate=zero,
        rate_derivative=zero,
        strokes={},
    )


def test_at_rest_every_point_feels_one_g_upward() -> None:
    force = specific_force_at(still(), np.array([3.0, 1.0, 4.0]))
    np.testing.assert_allclose(force, np.tile([0.0, 0.0, -G], (5, 1)), atol=1e-12)


def test_at_rest_with_the_nose_up_gravity_splits_by_sine_and_cosine() -> None:
    turned = replace(still(), attitude=np.tile(quaternion_from_euler(0.0, 0.1, 0.0), (5, 1)))
    force = specific_force_at(turned, np.zeros(3))
    np.testing.assert_allclose(force[0], [G * np.sin(0.1), 0.0, -G * np.cos(0.1)], atol=1e-12)


def test_steady_turn_adds_the_centripetal_acceleration() -> None:
    # A point r ahead of a steadily pitching origin is pulled back with q^2 r (closed form).
    pitching = replace(still(), rate=np.tile([0.0, 0.4, 0.0], (5, 1)))
    ahead = pitching.origin + np.array([-5.0, 0.0, 0.0])  # structural x is aft
    force = specific_force_at(pitching, ahead)
    np.testing.assert_allclose(force[0], [-(0.4**2) * 5.0, 0.0, -G], atol=1e-12)


def test_angular_acceleration_lifts_the_point_ahead() -> None:
    # Nose-up acceleration of 2 rad/s2 lifts a point 5 m ahead with 10 m/s2 (closed form).
    starting = replace(still(), rate_derivative=np.tile([0.0, 2.0, 0.0], (5, 1)))
    ahead = starting.origin + np.array([-5.0, 0.0, 0.0])
    assert specific_force_at(starting, ahead)[0, 2] == pytest.approx(-G - 10.0)


def test_specific_force_does_not_depend_on_the_reference_point(motion: Motion) -> None:
    point, other = np.array([3.0, 1.0, 1.0]), np.array([14.0, -2.0, 3.0])
    turn = rotation_matrix(motion.attitude)
    force = specific_force_at(motion, other)
    moved = replace(
        motion,
        origin=other,
        acceleration=np.einsum("tij,tj->ti", turn, force) + np.array([0.0, 0.0, G]),
    )
    np.testing.assert_allclose(
        specific_force_at(moved, point), specific_force_at(motion, point), atol=1e-9
    )


def test_specific_force_does_not_depend_on_the_runway_heading(motion: Motion) -> None:
    half = np.array([np.cos(0.6), 0.0, 0.0, np.sin(0.6)])  # earth axes turned by 1.2 rad
    turn = rotation_matrix(half)
    w, v = motion.attitude[:, :1], motion.attitude[:, 1:]
    attitude = np.concatenate(
        [
            half[0] * w - v @ half[1:, None],
            half[0] * v + w * half[1:] + np.cross(half[1:], v),
        ],
        axis=1,
    )
    turned = replace(motion, attitude=attitude, acceleration=motion.acceleration @ turn.T)
    point = np.array([3.0, 1.0, 1.0])
    np.testing.assert_allclose(
        specific_force_at(turned, point), specific_force_at(motion, point), atol=1e-9
    )


def test_velocity_of_a_point_is_the_derivative_of_its_height(motion: Motion) -> None:
    point = np.array([3.0, 1.0, 1.0])
    height, speed = height_at(motion, point), -velocity_at(motion, point)[:, 2]
    derivative = np.gradient(height, motion.time)
    before = motion.time < -0.1
    np.testing.assert_allclose(derivative[before][5:-5], speed[before][5:-5], atol=2e-3)


def test_flight_joins_the_simulated_contact(motion: Motion) -> None:
    at = int(np.argmin(np.abs(motion.time)))
    step = motion.interval
    for name in ("position", "velocity", "attitude", "rate"):
        values = getattr(motion, name)
        jump = np.abs(values[at] - values[at - 1]).max()
        assert jump < 0.3 * (1.0 if name != "position" else 62.0) * step * 10, name


def test_lever_is_the_exact_rotation() -> None:
    arm = np.array([4.0, 1.5, 1.9])
    turn = rotation_matrix(quaternion_from_euler(0.05, 0.08, 0.7))
    assert rise(arm, 0.08, 0.05) == pytest.approx(-(turn @ arm)[2], abs=1e-14)


def test_lever_rate_is_its_derivative() -> None:
    arm, step = np.array([4.0, 1.5, 1.9]), 1e-6
    later = rise(arm, 0.08 + 0.1 * step, 0.05 - 0.2 * step)
    earlier = rise(arm, 0.08 - 0.1 * step, 0.05 + 0.2 * step)
    numeric = float(later - earlier) / (2 * step)
    assert rise_rate(arm, 0.08, 0.05, 0.1, -0.2) == pytest.approx(numeric, rel=1e-7)
