"""The flight before a simulated contact and the roll after it, joined to the simulation.

Not a flight simulation: a smooth path through approach, flare and gusts that ends in exactly the
contact's attitude, rates and velocity, with accelerations that belong to it.  It serves to make
recordings whose truth is known; its shape is deliberately not that of the estimator's model.
"""

from dataclasses import dataclass

import numpy as np
from scipy.signal import butter, lfilter

from solver.arrays import Array
from solver.flight_data.motion import Motion, motion_of_landing
from solver.frames import euler_from_quaternion, quaternion_from_euler
from solver.landing.history import LandingHistory


@dataclass(frozen=True, slots=True)
class Approach:
    """How the aircraft came in."""

    duration: float = 20.0  #: before the contact [s]
    flare: float = 5.0  #: how long before the contact the flare began [s]
    glide_angle: float = np.deg2rad(3.0)  #: before the flare [rad]
    pitch_change: float = np.deg2rad(3.0)  #: nose raised in the flare [rad]
    crab: float = 0.0  #: drift angle taken out in the last seconds [rad]
    deceleration: float = 0.6  #: over ground [m/s2]
    gust: float = 0.25  #: standard deviation of the vertical acceleration [m/s2]
    gust_bandwidth: float = 0.5  #: [Hz]
    pitch_activity: float = np.deg2rad(0.4)  #: standard deviation of the control activity [rad]
    roll_activity: float = np.deg2rad(1.0)  #: [rad]
    yaw_activity: float = np.deg2rad(0.3)  #: [rad]
    roll_out: float = 8.0  #: recorded after the simulation's end [s]
    braking: float = 2.0  #: [m/s2]
    roughness: float = 0.4  #: standard deviation of the vertical acceleration rolling [m/s2]


def fly_in(history: LandingHistory, approach: Approach, rng: np.random.Generator) -> Motion:
    """Join approach, simulated landing and roll-out into one motion, time 0 at the contact.

    Parameters
    ----------
    history : LandingHistory
        Its output interval becomes the grid of all.
    approach : Approach
    rng : numpy.random.Generator
        Gusts and control activity.
    """
    landing = motion_of_landing(history)
    step = landing.interval
    before = _before(landing, approach, step, rng)
    after = _after(landing, approach, step, rng)

    def joined(name: str) -> Array:
        return np.concatenate([getattr(part, name) for part in (before, landing, after)])

    return Motion(
        time=joined("time"),
        origin=landing.origin,
        position=joined("position"),
        velocity=joined("velocity"),
        acceleration=joined("acceleration"),
        attitude=joined("attitude"),
        rate=joined("rate"),
        rate_derivative=joined("rate_derivative"),
        strokes={
            gear: np.concatenate(
                [np.full(len(before.time), s[0]), s, np.full(len(after.time), s[-1])]
            )
            for gear, s in landing.strokes.items()
        },
        contacts=landing.contacts,
    )


def _before(landing: Motion, approach: Approach, step: float, rng: np.random.Generator) -> Motion:
    time = -step * np.arange(round(approach.duration / step), 0, -1, dtype=np.float64)
    grid = np.append(time, 0.0)
    roll, pitch, yaw = (float(a) for a in euler_from_quaternion(landing.attitude[0]))
    p, q, r = landing.rate[0]
    # Euler rates from body rates, ISO 1151-1.
    roll_rate = p + np.tan(pitch) * (q * np.sin(roll) + r * np.cos(roll))
    pitch_rate = q * np.cos(roll) - r * np.sin(roll)
    yaw_rate = (q * np.sin(roll) + r * np.cos(roll)) / np.cos(pitch)
    angles = np.array(
        [
            _held(grid, 0.0, roll, roll_rate, 4.0, approach.roll_activity, 0.4, rng),
            _held(
                grid,
                pitch - approach.pitch_change,
                pitch,
                pitch_rate,
                approach.flare,
                approach.pitch_activity,
                0.5,
                rng,
            ),
            _held(grid, yaw + approach.crab, yaw, yaw_rate, 3.0, approach.yaw_activity, 0.3, rng),
        ]
    )
    rate = _body_rates(grid, angles)

    speed = float(landing.velocity[0, 0])
    forward = speed - approach.deceleration * grid
    glide = float(np.tan(approach.glide_angle)) * speed
    shake = _band_noise(len(grid), step, approach.gust_bandwidth, rng) * approach.gust
    sink_flare = _eased(
        grid,
        glide,
        float(landing.velocity[0, 2]),
        float(landing.acceleration[0, 2] - shake[-1]),
        approach.flare,
    )
    down = np.gradient(sink_flare, step) + shake
    acceleration = np.stack([np.full_like(grid, -approach.deceleration), 0.0 * grid, down], axis=1)
    velocity = np.stack([forward, 0.0 * grid, _integral(down, step)], axis=1)
    velocity[:, 1:] += landing.velocity[0, 1:] - velocity[-1, 1:]
    position = np.stack([_integral(column, step) for column in velocity.T], axis=1)
    position += landing.position[0] - position[-1]
    keep = slice(0, len(time))
    return Motion(
        time=time,
        origin=landing.origin,
        position=position[keep],
        velocity=velocity[keep],
        acceleration=acceleration[keep],
        attitude=np.array([quaternion_from_euler(*a) for a in angles.T[keep]]),
        rate=rate[keep],
        rate_derivative=np.gradient(rate, step, axis=0)[keep],
        strokes={},
    )


def _after(landing: Motion, approach: Approach, step: float, rng: np.random.Generator) -> Motion:
    count = round(approach.roll_out / step)
    passed = step * np.arange(1, count + 1)
    speed = float(landing.velocity[-1, 0])
    braking = np.where(passed < speed / approach.braking, approach.braking, 0.0)
    velocity = np.zeros((count, 3))
    velocity[:, 0] = np.maximum(speed - approach.braking * passed, 0.0)
    position = np.tile(landing.position[-1], (count, 1))
    position[:, 0] += np.cumsum(velocity[:, 0]) * step
    shake = _band_noise(count, step, 3.0, rng) * approach.roughness
    acceleration = np.stack([-braking, np.zeros(count), shake], axis=1)
    zero = np.zeros((count, 3))
    return Motion(
        time=landing.time[-1] + passed,
        origin=landing.origin,
        position=position,
        velocity=velocity,
        acceleration=acceleration,
        attitude=np.tile(landing.attitude[-1], (count, 1)),
        rate=zero,
        rate_derivative=zero,
        strokes={},
    )


def _eased(time: Array, first: float, last: float, slope: float, duration: float) -> Array:
    """Cubic from ``first`` at rest to ``last`` with ``slope`` at time 0, constant before it."""
    s = np.clip(1.0 + time / duration, 0.0, 1.0)
    rise = s * s * (3.0 - 2.0 * s)
    return np.asarray(first + (last - first) * rise + slope * duration * s * s * (s - 1.0))


def _held(
    time: Array,
    first: float,
    last: float,
    slope: float,
    duration: float,
    sd: float,
    bandwidth: float,
    rng: np.random.Generator,
) -> Array:
    """As `_eased`, with band-limited activity that goes on until time 0.

    The cubic gives way so that value and slope at time 0 are still exactly those asked for.
    """
    step = float(time[1] - time[0])
    activity = _band_noise(len(time), step, bandwidth, rng) * sd
    end_slope = float(activity[-1] - activity[-2]) / step
    course = _eased(time, first, last, slope - end_slope, duration)
    return np.asarray(course + activity - activity[-1])


def _band_noise(count: int, step: float, bandwidth: float, rng: np.random.Generator) -> Array:
    """Noise of unit variance below a bandwidth [Hz], second-order Butterworth."""
    settle = round(2.0 / bandwidth / step)
    numerator, denominator = butter(2, bandwidth, fs=1.0 / step)
    noise = lfilter(numerator, denominator, rng.standard_normal(count + settle))[settle:]
    # White noise of unit variance through the filter keeps (noise bandwidth) / (Nyquist) of it;
    # for the second order the noise bandwidth is 1.11 of the corner (pi / 4 / sin(pi / 4)).
    return np.asarray(noise / np.sqrt(1.11 * bandwidth * 2.0 * step))


def _integral(values: Array, step: float) -> Array:
    """Cumulative trapezium, zero at the first sample."""
    return np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2) * step])


def _body_rates(time: Array, angles: Array) -> Array:
    """(nt, 3) body rates from roll, pitch, yaw (3, nt), ISO 1151-1."""
    roll, pitch, _ = angles
    roll_rate, pitch_rate, yaw_rate = (np.gradient(a, time) for a in angles)
    p = roll_rate - yaw_rate * np.sin(pitch)
    q = pitch_rate * np.cos(roll) + yaw_rate * np.sin(roll) * np.cos(pitch)
    r = -pitch_rate * np.sin(roll) + yaw_rate * np.cos(roll) * np.cos(pitch)
    return np.stack([p, q, r], axis=1)
