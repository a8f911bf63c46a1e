"""Measurements of the vertical smoother: altimeters, inertial speed, touches, rolling."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.course import Course
from solver.flight_data.geometry import Geometry, antenna_height
from solver.flight_data.lever import rise
from solver.flight_data.vertical_acceleration import VerticalSources
from solver.flight_data.vertical_course import (
    HEIGHT,
    INERTIAL_DELAY,
    INERTIAL_OFFSET,
    PER_RADIO,
    RADIO,
    SPEED,
    Touch,
    VerticalCourse,
)
from solver.frames import body_structural

#: Vertical speed of the accelerometer while the aircraft rolls [m/s].
_ROLLING_SPEED_SD = 0.05

#: Interval at which the rolling aircraft is held to it [s].
_ROLLING_INTERVAL = 0.5

#: Radius of a tyre, its wear and the runway under it [m].  Where the sensor sits does not matter:
#: an error of its height is the same at the touch and after it.
_TYRE_SD = 0.02

#: Sink rate taken for the first pass [m/s].
_USUAL_SINK = 1.5

#: In a shock the inertial vertical speed shows its own filter: error per acceleration [s].
_INERTIAL_LAG = 0.1


@dataclass(frozen=True, slots=True)
class Measurement:
    """``value = row . state`` with this variance."""

    time: float  #: [s]
    row: Array  #: (n,)
    value: float
    variance: float


@dataclass(frozen=True, slots=True)
class VerticalMeasurements:
    """Maker of the measurements of one window."""

    sources: VerticalSources
    pitch: Course
    roll: Course
    geometry: Geometry
    over_runway_from: float  #: radio altitude before that is over other ground [s]
    span: tuple[float, float]  #: [s]

    @property
    def size(self) -> int:
        """Length of the state."""
        return RADIO + PER_RADIO * len(self.sources.radio)

    def all(
        self,
        touches: tuple[Touch, ...],
        rolling_from: float | None,
        rough: VerticalCourse | None,
    ) -> list[Measurement]:
        """Measurements in order of time.

        The delays act on speed and acceleration: ``rough`` gives them, None in the first pass.
        """
        found = self._radio(rough) + self._inertial(rough) + self._touches(touches, rough)
        if rolling_from is not None:
            found += self._rolling(rolling_from)
        return sorted(found, key=lambda each: each.time)

    def _row(self, entries: dict[int, float]) -> Array:
        row = np.zeros(self.size)
        for index, value in entries.items():
            row[index] = value
        return row

    def _radio(self, rough: VerticalCourse | None) -> list[Measurement]:
        """Compare with ``(1 + scale) altitude + bias``, a delay ago."""
        found = []
        installation = self.geometry.installation
        arm = body_structural(installation.antenna - installation.accelerometer)
        zero = antenna_height(self.geometry)
        for index, radio in enumerate(self.sources.radio):
            bias, scale, delay = (RADIO + PER_RADIO * index + k for k in range(PER_RADIO))
            over = rise(arm, self.pitch.at(radio.time), self.roll.at(radio.time))
            start = max(self.over_runway_from, self.span[0])
            for k in np.flatnonzero((radio.time > start) & (radio.time < self.span[1])):
                time, shown = float(radio.time[k]), float(radio.value[k])
                speed = 0.0 if rough is None else rough.speed_at(time)
                row = self._row({HEIGHT: 1.0, bias: 1.0, scale: shown, delay: -speed})
                found.append(Measurement(time, row, shown - float(over[k]) + zero, radio.sd**2))
        return found

    def _inertial(self, rough: VerticalCourse | None) -> list[Measurement]:
        found = []
        for series in self.sources.inertial:
            for k in np.flatnonzero((series.time > self.span[0]) & (series.time < self.span[1])):
                time = float(series.time[k])
                up = 0.0 if rough is None else rough.acceleration_at(time)
                row = self._row({SPEED: 1.0, INERTIAL_OFFSET: 1.0, INERTIAL_DELAY: -up})
                variance = series.sd**2 + (_INERTIAL_LAG * up) ** 2
                found.append(Measurement(time, row, float(series.value[k]), variance))
        return found

    def _touches(
        self, touches: tuple[Touch, ...], rough: VerticalCourse | None
    ) -> list[Measurement]:
        """Hold the lowest wheel to height zero."""
        found = []
        for touch in touches:
            _, pitch = self.pitch.state(touch.time)
            _, roll = self.roll.state(touch.time)
            lowest, arm = self._lowest(touch.wheels, touch.time)
            speed = _USUAL_SINK if rough is None else rough.speed_at(touch.time)
            variance = (speed * touch.sd) ** 2 + _TYRE_SD**2
            variance += arm[0] ** 2 * pitch[0, 0] + arm[1] ** 2 * roll[0, 0]
            found.append(Measurement(touch.time, self._row({HEIGHT: 1.0}), -lowest, variance))
        return found

    def _rolling(self, rolling_from: float) -> list[Measurement]:
        """Hold the speed to zero, and once the height to that of an aircraft on its wheels."""
        times = np.arange(rolling_from, self.span[1], _ROLLING_INTERVAL)
        still = self._row({SPEED: 1.0})
        found = [Measurement(float(time), still, 0.0, _ROLLING_SPEED_SD**2) for time in times]
        if len(times):
            last = float(times[-1])
            mains = tuple(wheel.gear for wheel in self.geometry.mains)
            height = -self._lowest(mains, last)[0] - self.geometry.static_closure
            variance = self.geometry.static_closure_sd**2
            found.append(Measurement(last, self._row({HEIGHT: 1.0}), height, variance))
        return found

    def _lowest(self, wheels: tuple[str, ...], time: float) -> tuple[float, Array]:
        """How far the lowest wheel is above the sensor (it is below: negative), and its arm."""
        pitch, roll = float(self.pitch.at(time)), float(self.roll.at(time))
        drops = []
        for wheel in self.geometry.wheels:
            if wheel.gear in wheels:
                arm = body_structural(wheel.position - self.geometry.installation.accelerometer)
                drops.append((float(rise(arm, pitch, roll)), arm))
        return min(drops, key=lambda drop: drop[0])
