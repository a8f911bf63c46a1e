"""The answer to one landing: verdict, margins, hot spots, gear loads and what they rest on."""

from dataclasses import dataclass, field
from enum import StrEnum

from solver.arrays import Array, IntArray
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import ContactUncertainty
from solver.landing.history import LandingHistory
from solver.recorded import RecordedContact


class Verdict(StrEnum):
    """What to do with the aircraft, mildest first; UNDETERMINED is treated as INSPECT."""

    NORMAL = "NORMAL"
    FIRM = "FIRM"
    INSPECT = "INSPECT"
    HARD = "HARD"
    UNDETERMINED = "UNDETERMINED"


ADVISORY = (
    "Advisory only: approved maintenance data for the aircraft type remain the authority "
    "for return to service."
)


@dataclass(frozen=True, slots=True)
class TouchdownRecord:
    """A landing as the solver takes it: loading and contacts, SI units.

    ``None`` for a mass or fuel figure means the record does not say; the assessment then uses the
    documented default of the aircraft definition and says so in its notes.
    """

    aircraft: str  #: name of the aircraft definition
    contacts: tuple[Contact, ...]  #: those whose state is known, in order
    mass: float | None = None  #: gross mass [kg]
    centre_of_gravity: float | None = None  #: structural x station [m]
    fuel: dict[str, float] = field(default_factory=dict)  #: tank name to fuel mass [kg]
    payload: dict[str, float] = field(default_factory=dict)  #: bay name to mass [kg]
    missing: tuple[str, ...] = ()  #: names of what the record lacks for a verdict
    mass_deviation: float | None = None  #: standard deviation of the gross mass [kg]
    centre_of_gravity_deviation: float | None = None  #: standard deviation of the station [m]
    recorded: tuple[RecordedContact, ...] = ()  #: every contact, with unknown state or without
    uncertainties: tuple[ContactUncertainty, ...] = ()  #: of each of `contacts`, or empty: not said
    #: Largest coefficient of friction of the tyres on the runway, as measured at the time; None: as
    #: the aircraft's definition has it, and with its scatter.
    runway_friction: float | None = None
    runway_friction_deviation: float = 0.0  #: standard deviation of it
    unexplained: tuple[str, ...] = ()  #: recorded responses that no landing as believed can give


@dataclass(frozen=True, slots=True)
class Reason:
    """One line of justification, with the code a machine can act on."""

    code: str
    text: str
    verdict: Verdict  #: the least severe verdict this reason alone would give


class ProbabilityBasis(StrEnum):
    """What a probability rests on."""

    CORNERS = "corners"  #: pessimistic landings that stay below every limit
    FIRST_SAMPLES = "first_samples"  #: few samples, all of them far below every limit
    SAMPLES = "samples"


@dataclass(frozen=True, slots=True)
class LimitProbability:
    """Probability that a landing exceeded a limit allowable or a gear's design limit load."""

    probability: float
    standard_error: float  #: of sampling alone
    lower: float  #: of the 95 % interval of sampling; see `solver.probability`
    upper: float  #: the same, or what the basis leaves
    samples: int  #: landings simulated for it
    failed: int  #: of those, not to be simulated and counted as exceeding
    basis: ProbabilityBasis


@dataclass(frozen=True, slots=True)
class HotSpot:
    """The worst element of one zone of one component."""

    rank: int
    component: str
    zone: str
    side: str  #: "port", "starboard" or "centre"
    element: int  #: identifier in the bulk data
    element_kind: str  #: "CQUAD4", "CTRIA3" or "CBAR"
    position: tuple[float, float, float]  #: centroid, structural axes [m]
    peak_stress: float  #: von Mises [Pa]
    allowable: float  #: limit allowable [Pa]
    utilisation: float  #: peak / allowable
    margin: float  #: allowable / peak - 1
    time: float  #: of the peak, from that contact [s]
    contact: int  #: which of the record's contacts drove it, from 0
    ata_chapter: str
    inspection: str  #: what to look for, from the aircraft definition
    #: that an element of this zone exceeded its limit allowable; None if it was not asked
    probability_limit_exceeded: float | None = None
    probability_standard_error: float | None = None  #: of sampling alone


@dataclass(frozen=True, slots=True)
class GearLoad:
    """Peaks of one gear in one contact against its design limits."""

    gear: str
    contact: int
    vertical_force: float  #: [N]
    vertical_time: float  #: [s]
    drag_force: float  #: largest aft force [N]
    spring_back_force: float  #: largest forward force [N]
    side_force: float  #: largest magnitude [N]
    stroke: float  #: [m]
    tyre_deflection: float  #: [m]
    stroke_utilisation: float  #: stroke / full stroke
    utilisation: float  #: worst of vertical, drag and side against their limits
    bounces: int  #: stays on the ground beyond the first


class RuleStatus(StrEnum):
    """What a maker's rule says of a contact."""

    PASSED = "passed"
    EXCEEDED = "exceeded"
    CANNOT_TELL = "cannot_tell"


class RuleDifference(StrEnum):
    """How the maker's rule and the stress verdict stand to each other."""

    AGREE = "agree"
    STRESS_STRICTER = "stress_stricter"
    RULE_STRICTER = "rule_stricter"
    RULE_CANNOT_TELL = "rule_cannot_tell"
    NO_RULE = "no_rule"  #: the aircraft's definition names none


@dataclass(frozen=True, slots=True)
class RuleFinding:
    """One criterion of a maker's rule at one contact; SI, load factors in g."""

    criterion: str
    contact: int  #: of all the record's contacts, from 0
    quantity: str
    unit: str  #: of value and limit
    value: float | None  #: as recorded; None if it is not
    limit: float | None  #: None where it cannot be told; 0 means inspect whatever the value
    status: RuleStatus
    action: Verdict  #: what the rule asks for where the limit is exceeded
    text: str  #: in the units of the rule
    source: str
    certainty: str  #: of the source, see `solver.verdict.makers_rule.Certainty`


@dataclass(frozen=True, slots=True)
class RuleVerdict:
    """What a maker's rule says of a landing."""

    rule: str
    title: str
    status: RuleStatus  #: exceeded if any finding is, else cannot_tell if any is
    verdict: Verdict  #: NORMAL, INSPECT, HARD, or UNDETERMINED where the rule cannot tell
    findings: tuple[RuleFinding, ...]


@dataclass(frozen=True, slots=True)
class PeakField:
    """Every element's peak over the whole landing, in the solver's element order."""

    element_identifiers: IntArray  #: (ne,)
    stress: Array  #: (ne,) von Mises [Pa]
    utilisation: Array  #: (ne,)
    time: Array  #: (ne,) [s]
    contact: IntArray  #: (ne,)


@dataclass(frozen=True, slots=True)
class Timing:
    """Wall-clock seconds of each step."""

    simulation: float
    reduced_solution: float
    peak_search: float
    total: float
    probability: float = 0.0


@dataclass(frozen=True, slots=True)
class Assessment:
    """All that is stored about a landing."""

    verdict: Verdict  #: from stress and gear loads
    action: Verdict  #: the stricter of that and the maker's rule
    rule_difference: RuleDifference
    makers_rule: RuleVerdict | None  #: None if the aircraft's definition names no rule
    reasons: tuple[Reason, ...]
    #: None if the record does not say how well it is known
    limit_probability: LimitProbability | None
    driving_contact: int | None  #: None if no contact could be simulated
    worst_utilisation: float
    worst_margin: float
    hot_spots: tuple[HotSpot, ...]
    gear_loads: tuple[GearLoad, ...]
    peak_normal_load_factor: float  #: [g]
    energy_error: float
    equilibrium_residual: float  #: of the structural loads, relative to them
    notes: tuple[str, ...]  #: defaults used, what was not assessed
    model_hash: str
    program_version: str
    timing: Timing
    peak_field: PeakField | None = None
    histories: tuple[LandingHistory, ...] = ()  #: one for each contact
    advisory: str = ADVISORY

    @property
    def probability_limit_exceeded(self) -> float | None:
        """Probability that a limit allowable or a gear's design limit load was exceeded."""
        known = self.limit_probability
        return None if known is None else known.probability
