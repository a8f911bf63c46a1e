"""When a shock began, from the samples around its rise through the filter of the recorder."""

from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.ndimage import gaussian_filter1d

from solver.arrays import Array
from solver.flight_data.alignment import Series


@dataclass(frozen=True, slots=True)
class Indicator:
    """What one indicator says about the time of a contact."""

    name: str
    log_likelihood: Array  #: on the common grid of times, 0 at its largest
    time: float  #: mean [s]
    sd: float  #: [s]


#: Time over which the load of a gear comes up: tyre first, then the preload of the strut [s].
_RISES = (0.03, 0.06, 0.1, 0.15, 0.2)

#: Parts of the time between the touches of two gears that are added to each.
_DRAWN_OUT = (0.0, 0.3, 0.6, 0.8, 1.0)

#: How far the true course of a shock leaves the template, per unit of its height.
_MISFIT = 0.1

#: Scatter of an onset in sampling intervals that the template does not account for: the step of a
#: brake or a gust in between, a shock of several pulses.
_SPREAD = 0.2

#: Load that may come up before: parts of the shock's height, and how long before [s].
_LEADING_SHARES = (0.15, 0.3, 0.5)
_LEADS = (0.1, 0.2, 0.3, 0.45)

#: Height of the shock over the highest sample around its rise.
_HEIGHTS = (0.7, 0.85, 1.0, 1.2, 1.5, 2.0, 3.0)

#: Scatter of its logarithm: some shocks still grow after their first samples.
_HEIGHT_SPREAD = 0.35


def ramp_response(time: Array, rise: Array | float, corner: float) -> Array:
    """Ramp from 0 at time 0 to 1 at ``rise``, behind a second-order Butterworth low-pass.

    Notes
    -----
    Integral of the step response ``1 - exp(-a t) (cos a t + sin a t)``, ``a = sqrt(2) pi corner``,
    of ``1 / (s^2 + sqrt(2) s + 1)``, over the ramp; without a filter the ramp itself.
    """
    if corner <= 0:
        return np.asarray(np.clip(time / rise, 0.0, 1.0))
    a = np.sqrt(2.0) * np.pi * corner

    def integral(t: Array) -> Array:
        late = np.maximum(t, 0.0)
        return np.asarray(late - (1.0 - np.exp(-a * late) * np.cos(a * late)) / a)

    return np.asarray((integral(time) - integral(time - rise)) / rise)


def rise_onset(
    name: str,
    series: Series,
    grid: Array,
    noise: float,
    until: float,
    apart: float,
    *,
    is_led: bool = False,
) -> Indicator | None:
    """Time at which a quantity began to rise after it had been level or falling, as in a hop.

    Parameters
    ----------
    name : str
    series : Series
    grid : (n,) array
        Times considered; all after the top of the hop [s].
    noise : float
        Least scatter of the quantity before the shock, in its unit.
    until : float
        Later samples show the oleo's course and not the onset [s].
    apart : float
        Time between the touches of two gears, over which the rise is drawn out [s].
    is_led : bool, optional
        Whether another load comes up before it, as that of a nose wheel that is on the ground.

    Returns
    -------
    Indicator or None
        None if the samples show no rise there.
    """
    # The filter smears, it does not shift: its response begins with the shock.
    time = series.time + series.lag
    before = np.flatnonzero(time < grid[0])[-_LEVEL_SAMPLES:]
    during = (time >= grid[0]) & (time <= max(until, grid[-1] + 2 * series.interval))
    if len(before) < _LEVEL_SAMPLES or during.sum() < 2:
        return None
    level, moment = series.value[before], time[before]
    # Lift that falls goes on falling for a moment: half of it is taken.
    slope = min(float(level[-1] - level[0]) / float(moment[-1] - moment[0]), 0.0) / 2
    scatter = float(np.hypot(np.std(level) / 2, max(noise, series.sd)))
    shown = series.value[during] - level[-1] - slope * (time[during] - moment[-1])
    height = float(shown.max())
    if height < 2.0 * scatter:
        return None
    return _posterior(name, series, grid, time[during], shown, scatter, height, apart, is_led)


#: Samples that show the level before a rise; a hop holds no more.
_LEVEL_SAMPLES = 3


def _posterior(
    name: str,
    series: Series,
    grid: Array,
    time: Array,
    shown: Array,
    scatter: float,
    height: float,
    apart: float,
    is_led: bool,
) -> Indicator:
    """Likelihood of each onset, averaged over rise times, heights, and loads before it."""
    since = time[None, None, :] - grid[:, None, None]
    rises = np.array(_RISES)[None, :, None] + apart * np.array(_DRAWN_OUT)[None, :, None]
    response = ramp_response(since, rises, series.entry.corner.value)
    leading = [np.zeros_like(response)]
    if is_led:
        leading += [
            share * height * ramp_response(since + lead, lead, series.entry.corner.value)
            for share in _LEADING_SHARES
            for lead in _LEADS
        ]
    likelihoods = []
    for factor, before in product(_HEIGHTS, leading):
        expected = factor * height * response + before
        sd = np.hypot(scatter, _MISFIT * factor * height * np.minimum(3 * response, 1.0))
        fit = (-0.5 * ((shown - expected) / sd) ** 2 - np.log(sd)).sum(axis=2)
        likelihoods.append(fit - 0.5 * (np.log(factor) / _HEIGHT_SPREAD) ** 2)
    total = np.array(likelihoods)
    log = np.logaddexp.reduce(np.logaddexp.reduce(total, axis=0), axis=1)
    # The rest of what the template leaves open grows with the time between samples.
    spread = float(np.hypot(series.entry.delay_scatter.value, _SPREAD * series.interval))
    log = blurred(log, grid, spread)
    return indicator(name, grid, log)


def blurred(log_likelihood: Array, grid: Array, sd: float) -> Array:
    """Log likelihood after an independent Gaussian error of the time itself; the grid is even."""
    if sd <= 0:
        return log_likelihood
    top = log_likelihood.max()
    step = float(grid[1] - grid[0])
    spread = gaussian_filter1d(np.exp(log_likelihood - top), sd / step, mode="nearest")
    return np.asarray(np.log(spread + 1e-300) + top)


def indicator(name: str, grid: Array, log_likelihood: Array) -> Indicator:
    """Summarise a log likelihood on a grid."""
    log = log_likelihood - log_likelihood.max()
    weight = np.exp(log)
    weight /= weight.sum()
    time = float(weight @ grid)
    return Indicator(name, log, time, float(np.sqrt(weight @ (grid - time) ** 2)))
