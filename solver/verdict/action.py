"""The action: the stricter of the stress verdict and the maker's rule."""

from solver.assessment import RuleDifference, RuleStatus, RuleVerdict, Verdict
from solver.verdict.judge import SEVERITY

#: Neither asks for anything on the aircraft; a rule that is passed knows no finer step.
_NOTHING_TO_DO = frozenset({Verdict.NORMAL, Verdict.FIRM})


def combine(stress: Verdict, rule: RuleVerdict | None) -> tuple[Verdict, RuleDifference]:
    """Return the action, and how the two stand to each other.

    A rule that cannot tell adds nothing and takes nothing away: the action is the stress verdict,
    and the difference on record says that it stands alone.

    Parameters
    ----------
    stress : Verdict
        From stresses, gear loads and contact conditions.
    rule : RuleVerdict, optional
        Of the maker's rule; None if the aircraft has none.
    """
    if rule is None:
        return stress, RuleDifference.NO_RULE
    if rule.status is RuleStatus.CANNOT_TELL:
        return stress, RuleDifference.RULE_CANNOT_TELL
    if stress is rule.verdict or {stress, rule.verdict} <= _NOTHING_TO_DO:
        return max(stress, rule.verdict, key=SEVERITY.__getitem__), RuleDifference.AGREE
    if SEVERITY[rule.verdict] > SEVERITY[stress]:
        return rule.verdict, RuleDifference.RULE_STRICTER
    return stress, RuleDifference.STRESS_STRICTER
