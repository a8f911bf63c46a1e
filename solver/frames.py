"""Frames and rotations: the one place where a sign is flipped.

Body axes (ISO 1151): x forward, y starboard, z down.
Earth axes: x along the runway, y to its right, z down.
Structural axes: x aft, y starboard, z up (those of the airframe's bulk data).
Attitude is a unit quaternion ``(w, x, y, z)`` that turns body components into earth components.
"""

import numpy as np

from solver.arrays import Array

#: Structural axes from body axes and back: x and z change sign (a half turn about y).
BODY_STRUCTURAL = np.array([-1.0, 1.0, -1.0])


def body_structural(vectors: Array) -> Array:
    """Turn body components into structural ones, or back (the turn is its own inverse).

    Parameters
    ----------
    vectors : (..., 3) array
        True or axial vectors (forces, moments, rates); both turn alike, as no mirror is involved.
    """
    turned: Array = vectors * BODY_STRUCTURAL
    return turned


def skew(vector: Array) -> Array:
    """Matrix of the cross product, ``skew(a) @ b == cross(a, b)``, from (..., 3) arrays."""
    x, y, z = vector[..., 0], vector[..., 1], vector[..., 2]
    zero = np.zeros_like(x)
    rows = [zero, -z, y, z, zero, -x, -y, x, zero]
    return np.stack(rows, axis=-1).reshape(*x.shape, 3, 3)


def quaternion_from_euler(roll: float, pitch: float, yaw: float) -> Array:
    """Attitude from the yaw-pitch-roll sequence of ISO 1151 (angles in rad)."""
    cr, sr = np.cos(roll / 2), np.sin(roll / 2)
    cp, sp = np.cos(pitch / 2), np.sin(pitch / 2)
    cy, sy = np.cos(yaw / 2), np.sin(yaw / 2)
    return np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )


def rotation_matrix(quaternion: Array) -> Array:
    """Matrix that turns body components into earth components; shape (..., 4) to (..., 3, 3)."""
    w, x, y, z = (quaternion[..., k] for k in range(4))
    rows = [
        1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
        2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
        2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
    ]  # fmt: skip
    return np.stack(rows, axis=-1).reshape(*w.shape, 3, 3)


def euler_from_quaternion(quaternion: Array) -> tuple[Array, Array, Array]:
    """Roll, pitch and yaw [rad] of attitudes (..., 4), inverting the sequence above."""
    w, x, y, z = (quaternion[..., k] for k in range(4))
    roll = np.arctan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - x * z), -1.0, 1.0))
    yaw = np.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))
    return roll, pitch, yaw
