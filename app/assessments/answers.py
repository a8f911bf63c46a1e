"""Assessments as the service answers them."""

from datetime import datetime
from typing import Any, Literal

from pydantic import BaseModel, Field

from app.assessments.states import State
from solver.assessment import (
    ADVISORY,
    ProbabilityBasis,
    RuleDifference,
    RuleStatus,
    Verdict,
)


class ReasonOut(BaseModel):
    """One line of justification."""

    code: str
    text: str
    verdict: Verdict = Field(description="The least severe verdict this reason alone would give.")


class GearLoadOut(BaseModel):
    """Peaks of one gear in one contact against its design limits; N, m, s."""

    gear: str
    contact: int
    vertical_force: float | None
    vertical_time: float | None
    drag_force: float | None
    spring_back_force: float | None
    side_force: float | None
    stroke: float | None
    tyre_deflection: float | None
    stroke_utilisation: float | None
    utilisation: float | None
    bounces: int


class RuleFindingOut(BaseModel):
    """One criterion of the maker's rule at one contact; value and limit in `unit`."""

    criterion: str
    contact: int = Field(description="Of all contacts of the record, from 0.")
    quantity: str
    unit: str
    value: float | None = Field(description="As recorded; null if it is not.")
    limit: float | None = Field(
        description="Null where it cannot be told; 0 asks for an inspection whatever the value."
    )
    status: RuleStatus
    action: Verdict = Field(description="What the rule asks for where the limit is exceeded.")
    text: str
    source: str
    certainty: str = Field(
        description="Of the source: `read` there, `computed` from it, from `memory`, or `assumed`."
    )


class RuleVerdictOut(BaseModel):
    """What the maker's hard-landing rule says of the recorded peaks."""

    rule: str
    title: str
    status: RuleStatus
    verdict: Verdict = Field(description="UNDETERMINED where the rule cannot tell.")
    findings: list[RuleFindingOut]


class LimitProbabilityOut(BaseModel):
    """Probability that a limit was exceeded, with the error of its own sampling."""

    probability: float
    standard_error: float = Field(description="Of sampling alone.")
    lower: float = Field(description="Of the 95 % interval of sampling.")
    upper: float = Field(
        description="Of the same interval; where nothing or little was sampled, the bound that "
        "`basis` leaves."
    )
    samples: int = Field(description="Landings simulated for it.")
    failed: int = Field(description="Of those, not to be simulated; counted as exceeding.")
    basis: ProbabilityBasis = Field(
        description="`corners`: pessimistic landings stay below every limit; `first_samples`: few "
        "samples, all far below every limit; `samples`: all samples."
    )


class VerdictOut(BaseModel):
    """What was found and what it rests on."""

    verdict: Verdict = Field(description="From stresses, gear loads and contact conditions.")
    action: Verdict = Field(
        description="What to do: the stricter of `verdict` and the maker's rule. A rule that "
        "cannot tell leaves the verdict as it is."
    )
    rule_difference: RuleDifference
    makers_rule: RuleVerdictOut | None = Field(
        description="Null if the aircraft's definition names no rule."
    )
    is_provisional: bool
    reasons: list[ReasonOut]
    probability_limit_exceeded: float | None = Field(
        description="That a limit allowable of the airframe or a gear's design limit load was "
        "exceeded, as well as the record is known. Null where nothing could be simulated."
    )
    limit_probability: LimitProbabilityOut | None = Field(
        description="The same with its own sampling error and what it rests on."
    )
    driving_contact: int | None
    worst_utilisation: float | None = Field(description="Peak stress over limit allowable.")
    worst_margin: float | None
    peak_normal_load_factor: float | None = Field(description="[g]")
    energy_error: float | None
    equilibrium_residual: float | None
    gear_loads: list[GearLoadOut]
    notes: list[str]
    timing: dict[str, float | None] | None = Field(description="Seconds of each step.")
    model_hash: str
    program_version: str
    inputs: dict[str, Any] = Field(description="What the solver was given: SI, rad.")
    assessed_at: datetime


class Span(BaseModel):
    """A number and where it may lie by the envelope's error; null beyond the envelope."""

    value: float | None
    low: float | None
    high: float | None


class ProvisionalOut(BaseModel):
    """First answer to a landing, from its aircraft's envelope; the full verdict follows."""

    is_provisional: Literal[True] = True
    verdict: Verdict | None = Field(
        description="Of the stress verdict to come, on the stricter side of the envelope's error; "
        "null where it cannot be told beforehand."
    )
    reasons: list[str] = Field(description="Why there is none, or what it does not speak for.")
    contact: int | None = Field(
        default=None, description="The contact that decides, of those whose state is known."
    )
    sink_rate_m_s: float | None = Field(default=None, description="Of that contact.")
    utilisation: Span | None = Field(default=None, description="Expected, of the limits.")
    limit_sink_rate_m_s: Span | None = Field(
        default=None,
        description="At which a limit would be reached in its attitude, loading and lift.",
    )
    rests_on: str | None = None
    model_hash: str | None = None
    program_version: str | None = None
    advisory: str = ADVISORY


class AssessmentOut(BaseModel):
    """An assessment: where it stands and, once it is done, its verdict."""

    id: str
    landing_id: str
    state: State
    lane: str
    attempts: int
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None
    last_error: str | None = Field(description="Why the last attempt ended without a verdict.")
    provisional: ProvisionalOut | None = Field(
        default=None, description="Made when the record came in; null for those of a back-fill."
    )
    provisional_differs: bool | None = Field(
        default=None, description="Null until there are both verdicts."
    )
    provisional_difference: str | None = Field(
        default=None, description="How they differ, in one sentence."
    )
    result: VerdictOut | None = None
    links: dict[str, str]
    advisory: str = ADVISORY


class HotSpotOut(BaseModel):
    """The worst element of one zone; positions in structural axes [m], stresses in Pa."""

    rank: int
    component: str
    zone: str
    side: str
    element: int
    element_kind: str
    position: tuple[float, float, float]
    peak_stress: float
    allowable: float
    utilisation: float
    margin: float | None
    time: float
    contact: int
    ata_chapter: str
    inspection: str
    probability_limit_exceeded: float | None = Field(
        description="That an element of this zone exceeded its limit allowable."
    )
    probability_standard_error: float | None = Field(description="Of sampling alone.")


class HotSpots(BaseModel):
    """Hot spots, worst first."""

    assessment_id: str
    verdict: Verdict
    items: list[HotSpotOut]
    advisory: str = ADVISORY


class Channel(BaseModel):
    """One curve on the common time grid."""

    name: str
    unit: str
    values: list[float | None]


class Histories(BaseModel):
    """Curves of one contact."""

    assessment_id: str
    contact: int
    contacts: int
    outcome: str
    ground_contacts: list[dict[str, Any]]
    time: list[float]
    channels: list[Channel]


class PeakFieldOut(BaseModel):
    """Every element's peak over the whole landing, in the order of the model's mesh."""

    assessment_id: str
    model_hash: str
    element: list[int]
    stress: list[float | None] = Field(description="von Mises [Pa]")
    utilisation: list[float | None]
    time: list[float | None] = Field(description="[s] from the contact")
    contact: list[int]
