"""Datum of the normal acceleration: what it shows while the aircraft only rolls must be one g."""

from dataclasses import dataclass

import numpy as np

from solver.flight_data.alignment import Series

#: Least stretch of rolling from which a datum is taken [s].
SHORTEST = 2.0

#: Above this scatter the aircraft does more than roll [g].
_ROUGHEST = 0.12

#: What a mean over a few seconds of rolling may still hide: attitude, slope, oleos at work [g].
_LEFT = 0.004


@dataclass(frozen=True, slots=True)
class Datum:
    """What to take off the recorded normal acceleration."""

    offset: float  #: [g]
    sd: float  #: [g]
    found: bool  #: False: no rolling in the window, the frame's own figure stands


def normal_datum(series: Series, rolling_from: float) -> Datum:
    """Mean of the normal acceleration over the rolling part of a window less one g.

    Parameters
    ----------
    series : Series
        Normal acceleration.
    rolling_from : float
        Time from which the aircraft has settled on its wheels [s].
    """
    value = series.value[series.time >= rolling_from]
    span = len(value) * series.interval
    wide = Datum(0.0, series.entry.bias.value, False)
    if span < SHORTEST:
        return wide
    scatter = float(np.std(value))
    if scatter > _ROUGHEST:
        return wide
    # Roughness is not white: about one sample in two counts.
    sd = np.hypot(scatter * np.sqrt(2.0 / len(value)), _LEFT)
    return Datum(float(np.mean(value)) - 1.0, float(sd), True)
