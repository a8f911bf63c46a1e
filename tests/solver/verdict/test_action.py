"""The stricter of two: every pair of stress verdict and rule."""

from itertools import product

import pytest

from solver.assessment import RuleDifference, RuleStatus, RuleVerdict, Verdict
from solver.verdict.action import combine
from solver.verdict.judge import SEVERITY

NORMAL, FIRM, INSPECT, HARD, UNDETERMINED = Verdict
AGREE, STRESS, RULE, CANNOT_TELL, NO_RULE = RuleDifference


def rule(verdict: Verdict) -> RuleVerdict:
    status = {
        NORMAL: RuleStatus.PASSED,
        UNDETERMINED: RuleStatus.CANNOT_TELL,
    }.get(verdict, RuleStatus.EXCEEDED)
    return RuleVerdict("r", "R", status, verdict, ())


TABLE = {
    (NORMAL, NORMAL): (NORMAL, AGREE),
    (NORMAL, INSPECT): (INSPECT, RULE),
    (NORMAL, HARD): (HARD, RULE),
    (NORMAL, UNDETERMINED): (NORMAL, CANNOT_TELL),
    (FIRM, NORMAL): (FIRM, AGREE),
    (FIRM, INSPECT): (INSPECT, RULE),
    (FIRM, HARD): (HARD, RULE),
    (FIRM, UNDETERMINED): (FIRM, CANNOT_TELL),
    (INSPECT, NORMAL): (INSPECT, STRESS),
    (INSPECT, INSPECT): (INSPECT, AGREE),
    (INSPECT, HARD): (HARD, RULE),
    (INSPECT, UNDETERMINED): (INSPECT, CANNOT_TELL),
    (HARD, NORMAL): (HARD, STRESS),
    (HARD, INSPECT): (HARD, STRESS),
    (HARD, HARD): (HARD, AGREE),
    (HARD, UNDETERMINED): (HARD, CANNOT_TELL),
    (UNDETERMINED, NORMAL): (UNDETERMINED, STRESS),
    (UNDETERMINED, INSPECT): (UNDETERMINED, STRESS),
    (UNDETERMINED, HARD): (HARD, RULE),
    (UNDETERMINED, UNDETERMINED): (UNDETERMINED, CANNOT_TELL),
}


def test_the_table_is_exhaustive() -> None:
    assert set(TABLE) == set(product(Verdict, (NORMAL, INSPECT, HARD, UNDETERMINED)))


@pytest.mark.parametrize(("stress", "by_rule"), list(TABLE))
def test_every_pair(stress: Verdict, by_rule: Verdict) -> None:
    assert combine(stress, rule(by_rule)) == TABLE[stress, by_rule]


@pytest.mark.parametrize(("stress", "by_rule"), list(TABLE))
def test_the_action_is_never_milder_than_either(stress: Verdict, by_rule: Verdict) -> None:
    action, difference = combine(stress, rule(by_rule))
    assert SEVERITY[action] >= SEVERITY[stress]
    if difference is not CANNOT_TELL:
        assert SEVERITY[action] >= SEVERITY[by_rule]


@pytest.mark.parametrize("stress", list(Verdict))
def test_without_a_rule_the_stress_verdict_is_the_action(stress: Verdict) -> None:
    assert combine(stress, None) == (stress, NO_RULE)
