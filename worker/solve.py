"""The one place where the service calls the solver."""

import solver
from solver.assess import AssessmentModel, assess_landing
from solver.assessment import Assessment, Reason, Timing, TouchdownRecord, Verdict
from solver.errors import SolverError


def solve(model: AssessmentModel, record: TouchdownRecord) -> Assessment:
    """Assess a landing."""
    return assess_landing(model, record)


def undetermined(model_hash: str, error: SolverError) -> Assessment:
    """The answer to a record that turns out inadmissible only when it is computed.

    "Cannot tell" is a verdict: it sends somebody to look, which a failed job would not.
    """
    nothing = float("nan")
    return Assessment(
        verdict=Verdict.UNDETERMINED,
        reasons=(Reason("inadmissible_record", str(error), Verdict.UNDETERMINED),),
        probability_limit_exceeded=None,
        driving_contact=None,
        worst_utilisation=nothing,
        worst_margin=nothing,
        hot_spots=(),
        gear_loads=(),
        peak_normal_load_factor=nothing,
        energy_error=nothing,
        equilibrium_residual=nothing,
        notes=("Nothing was assessed.",),
        model_hash=model_hash,
        program_version=solver.__version__,
        timing=Timing(0.0, 0.0, 0.0, 0.0),
    )
