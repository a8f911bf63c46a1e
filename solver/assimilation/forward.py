"""From parameters to predicted samples: simulate, and show it as the recorder does."""

from collections.abc import Sequence

import numpy as np

from solver.arrays import Array
from solver.assimilation.samples import ChannelSamples
from solver.assimilation.sensor import SensorCourses
from solver.assimilation.state import Prior, accelerometer, channel_errors, simulated
from solver.errors import SolverError
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Landings kept: more than one set of derivatives takes, few enough to forget about memory.
_KEPT = 64

#: Grid of the simulated courses: ten points to a swing of a leg at 25 Hz [s].
_INTERVAL = 4e-3


class LandingPrediction:
    """Predicted samples as a function of independent parameters of unit variance.

    A landing that was simulated is kept: most parameters of the recorder need none.
    """

    def __init__(self, prior: Prior, channels: Sequence[ChannelSamples], last: float) -> None:
        self._prior = prior
        self._channels = channels
        self._options = SimulationOptions(
            output_interval=_INTERVAL,
            time_limit=max(last, 2 * _INTERVAL),
            stop_when_settled=False,
        )
        self._histories: dict[bytes, LandingHistory | None] = {}
        self._courses_kept: dict[tuple[bytes, bytes], SensorCourses] = {}

    def __call__(self, whitened: Array) -> Array | None:
        """(n,) parameters to (m,) samples of all channels; None if it cannot be simulated."""
        parts = self.by_channel(whitened)
        return None if parts is None else np.concatenate(parts)

    def by_channel(self, whitened: Array) -> list[Array] | None:
        """As a call, one array for each channel."""
        values = self._prior.named(whitened)
        courses = self._courses(whitened, accelerometer(self._prior, values))
        if courses is None:
            return None
        return [
            courses.predicted(channel.entry, channel.time, channel_errors(channel, values))
            for channel in self._channels
        ]

    def _courses(self, whitened: Array, place: Array) -> SensorCourses | None:
        key = whitened[: self._prior.simulated_count].tobytes()
        if key not in self._histories:
            aircraft, contact = simulated(self._prior, self._prior.named(whitened))
            try:
                self._histories[key] = simulate_landing(
                    aircraft, contact, self._options, self._prior.believed.wheel_speeds
                )
            except SolverError:
                # A step too far; the iteration takes a shorter one.
                self._histories[key] = None
            if len(self._histories) > _KEPT:
                self._histories.pop(next(iter(self._histories)))
        history = self._histories[key]
        if history is None:
            return None
        at = (key, place.tobytes())
        if at not in self._courses_kept:
            self._courses_kept[at] = SensorCourses(history, place)
            if len(self._courses_kept) > _KEPT:
                self._courses_kept.pop(next(iter(self._courses_kept)))
        return self._courses_kept[at]
