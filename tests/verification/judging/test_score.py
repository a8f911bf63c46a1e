"""Scores of a made-up fleet whose figures follow by counting."""

import dataclasses
from collections.abc import Iterator

import numpy as np
import pytest

from verification.judging.knowledge import compared_knowledge, learned_parameters
from verification.judging.methods import Answers
from verification.judging.score import (
    REPORTS_RIGHT,
    felt_sink_rates,
    report_threshold,
    score_fleet,
    truth_of,
)

SMOOTHED_8, ALL = "state by the smoother, 8 Hz", "all of these, 8 Hz"

PERFECT = Answers(
    number=0,
    kind="firm",
    weight=1.0,
    rate=8.0,
    sink_rate=1.0,
    utilisation=0.5,
    load_factor_share=0.5,
    is_over_load_factor=False,
    sink_difference=1.0,
    undetermined="",
    contacts=1,
    sink_estimate=1.0,
    estimate=0.5,
    is_held=False,
    is_complete=True,
    sink_corrected=1.0,
    corrected=0.5,
    probability=0.0,
    probability_on_runway=0.0,
)


def landings(count: int = 40) -> Iterator[Answers]:
    """Every second one hard, all methods right."""
    for number in range(count):
        used = 1.2 if number % 2 else 0.8
        is_hard = used > 1.0
        yield dataclasses.replace(
            PERFECT,
            number=number,
            sink_rate=3.0 * used,
            utilisation=used,
            load_factor_share=used,
            is_over_load_factor=is_hard,
            sink_difference=3.048 * used,
            estimate=used,
            is_held=is_hard,
            corrected=used,
            probability=float(is_hard),
            probability_on_runway=float(is_hard),
            knowledge={ALL: used, SMOOTHED_8: used},
        )


def test_right_answers_score_full_marks() -> None:
    score = score_fleet(list(landings()), seed=1)
    assert (score.landings, score.hard) == (40, 20)
    assert score.hard_share.value == 0.5
    for method in score.methods[1:]:
        assert method.wrong_calls.value == 0.0
        assert method.misses.value == 0.0
        assert method.area == 1.0
    assert score.calibration_flown is not None
    assert score.calibration_flown.error == 0.0


def test_one_false_alarm_and_one_miss_are_counted_with_their_weights() -> None:
    fleet = list(landings())
    fleet[0] = dataclasses.replace(fleet[0], estimate=1.1, weight=2.0)
    fleet[1] = dataclasses.replace(fleet[1], estimate=0.9, weight=3.0)
    by_name = {each.name: each for each in score_fleet(fleet, seed=1).methods}
    estimate = by_name["estimate"]
    assert estimate.wrong_calls.value == pytest.approx(2.0 / (2.0 + 19.0))
    assert estimate.false_alarms.value == pytest.approx(2.0 / (2.0 + 19.0))
    assert estimate.misses.value == pytest.approx(3.0 / (3.0 + 19.0))
    assert by_name["estimate after assimilation"].misses.value == 0.0


def test_a_window_that_cannot_tell_is_inspected_and_never_missed() -> None:
    fleet = list(landings())
    silent = {
        "estimate": None, "corrected": None, "probability": None, "is_held": True,
        "is_complete": False, "knowledge": {},
    }  # fmt: skip
    fleet[1] = dataclasses.replace(fleet[1], undetermined="no_radio_altitude", **silent)
    score = score_fleet(fleet, seed=1)
    assert score.undetermined.value == pytest.approx(1 / 40)
    assert all(each.misses.value == 0.0 for each in score.methods[3:])


def test_an_unexplained_response_is_inspected() -> None:
    fleet = list(landings())
    fleet[0] = dataclasses.replace(fleet[0], is_unexplained=True)
    by_name = {each.name: each for each in score_fleet(fleet, seed=1).methods}
    assert by_name["probability, INSPECT or more"].false_alarms.value == pytest.approx(1 / 20)
    assert by_name["probability, HARD"].false_alarms.value == 0.0


def test_crews_reports_are_as_often_right_as_the_maker_says() -> None:
    """Calibrated: at the threshold one report in seven is right, or a little more."""
    rng = np.random.default_rng(2)
    fleet = [
        dataclasses.replace(PERFECT, number=n, sink_rate=sink, utilisation=sink / 3.2)
        for n, sink in enumerate(rng.gamma(4.0, 0.3, 20_000))
    ]
    hard, weights = truth_of(fleet)
    felt = felt_sink_rates(fleet, 1)
    reported = felt >= report_threshold(felt[:3000], hard[:3000], weights[:3000])
    right = float((hard & reported)[:3000].sum() / reported[:3000].sum())
    assert REPORTS_RIGHT <= right < 2.0 * REPORTS_RIGHT


def test_knowledge_is_compared_on_the_same_landings() -> None:
    """A landing that lacks one kind of knowledge counts for none; the least comes first."""
    fleet = list(landings())
    fleet[3] = dataclasses.replace(fleet[3], knowledge={SMOOTHED_8: 1.0})
    fleet[5] = dataclasses.replace(fleet[5], knowledge={})
    found = compared_knowledge(fleet)
    assert [(each.name, each.landings) for each in found] == [(SMOOTHED_8, 38), (ALL, 38)]


def test_what_was_learned_is_told_by_the_recorders_rate() -> None:
    """Means by counting; a landing of which nothing was learned does not count."""
    fleet = [
        dataclasses.replace(a, rate=(8.0, 16.0)[a.number % 2], learned={"mass": 0.1 * a.number})
        for a in list(landings())[:4]
    ]
    (mass,) = learned_parameters([*fleet, PERFECT])
    assert mass.parameter == "mass"
    assert mass.left == {8.0: pytest.approx(0.1), 16.0: pytest.approx(0.2)}
    assert learned_parameters([PERFECT]) == ()


def test_without_a_landing_near_the_limit_nothing_is_compared() -> None:
    assert compared_knowledge([PERFECT]) == ()


def test_errors_are_relative_to_the_truth() -> None:
    """All 10 % too large: the half at 0.8 is called sound still, the other hard."""
    fleet = [
        dataclasses.replace(
            a, knowledge={SMOOTHED_8: 1.1 * a.utilisation, ALL: 0.8 * a.utilisation}
        )
        for a in landings()
    ]
    large, small = compared_knowledge(fleet)
    assert large.error_mean == pytest.approx(0.1)
    assert large.error_sd == pytest.approx(0.0, abs=1e-12)
    assert (large.error_size, small.error_size) == pytest.approx((0.1, 0.2))
    assert (large.wrong_calls.value, large.misses.value) == (0.0, 0.0)
    assert small.misses.value == 1.0


def test_in_service_landings_far_from_the_limit_count_as_they_were_told() -> None:
    """Twenty hard: one is not near and missed all the same, the others are told by `ALL`."""
    fleet = list(landings())
    fleet[1] = dataclasses.replace(fleet[1], knowledge={}, corrected=0.9, weight=2.0)
    fleet[2] = dataclasses.replace(fleet[2], knowledge={SMOOTHED_8: 0.8, ALL: 1.3}, weight=3.0)
    smoothed, whole = compared_knowledge(fleet)
    assert smoothed.misses_in_service.value == pytest.approx(2.0 / 21.0)
    assert smoothed.wrong_calls_in_service.value == 0.0
    assert whole.wrong_calls_in_service.value == pytest.approx(3.0 / (3.0 + 19.0))
