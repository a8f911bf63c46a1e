"""Samples put back to when they were true, with the error of each, as the frame tells."""

from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.flight_data.anti_alias import filter_delay
from solver.flight_data.frame import Certainty, Figure, RecordedParameter
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.parameter import ACCELERATIONS, HEADINGS, Parameter
from solver.flight_data.window import Channel, Window

#: Frame taken where nobody says which it is: every error wide, rate and step from the data.
UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Series:
    """One channel on the time of the aircraft."""

    channel: Channel
    entry: RecordedParameter
    time: Array  #: (n,) of the event shown: filed time less delay and filter delay [s]
    value: Array  #: (n,)
    sd: float  #: of what is independent from sample to sample: noise and step

    @property
    def lag(self) -> float:
        """Part of the delay that is the filter's; it smears rather than shifts [s]."""
        return filter_delay(self.entry.corner.value)

    @property
    def interval(self) -> float:
        """Between samples [s]."""
        return 1.0 / self.channel.rate if self.channel.rate > 0 else np.inf


def aligned(window: Window, parameter: Parameter) -> tuple[Series, ...]:
    """All sources of a parameter on the time of the aircraft."""
    return tuple(_series(channel, window) for channel in window.of(parameter))


def best(window: Window, parameter: Parameter) -> Series | None:
    """Source of the highest rate."""
    channel = window.first(parameter)
    return None if channel is None else _series(channel, window)


def entry_of(channel: Channel, window: Window) -> RecordedParameter:
    """Frame's entry for a channel, or the wide one where the frame does not hold it."""
    found = window.frame and window.frame.find(channel.parameter, channel.source)
    if found:
        return found
    wide = packaged_frame(UNKNOWN).require(channel.parameter)
    step = np.diff(np.unique(channel.value))
    resolution = float(step.min()) if len(step) else 0.0
    corner = channel.rate / 2 if channel.parameter in ACCELERATIONS else 0.0
    return replace(
        wide,
        rate=Figure(channel.rate, Certainty.COMPUTED),
        resolution=Figure(resolution, Certainty.COMPUTED),
        corner=Figure(corner, Certainty.ASSUMED),
    )


def _series(channel: Channel, window: Window) -> Series:
    entry = entry_of(channel, window)
    delay = entry.delay.value + filter_delay(entry.corner.value)
    # A step of q leaves an error uniform over it: variance q^2 / 12.
    sd = float(np.hypot(entry.noise.value, entry.resolution.value / np.sqrt(12.0)))
    value = np.unwrap(channel.value) if channel.parameter in HEADINGS else channel.value
    return Series(channel, entry, channel.time - delay, value, sd)
