"""What a recorder shows of a landing: sensor, filter, delay, sampling, errors, steps, overflow."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.anti_alias import anti_aliased
from solver.flight_data.frame import RecordedParameter, RecorderFrame
from solver.flight_data.geometry import Geometry, antenna_height
from solver.flight_data.motion import Motion, height_at, specific_force_at, velocity_at
from solver.flight_data.parameter import HEADINGS, SWITCHES, Parameter
from solver.flight_data.window import Channel, Window
from solver.frames import euler_from_quaternion
from solver.gear.place import Place
from solver.landing.records import GRAVITY

#: Closure of a strut at which its ground switch is taken to move [m].
SWITCH_STROKE = 0.02


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What the recorder shows besides the aircraft's motion over the runway."""

    runway_slope: float = 0.0  #: uphill positive; levels and vertical speeds refer to the horizon
    runway_heading: float = 0.0  #: [rad]
    headwind: float = 0.0  #: [m/s]
    mass: float = 0.0  #: [kg]; 0: no gross mass is recorded


def record(
    motion: Motion,
    frame: RecorderFrame,
    geometry: Geometry,
    surroundings: Surroundings,
    seed: int,
) -> Window:
    """Record a motion.

    Parameters
    ----------
    motion : Motion
    frame : RecorderFrame
        What is recorded, and with which errors; a standard deviation is drawn from once.
    geometry : Geometry
        Where the sensors sit.
    surroundings : Surroundings
    seed : int
        The same seed gives the same recording.

    Returns
    -------
    Window
    """
    rng = np.random.default_rng(seed)
    shown = _Shown(motion, geometry, surroundings)
    channels = []
    for entry in frame.parameters:
        values = shown.values(entry.parameter)
        # Drawn even if not shown, so that one parameter's errors do not hang on the others.
        errors = _Errors.drawn(entry, rng)
        seed_noise = int(rng.integers(2**63))
        if values is not None:
            channels.append(_recorded(motion, entry, values, errors, seed_noise))
    kept = tuple(channel for channel in channels if len(channel.time))
    return Window(kept, frame)


@dataclass(frozen=True, slots=True)
class _Errors:
    phase: float  #: of the first sample, in sampling intervals
    bias: float
    scale: float
    delay: float  #: [s]

    @classmethod
    def drawn(cls, entry: RecordedParameter, rng: np.random.Generator) -> "_Errors":
        phase, late = rng.random(2)
        normal = rng.standard_normal(3)
        delay = entry.delay.value + entry.delay_scatter.value * normal[2]
        return cls(
            phase=float(phase),
            bias=float(entry.bias.value * normal[0]),
            scale=float(1.0 + entry.scale.value * normal[1]),
            delay=float(delay + late * entry.late_most.value),
        )


def _recorded(
    motion: Motion, entry: RecordedParameter, values: Array, errors: _Errors, seed: int
) -> Channel:
    rng = np.random.default_rng(seed)
    filtered = anti_aliased(values, entry.corner.value, motion.interval)
    interval = 1.0 / entry.rate.value
    # The frame began long ago: a slow parameter may show no sample at all inside the window.
    first = motion.time[0] + (errors.phase % 1.0) * interval
    time = np.arange(first, motion.time[-1], interval)
    sampled = np.interp(time - errors.delay, motion.time, filtered)
    if entry.parameter in SWITCHES:
        return Channel(entry.parameter, entry.source, time, (sampled > 0.5).astype(np.float64))
    sampled = errors.scale * sampled + errors.bias
    sampled = sampled + entry.noise.value * rng.standard_normal(len(time))
    return Channel(entry.parameter, entry.source, time, quantised(sampled, entry))


def quantised(values: Array, entry: RecordedParameter) -> Array:
    """Values in steps of the resolution, within the range: clipped, or starting again beyond it."""
    least, greatest, step = entry.least.value, entry.greatest.value, entry.resolution.value
    if entry.parameter in HEADINGS:
        values = (values + np.pi) % (2 * np.pi) - np.pi
    elif entry.wraps:
        values = (values - least) % (greatest - least) + least
    else:
        values = np.clip(values, least, greatest)
    return np.asarray(np.round(values / step) * step) if step > 0 else values


class _Shown:
    """True course of each parameter at its sensor, on the motion's grid."""

    def __init__(self, motion: Motion, geometry: Geometry, surroundings: Surroundings) -> None:
        self._motion = motion
        self._geometry = geometry
        self._around = surroundings
        sensor = geometry.installation.accelerometer
        self._force = specific_force_at(motion, sensor) / GRAVITY
        self._velocity = velocity_at(motion, sensor)
        self._angles = euler_from_quaternion(motion.attitude)

    def values(self, parameter: Parameter) -> Array | None:
        roll, pitch, drift = self._angles
        around = self._around
        level = np.ones_like(roll)
        forward = self._velocity[:, 0]
        match parameter:
            case Parameter.NORMAL_ACCELERATION:
                return np.asarray(-self._force[:, 2])
            case Parameter.LATERAL_ACCELERATION:
                return self._force[:, 1]
            case Parameter.LONGITUDINAL_ACCELERATION:
                return self._force[:, 0]
            case Parameter.RADIO_ALTITUDE:
                return self._radio_altitude()
            case Parameter.VERTICAL_SPEED:
                return -self._velocity[:, 2] + around.runway_slope * forward
            case Parameter.PITCH:
                return pitch + around.runway_slope * level
            case Parameter.ROLL:
                return roll
            case Parameter.HEADING:
                return around.runway_heading + drift
            case Parameter.TRACK:
                return around.runway_heading + np.arctan2(self._velocity[:, 1], forward)
            case Parameter.DRIFT:
                return drift - np.arctan2(self._velocity[:, 1], np.maximum(forward, 1.0))
            case Parameter.GROUND_SPEED:
                return np.hypot(forward, self._velocity[:, 1])
            case Parameter.AIRSPEED:
                return forward + around.headwind
            case Parameter.GROSS_MASS:
                return np.asarray(level * around.mass) if around.mass > 0 else None
            case Parameter.GEAR_LEFT | Parameter.GEAR_RIGHT | Parameter.GEAR_NOSE:
                return self._switch(Place(parameter.removeprefix("gear_")))
            case Parameter.GEAR_ANY:
                switches = [self._switch(place) for place in Place]
                return np.asarray(np.max([s for s in switches if s is not None], axis=0))
            case _:
                return None

    def _radio_altitude(self) -> Array:
        installation = self._geometry.installation
        return height_at(self._motion, installation.antenna) - antenna_height(self._geometry)

    def _switch(self, place: Place) -> Array | None:
        strokes = [
            self._motion.strokes[wheel.gear]
            for wheel in self._geometry.of(place)
            if wheel.gear in self._motion.strokes
        ]
        if not strokes:
            return None
        closed = np.max(strokes, axis=0) > SWITCH_STROKE
        return np.asarray(closed, dtype=np.float64)
