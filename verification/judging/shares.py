"""Shares of a weighted sample with their intervals, areas under curves, and calibration."""

from dataclasses import dataclass

import numpy as np
from scipy.stats import beta

from solver.arrays import Array, BoolArray

#: Probability that an interval holds the true value.
CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True)
class Share:
    """A weighted share and its interval; nan where there is nothing to take a share of."""

    value: float
    lower: float
    upper: float
    count: int  #: landings it is taken of


def weighted_share(happened: BoolArray, weights: Array) -> Share:
    """Weighted share of those (n,) that happened.

    Notes
    -----
    The interval is Jeffreys' for a binomial share, with the effective sample size of the weights,
    (sum w)^2 / sum w^2 (L. Kish, Survey Sampling (1965), sec. 11.7; for intervals of shares E. L.
    Korn and B. I. Graubard, Survey Methodology 24, 1998).
    """
    total = float(weights.sum())
    if not total > 0.0:
        return Share(np.nan, 0.0, 1.0, 0)
    value = min(float(weights[happened].sum()) / total, 1.0)
    effective = total**2 / float((weights**2).sum())
    tail = (1.0 - CONFIDENCE) / 2.0
    above, below = value * effective + 0.5, (1.0 - value) * effective + 0.5
    return Share(
        value=value,
        lower=0.0 if value == 0.0 else float(beta.ppf(tail, above, below)),
        upper=1.0 if value == 1.0 else float(beta.ppf(1.0 - tail, above, below)),
        count=len(happened),
    )


@dataclass(frozen=True, slots=True)
class Curve:
    """Receiver operating characteristic: an alarm where a score is above each threshold."""

    thresholds: Array  #: (k,) falling
    alarms_of_sound: Array  #: (k,) share of sound landings with an alarm
    alarms_of_hard: Array  #: (k,) share of hard landings with an alarm
    wrong_calls: Array  #: (k,) share of the alarms that are of sound landings

    @property
    def area(self) -> float:
        """Probability that a hard landing scores higher than a sound one, ties half."""
        x = np.concatenate([[0.0], self.alarms_of_sound])
        y = np.concatenate([[0.0], self.alarms_of_hard])
        return float(np.sum(np.diff(x) * (y[1:] + y[:-1]) / 2.0))


def operating_curve(scores: Array, is_hard: BoolArray, weights: Array) -> Curve:
    """Curve of scores (n,) against truth (n,), with weights (n,).

    Raises
    ------
    ValueError
        There is no hard landing, or no sound one.
    """
    if is_hard.all() or not is_hard.any():
        raise ValueError("a curve needs hard landings and sound ones")
    thresholds = np.unique(scores)[::-1]
    alarm = scores[None, :] >= thresholds[:, None]
    hard = alarm @ (weights * is_hard)
    sound = alarm @ (weights * ~is_hard)
    return Curve(
        thresholds=thresholds,
        alarms_of_sound=sound / sound[-1],
        alarms_of_hard=hard / hard[-1],
        wrong_calls=sound / (sound + hard),
    )


def area_interval(
    scores: Array, is_hard: BoolArray, weights: Array, seed: int, repetitions: int = 400
) -> tuple[float, float]:
    """Interval of the area under the curve by drawing landings again (percentile bootstrap).

    Notes
    -----
    B. Efron and R. J. Tibshirani, An Introduction to the Bootstrap (1993), sec. 13.3.  Hard and
    sound landings are drawn apart, so that every repetition has both.
    """
    rng = np.random.default_rng(seed)
    groups = [np.flatnonzero(is_hard), np.flatnonzero(~is_hard)]
    areas = []
    for _ in range(repetitions):
        drawn = np.concatenate([rng.choice(group, len(group)) for group in groups])
        areas.append(operating_curve(scores[drawn], is_hard[drawn], weights[drawn]).area)
    low, high = np.quantile(areas, [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return float(low), float(high)


@dataclass(frozen=True, slots=True)
class CalibrationBin:
    """Landings whose stated probabilities are alike."""

    share: float  #: of all landings
    stated: float  #: mean
    observed: Share  #: of hard ones among them


def calibration(
    probability: Array, is_hard: BoolArray, weights: Array, edges: Array
) -> tuple[CalibrationBin, ...]:
    """Stated against observed in bins between ``edges``; empty bins are left out."""
    place = np.clip(np.searchsorted(edges, probability, side="right") - 1, 0, len(edges) - 2)
    bins = []
    for index in range(len(edges) - 1):
        inside = place == index
        if inside.any():
            bins.append(
                CalibrationBin(
                    share=float(weights[inside].sum() / weights.sum()),
                    stated=float(np.average(probability[inside], weights=weights[inside])),
                    observed=weighted_share(is_hard[inside], weights[inside]),
                )
            )
    return tuple(bins)


def calibration_error(bins: tuple[CalibrationBin, ...]) -> float:
    """Mean distance of stated and observed over all landings (expected calibration error)."""
    return sum(each.share * abs(each.stated - each.observed.value) for each in bins)
