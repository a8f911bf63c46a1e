"""`hardlanding assess`: the same record and the same answer as through the service."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from app.cli.main import app
from app.config import get_settings
from app.landings.intake import parse_record, take_in
from solver.aircraft.definition_reader import load_definition
from solver.assess import assess_landing, load_assessment_model
from tests.records import changed, contact, record

runner = CliRunner()


@pytest.fixture(autouse=True)
def _cached(cache_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HL_CACHE_DIR", str(cache_folder))
    monkeypatch.setenv("HL_PROPAGATE_UNCERTAINTY", "false")
    get_settings.cache_clear()


def assess(tmp_path: Path, aircraft: Path, document: Any, *options: str) -> Any:
    path = tmp_path / "record.json"
    path.write_text(json.dumps(document))
    return runner.invoke(app, ["assess", str(path), "--aircraft-dir", str(aircraft), *options])


def test_json_on_standard_output_is_the_whole_answer(tmp_path: Path, aircraft_folder: Path) -> None:
    result = assess(tmp_path, aircraft_folder, record(3.0), "--json")
    assert result.exit_code == 0, result.output
    answer = json.loads(result.stdout)
    assert answer["verdict"] in {"NORMAL", "FIRM"}
    assert answer["hot_spots"][0]["rank"] == 1
    assert answer["probability_limit_exceeded"] is None
    assert len(answer["gear_loads"]) == 3
    assert answer["equilibrium_residual"] < 1e-8
    assert "Advisory only" in answer["advisory"]


def test_a_soft_landing_has_its_probability(
    tmp_path: Path, aircraft_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HL_PROPAGATE_UNCERTAINTY", "true")
    get_settings.cache_clear()
    answer = json.loads(assess(tmp_path, aircraft_folder, record(3.0), "--json").stdout)
    assert answer["probability_limit_exceeded"] == 0.0
    assert answer["limit_probability"]["basis"] == "corners"


def test_the_same_record_gives_the_same_answer_to_the_last_digit(
    tmp_path: Path, aircraft_folder: Path
) -> None:
    answers = [
        json.loads(assess(tmp_path, aircraft_folder, record(5.0), "--json").stdout)
        for _ in range(2)
    ]
    for answer in answers:
        del answer["timing"]
    assert answers[0] == answers[1]


def test_the_table_names_verdict_zone_and_gear(tmp_path: Path, aircraft_folder: Path) -> None:
    result = assess(tmp_path, aircraft_folder, record(12.0))
    assert result.exit_code == 0, result.output
    for word in ("HARD", "Where to look", "Gear loads", "main_left", "Advisory only"):
        assert word in result.stdout


@pytest.mark.parametrize(
    ("path", "value", "told"),
    [
        ("contacts.0.pitch.value", 95, "pitch"),
        ("aircraft.model_id", "no-such-jet", "no-such-jet"),
        ("mass.gross_weight.unit", "stone", "gross_weight"),
    ],
)
def test_a_bad_record_names_its_field(
    tmp_path: Path, aircraft_folder: Path, path: str, value: Any, told: str
) -> None:
    result = assess(tmp_path, aircraft_folder, changed(path, value))
    assert result.exit_code == 2
    assert told in result.stderr


def test_the_worst_of_several_contacts_gives_the_verdict(
    aircraft_folder: Path, cache_folder: Path
) -> None:
    """A soft first contact must not hide the hard one after the bounce."""
    definition = load_definition(aircraft_folder / "mini")
    model = load_assessment_model(aircraft_folder / "mini", cache_folder)

    def assessed(*sink_rates: float) -> Any:
        document = record() | {"contacts": [contact(rate) for rate in sink_rates]}
        landing = take_in(parse_record(document), definition).record
        return assess_landing(model, replace(landing, uncertainties=()))

    soft, hard, both = assessed(2.0), assessed(11.0), assessed(2.0, 11.0)
    assert both.verdict is hard.verdict
    assert both.driving_contact == 1
    # by itself the hard one would have to spin its wheels up
    assert soft.worst_utilisation < both.worst_utilisation < hard.worst_utilisation
    assert {load.contact for load in both.gear_loads} == {0, 1}


def test_a_contact_of_unknown_sink_rate_is_left_out_and_named(
    aircraft_folder: Path, cache_folder: Path
) -> None:
    document = record(2.0)
    second = contact(2.0)
    del second["sink_rate"]
    document["contacts"].append(second)
    definition = load_definition(aircraft_folder / "mini")
    model = load_assessment_model(aircraft_folder / "mini", cache_folder)
    answer = assess_landing(model, take_in(parse_record(document), definition).record)
    assert answer.verdict == "UNDETERMINED"
    assert "contacts[1].sink_rate" in answer.reasons[0].text
    assert len(answer.histories) == 1
