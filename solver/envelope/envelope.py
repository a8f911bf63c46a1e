"""An aircraft's envelope: how much of its limits a landing uses, and its limit sink rate.

The surface is compared with landings that it was not fitted to; how far they lie beyond it is its
error, which is never left out: a landing is graded by what it may use, not by what is expected.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.mass_states import MassStates, WeighedGroup
from solver.arrays import Array
from solver.envelope.domain import SINK_RATE, Domain
from solver.envelope.surface import Surface

#: Share of the held-out landings that the error covers, on either side.
COVERED_SHARE = 0.975

#: Sink rates at which an envelope is looked at between the ends of its range.
_GRID = 49


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
class Envelope:
    """Everything an aircraft's landings need for a first answer."""

    basis: Basis
    domain: Domain
    surface: Surface
    error: SurfaceError
    held_out: Array  #: (n, 2) utilisation expected and found, of landings that were not fitted
    mass_states: MassStates[WeighedGroup]

    def expected(self, coordinates: Array) -> Expected:
        """Largest use of the limits at coordinates (12,) and at any softer sink rate there.

        A rising sink rate never lowers it: where one part is relieved by a harder contact (the nose
        wheel comes down otherwise), what a softer one would use still counts.
        """
        grid, used, stops = self._course(coordinates)
        sink_rate = coordinates[SINK_RATE]
        utilisation = float(np.interp(sink_rate, grid, used))
        return Expected(
            utilisation=utilisation,
            low=utilisation * (1.0 - self.error.below),
            high=utilisation * (1.0 + self.error.above),
            stop_ratio=float(np.interp(sink_rate, grid, stops)) * (1.0 + self.error.stops_above),
        )

    def limit_sink_rate(self, coordinates: Array, utilisation: float = 1.0) -> LimitSinkRate:
        """Sink rate at which landings at coordinates (12,) reach a utilisation."""
        grid, used, _ = self._course(coordinates)
        return LimitSinkRate(
            value=_crossing(grid, used, utilisation),
            low=_crossing(grid, used * (1.0 + self.error.above), utilisation),
            high=_crossing(grid, used * (1.0 - self.error.below), utilisation),
        )

    def _course(self, coordinates: Array) -> tuple[Array, Array, Array]:
        """Sink rates of the box and the largest utilisation and stop ratio up to each of them."""
        grid = np.linspace(self.domain.low[SINK_RATE], self.domain.high[SINK_RATE], _GRID)
        rows = np.tile(coordinates, (_GRID, 1))
        rows[:, SINK_RATE] = grid
        used, stops = self.surface(self.domain.unit(rows))
        return grid, np.maximum.accumulate(used), np.maximum.accumulate(stops)


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
