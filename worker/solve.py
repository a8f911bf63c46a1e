"""The one place where the service calls the solver."""

import solver
from solver.assess import AssessmentModel, assess_landing, judge_by_rule
from solver.assessment import Assessment, Reason, Timing, TouchdownRecord, Verdict
from solver.errors import SolverError
from solver.verdict.action import combine


def solve(model: AssessmentModel, record: TouchdownRecord) -> Assessment:
    """Assess a landing."""
    return assess_landing(model, record)


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
        reasons=(Reason("inadmissible_record", str(error), Verdict.UNDETERMINED),),
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
