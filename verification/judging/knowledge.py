"""What limits the estimates: the same landings judged with more and more of the truth.

Only landings near the limit count here, as they were flown and without weights: a landing far from
the limit is told by any method.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from verification.judging.given_truth import (
    ASSIMILATED,
    LEARNED,
    SMOOTHED,
    TRUE_LANDING,
    TRUE_STATE,
    alone,
    together,
)
from verification.judging.methods import Answers
from verification.judging.score import corrected_of, truth_of
from verification.judging.shares import Share, operating_curve, weighted_share
from verification.judging.true_parts import Part


@dataclass(frozen=True, slots=True)
class Knowledge:
    """How well one kind of knowledge tells hard from sound near the limit."""

    name: str
    landings: int
    error_mean: float  #: of the use of a limit over the true one, less 1
    error_sd: float
    error_size: float  #: median of its absolute value: one landing far off does not shift it
    wrong_calls: Share
    misses: Share
    area: float
    wrong_calls_in_service: Share  #: of all landings, weighted; those far from the limit as ever
    misses_in_service: Share


def compared_knowledge(answers: Sequence[Answers]) -> tuple[Knowledge, ...]:
    """Every kind of knowledge on the landings that have all of them, so that rows compare."""
    near = [each for each in answers if each.knowledge]
    if not near:
        return ()
    names = set().union(*(each.knowledge for each in near))
    complete = [each for each in near if names <= set(each.knowledge)]
    return tuple(_knowledge(name, complete, answers) for name in sorted(names, key=_place))


#: Rows begin with these, in this order; of those alike the slower recorder comes first.
_ORDER = (
    SMOOTHED,
    ASSIMILATED,
    LEARNED,
    *(alone(part) for part in Part),
    *(together(part) for part in Part),
    TRUE_STATE,
    TRUE_LANDING,
)


def _place(name: str) -> tuple[int, float]:
    start, _, rate = name.partition(", ")
    if not rate.endswith(" Hz"):
        return _ORDER.index(name), 0.0
    return _ORDER.index(start), float(rate.removesuffix(" Hz"))


@dataclass(frozen=True, slots=True)
class Learned:
    """How much less uncertain something about the aircraft is after assimilation."""

    parameter: str
    left: dict[float, float]  #: mean deviation after over before, by the recorder's rate [Hz]


def learned_parameters(answers: Sequence[Answers]) -> tuple[Learned, ...]:
    """Mean over the landings whose response was explained, for each parameter of the aircraft."""
    told = [each for each in answers if each.learned]
    names = told[0].learned if told else {}
    rates = sorted({each.rate for each in told})
    return tuple(
        Learned(
            name,
            {
                rate: float(np.mean([a.learned[name] for a in told if a.rate == rate]))
                for rate in rates
            },
        )
        for name in names
    )


def _knowledge(name: str, near: Sequence[Answers], every: Sequence[Answers]) -> Knowledge:
    used = np.array([each.knowledge[name] for each in near])
    true = np.array([each.utilisation for each in near])
    hard, alarm, ones = true > 1.0, used > 1.0, np.ones(len(true))
    # A window without a verdict is inspected.
    told = [(each.knowledge.get(name, corrected_of(each)), each) for each in every]
    called = np.array([value is None or value > 1.0 for value, _ in told])
    is_hard, weights = truth_of(every)
    error = used / true - 1.0
    has_both = bool(hard.any()) and not bool(hard.all())
    return Knowledge(
        name=name,
        landings=len(near),
        error_mean=float(error.mean()),
        error_sd=float(error.std()),
        error_size=float(np.median(np.abs(error))),
        wrong_calls=weighted_share(~hard[alarm], ones[alarm]),
        misses=weighted_share(~alarm[hard], ones[hard]),
        area=operating_curve(used, hard, ones).area if has_both else float("nan"),
        wrong_calls_in_service=weighted_share(~is_hard[called], weights[called]),
        misses_in_service=weighted_share(~called[is_hard], weights[is_hard]),
    )
