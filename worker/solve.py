"""The one place where the service calls the solver."""

import math
from dataclasses import replace

import solver
from solver.assess import AssessmentModel, assess_landing, judge_by_rule
from solver.assessment import Assessment, Reason, Timing, TouchdownRecord, Verdict
from solver.errors import SolverError
from solver.verdict.action import combine
from solver.verdict.judge import record_gaps


def solve(
    model: AssessmentModel,
    record: TouchdownRecord,
    *,
    propagate_uncertainty: bool = True,
    time_limit: float = math.inf,
) -> Assessment:
    """Assess a landing, without its probability if its uncertainty is not to be propagated.

    Most of the `time_limit` [s] may go into samples; the rest is for the assessment itself.
    """
    if not propagate_uncertainty:
        record = replace(record, uncertainties=())
    return assess_landing(model, record, probability_time_budget=time_limit / 2)


def undetermined(model: AssessmentModel, record: TouchdownRecord, error: SolverError) -> Assessment:
    """The answer to a record that turns out inadmissible only when it is computed.

    "Cannot tell" is a verdict: it sends somebody to look, which a failed job would not.  The
    maker's rule needs no simulation and may know more.
    """
    nothing = float("nan")
    rule = judge_by_rule(model, record)
    action, difference = combine(Verdict.UNDETERMINED, rule)
    return Assessment(
        verdict=Verdict.UNDETERMINED,
        action=action,
        rule_difference=difference,
        makers_rule=rule,
        reasons=(
            Reason("inadmissible_record", str(error), Verdict.UNDETERMINED),
            *record_gaps(record),
        ),
        limit_probability=None,
        driving_contact=None,
        worst_utilisation=nothing,
        worst_margin=nothing,
        hot_spots=(),
        gear_loads=(),
        peak_normal_load_factor=nothing,
        energy_error=nothing,
        equilibrium_residual=nothing,
        notes=("Nothing was assessed.",),
        model_hash=model.content_hash,
        program_version=solver.__version__,
        timing=Timing(0.0, 0.0, 0.0, 0.0),
    )
