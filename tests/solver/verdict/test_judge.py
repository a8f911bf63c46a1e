"""The verdict from margins and contact conditions: every reason alone, and together."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.definition_reader import load_definition
from solver.assessment import (
    GearLoad,
    HotSpot,
    LimitProbability,
    ProbabilityBasis,
    Reason,
    TouchdownRecord,
    Verdict,
)
from solver.landing.contact import Contact
from solver.landing.history import (
    EnergyAccount,
    GroundContact,
    LandingHistory,
    Outcome,
)
from solver.recorded import RecordedContact
from solver.verdict.judge import judge, severest
from tests.solver.aircraft.mini import write_mini_aircraft

CONTACT = Contact(sink_rate=1.0, ground_speed=55.0)


@pytest.fixture(scope="module")
def definition(tmp_path_factory: pytest.TempPathFactory) -> AircraftDefinition:
    folder: Path = tmp_path_factory.mktemp("aircraft")
    return load_definition(write_mini_aircraft(folder))


def spot(utilisation: float) -> HotSpot:
    return HotSpot(
        rank=1,
        component="wing",
        zone="rear spar",
        side="port",
        element=1,
        element_kind="CQUAD4",
        position=(0.0, 0.0, 0.0),
        peak_stress=utilisation * 300e6,
        allowable=300e6,
        utilisation=utilisation,
        margin=1 / utilisation - 1,
        time=0.1,
        contact=0,
        ata_chapter="57",
        inspection="cracks",
    )


def load(gear: str = "main_left", **changes: float) -> GearLoad:
    values: dict[str, float] = {
        "vertical_force": 40e3,
        "vertical_time": 0.1,
        "drag_force": 1e3,
        "spring_back_force": 1e3,
        "side_force": 0.0,
        "stroke": 0.1,
        "tyre_deflection": 0.02,
        "stroke_utilisation": 0.3,
        "utilisation": 0.3,
    }
    return GearLoad(gear=gear, contact=0, bounces=0, **(values | changes))


def history(
    *touched: tuple[str, float],
    outcome: Outcome = Outcome.SETTLED,
    closure_speed: float = 1.0,
) -> LandingHistory:
    """A landing that is nothing but its ground contacts (gear, start)."""
    empty = np.zeros(1)
    account = dataclasses.fields(EnergyAccount)
    energy = EnergyAccount(
        **{f.name: empty for f in account[:-2]}, impact_energy=1.0, closure_error=0.0
    )
    stays = tuple(
        GroundContact(gear, start, None, 1e3, 0.1, 1e3, 0.1, closure_speed)
        for gear, start in touched
    )
    arrays = {f.name: empty for f in dataclasses.fields(LandingHistory)}
    return LandingHistory(
        **(arrays | {"gears": (), "contacts": stays, "energy": energy, "outcome": outcome})
    )


MAINS_FIRST = history(("main_left", 0.0), ("main_right", 0.0), ("nose", 0.3))


def verdict_of(
    definition: AircraftDefinition,
    *,
    utilisation: float = 0.1,
    contact: Contact = CONTACT,
    landing: LandingHistory = MAINS_FIRST,
    loads: tuple[GearLoad, ...] = (),
    mass: float = 11_000.0,
    missing: tuple[str, ...] = (),
    unexplained: tuple[str, ...] = (),
    recorded: tuple[RecordedContact, ...] = (),
) -> tuple[Verdict, set[str]]:
    record = TouchdownRecord(
        aircraft=definition.name,
        contacts=(contact,),
        missing=missing,
        unexplained=unexplained,
        recorded=recorded,
    )
    reasons = judge(definition, record, mass, [landing], loads, spot(utilisation))
    return severest(reasons), {reason.code for reason in reasons}


class TestUtilisation:
    def test_every_threshold_is_where_the_definition_puts_it(
        self, definition: AircraftDefinition
    ) -> None:
        thresholds = definition.verdict
        for utilisation, expected in (
            (thresholds.firm_utilisation - 1e-9, Verdict.NORMAL),
            (thresholds.firm_utilisation, Verdict.FIRM),
            (thresholds.inspect_utilisation - 1e-9, Verdict.FIRM),
            (thresholds.inspect_utilisation, Verdict.INSPECT),
            (1.0, Verdict.INSPECT),
            (1.0 + 1e-9, Verdict.HARD),
        ):
            assert verdict_of(definition, utilisation=utilisation)[0] is expected

    def test_lower_thresholds_apply_above_the_landing_mass(
        self, definition: AircraftDefinition
    ) -> None:
        thresholds = definition.verdict
        between = thresholds.inspect_utilisation * (1 + thresholds.overweight_factor) / 2
        heavy = definition.masses.maximum_landing * 1.01
        assert verdict_of(definition, utilisation=between)[0] is Verdict.FIRM
        assert verdict_of(definition, utilisation=between, mass=heavy)[0] is Verdict.INSPECT

    def test_an_overweight_landing_says_so(self, definition: AircraftDefinition) -> None:
        heavy = definition.masses.maximum_landing * 1.01
        verdict, codes = verdict_of(definition, mass=heavy)
        assert verdict is Verdict.NORMAL
        assert "overweight" in codes

    def test_a_mass_rounded_to_the_limit_is_not_overweight(
        self, definition: AircraftDefinition
    ) -> None:
        rounded = definition.masses.maximum_landing + 0.4
        assert "overweight" not in verdict_of(definition, mass=rounded)[1]

    def test_a_gear_above_its_design_limit_is_hard_whatever_the_airframe_says(
        self, definition: AircraftDefinition
    ) -> None:
        verdict, codes = verdict_of(definition, loads=(load(utilisation=1.01),))
        assert verdict is Verdict.HARD
        assert "gear_limit_exceeded" in codes

    @pytest.mark.parametrize(
        ("changes", "code"),
        [
            ({"stroke_utilisation": 1.0}, "strut_bottomed"),
            ({"tyre_deflection": 0.08}, "tyre_bottomed"),
        ],
    )
    def test_a_stop_that_was_reached_is_inspected(
        self, definition: AircraftDefinition, changes: dict[str, float], code: str
    ) -> None:
        verdict, codes = verdict_of(definition, loads=(load(**changes),))
        assert verdict is Verdict.INSPECT
        assert code in codes


class TestContactConditions:
    def test_nose_first_sends_an_inspector_to_the_nose_gear(
        self, definition: AircraftDefinition
    ) -> None:
        landing = history(("nose", 0.0), ("main_left", 0.1), ("main_right", 0.1))
        verdict, codes = verdict_of(definition, landing=landing)
        assert verdict is definition.verdict.nose_first
        assert "nose_first" in codes

    def test_a_nose_gear_alone_on_the_ground_is_nose_first(
        self, definition: AircraftDefinition
    ) -> None:
        assert "nose_first" in verdict_of(definition, landing=history(("nose", 0.0)))[1]

    @pytest.mark.parametrize(
        ("switches", "lead", "named"),
        [
            (None, 0.02, True),
            (False, 0.02, False),  # three wheels together: the switches know which was first
            (False, 0.5, True),  # too long for switches to have missed
            (True, 0.02, True),
            (True, -0.3, True),
        ],
    )
    def test_switches_say_which_wheel_was_first_where_the_simulation_hardly_can(
        self, definition: AircraftDefinition, switches: bool | None, lead: float, named: bool
    ) -> None:
        landing = history(("nose", 1.0 - lead), ("main_left", 1.0), ("main_right", 1.1))
        recorded = (RecordedContact(nose_first=switches, simulated=0),)
        codes = verdict_of(definition, landing=landing, recorded=recorded)[1]
        assert ("nose_first" in codes) is named

    def test_a_nose_that_stayed_down_through_a_hop_is_not_first_again(
        self, definition: AircraftDefinition
    ) -> None:
        hop = history(("nose", 0.0), ("main_left", 0.6), ("main_right", 0.6))
        for switches, named in ((False, False), (True, True), (None, True)):
            record = TouchdownRecord(
                aircraft=definition.name,
                contacts=(CONTACT, CONTACT),
                recorded=(
                    RecordedContact(nose_first=False, simulated=0),
                    RecordedContact(nose_first=switches, simulated=1),
                ),
            )
            reasons = judge(definition, record, 11_000.0, [MAINS_FIRST, hop], (), spot(0.1))
            assert ("nose_first" in {reason.code for reason in reasons}) is named

    def test_a_nose_wheel_that_is_down_does_not_touch(self, definition: AircraftDefinition) -> None:
        both = history(("nose", 0.0), ("main_left", 0.001), ("main_right", 0.01))
        for is_down in (True, False):
            record = TouchdownRecord(
                aircraft=definition.name,
                contacts=(CONTACT, dataclasses.replace(CONTACT, nose_wheel_down=is_down)),
            )
            reasons = judge(definition, record, 11_000.0, [MAINS_FIRST, both], (), spot(0.1))
            assert ("nose_first" in {reason.code for reason in reasons}) is not is_down

    def test_a_bounce_onto_the_nose_after_the_mains_is_not_nose_first(
        self, definition: AircraftDefinition
    ) -> None:
        landing = history(("main_left", 0.0), ("nose", 0.2), ("main_left", 0.6))
        assert "nose_first" not in verdict_of(definition, landing=landing)[1]

    def test_a_nose_brought_down_fast_is_inspected_and_a_main_gear_is_not(
        self, definition: AircraftDefinition
    ) -> None:
        limit = definition.verdict.nose_closure_limit
        touched = (("main_left", 0.0), ("main_right", 0.0), ("nose", 0.3))
        for count, closure_speed, expected in (
            (3, limit, Verdict.INSPECT),
            (3, limit - 1e-9, Verdict.NORMAL),
            (2, limit, Verdict.NORMAL),
        ):
            landing = history(*touched[:count], closure_speed=closure_speed)
            verdict, codes = verdict_of(definition, landing=landing)
            assert verdict is expected
            assert ("nose_struck" in codes) is (expected is Verdict.INSPECT)

    @pytest.mark.parametrize("side", [1.0, -1.0])
    def test_roll_at_the_limit_is_inspected_on_either_side(
        self, definition: AircraftDefinition, side: float
    ) -> None:
        limit = definition.verdict.roll_limit
        at = dataclasses.replace(CONTACT, roll=side * limit)
        below = dataclasses.replace(CONTACT, roll=side * (limit - math.radians(0.01)))
        assert verdict_of(definition, contact=at)[0] is Verdict.INSPECT
        assert verdict_of(definition, contact=below)[0] is Verdict.NORMAL


class TestWhatCannotBeTold:
    def test_an_incomplete_record_is_never_normal(self, definition: AircraftDefinition) -> None:
        verdict, codes = verdict_of(definition, missing=("contacts[0].sink_rate",))
        assert verdict is Verdict.UNDETERMINED
        assert "record_incomplete" in codes

    def test_a_recorded_response_that_does_not_fit_is_never_normal(
        self, definition: AircraftDefinition
    ) -> None:
        verdict, codes = verdict_of(definition, unexplained=("contact 1: peaked at 2.2 g",))
        assert verdict is Verdict.UNDETERMINED
        assert "recorded_response_unexplained" in codes

    def test_what_is_known_to_be_hard_stays_hard(self, definition: AircraftDefinition) -> None:
        verdict, _ = verdict_of(definition, utilisation=1.2, missing=("contacts[1].pitch",))
        assert verdict is Verdict.HARD

    def test_a_landing_that_never_loads_a_gear_is_undetermined(
        self, definition: AircraftDefinition
    ) -> None:
        airborne = history(outcome=Outcome.TIME_LIMIT)
        assert verdict_of(definition, landing=airborne)[0] is Verdict.UNDETERMINED

    def test_nothing_found_is_no_verdict(self) -> None:
        assert severest(()) is Verdict.UNDETERMINED


def test_reasons_come_most_severe_first(definition: AircraftDefinition) -> None:
    record = TouchdownRecord(aircraft=definition.name, contacts=(CONTACT,), missing=("x",))
    firm = definition.verdict.firm_utilisation
    loads = (load(utilisation=1.5), load(stroke_utilisation=1.0), load(utilisation=firm))
    reasons = judge(definition, record, 11e3, [MAINS_FIRST], loads, spot(0.1))
    assert [reason.verdict for reason in reasons] == [
        Verdict.HARD,
        Verdict.UNDETERMINED,
        Verdict.INSPECT,
        Verdict.FIRM,
        Verdict.NORMAL,
    ]


def likelihood(
    probability: float, basis: ProbabilityBasis = ProbabilityBasis.SAMPLES
) -> LimitProbability:
    return LimitProbability(probability, 0.01, 0.0, max(probability, 0.016), 256, 0, basis)


class TestProbability:
    def reason(self, definition: AircraftDefinition, known: LimitProbability) -> Reason:
        (found,) = (
            reason
            for reason in judge(
                definition,
                TouchdownRecord("mini", (CONTACT,)),
                10_000.0,
                [history(("main_left", 0.0))],
                [load()],
                spot(0.3),
                known,
            )
            if "probab" in reason.text
        )
        return found

    def test_the_threshold_weighs_a_missed_landing_against_a_needless_look(
        self, definition: AircraftDefinition
    ) -> None:
        """Not looking costs 20 p, looking 1 (1 - p): equal at p = 1 / 21."""
        assert definition.verdict.inspect_probability == pytest.approx(1 / 21)

    @pytest.mark.parametrize(
        ("probability", "verdict"),
        [
            (0.0, Verdict.NORMAL),
            (0.047, Verdict.NORMAL),
            (0.048, Verdict.INSPECT),
            (0.89, Verdict.INSPECT),
            (0.9, Verdict.HARD),
            (1.0, Verdict.HARD),
        ],
    )
    def test_probabilities_have_their_verdicts(
        self, definition: AircraftDefinition, probability: float, verdict: Verdict
    ) -> None:
        assert self.reason(definition, likelihood(probability)).verdict is verdict

    def test_the_reason_says_what_it_rests_on(self, definition: AircraftDefinition) -> None:
        sampled = self.reason(definition, likelihood(0.1)).text
        assert "10.0%" in sampled
        assert "256 simulated landings" in sampled
        settled = self.reason(definition, likelihood(0.0, ProbabilityBasis.CORNERS)).text
        assert "0 (at most 1.6%" in settled

    def test_a_low_probability_lowers_no_verdict(self, definition: AircraftDefinition) -> None:
        reasons = judge(
            definition,
            TouchdownRecord("mini", (CONTACT,)),
            10_000.0,
            [history(("main_left", 0.0))],
            [load()],
            spot(0.9),
            likelihood(0.0),
        )
        assert severest(reasons) is Verdict.INSPECT
