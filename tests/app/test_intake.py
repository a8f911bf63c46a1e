"""Records become what the solver takes: units, signs, defaults."""

import json
import math
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from app.landings import inputs
from app.landings.field_errors import InvalidRecordError
from app.landings.intake import parse_record, read_record_file, take_in
from solver import units
from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.definition_reader import load_definition
from solver.landing.contact import LiftModel
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.units import Dimension, allowed_units, from_si, to_si
from tests.records import contact, record


@pytest.fixture
def mini(aircraft_folder: Path) -> AircraftDefinition:
    return load_definition(aircraft_folder / "mini")


#: By definition: foot and pound of 1959, international nautical mile, standard gravity of 1901.
EXACT = [
    (1000.0, "ft/min", Dimension.SPEED, 5.08),
    (10.0, "ft/s", Dimension.SPEED, 3.048),
    (3600.0, "kt", Dimension.SPEED, 1852.0),
    (36.0, "km/h", Dimension.SPEED, 10.0),
    (180.0, "deg", Dimension.ANGLE, math.pi),
    (180.0, "deg/s", Dimension.ANGULAR_RATE, math.pi),
    (100.0, "lb", Dimension.MASS, 45.359237),
    (1.5, "t", Dimension.MASS, 1500.0),
    (9.80665, "m/s2", Dimension.LOAD_FACTOR, 1.0),
    (12.0, "in", Dimension.STATION, 0.3048),
    (10.0, "ft", Dimension.STATION, 3.048),
    (250.0, "ms", Dimension.TIME, 0.25),
    (90.0, "%", Dimension.FRACTION, 0.9),
]


@pytest.mark.parametrize(("value", "unit", "dimension", "expected"), EXACT)
def test_units(value: float, unit: str, dimension: Dimension, expected: float) -> None:
    assert to_si(value, unit, dimension) == pytest.approx(expected, rel=1e-15)
    assert from_si(expected, unit, dimension) == pytest.approx(value, rel=1e-15)


def test_every_unit_that_a_record_may_name_has_a_factor() -> None:
    for dimension in Dimension:
        for unit in allowed_units(dimension):
            if unit != units.PERCENT_CHORD:
                assert to_si(1.0, unit, dimension) > 0
    assert set(get_args(units.SpeedUnit)) == set(allowed_units(Dimension.SPEED))


def test_signs_and_units_of_a_contact(mini: AircraftDefinition) -> None:
    posted = record(
        contacts=[
            contact(
                roll={"value": -2, "unit": "deg"},
                drift={"value": 4, "unit": "deg"},
                roll_rate={"value": 3, "unit": "deg/s"},
            )
        ]
    )
    posted["contacts"][0]["sink_rate"] = {"value": 600, "unit": "ft/min"}
    (landed,) = take_in(parse_record(posted), mini).record.contacts
    assert landed.sink_rate == pytest.approx(3.048)
    assert landed.ground_speed == pytest.approx(120 * 1852 / 3600)
    assert landed.roll == pytest.approx(math.radians(-2))
    assert landed.drift == pytest.approx(math.radians(4))
    assert landed.roll_rate == pytest.approx(math.radians(3))
    assert (landed.pitch_rate, landed.yaw_rate) == (0.0, 0.0)


def test_mass_and_balance(mini: AircraftDefinition) -> None:
    posted = record(
        fuel={"wing_left": {"value": 1000, "unit": "lb"}},
        payload={"cabin": {"value": 0.4, "unit": "t"}},
    )
    landing = take_in(parse_record(posted), mini).record
    reference = mini.reference
    assert landing.mass == pytest.approx(25_000 * 0.45359237)
    assert landing.centre_of_gravity == pytest.approx(
        reference.mean_chord_leading_edge + 0.24 * reference.mean_chord
    )
    assert landing.fuel == {"wing_left": pytest.approx(453.59237)}
    assert landing.payload == {"cabin": pytest.approx(400.0)}


def test_what_the_record_does_not_say_stays_open(mini: AircraftDefinition) -> None:
    landing = take_in(parse_record(record(mass={})), mini).record
    assert landing.mass is None
    assert landing.centre_of_gravity is None
    assert landing.fuel == {}


def test_deviations_are_kept_and_defaults_are_flagged(mini: AircraftDefinition) -> None:
    intake = take_in(parse_record(record()), mini)
    assert intake.sd["mass.gross_weight"] == pytest.approx(250 * 0.45359237)
    assert intake.sd["mass.cg"] == pytest.approx(0.02 * mini.reference.mean_chord)
    assert intake.sd["contacts[0].pitch"] == pytest.approx(math.radians(0.5))
    assert "contacts[0].pitch" in intake.sd_defaulted
    assert "mass.gross_weight" not in intake.sd_defaulted


def test_lift_is_never_assumed_to_last(mini: AircraftDefinition) -> None:
    (landed,) = take_in(parse_record(record()), mini).record.contacts
    assert landed.lift.model is LiftModel.DECAYING


def test_lift_decays_on_where_a_later_contact_does_not_say(mini: AircraftDefinition) -> None:
    """The spoilers are taken to come out half a second after the first contact, once."""
    given = {"decay_start": {"value": 0.4, "unit": "s"}}
    later = [contact(time={"value": time, "unit": "s"}) for time in (0.2, 1.5)]
    stated = contact(time={"value": 1.5, "unit": "s"}, lift={"model": "decaying", **given})
    posted = record(contacts=[contact(), *later, stated])
    found = take_in(parse_record(posted), mini).record.contacts
    assert [each.lift.decay_start for each in found] == pytest.approx([0.5, 0.3, 0.0, 0.4])


def test_lift_as_given(mini: AircraftDefinition) -> None:
    trimmed = {
        "model": "trimmed",
        "normal_acceleration": {"value": 0.95, "unit": "g"},
        "decay_time": {"value": 800, "unit": "ms"},
    }
    short = {"value": 0.9}
    posted = record(contacts=[contact(lift=trimmed), contact(lift_fraction=short)])
    first, second = take_in(parse_record(posted), mini).record.contacts
    assert first.lift.model is LiftModel.TRIMMED
    assert first.lift.recorded_normal_acceleration == pytest.approx(0.95)
    assert first.lift.decay_time == pytest.approx(0.8)
    assert second.lift.fraction == pytest.approx(0.9)


def test_contacts_are_timed_from_the_first(mini: AircraftDefinition) -> None:
    posted = record(
        contacts=[
            contact(t_utc="2026-03-01T04:00:00.50Z"),
            contact(t_utc="2026-03-01T04:00:02.75Z"),
            contact(time={"value": 4, "unit": "s"}),
        ]
    )
    times = [landed.time for landed in take_in(parse_record(posted), mini).record.contacts]
    assert times == pytest.approx([0.0, 2.25, 4.0])


@pytest.mark.parametrize("name", ["sink_rate", "ground_speed", "pitch", "roll"])
def test_an_unknown_state_is_missing_for_a_verdict(mini: AircraftDefinition, name: str) -> None:
    posted = record()
    del posted["contacts"][0][name]
    assert take_in(parse_record(posted), mini).record.missing == (f"contacts[0].{name}",)


@pytest.mark.parametrize(("rate", "is_missing"), [(2.0, True), (4.0, False), (8.0, False)])
def test_a_recorder_must_be_fast_enough(
    mini: AircraftDefinition, rate: float, is_missing: bool
) -> None:
    peak = {"value": 1.4, "unit": "g", "rate_hz": rate}
    landing = take_in(parse_record(record(contacts=[contact(nz_peak=peak)])), mini).record
    assert bool(landing.missing) is is_missing


def test_the_solvers_input_survives_storage(mini: AircraftDefinition) -> None:
    posted = record(contacts=[contact(lift_fraction={"value": 0.9}), contact(3.0)])
    landing = take_in(parse_record(posted), mini).record
    assert inputs.from_json(json.loads(json.dumps(inputs.to_json(landing)))) == landing


class TestFile:
    def test_a_file_is_taken_in_like_a_posting(self, aircraft_folder: Path, tmp_path: Path) -> None:
        path = tmp_path / "record.json"
        path.write_text(json.dumps(record()))
        intake = read_record_file(path, aircraft_folder)
        assert intake.record.aircraft == "mini"

    @pytest.mark.parametrize(
        ("text", "said"),
        [
            ("{", "not valid JSON"),
            ('{"aircraft": {"model_id": "zeppelin"}, "contacts": [{}]}', "allowed: mini"),
            ('{"aircraft": {"model_id": "mini"}, "contacts": [{"pitch": 3}]}', "contacts[0].pitch"),
        ],
    )
    def test_faults_are_named(
        self, aircraft_folder: Path, tmp_path: Path, text: str, said: str
    ) -> None:
        path = tmp_path / "record.json"
        path.write_text(text)
        with pytest.raises(InvalidRecordError) as caught:
            read_record_file(path, aircraft_folder)
        assert said in str(caught.value)


class TestUncertainty:
    def test_deviations_reach_the_solver_in_si(self, mini: AircraftDefinition) -> None:
        """Foot of 1959 and pound; what the record does not say has the documented default."""
        taken = take_in(parse_record(record(6.0)), mini).record
        (known,) = taken.uncertainties
        deviations = dict(zip(CONTACT_COMPONENTS, np.sqrt(np.diag(known.matrix)), strict=True))
        assert deviations["sink_rate"] == pytest.approx(0.3048)
        assert deviations["roll"] == pytest.approx(math.radians(0.5))
        assert deviations["drift"] == pytest.approx(math.radians(1.0))
        assert deviations["yaw_rate"] == pytest.approx(math.radians(0.8))
        assert deviations["lift_fraction"] == pytest.approx(0.1)
        assert taken.mass_deviation == pytest.approx(250 * 0.45359237)
        assert taken.centre_of_gravity_deviation == pytest.approx(0.02 * mini.reference.mean_chord)

    def test_a_trimmed_lift_is_as_uncertain_as_its_acceleration(
        self, mini: AircraftDefinition
    ) -> None:
        lift = {
            "model": "trimmed",
            "normal_acceleration": {"value": 0.98, "unit": "g", "sd": 0.02},
        }
        taken = take_in(parse_record(record(contacts=[contact(lift=lift)])), mini).record
        assert np.sqrt(taken.uncertainties[0].matrix[8, 8]) == pytest.approx(0.02)

    def test_each_simulated_contact_has_its_own(self, mini: AircraftDefinition) -> None:
        unknown = contact()
        del unknown["sink_rate"]
        taken = take_in(parse_record(record(contacts=[contact(), unknown, contact(3.0)])), mini)
        assert len(taken.record.contacts) == len(taken.record.uncertainties) == 2

    def test_the_friction_of_the_runway_reaches_the_solver(self, mini: AircraftDefinition) -> None:
        known = take_in(parse_record(record(leg={"runway_friction": {"value": 0.45}})), mini)
        assert known.record.runway_friction == 0.45
        assert known.record.runway_friction_deviation == 0.05
        assert "leg.runway_friction" in known.sd_defaulted
        unknown = take_in(parse_record(record(leg={"surface": "wet"})), mini).record
        assert unknown.runway_friction is None

    def test_the_course_of_the_lift_is_as_uncertain_as_stated(
        self, mini: AircraftDefinition
    ) -> None:
        lift = {
            "decay_start": {"value": 0.6, "unit": "s", "sd": 0.05},
            "decay_time": {"value": 800, "unit": "ms", "sd": 80},
            "residual_fraction": {"value": 0.4, "unit": "1"},
        }
        taken = take_in(parse_record(record(contacts=[contact(lift=lift)])), mini).record
        assert taken.uncertainties[0].lift_course == (
            pytest.approx(0.05),
            pytest.approx(0.1),
            None,
        )

    @pytest.mark.parametrize("lift", [None, {"decay_start": {"value": 0.6, "unit": "s", "sd": 0}}])
    def test_stored_and_read_again(
        self, mini: AircraftDefinition, lift: dict[str, Any] | None
    ) -> None:
        given = contact() if lift is None else contact(lift=lift)
        taken = take_in(parse_record(record(contacts=[given])), mini).record
        assert inputs.from_json(json.loads(json.dumps(inputs.to_json(taken)))) == taken
