"""An aircraft's envelope: how much of its limits a landing uses, and its limit sink rate.

The surface is compared with landings that it was not fitted to; how far they lie beyond it is its
error, which is never left out: a landing is graded by what it may use, not by what is expected.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.mass_states import MassStates
from solver.arrays import Array
from solver.envelope.domain import SINK_RATE, Domain
from solver.envelope.surface import Surface

#: Share of the held-out landings that the error covers, on either side.
COVERED_SHARE = 0.975

#: Sink rates at which an envelope is looked at between the ends of its range.
_GRID = 33


@dataclass(frozen=True, slots=True)
class SurfaceError:
    """How held-out landings lie about the surface, as shares of what it expects."""

    above: float  #: that `COVERED_SHARE` of them do not exceed
    below: float  #: that `COVERED_SHARE` of them do not fall short by
    stops_above: float  #: as ``above``, for the stop ratios
    root_mean_square: float
    landings: int  #: held out, where the surface is graded


@dataclass(frozen=True, slots=True)
class Basis:
    """What an envelope rests on; another program or aircraft has another."""

    content_hash: str  #: of the aircraft's files
    program_version: str
    landings: int  #: fitted
    failed: int  #: that could not be simulated


@dataclass(frozen=True, slots=True)
class Expected:
    """What the envelope expects of one landing, at its sink rate or at any softer one."""

    utilisation: float
    low: float  #: with the surface's error
    high: float
    stop_ratio: float  #: stroke or tyre deflection over its stop, with the error


@dataclass(frozen=True, slots=True)
class LimitSinkRate:
    """Sink rate [m/s] at which a utilisation is reached; infinite beyond the envelope's hardest."""

    value: float
    low: float  #: where it may be reached already, by the surface's error
    high: float


@dataclass(frozen=True, slots=True)
class Course:
    """What landings use of their limits as the sink rate rises and all else stays.

    It never falls: where one part is relieved by a harder contact (the nose wheel comes down
    otherwise), what a softer one would use still counts.
    """

    sink_rates: Array  #: (q,) over the envelope's range [m/s]
    used: Array  #: (q,) largest utilisation up to each
    stops: Array  #: (q,) largest stop ratio up to each
    error: SurfaceError

    def expected(self, sink_rate: float) -> Expected:
        """At a sink rate [m/s]; beyond either end of the range what holds there."""
        utilisation = float(np.interp(sink_rate, self.sink_rates, self.used))
        stops = float(np.interp(sink_rate, self.sink_rates, self.stops))
        return Expected(
            utilisation=utilisation,
            low=utilisation * (1.0 - self.error.below),
            high=utilisation * (1.0 + self.error.above),
            stop_ratio=stops * (1.0 + self.error.stops_above),
        )

    def limit_sink_rate(self, utilisation: float = 1.0) -> LimitSinkRate:
        """Where a utilisation is reached."""
        return LimitSinkRate(
            value=_crossing(self.sink_rates, self.used, utilisation),
            low=_crossing(self.sink_rates, self.used * (1.0 + self.error.above), utilisation),
            high=_crossing(self.sink_rates, self.used * (1.0 - self.error.below), utilisation),
        )


@dataclass(frozen=True, slots=True)
class Envelope:
    """Everything an aircraft's landings need for a first answer."""

    basis: Basis
    domain: Domain
    surface: Surface
    error: SurfaceError
    held_out: Array  #: (n, 2) utilisation expected and found, of landings that were not fitted
    mass_states: MassStates

    def course(self, coordinates: Array) -> Course:
        """Course through coordinates (12,), whatever their own sink rate."""
        return Course(*rising(self.domain, self.surface, coordinates), self.error)


def rising(domain: Domain, surface: Surface, coordinates: Array) -> tuple[Array, Array, Array]:
    """Sink rates (q,) over the box, and the largest utilisation and stop ratio up to each."""
    sink_rates = np.linspace(domain.low[SINK_RATE], domain.high[SINK_RATE], _GRID)
    rows = np.tile(coordinates, (_GRID, 1))
    rows[:, SINK_RATE] = sink_rates
    used, stops = surface(domain.unit(rows))
    return sink_rates, np.maximum.accumulate(used), np.maximum.accumulate(stops)


def _crossing(grid: Array, used: Array, level: float) -> float:
    """Where a rising course first reaches a level; its start if it is there already."""
    reached = np.flatnonzero(used >= level)
    if len(reached) == 0:
        return float("inf")
    after = int(reached[0])
    if after == 0:
        return float(grid[0])
    before = after - 1
    share = (level - used[before]) / (used[after] - used[before])
    return float(grid[before] + share * (grid[after] - grid[before]))
