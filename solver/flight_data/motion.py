"""The motion of a rigid aircraft through a whole landing, and what a point fixed to it feels."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.frames import body_structural, rotation_matrix
from solver.landing.history import GroundContact, LandingHistory
from solver.landing.records import GRAVITY


@dataclass(frozen=True, slots=True)
class Motion:
    """Motion on a uniform grid; earth axes have x along the runway and z normal to it, downward."""

    time: Array  #: (nt,) [s]
    origin: Array  #: (3,) the point whose motion this is, structural axes [m]
    position: Array  #: (nt, 3) earth axes, z 0 at the runway [m]
    velocity: Array  #: (nt, 3) earth axes [m/s]
    acceleration: Array  #: (nt, 3) earth axes [m/s2]
    attitude: Array  #: (nt, 4) quaternion, body to earth
    rate: Array  #: (nt, 3) body axes [rad/s]
    rate_derivative: Array  #: (nt, 3) body axes [rad/s2]
    strokes: dict[str, Array]  #: gear to (nt,) closure of its strut [m]
    contacts: tuple[GroundContact, ...] = ()  #: what really happened

    @property
    def interval(self) -> float:
        """Of the grid [s]."""
        return float(self.time[1] - self.time[0])

    def arm(self, point: Array) -> Array:
        """(3,) from the origin to a point given in structural axes, body axes [m]."""
        return body_structural(np.asarray(point) - self.origin)


def motion_of_landing(history: LandingHistory) -> Motion:
    """Motion of the airframe's centre of gravity in a simulated landing."""
    turn = rotation_matrix(history.attitude)
    return Motion(
        time=history.time,
        origin=history.origin,
        position=history.position,
        velocity=np.einsum("tij,tj->ti", turn, history.velocity),
        acceleration=np.einsum("tij,tj->ti", turn, history.acceleration),
        attitude=history.attitude,
        rate=history.rate,
        rate_derivative=history.rate_derivative,
        strokes={gear.name: gear.stroke for gear in history.gears},
        contacts=history.contacts,
    )


def specific_force_at(motion: Motion, point: Array) -> Array:
    """Derive what an accelerometer fixed at a point measures, body axes.

    Parameters
    ----------
    motion : Motion
    point : (3,) array
        Structural axes [m].

    Returns
    -------
    (nt, 3) array
        Acceleration of the point less gravity [m/s2].

    Notes
    -----
    ``a_P = a_O + omega' x r + omega x (omega x r)``; rigid-body kinematics, e.g. Meriam & Kraige,
    Engineering Mechanics: Dynamics, eq. 7/2 ff. with r fixed in the body.
    """
    arm = motion.arm(point)
    turn = rotation_matrix(motion.attitude)
    inertial = motion.acceleration - np.array([0.0, 0.0, GRAVITY])
    force = np.einsum("tji,tj->ti", turn, inertial)
    force = force + np.cross(motion.rate_derivative, arm)
    return np.asarray(force + np.cross(motion.rate, np.cross(motion.rate, arm)))


def velocity_at(motion: Motion, point: Array) -> Array:
    """Velocity of a point fixed to the aircraft, (nt, 3) earth axes [m/s]."""
    turn = rotation_matrix(motion.attitude)
    swing = np.cross(motion.rate, motion.arm(point))
    return np.asarray(motion.velocity + np.einsum("tij,tj->ti", turn, swing))


def height_at(motion: Motion, point: Array) -> Array:
    """Height of a point fixed to the aircraft above the runway, (nt,) [m]."""
    turn = rotation_matrix(motion.attitude)
    return np.asarray(-(motion.position[:, 2] + turn[:, 2, :] @ motion.arm(point)))
