"""What a rule says when the record says too little: never 'passed'."""

import math

import pytest

from solver.assessment import Verdict
from solver.landing.contact import Contact
from tests.solver.verdict.rule_cases import (
    CANNOT_TELL,
    EXCEEDED,
    LANDING_MASS,
    PASSED,
    contact,
    finding,
    held,
)
from tests.solver.verdict.test_judge import history

SLOW_ROLL = math.radians(1.0)


class TestMissingData:
    def test_without_a_recorded_peak(self) -> None:
        verdict = held("boeing-737", contact(None))
        assert verdict.status is CANNOT_TELL
        assert verdict.verdict is Verdict.UNDETERMINED
        (found,) = verdict.findings
        assert (found.value, found.text) == (
            None, "contact 1, normal load factor: cannot be judged: it is not recorded",
        )  # fmt: skip

    def test_a_record_with_states_alone_is_never_passed(self) -> None:
        states = (Contact(sink_rate=0.5, ground_speed=60.0),)
        assert held("boeing-737", simulated=states).status is CANNOT_TELL
        told = held("airbus-a320-classic", simulated=states, histories=(mains_first(),))
        assert finding(told, "vertical speed").status is PASSED
        assert told.status is CANNOT_TELL

    def test_nothing_recorded_at_all(self) -> None:
        assert held("boeing-737").status is CANNOT_TELL

    def test_without_the_mass(self) -> None:
        told = held("boeing-737", contact(1.2), mass=None)
        assert told.status is CANNOT_TELL
        assert "the mass is not recorded" in told.findings[0].text
        assert told.findings[0].limit is None

    def test_without_the_roll(self) -> None:
        told = held("boeing-737", contact(1.2, roll=None))
        assert told.status is CANNOT_TELL
        assert "the roll is not recorded" in told.findings[0].text

    @pytest.mark.parametrize("unknown", [{"mass": None}, {"roll": None}])
    def test_above_every_limit_it_could_have_it_is_exceeded_all_the_same(
        self, unknown: dict[str, None]
    ) -> None:
        """737 at 16 Hz: at most 2.20 g whatever mass and roll."""
        roll = unknown.get("roll", 0.0)
        mass = unknown.get("mass", LANDING_MASS)
        for nz, status in ((2.20, CANNOT_TELL), (2.21, EXCEEDED)):
            assert held("boeing-737", contact(nz, roll=roll), mass=mass).status is status

    def test_a_lateral_peak_is_needed_where_the_rule_limits_it(self) -> None:
        usual = {"sink_rate": 1.0, "roll_rate": 0.0}
        without = held("ebj-19", contact(1.3, 8, **usual))
        within = held("ebj-19", contact(1.3, 8, ny=-0.2, **usual))
        beyond = held("ebj-19", contact(1.3, 8, ny=-0.41, **usual))
        assert (without.status, within.status, beyond.status) == (CANNOT_TELL, PASSED, EXCEEDED)

    def test_roll_rate_is_not_needed_below_its_onset(self) -> None:
        """Embraer 175 at 30 t: 1.83 - 0.63 (30 - 21.8) / (38.79 - 21.8) = 1.526 g."""
        for nz, status in ((1.52, PASSED), (1.53, CANNOT_TELL)):
            told = held("embraer-170-175", contact(nz, 8), mass=30_000.0)
            assert finding(told, "roll rate").status is status

    def test_whether_the_onset_was_reached_must_be_recorded_fast_enough(self) -> None:
        fast_roll = math.radians(15.0)
        for peak, hz, status in (
            (None, 8, CANNOT_TELL), (1.2, 4, CANNOT_TELL), (1.2, 8, PASSED), (1.8, 4, EXCEEDED),
        ):  # fmt: skip
            told = held("embraer-170-175", contact(peak, hz, roll_rate=fast_roll), mass=30_000.0)
            assert finding(told, "roll rate").status is status

    def test_the_onset_needs_the_mass_between_the_ends_of_its_line(self) -> None:
        for nz, status in ((1.19, PASSED), (1.5, CANNOT_TELL), (1.9, EXCEEDED)):
            rolling = contact(nz, 8, roll_rate=math.radians(15.0))
            told = held("embraer-170-175", rolling, mass=None)
            assert finding(told, "roll rate").status is status


class TestSampleRate:
    def test_a_slow_recorder_passes_nothing(self) -> None:
        told = held("boeing-767", contact(1.3, 4))
        assert told.status is CANNOT_TELL
        assert "recorded at 4 Hz, the rule needs 8 Hz" in told.findings[0].text

    def test_a_slow_recorder_can_only_have_missed_more(self) -> None:
        """767: 1.8 g at 8 Hz."""
        for nz, status in ((1.80, CANNOT_TELL), (1.81, EXCEEDED)):
            assert held("boeing-767", contact(nz, 4)).status is status

    def test_lateral_acceleration_has_a_rate_of_its_own(self) -> None:
        usual = {"sink_rate": 1.0, "roll_rate": 0.0}
        for hz, status in ((2, CANNOT_TELL), (4, PASSED)):
            told = held("ebj-19", contact(1.3, hz, ny=0.2, **usual))
            assert finding(told, "lateral load factor").status is status


class TestFirstGear:
    def test_the_nose_first_is_outside_the_rule(self) -> None:
        for nz, status in ((1.4, CANNOT_TELL), (2.3, EXCEEDED)):
            assert held("boeing-737", contact(nz, nose_first=True)).status is status

    def test_the_simulation_says_what_the_switches_do_not(self) -> None:
        unknown = contact(1.4, nose_first=None, simulated=0)
        for landing, status in (
            (mains_first(), PASSED),
            (history(("nose", 0.0), ("main_left", 0.2)), CANNOT_TELL),
            (history(), CANNOT_TELL),
        ):
            assert held("boeing-737", unknown, histories=(landing,)).status is status

    def test_unknown_without_a_simulation(self) -> None:
        told = held("boeing-737", contact(1.4, nose_first=None))
        assert told.status is CANNOT_TELL
        assert "which gear touched first" in told.findings[0].text


class TestSeveralContacts:
    def test_one_exceeded_is_enough(self) -> None:
        told = held("boeing-737", contact(1.2), contact(None), contact(2.5))
        assert [f.status for f in told.findings] == [PASSED, CANNOT_TELL, EXCEEDED]
        assert (told.status, told.verdict) == (EXCEEDED, Verdict.INSPECT)

    def test_one_unknown_leaves_the_whole_unknown(self) -> None:
        told = held("boeing-737", contact(1.2), contact(None))
        assert (told.status, told.verdict) == (CANNOT_TELL, Verdict.UNDETERMINED)

    def test_the_contact_of_a_finding_counts_those_that_could_not_be_simulated(self) -> None:
        bounce = (contact(1.2, simulated=None), contact(1.4, nose_first=None, simulated=0))
        told = held("boeing-737", *bounce, histories=(mains_first(),))
        assert [(f.contact, f.status) for f in told.findings] == [(0, PASSED), (1, PASSED)]


def mains_first() -> object:
    return history(("main_left", 0.0), ("nose", 0.4))


def test_numbers_are_si_and_the_text_speaks_the_rules_units() -> None:
    told = held("airbus-a320-classic", contact(1.5, 8, sink_rate=3.3))
    found = finding(told, "vertical speed")
    assert (found.value, found.unit) == (3.3, "m/s")
    assert found.limit == pytest.approx(600 * 0.3048 / 60)
    assert found.text == (
        "contact 1, vertical speed: 649.6 ft/min exceeds the limit of 600 ft/min "
        "(up to landing mass)"
    )


def test_a_limit_met_exactly_in_other_units_is_not_exceeded() -> None:
    """10 ft/s is 600 ft/min."""
    told = held("airbus-a320-classic", contact(1.5, 8, sink_rate=10 * 0.3048))
    assert finding(told, "vertical speed").status is PASSED
