"""The maker's rule beside the stress verdict, over HTTP and on the command line."""

import dataclasses
import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from alembic import command
from sqlalchemy import Engine, select, text
from typer.testing import CliRunner

import worker.work
from app import migrate
from app.artefacts.models import Artefact
from app.cli.main import app
from app.config import get_settings
from app.db import make_engine, reading
from app.landings import inputs
from app.landings.intake import parse_record, take_in
from solver.assess import AssessmentModel, load_assessment_model
from solver.assessment import Assessment, TouchdownRecord
from solver.errors import ModelError
from solver.recorded import RecordedContact, RecordedPeak
from tests.conftest import Service, Stack
from tests.records import contact, record
from tests.solver.verdict.rule_cases import mini_definition
from worker.solve import solve


def g(value: float, rate_hz: float = 16.0) -> dict[str, Any]:
    return {"value": value, "unit": "g", "rate_hz": rate_hz}


def complete(nz: float, sink_rate: float = 2.0, **fields: Any) -> dict[str, Any]:
    """A contact that leaves nothing open to the example aircraft's rule."""
    calm = {"ny_peak": g(0.1, 4), "roll_rate": {"value": 0.5, "unit": "deg/s"}, "first_gear": "M"}
    return contact(sink_rate, nz_peak=g(nz), **calm, **fields)


class TestIntake:
    def test_every_contact_reaches_the_rule_with_what_was_recorded_and_no_more(self) -> None:
        unknown = contact(2.0, nz_peak=g(2.4, 8), first_gear="N")
        del unknown["sink_rate"]
        taken = take_in(
            parse_record(record(contacts=[unknown, complete(1.3)])), mini_definition()
        ).record
        first, second = taken.recorded
        assert (first.sink_rate, first.simulated, first.nose_first) == (None, None, True)
        assert first.normal_load_factor == RecordedPeak(2.4, 8.0)
        assert (first.roll_rate, first.lateral_load_factor) == (None, None)
        assert (second.simulated, second.nose_first) == (0, False)
        assert second.lateral_load_factor == RecordedPeak(0.1, 4.0)
        assert second.sink_rate == pytest.approx(2.0 * 0.3048)
        assert len(taken.contacts) == 1

    def test_a_nose_wheel_that_is_down_is_not_first(self) -> None:
        hop = [complete(1.3), contact(2.0, nose_wheel_down=True)]
        taken = take_in(parse_record(record(contacts=hop)), mini_definition()).record
        assert [each.nose_wheel_down for each in taken.contacts] == [False, True]
        assert taken.recorded[1].nose_first is False

    def test_accelerations_in_other_units(self) -> None:
        peak = {"value": 19.6133, "unit": "m/s2", "rate_hz": 8}
        taken = take_in(
            parse_record(record(contacts=[contact(nz_peak=peak)])), mini_definition()
        ).record
        assert taken.recorded[0].normal_load_factor == RecordedPeak(pytest.approx(2.0), 8.0)

    def test_stored_inputs_come_back_the_same(self) -> None:
        document = record(contacts=[contact(2.0), complete(1.3)])
        taken = take_in(parse_record(document), mini_definition()).record
        stored = json.loads(json.dumps(inputs.to_json(taken)))
        assert inputs.from_json(stored) == taken

    def test_landings_stored_before_there_were_rules_can_still_be_read(self) -> None:
        stored = inputs.to_json(TouchdownRecord("mini", ()))
        del stored["recorded"]
        assert inputs.from_json(stored).recorded == ()
        assert RecordedContact().normal_load_factor is None


class TestService:
    def test_agreement(self, service: Service) -> None:
        result = service.assessed(record(contacts=[complete(1.3)]))["result"]
        assert result["verdict"] == result["action"] == "NORMAL"
        assert result["rule_difference"] == "agree"
        rule = result["makers_rule"]
        assert (rule["rule"], rule["status"], rule["verdict"]) == ("ebj-19", "passed", "NORMAL")
        load_factor = rule["findings"][0]
        assert (load_factor["value"], load_factor["limit"], load_factor["unit"]) == (1.3, 2.15, "g")
        assert load_factor["certainty"] == "assumed"
        assert "1.3 g at 16 Hz is within the limit of 2.15 g" in load_factor["text"]

    def test_the_stricter_rule_is_the_action_and_keeps_the_arrays(self, service: Service) -> None:
        object.__setattr__(service.settings, "keep_arrays_above", 1e9)
        answer = service.assessed(record(contacts=[complete(2.2)]))
        result = answer["result"]
        assert result["verdict"] == "NORMAL"
        assert result["action"] == "INSPECT"
        assert result["rule_difference"] == "rule_stricter"
        assert result["makers_rule"]["status"] == "exceeded"
        with reading(service.engine) as session:
            kept = session.scalars(
                select(Artefact.kind).where(Artefact.assessment_id == answer["id"])
            ).all()
        assert kept, "an action that sends somebody to look keeps its pictures"
        listed = service.get("/v1/landings").json()["items"][0]
        assert (listed["verdict"], listed["action"]) == ("NORMAL", "INSPECT")
        by_action = service.get("/v1/landings?action=INSPECT").json()["items"]
        assert [item["id"] for item in by_action] == [listed["id"]]
        assert service.get("/v1/landings?action=NORMAL").json()["items"] == []
        assert service.get("/v1/landings?action=INSPECT&verdict=HARD").json()["items"] == []

    def test_the_stricter_stress_verdict_is_the_action(self, service: Service) -> None:
        """The definition inspects from 5 degrees of roll, the rule only lowers its limit there."""
        rolled = complete(1.3, roll={"value": 5.5, "unit": "deg"})
        result = service.assessed(record(contacts=[rolled]))["result"]
        assert result["verdict"] == result["action"] == "INSPECT"
        assert result["makers_rule"]["status"] == "passed"
        assert result["rule_difference"] == "stress_stricter"

    def test_without_recorded_peaks_the_rule_cannot_tell(self, service: Service) -> None:
        result = service.assessed(record(2.0))["result"]
        assert result["action"] == result["verdict"] == "NORMAL"
        assert result["rule_difference"] == "rule_cannot_tell"
        assert result["makers_rule"]["verdict"] == "UNDETERMINED"
        statuses = {f["criterion"]: f["status"] for f in result["makers_rule"]["findings"]}
        assert statuses["normal load factor"] == "cannot_tell"
        assert statuses["vertical speed"] == "passed"

    def test_an_aircraft_without_a_rule(
        self, service: Service, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def without(model: AssessmentModel, landing: TouchdownRecord, **how: Any) -> Assessment:
            return solve(dataclasses.replace(model, makers_rule=None), landing, **how)

        monkeypatch.setattr(worker.work, "solve", without)
        result = service.assessed(record(contacts=[complete(3.0)]))["result"]
        assert result["makers_rule"] is None
        assert result["rule_difference"] == "no_rule"
        assert result["action"] == result["verdict"] == "NORMAL"

    def test_a_contact_that_cannot_be_simulated_is_still_held_against_the_rule(
        self, service: Service
    ) -> None:
        unknown = complete(2.8)
        del unknown["sink_rate"]
        result = service.assessed(record(contacts=[unknown]))["result"]
        assert (result["verdict"], result["action"]) == ("UNDETERMINED", "HARD")
        assert result["rule_difference"] == "rule_stricter"

    def test_an_inadmissible_record_is_still_held_against_the_rule(self, service: Service) -> None:
        full = {"value": 2500, "unit": "kg"}
        light = record(fuel={"wing_left": full, "wing_right": full}, contacts=[complete(2.8)])
        light["mass"]["gross_weight"] = {"value": 8400, "unit": "kg"}
        result = service.assessed(light)["result"]
        assert result["reasons"][0]["code"] == "inadmissible_record"
        assert (result["verdict"], result["action"]) == ("UNDETERMINED", "HARD")


class TestMigration:
    def test_earlier_verdicts_keep_theirs_as_the_action(self, stack: Stack) -> None:
        url = stack.settings.sqlalchemy_url
        engine: Engine = make_engine(url)
        command.downgrade(migrate.configuration(url), "makers_rules-1")
        with engine.begin() as connection:
            _store_an_old_verdict(connection)
        migrate.upgrade(url)
        with engine.connect() as connection:
            row = connection.execute(
                text("SELECT action, rule_difference, makers_rule FROM verdict")
            ).one()
        assert tuple(row) == ("FIRM", "no_rule", None)
        engine.dispose()


def _store_an_old_verdict(connection: Any) -> None:
    now = "2026-01-01 00:00:00+00:00"
    for statement in (
        f"INSERT INTO operator VALUES ('o', 'old', '{now}')",
        "INSERT INTO landing (id, operator_id, record_id, body_digest, aircraft, touchdown_at, "
        "received_at, record, inputs, sd, sd_defaulted, taken_as_zero) VALUES "
        f"('l', 'o', 'r', 'd', 'mini', '{now}', '{now}', '{{}}', '{{}}', '{{}}', '[]', '[]')",
        "INSERT INTO assessment (id, operator_id, landing_id, lane, state, attempts, created_at, "
        f"version) VALUES ('a', 'o', 'l', 0, 'assessed', 1, '{now}', 1)",
        "INSERT INTO verdict (assessment_id, operator_id, landing_id, verdict, is_provisional, "
        "reasons, gear_loads, notes, advisory, model_hash, program_version, inputs, created_at) "
        "VALUES ('a', 'o', 'l', 'FIRM', false, '[]', '[]', '[]', '', 'h', '1', '{}', "
        f"'{now}')",
    ):
        connection.exec_driver_sql(statement)


class TestCommandLine:
    @pytest.fixture(autouse=True)
    def _cached(self, cache_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setenv("HL_CACHE_DIR", str(cache_folder))
        get_settings.cache_clear()

    def assess(self, tmp_path: Path, aircraft: Path, document: Any, *options: str) -> Any:
        path = tmp_path / "record.json"
        path.write_text(json.dumps(document))
        return CliRunner().invoke(
            app, ["assess", str(path), "--aircraft-dir", str(aircraft), *options]
        )

    def test_action_and_rule_are_printed(self, tmp_path: Path, aircraft_folder: Path) -> None:
        result = self.assess(tmp_path, aircraft_folder, record(contacts=[complete(2.2)]))
        assert result.exit_code == 0, result.output
        printed = " ".join(result.stdout.split())
        for words in (
            "action INSPECT: the maker's rule is stricter than the stress verdict",
            "maker's rule, Example aircraft EBJ-19: exceeded",
            "exceeded: contact 1, normal load factor: 2.2 g at 16 Hz exceeds the limit of 2.15 g",
            "passed: contact 1, lateral load factor: 0.1 g at 4 Hz is within the limit of 0.4 g",
        ):
            assert words in printed

    def test_json(self, tmp_path: Path, aircraft_folder: Path) -> None:
        result = self.assess(tmp_path, aircraft_folder, record(2.0), "--json")
        answer = json.loads(result.stdout)
        assert answer["action"] == "NORMAL"
        assert answer["rule_difference"] == "rule_cannot_tell"
        assert answer["makers_rule"]["findings"][0]["status"] == "cannot_tell"

    def test_an_aircraft_whose_rule_cannot_be_read_is_refused(
        self, tmp_path: Path, aircraft_folder: Path
    ) -> None:
        folder = tmp_path / "mini"
        shutil.copytree(aircraft_folder / "mini", folder)
        definition = folder / "definition.toml"
        definition.write_text(definition.read_text().replace('"ebj-19"', '"own.toml"'))
        (folder / "own.toml").write_text('title = "Own"\n')
        with pytest.raises(ModelError, match=r"own\.toml: note: Field required"):
            load_assessment_model(folder, None)
        result = CliRunner().invoke(app, ["aircraft", "check", str(folder)])
        assert result.exit_code == 2
        assert "own.toml" in result.stderr
