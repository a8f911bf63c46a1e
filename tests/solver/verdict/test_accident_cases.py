"""Published hard landings, scaled to the example aircraft's limit sink rate, are never NORMAL.

Facts and their certainty stand in `verification/judging/accident_cases.toml`, the scaling in
`verification.judging.accidents`. No stress is compared: the accidents happened to other types.
"""

import pytest

from solver.assess import AssessmentModel
from solver.assessment import Verdict
from solver.verdict.judge import SEVERITY
from verification.judging.accident_file import PublishedCase, published_cases
from verification.judging.accidents import JudgedCase, Scale, fly_case, scale_of

CASES = published_cases()
ACCIDENTS = tuple(case for case in CASES if case.expected is Verdict.HARD)

#: Nose gears damaged inside, of which no figure is published: our own, assumed landings use 73 and
#: 84 % of a limit, and an inspection is asked for because of how fast the nose wheel came down.
#: The third bounced on its nose gear at 1.6 g, twice: with the wheels turning since the first
#: contact that is 93 % of the nose gear's limit, with the drag of a spin-up it was above it.
INSPECTED = ("MON-MARA", "TOM519", "UAL-IAH")


@pytest.fixture(scope="module")
def scale(example_jet: AssessmentModel) -> Scale:
    return scale_of(example_jet)


@pytest.fixture(scope="module")
def judged(example_jet: AssessmentModel, scale: Scale) -> dict[str, JudgedCase]:
    return {case.name: fly_case(example_jet, scale, case) for case in CASES}


def test_the_limit_sink_rate_is_that_of_the_design_or_a_little_more(scale: Scale) -> None:
    """14 CFR 25.473(a)(2): 10 ft/s, 3.048 m/s, is within the limit, and the structure is sized for
    it."""
    assert 3.048 <= scale.limit_sink_rate < 1.1 * 3.048


@pytest.mark.parametrize("case", ACCIDENTS, ids=lambda case: case.name)
def test_an_accident_is_hard_or_at_least_inspected(
    judged: dict[str, JudgedCase], case: PublishedCase
) -> None:
    verdict = judged[case.name].assessment.verdict
    if case.name in INSPECTED:
        assert verdict is Verdict.INSPECT
    else:
        assert verdict is Verdict.HARD


@pytest.mark.parametrize("name", ["TABLE-1", "FLEET-MEAN", "FLEET-MEAN-SCALED", "BOEING-TYPICAL"])
def test_ordinary_landings_are_normal(judged: dict[str, JudgedCase], name: str) -> None:
    assert judged[name].assessment.verdict is Verdict.NORMAL


def test_a_landing_that_crews_begin_to_report_is_only_noted(judged: dict[str, JudgedCase]) -> None:
    assert judged["BOEING-CREW"].assessment.verdict is Verdict.FIRM


def test_nose_gears_are_named_where_noses_were_damaged(judged: dict[str, JudgedCase]) -> None:
    """A nose gear over its limit, first on the ground or brought down fast: one must be said."""
    for case in ACCIDENTS:
        if case.damage == "nose":
            reasons = judged[case.name].assessment.reasons
            assert any(
                SEVERITY[reason.verdict] >= SEVERITY[Verdict.INSPECT] and "nose" in reason.text
                for reason in reasons
            ), case.name


def test_the_worst_contact_decides(
    example_jet: AssessmentModel, scale: Scale, judged: dict[str, JudgedCase]
) -> None:
    """The first contact of the DC-10 at Baltimore looks like a firm landing; the crew said so."""
    whole = judged["WOA8535"]
    first = whole.case.model_copy(update={"contact": whole.case.contact[:1]})
    alone = fly_case(example_jet, scale, first)
    assert SEVERITY[alone.assessment.verdict] < SEVERITY[whole.assessment.verdict]
    assert whole.assessment.driving_contact == 1


def test_a_load_factor_is_scaled_by_its_share_of_the_increment(scale: Scale) -> None:
    """At the type's limit it is the limit sink rate, and it rises with the load factor."""
    case = next(case for case in CASES if case.name == "NPT05L")
    assert case.type_limit is not None
    rates = [
        scale.sink_rate(case, case.contact[0].model_copy(update={"value": value}))
        for value in (1.5, case.type_limit.value, 2.5)
    ]
    assert rates[1] == pytest.approx(scale.limit_sink_rate)
    assert rates[0] < rates[1] < rates[2]
