"""A recorder window: channels at their native rates, and what was done to them on the way in."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.frame import RecorderFrame
from solver.flight_data.parameter import Parameter


@dataclass(frozen=True, slots=True)
class Channel:
    """One parameter of one source, never resampled."""

    parameter: Parameter
    source: str  #: "" where there is one only, else as "L", "R", "1", "A"
    time: Array  #: (n,) rising, of one clock for the whole window [s]
    value: Array  #: (n,) SI, load factors in g, headings unwrapped

    @property
    def rate(self) -> float:
        """Samples per second, from the median interval; 0 with fewer than two samples [Hz]."""
        if len(self.time) < 2:
            return 0.0
        return float(1.0 / np.median(np.diff(self.time)))

    @property
    def label(self) -> str:
        """Parameter and source for messages."""
        return f"{self.parameter} {self.source}".strip()


@dataclass(frozen=True, slots=True)
class Note:
    """One thing that was found or changed in a window."""

    code: str  #: for a machine: "unknown_column", "duplicates", "datum", ...
    text: str


@dataclass(frozen=True, slots=True)
class Window:
    """Some seconds of recording around a landing."""

    channels: tuple[Channel, ...]
    frame: RecorderFrame | None = None  #: None: unknown, errors are then taken wide
    notes: tuple[Note, ...] = ()

    def of(self, parameter: Parameter) -> tuple[Channel, ...]:
        """Every source of a parameter."""
        return tuple(c for c in self.channels if c.parameter is parameter)

    def first(self, parameter: Parameter) -> Channel | None:
        """Source with the highest rate, None if the parameter is not recorded."""
        return max(self.of(parameter), key=lambda c: c.rate, default=None)

    @property
    def start(self) -> float:
        """First sample of any channel [s]."""
        return min(float(c.time[0]) for c in self.channels)

    @property
    def end(self) -> float:
        """Last sample of any channel [s]."""
        return max(float(c.time[-1]) for c in self.channels)
