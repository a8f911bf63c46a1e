"""What is made of an envelope whose utilisation is known: sink rate over 4 m/s."""

from dataclasses import replace

import numpy as np
import pytest

from solver.assessment import TouchdownRecord, Verdict
from solver.envelope.provisional import ProvisionalVerdict, provisional_verdict
from solver.landing.contact import Contact, Lift, LiftModel
from solver.recorded import RecordedContact
from solver.verdict.judge import SEVERITY
from tests.solver.envelope.synthetic import HARDEST, linear_envelope
from tests.solver.verdict.rule_cases import mini_definition

LIMIT = 4.0
MASS = 11_000.0


def contact(sink_rate: float, **fields: object) -> Contact:
    return replace(Contact(sink_rate, ground_speed=55.0, pitch=0.06), **fields)  # type: ignore[arg-type]


def given(*contacts: Contact, mass: float = MASS, **fields: object) -> TouchdownRecord:
    return replace(TouchdownRecord("mini", contacts, mass=mass), **fields)  # type: ignore[arg-type]


def judged(*contacts: Contact, mass: float = MASS, above: float = 0.0) -> ProvisionalVerdict:
    return provisional_verdict(linear_envelope(LIMIT, above=above), given(*contacts, mass=mass))


@pytest.mark.parametrize("sink_rate", [0.05, 1.0, 2.5, 3.7, 4.2, 9.0])
def test_graded_as_the_full_verdict_is(sink_rate: float) -> None:
    thresholds = mini_definition().verdict
    used = sink_rate / LIMIT
    expected = (
        Verdict.HARD if used > 1.0
        else Verdict.INSPECT if used >= thresholds.inspect_utilisation
        else Verdict.FIRM if used >= thresholds.firm_utilisation
        else Verdict.NORMAL
    )  # fmt: skip
    found = judged(contact(sink_rate))
    assert found.verdict is expected
    assert found.reasons == ()


def test_the_limit_sink_rate_and_its_error() -> None:
    found = judged(contact(2.0), above=0.25)
    assert found.driving is not None
    limit = found.driving.limit_sink_rate
    assert limit.value == pytest.approx(LIMIT, rel=2e-3)
    assert limit.low == pytest.approx(LIMIT / 1.25, rel=2e-3)
    assert found.driving.expected.utilisation == pytest.approx(0.5, rel=2e-3)
    assert found.driving.expected.high == pytest.approx(0.625, rel=2e-3)


def test_within_the_error_of_a_threshold_the_stricter_verdict_is_given() -> None:
    assert judged(contact(3.6)).verdict is Verdict.INSPECT
    assert judged(contact(3.6), above=0.15).verdict is Verdict.HARD


def test_a_rising_sink_rate_never_lowers_the_verdict_where_the_surface_dips() -> None:
    envelope = linear_envelope(LIMIT)
    used = envelope.surface.utilisations
    # A part that is relieved by harder contacts: 0.9 at the softest, falling to 0.2.
    dip = 0.55 - 0.35 * envelope.surface.places[:, :1]
    surface = replace(envelope.surface, utilisations=np.hstack([used, dip]))
    envelope = replace(envelope, surface=surface)
    verdicts = []
    for sink_rate in np.linspace(0.1, 6.0, 40):
        found = provisional_verdict(envelope, given(contact(float(sink_rate)))).verdict
        assert found is not None
        verdicts.append(SEVERITY[found])
    assert verdicts == sorted(verdicts)
    assert verdicts[0] > 0, "the dip itself counts"


def test_lower_thresholds_above_the_landing_mass() -> None:
    definition = mini_definition()
    factor, inspect = definition.verdict.overweight_factor, definition.verdict.inspect_utilisation
    between = contact(LIMIT * inspect * 0.5 * (1.0 + factor))
    assert judged(between).verdict is Verdict.FIRM
    heavy = definition.masses.maximum_landing + 500.0
    assert judged(between, mass=heavy).verdict is Verdict.INSPECT


def test_a_stop_that_may_be_reached_asks_for_a_look() -> None:
    envelope = linear_envelope(LIMIT, stop=1.02)
    assert provisional_verdict(envelope, given(contact(1.0))).verdict is Verdict.INSPECT


def test_roll_at_its_limit_asks_for_a_look() -> None:
    limit = mini_definition().verdict.roll_limit
    assert judged(contact(1.0, roll=-limit)).verdict is Verdict.INSPECT


def test_the_worst_contact_decides() -> None:
    found = judged(contact(1.0), contact(3.7), contact(0.5))
    assert found.verdict is Verdict.INSPECT
    assert found.driving is not None
    assert found.driving.contact == 1


@pytest.mark.parametrize(
    ("strange", "said"),
    [
        (contact(1.0, pitch=-0.03), "the main gears do not clearly touch first: pitch -1.719"),
        (contact(1.0, drift=0.2), "drift 11.46 deg is outside"),
        (contact(1.0, roll_rate=0.3), "roll rate 17.19 deg/s is outside"),
        (contact(1.0, roll=0.3), "roll 17.19 deg is outside"),
        (contact(1.0, lift=Lift(LiftModel.HELD)), "lift is held"),
    ],
)
def test_a_contact_that_is_not_covered_is_never_normal(strange: Contact, said: str) -> None:
    found = judged(contact(1.0), strange)
    assert found.verdict is None
    assert found.reasons[0].startswith("contact 2: ")
    assert said in found.reasons[0]
    assert judged(contact(4.5), strange).verdict is Verdict.HARD, "nothing could make it milder"


def test_nose_first_by_the_gear_switches() -> None:
    recorded = (RecordedContact(sink_rate=1.0, nose_first=True, simulated=0),)
    found = provisional_verdict(linear_envelope(), given(contact(1.0), recorded=recorded))
    assert found.verdict is None
    assert "nose gear touched first" in found.reasons[0]


def test_an_unknown_contact_leaves_no_verdict_unless_another_is_hard() -> None:
    envelope = linear_envelope(LIMIT)
    lacking = given(contact(1.0), missing=("contacts[1].sink_rate",))
    found = provisional_verdict(envelope, lacking)
    assert found.verdict is None
    assert "contacts[1].sink_rate" in found.reasons[0]
    hard = replace(lacking, contacts=(contact(4.5),))
    assert provisional_verdict(envelope, hard).verdict is Verdict.HARD
    nothing = provisional_verdict(envelope, replace(lacking, contacts=()))
    assert (nothing.verdict, nothing.driving) == (None, None)


def test_a_loading_that_cannot_be_met() -> None:
    found = judged(contact(1.0), mass=30_000.0)
    assert found.verdict is None
    assert "cannot be met" in found.reasons[0]


def test_beyond_the_hardest_landing_of_an_envelope_that_is_not_hard_there() -> None:
    strong = linear_envelope(limit=2.0 * HARDEST)
    found = provisional_verdict(strong, given(contact(HARDEST + 1.0)))
    assert found.verdict is None
    assert "beyond the envelope's 5 m/s" in found.reasons[0]
