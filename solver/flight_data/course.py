"""Smoothing of one angle or speed from its samples: value and rate, with covariance."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.rts import LinearSystem, smooth


@dataclass(frozen=True, slots=True)
class Course:
    """Value and rate on a grid, given all samples.

    The covariance holds what is independent from sample to sample; the errors that stay the same
    through a landing are apart, as they do not average out.
    """

    time: Array  #: (n,) [s]
    mean: Array  #: (n, 2) value and rate
    covariance: Array  #: (n, 2, 2)
    bias_sd: float
    delay_sd: float  #: [s]

    def at(self, time: float | Array) -> Array:
        """Value at any time inside the grid, linear between nodes."""
        return np.asarray(np.interp(time, self.time, self.mean[:, 0]))

    def rate_at(self, time: float | Array) -> Array:
        """Rate at any time inside the grid."""
        return np.asarray(np.interp(time, self.time, self.mean[:, 1]))

    def state(self, time: float) -> tuple[Array, Array]:
        """(2,) value and rate, (2, 2) their whole covariance, at the node nearest a time."""
        node = int(np.argmin(np.abs(self.time - time)))
        mean, covariance = self.mean[node], self.covariance[node].copy()
        # An unknown delay shifts the value along its rate.
        covariance[0, 0] += self.bias_sd**2 + (self.delay_sd * mean[1]) ** 2
        return mean, covariance


#: Spectral densities tried for the second derivative of the quantity [unit^2/s^3].
#: A pilot is busiest in the last seconds; quiet ones before must not let the rates look certain.
ATTITUDE_ACTIVITY = 10.0 ** np.arange(-2.75, -1.0, 0.5)
#: The nose is turned into the track in the last seconds, which the seconds before do not show.
YAW_ACTIVITY = 10.0 ** np.arange(-3.5, -1.0, 0.5)
SPEED_ACTIVITY = 10.0 ** np.arange(-4.0, 0.6, 0.5)


def smooth_course(
    series: tuple[Series, ...],
    nodes: Array,
    opened: tuple[tuple[float, float, float], ...] = (),
    activity: Array = ATTITUDE_ACTIVITY,
    ground: tuple[float, float] = (np.inf, 0.0),
) -> Course:
    """Smooth the samples of one quantity, whose second derivative is white noise.

    Parameters
    ----------
    series : tuple of Series
        One or more sources; their constant differences are taken out beforehand.
    nodes : (n,) array
        Times at which the result is wanted [s].
    opened : tuple of (from, to, density)
        Stretches in which the ground moves the aircraft: there the density is at least this.
    activity : (k,) array
        Densities tried; the results are averaged by how likely each makes the samples, so that
        neither a quiet nor a busy approach is given a wrong certainty.
    ground : (from, density)
        Density from a time on, instead of those tried: an aircraft that rolls quietly must not
        make its approach look quiet.

    Returns
    -------
    Course

    Notes
    -----
    Y. Bar-Shalom, X. R. Li, T. Kirubarajan, Estimation with Applications to Tracking and Navigation
    (2001), sec. 6.2.2: discretised white noise acceleration; sec. 11.6.2 for the averaging.
    """
    samples = _merged(series, float(nodes[0]), float(nodes[-1]))
    grid = np.unique(np.concatenate([nodes, samples[0]]))
    results = [smooth(_system(grid, samples, density, opened, ground)) for density in activity]
    likelihood = np.array([result.log_likelihood for result in results])
    weight = np.exp(likelihood - likelihood.max())
    weight /= weight.sum()
    mean = np.sum([w * r.mean for w, r in zip(weight, results, strict=True)], axis=0)
    covariance = np.zeros((len(grid), 2, 2))
    for w, result in zip(weight, results, strict=True):
        apart = result.mean - mean
        covariance += w * (result.covariance + apart[:, :, None] * apart[:, None, :])
    count = max(len(series), 1)
    entry = series[0].entry
    return Course(
        time=grid,
        mean=mean,
        covariance=covariance,
        bias_sd=entry.bias.value / np.sqrt(count),
        delay_sd=entry.delay_scatter.value / np.sqrt(count),
    )


def _merged(series: tuple[Series, ...], first: float, last: float) -> tuple[Array, Array, Array]:
    """Time, value and variance of all samples in order."""
    middles = [float(np.median(s.value)) for s in series]
    common = float(np.mean(middles))
    times, values, variances = [], [], []
    for s, middle in zip(series, middles, strict=True):
        keep = (s.time >= first) & (s.time <= last)
        times.append(s.time[keep])
        values.append(s.value[keep] - (middle - common if len(series) > 1 else 0.0))
        variances.append(np.full(int(keep.sum()), max(s.sd, 1e-9) ** 2))
    time = np.concatenate(times)
    order = np.argsort(time, kind="stable")
    return time[order], np.concatenate(values)[order], np.concatenate(variances)[order]


def _system(
    grid: Array,
    samples: tuple[Array, Array, Array],
    density: float,
    opened: tuple[tuple[float, float, float], ...],
    ground: tuple[float, float],
) -> LinearSystem:
    time, value, variance = samples
    dt = np.diff(grid)
    middle = grid[:-1] + dt / 2
    level = np.where(middle < ground[0], density, ground[1])
    for start, end, least in opened:
        inside = (middle >= start) & (middle <= end)
        level[inside] = np.maximum(level[inside], least)
    transition = np.zeros((len(dt), 2, 2))
    transition[:, 0, 0] = transition[:, 1, 1] = 1.0
    transition[:, 0, 1] = dt
    noise = np.zeros((len(dt), 2, 2))
    noise[:, 0, 0] = level * dt**3 / 3
    noise[:, 0, 1] = noise[:, 1, 0] = level * dt**2 / 2
    noise[:, 1, 1] = level * dt
    middle_value = float(np.median(value)) if len(value) else 0.0
    spread = float(np.ptp(value)) if len(value) else 1.0
    return LinearSystem(
        initial=np.array([middle_value, 0.0]),
        initial_covariance=np.diag([(spread + 1.0) ** 2, (spread + 1.0) ** 2]),
        transition=transition,
        noise=noise,
        drive=np.zeros((len(dt), 2)),
        node=np.searchsorted(grid, time).astype(np.int64),
        row=np.tile([1.0, 0.0], (len(time), 1)),
        measured=value,
        variance=variance,
    )
