"""Peaks of a landing with their times, refined between the samples of the grid."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.landing.history import GearHistory, LandingHistory


@dataclass(frozen=True, slots=True)
class Peak:
    """Largest value of a history and when it occurs."""

    value: float
    time: float  #: [s]


@dataclass(frozen=True, slots=True)
class GearPeaks:
    """Peaks of one gear over the whole landing."""

    gear: str
    vertical_force: Peak  #: of the ground on the tyres, upward [N]
    drag_force: Peak  #: aft (spin-up) [N]
    forward_force: Peak  #: ground force forward [N]
    side_force: Peak  #: magnitude [N]
    strut_force: Peak  #: [N]
    pivot_drag_force: Peak  #: aft force of the gear on the airframe, spring-back included [N]
    pivot_forward_force: Peak  #: forward, spring-back [N]
    stroke: Peak  #: [m]
    tyre_deflection: Peak  #: [m]
    wheel_speed: Peak  #: [rad/s]


def refined_peak(time: Array, values: Array) -> tuple[float, float]:
    """Time and value of the maximum, by a parabola through the largest sample and its neighbours.

    The parabola's gain is kept only where the three samples are those of one smooth hump: it is at
    most an eighth of the larger drop, which holds of itself for equal spacing.
    """
    index = int(np.argmax(values))
    if index in (0, len(values) - 1):
        return float(time[index]), float(values[index])
    left, top, right = (float(value) for value in values[index - 1 : index + 2])
    bend = left - 2 * top + right
    if bend == 0:
        return float(time[index]), top
    shift = 0.5 * (left - right) / bend
    step = float(time[index + 1] - time[index])
    return float(time[index]) + shift * step, top - 0.25 * (left - right) * shift


def gear_peaks(history: LandingHistory) -> tuple[GearPeaks, ...]:
    """Peaks of every gear."""
    return tuple(_peaks(history.time, gear) for gear in history.gears)


def _peaks(time: Array, gear: GearHistory) -> GearPeaks:
    def peak(values: Array) -> Peak:
        moment, value = refined_peak(time, values)
        return Peak(value, moment)

    return GearPeaks(
        gear=gear.name,
        vertical_force=peak(-gear.ground_force[:, 2]),
        drag_force=peak(-gear.ground_force[:, 0]),
        forward_force=peak(gear.ground_force[:, 0]),
        side_force=peak(np.abs(gear.ground_force[:, 1])),
        strut_force=peak(gear.strut_force),
        pivot_drag_force=peak(-gear.wrench[:, 0]),
        pivot_forward_force=peak(gear.wrench[:, 0]),
        stroke=peak(gear.stroke),
        tyre_deflection=peak(gear.tyre_deflection),
        wheel_speed=peak(gear.wheel_speed),
    )
