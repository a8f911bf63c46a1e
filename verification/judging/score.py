"""From answers to each method's wrong calls, misses, area under the curve and calibration."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.aircraft.definition_file import VerdictSection
from solver.arrays import Array, BoolArray
from verification.judging.methods import Answers
from verification.judging.population import FEET_PER_MINUTE
from verification.judging.shares import (
    CalibrationBin,
    Curve,
    Share,
    area_interval,
    calibration,
    calibration_error,
    operating_curve,
    weighted_share,
)

#: Share of crews' reports that were right, by the maker's own chart: 1 in 7 (85 % wrong).
REPORTS_RIGHT = 0.15

#: Spread of what a crew takes for the same sink rate, standard deviation of its logarithm.
PILOT_SPREAD = 0.35

#: 14 CFR 25.473(a)(2), and what the classic rule of the A320 family asks an inspection from.
SINK_LIMIT = 600.0 * FEET_PER_MINUTE

_DEFAULT = {name: field.default for name, field in VerdictSection.model_fields.items()}

#: Probabilities from which the verdict is INSPECT and HARD by default.
INSPECT_PROBABILITY = 1.0 / (1.0 + _DEFAULT["missed_over_needless_cost"])
HARD_PROBABILITY = _DEFAULT["hard_probability"]

#: A window that carries no verdict is inspected: it scores above everything.
UNDETERMINED_SCORE = 99.0

#: Bins of the reliability diagram.
BINS = np.array([0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0])


@dataclass(frozen=True, slots=True)
class Method:
    """How one method scores landings, and from where it calls them hard."""

    name: str
    scores: Array  #: (n,)
    alarm: BoolArray  #: (n,)


@dataclass(frozen=True, slots=True)
class MethodScore:
    """What a method is worth in service."""

    name: str
    wrong_calls: Share  #: sound landings among those it called
    false_alarms: Share  #: called ones among sound landings
    misses: Share  #: hard landings it did not call
    area: float
    area_interval: tuple[float, float]
    curve: Curve


@dataclass(frozen=True, slots=True)
class Calibration:
    """Of the stated probabilities, in one weighting."""

    bins: tuple[CalibrationBin, ...]
    error: float  #: mean distance of stated and observed


@dataclass(frozen=True, slots=True)
class FleetScore:
    """All there is to say of a fleet."""

    landings: int
    hard: int
    hard_share: Share  #: in service
    undetermined: Share  #: in service
    methods: tuple[MethodScore, ...]
    calibration_flown: Calibration | None  #: None: no probability was computed
    calibration_service: Calibration | None


def methods_of(answers: Sequence[Answers], seed: int) -> tuple[Method, ...]:
    """Scores and alarms of every method on the same landings."""
    hard, weights = truth_of(answers)

    def column(value: Callable[[Answers], float | None]) -> Array:
        found = [value(each) for each in answers]
        return np.array([UNDETERMINED_SCORE if each is None else each for each in found])

    estimate = column(lambda a: a.estimate)
    corrected = column(corrected_of)
    probability = column(lambda a: probability_of(a, a.probability))
    unexplained = np.array([a.is_unexplained for a in answers])
    on_runway = column(lambda a: probability_of(a, a.probability_on_runway))
    unexplained_on_runway = np.array([a.is_unexplained_on_runway for a in answers])
    load_factor = column(lambda a: a.load_factor_share)
    over = np.array([a.is_over_load_factor for a in answers])
    held = np.array([a.is_held for a in answers])
    sink = column(lambda a: a.sink_difference)
    felt = felt_sink_rates(answers, seed)
    return (
        Method("crew's report (model)", felt, felt >= report_threshold(felt, hard, weights)),
        Method("recorded load factor, maker's rule", load_factor, over),
        Method("differenced radio altitude, 600 ft/min", sink, sink > SINK_LIMIT),
        Method("estimate", estimate, estimate > 1.0),
        Method("estimate, INSPECT or more", estimate, held),
        Method("estimate after assimilation", corrected, corrected > 1.0),
        Method("probability, HARD", probability, probability >= HARD_PROBABILITY),
        Method(
            "probability, INSPECT or more", probability,
            (probability >= INSPECT_PROBABILITY) | unexplained,
        ),
        Method("the same, friction measured, HARD", on_runway, on_runway >= HARD_PROBABILITY),
        Method(
            "the same, friction measured, INSPECT or more", on_runway,
            (on_runway >= INSPECT_PROBABILITY) | unexplained_on_runway,
        ),
    )  # fmt: skip


def corrected_of(answers: Answers) -> float | None:
    """Use of a limit after assimilation; where that was left out, by the estimate."""
    if answers.undetermined:
        return None
    return answers.corrected if answers.is_complete else answers.estimate


def probability_of(answers: Answers, stated: float | None) -> float | None:
    """Stated probability; where it was left out the landing is clearly sound, or clearly hard."""
    if answers.undetermined or answers.estimate is None:
        return None
    return stated if answers.is_complete else float(answers.estimate > 1.0)


def truth_of(answers: Sequence[Answers]) -> tuple[BoolArray, Array]:
    """Whether each landing was hard, and its weight."""
    return (
        np.array([each.utilisation > 1.0 for each in answers]),
        np.array([each.weight for each in answers]),
    )


def felt_sink_rates(answers: Sequence[Answers], seed: int) -> Array:
    """Sink rates as crews take them: nobody published how well, so the spread is assumed."""
    noise = [np.random.default_rng([seed, each.number, 7]).standard_normal() for each in answers]
    true = np.array([each.sink_rate for each in answers])
    return np.asarray(true * np.exp(PILOT_SPREAD * np.array(noise)))


def report_threshold(felt: Array, hard: BoolArray, weights: Array) -> float:
    """Felt sink rate from which one report in seven is right, the lowest such."""
    curve = operating_curve(felt, hard, weights)
    right = 1.0 - curve.wrong_calls >= REPORTS_RIGHT
    return float(curve.thresholds[right].min()) if right.any() else float(curve.thresholds[0])


def score_fleet(answers: Sequence[Answers], seed: int) -> FleetScore:
    """Score every method.

    Raises
    ------
    ValueError
        No landing was hard, or none sound: the fleet is too small.
    """
    hard, weights = truth_of(answers)
    scored = tuple(_scored(method, hard, weights, seed) for method in methods_of(answers, seed))
    stated = [i for i, each in enumerate(answers) if each.probability is not None]
    flown = service = None
    if stated:
        probability = np.array([answers[i].probability for i in stated])
        flown = _calibration(probability, hard[stated], np.ones(len(stated)))
        service = _calibration(probability, hard[stated], weights[stated])
    undetermined = np.array([bool(each.undetermined) for each in answers])
    return FleetScore(
        landings=len(answers),
        hard=int(hard.sum()),
        hard_share=weighted_share(hard, weights),
        undetermined=weighted_share(undetermined, weights),
        methods=scored,
        calibration_flown=flown,
        calibration_service=service,
    )


def _scored(method: Method, hard: BoolArray, weights: Array, seed: int) -> MethodScore:
    curve = operating_curve(method.scores, hard, weights)
    return MethodScore(
        name=method.name,
        wrong_calls=weighted_share(~hard[method.alarm], weights[method.alarm]),
        false_alarms=weighted_share(method.alarm[~hard], weights[~hard]),
        misses=weighted_share(~method.alarm[hard], weights[hard]),
        area=curve.area,
        area_interval=area_interval(method.scores, hard, weights, seed),
        curve=curve,
    )


def _calibration(probability: Array, hard: BoolArray, weights: Array) -> Calibration:
    bins = calibration(probability, hard, weights, BINS)
    return Calibration(bins, calibration_error(bins))
