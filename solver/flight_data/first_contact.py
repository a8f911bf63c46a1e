"""The first contact of a window, by the evidence of all indicators over all times it may have."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series, best
from solver.flight_data.contacts import (
    ONSET,
    SPIN_UP,
    ContactKind,
    ContactTime,
    likely_contact,
    main_switches,
)
from solver.flight_data.datum import Datum, normal_datum
from solver.flight_data.geometry import Geometry
from solver.flight_data.onset import Indicator, blurred, indicator
from solver.flight_data.parameter import Parameter
from solver.flight_data.smoothing import SETTLING, smooth_window
from solver.flight_data.sufficiency import Shortcoming, UndeterminedError, check_gaps
from solver.flight_data.touchdown import Courses
from solver.flight_data.undisturbed import IMPACT, SPIN_UP_PULL, Shock, shock_evidence
from solver.flight_data.vote import Vote, first_time_down, switch_indicator, vote
from solver.flight_data.wheels import lowest_course
from solver.flight_data.window import Window
from solver.gear.place import Place

#: How well a smoothed height is trusted besides its own standard deviation [m].
_HEIGHT_SD = 0.1

#: Seconds before the range of times that show how the aircraft flew.
_HISTORY = 5.0

#: What the shape of a shock leaves open of its onset, in sampling intervals.
_SHAPE = 0.1

#: Chance that a shock shows something else.
_DOUBT = 0.003

#: Step of the times considered [s].
_STEP = 0.01

#: Times closer than this belong to one hypothesis [s].
_APART = 0.2

#: Before and after a hypothesis in which its indicators are compared [s].
_AROUND = (0.3, 0.25)

#: Power of the likelihoods: those of models that are not quite right are too sure of themselves
#: (tempering; P. D. Gruenwald, T. van Ommen, Bayesian Analysis 12 (2017) 1069).
_TEMPER = 0.45

#: Less likely hypotheses are left out.
_LEAST_CHANCE = 0.003

#: A guess farther off than this is made good and the height smoothed again [s].
_ROUGH = 0.4

#: Wheels that are so many standard deviations above the runway do not touch it.
_OFF_GROUND = 4.0

#: Before and after the guess in which the first contact is sought [s].
_SOUGHT = (3.5, 2.0)

#: What the rise of the normal acceleration is late by when the nose wheel touches first: its
#: load is a fraction of the mains' and mostly turns the aircraft [s].
_NOSE_LEAD = 0.06

_NO_CONTACT = Shortcoming(
    "no_contact",
    "no ground contact is found in the window",
    "a window from 20 s before to 10 s after the touchdown",
)


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """One time the first contact may have had."""

    contact: ContactTime
    chance: float  #: that it is the right one


def first_contact(
    window: Window, normal: Series, geometry: Geometry
) -> tuple[tuple[Hypothesis, ...], Datum]:
    """Weigh all times of a range by shock, spin-up, wheel height and ground switches.

    Returns
    -------
    tuple of Hypothesis
        The likeliest first; chances sum to one.
    Datum

    Raises
    ------
    UndeterminedError
        Nothing shows a contact, or a needed channel has a gap there.
    """
    guess = likely_contact(window)
    if guess is None:
        raise UndeterminedError(_NO_CONTACT)
    found, datum = _weighed(window, normal, geometry, guess)
    if abs(found[0].contact.time - guess) > _ROUGH:
        found, datum = _weighed(window, normal, geometry, found[0].contact.time)
    return found, datum


def _weighed(
    window: Window, normal: Series, geometry: Geometry, guess: float
) -> tuple[tuple[Hypothesis, ...], Datum]:
    """Hypotheses around a guess, which the smoothed height is made for."""
    if not normal.time[0] + 2.0 < guess < normal.time[-1] - 1.0:
        raise UndeterminedError(_NO_CONTACT)
    check_gaps(window, guess)
    datum, height = _untied_height(window, normal, geometry, guess)
    grid = height[0]
    shocks = _shocks(window, normal, grid)
    total = first_time_down(*height)
    for _, log in shocks:
        total = total + _doubted(log)
    switches = switch_indicator("ground switches", main_switches(window), grid)
    if switches is not None:
        total = total + switches.log_likelihood
    weight = np.exp(total - total.max())
    weight /= weight.sum()
    found = []
    for start, end in _hypotheses(total):
        chance = float(weight[start:end].sum() ** _TEMPER)
        if chance > _LEAST_CHANCE:
            peak = float(grid[start + int(np.argmax(total[start:end]))])
            found.append(Hypothesis(_timed(window, grid, height, shocks, peak), chance))
    found.sort(key=lambda each: -each.chance)
    likeliest = found[0].contact.time
    if np.interp(likeliest, grid, height[1]) > _OFF_GROUND * np.interp(likeliest, grid, height[2]):
        raise UndeterminedError(_NO_CONTACT)
    sum_of_chances = sum(each.chance for each in found)
    return tuple(replace(each, chance=each.chance / sum_of_chances) for each in found), datum


def _shocks(window: Window, normal: Series, grid: Array) -> list[tuple[str, Array]]:
    """Evidence of each acceleration, with what shifts its onset besides noise."""

    def evidence(series: Series, shock: Shock) -> Array:
        shift = float(np.hypot(series.entry.delay_scatter.value, _SHAPE * series.interval))
        return blurred(shock_evidence(series, grid, shock, _HISTORY), grid, shift)

    found = [(ONSET, evidence(normal, IMPACT))]
    drag = best(window, Parameter.LONGITUDINAL_ACCELERATION)
    if drag is not None and drag.channel.rate >= 4:
        found.append((SPIN_UP, evidence(drag, SPIN_UP_PULL)))
    return found


def _doubted(log: Array) -> Array:
    """Log likelihood on a grid with the chance that it speaks of something else spread over it."""
    own = np.exp(log - log.max())
    return np.asarray(np.log((1 - _DOUBT) * own / own.sum() + _DOUBT / len(log)))


def _hypotheses(total: Array) -> list[tuple[int, int]]:
    """Ranges of indices around the peaks that stand apart, parted at the lowest value between."""
    apart = round(_APART / _STEP)
    peaks: list[int] = []
    for k in np.argsort(-total):
        if total[k] < total.max() + np.log(_LEAST_CHANCE) / _TEMPER:
            break
        if all(abs(k - other) >= apart for other in peaks):
            peaks.append(int(k))
    peaks.sort()
    bounds = [0]
    for one, other in pairwise(peaks):
        bounds.append(one + int(np.argmin(total[one:other])))
    bounds.append(len(total))
    return list(pairwise(bounds))


def _timed(
    window: Window,
    whole: Array,
    height: tuple[Array, Array, Array],
    shocks: list[tuple[str, Array]],
    peak: float,
) -> ContactTime:
    """Let the indicators vote on the time within one hypothesis."""
    near = (whole >= peak - _AROUND[0]) & (whole <= peak + _AROUND[1])
    grid = whole[near]
    indicators: list[Indicator] = [indicator(name, grid, log[near]) for name, log in shocks]
    switches = switch_indicator("ground switches", main_switches(window), grid)
    if switches is not None:
        indicators.append(switches)
    indicators.append(indicator("wheel height", grid, first_time_down(*height)[near]))
    result = vote(grid, indicators)
    return ContactTime(ContactKind.FIRST, result.time, result.sd, result)


def is_nose_first(courses: Courses, geometry: Geometry, time: float) -> bool:
    """Whether the nose wheel was lower than the main wheels at the first contact."""
    noses = geometry.of(Place.NOSE)
    if not noses:
        return False
    at = np.array([time])
    nose, _ = lowest_course(courses, geometry, noses, at)
    main, _ = lowest_course(courses, geometry, geometry.mains, at)
    return bool(nose[0] < main[0])


def nose_first(first: ContactTime) -> ContactTime:
    """First contact by the nose wheel, whose own shock hardly shows at the accelerometer."""
    return replace(
        first,
        kind=ContactKind.NOSE_FIRST,
        time=first.time - _NOSE_LEAD,
        sd=float(np.hypot(first.sd, _NOSE_LEAD)),
    )


def _untied_height(
    window: Window, normal: Series, geometry: Geometry, guess: float
) -> tuple[Datum, tuple[Array, Array, Array]]:
    """Height of the main wheels around a guess, from a smoothing that knows of no touch."""
    datum = normal_datum(normal, guess + SETTLING + 1.0)
    contact = ContactTime(ContactKind.FIRST, guess, 0.1, Vote(guess, 0.1, ()))
    courses = smooth_window(window, normal, geometry, [contact], datum, is_tied=False)
    grid = np.arange(guess - _SOUGHT[0], guess + _SOUGHT[1], _STEP)
    height, sd = lowest_course(courses, geometry, geometry.mains, grid)
    return datum, (grid, height, np.hypot(sd, _HEIGHT_SD))
