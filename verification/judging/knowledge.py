"""What limits the estimates: the same landings judged with more and more of the truth.

Only landings near the limit count here, as they were flown and without weights: a landing far from
the limit is told by any method.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from verification.judging.methods import Answers
from verification.judging.shares import Share, operating_curve, weighted_share

#: True use of a limit of the landings that count.
NEAR = (0.7, 1.4)


@dataclass(frozen=True, slots=True)
class Knowledge:
    """How well one kind of knowledge tells hard from sound near the limit."""

    name: str
    landings: int
    error_mean: float  #: of the use of a limit over the true one, less 1
    error_sd: float
    wrong_calls: Share
    misses: Share
    area: float


def compared_knowledge(answers: Sequence[Answers]) -> tuple[Knowledge, ...]:
    """Estimates of each recorder, and with parts of the truth; those without landings left out."""
    near = [a for a in answers if a.is_complete and NEAR[0] <= a.utilisation <= NEAR[1]]
    by_rate = [
        (f"{name}, {rate:g} Hz", rate, value)
        for name, value in (
            ("state by the smoother", lambda a: a.estimate),
            ("state after assimilation", lambda a: a.corrected),
        )
        for rate in sorted({a.rate for a in near})
    ]
    found = [_knowledge(name, [a for a in near if a.rate == rate], v) for name, rate, v in by_rate]
    found += [
        _knowledge("true state, aircraft as defined", near, lambda a: a.with_true_state),
        _knowledge(
            "state after assimilation, aircraft as it was", near, lambda a: a.with_true_aircraft
        ),
    ]
    return tuple(each for each in found if each is not None)


def _knowledge(
    name: str, answers: Sequence[Answers], value: Callable[[Answers], float | None]
) -> Knowledge | None:
    pairs = [(v, a.utilisation) for a in answers if (v := value(a)) is not None]
    if not pairs:
        return None
    used, true = np.array(pairs).T
    hard, alarm, ones = true > 1.0, used > 1.0, np.ones(len(true))
    error = used / true - 1.0
    told = bool(hard.any()) and not bool(hard.all())
    return Knowledge(
        name=name,
        landings=len(pairs),
        error_mean=float(error.mean()),
        error_sd=float(error.std()),
        wrong_calls=weighted_share(~hard[alarm], ones[alarm]),
        misses=weighted_share(~alarm[hard], ones[hard]),
        area=operating_curve(used, hard, ones).area if told else float("nan"),
    )
