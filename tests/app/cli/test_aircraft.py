"""`hardlanding aircraft` on the mini aircraft and on folders that hold none."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from app.cli.aircraft import aircraft
from app.cli.demo import EXAMPLE_AIRCRAFT
from solver.aircraft.definition_reader import load_definition
from solver.aircraft.nastran import read_bulk_data
from tests.solver.aircraft.mini import write_mini_aircraft


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_mini_aircraft(tmp_path_factory.mktemp("mini"))


def test_check_prints_json_alone_on_standard_output(folder):
    result = CliRunner().invoke(aircraft, ["check", str(folder), "--json"])
    found = json.loads(result.stdout)
    assert (result.exit_code, found["is_sound"], found["rigid_modes"]) == (0, True, 6)
    assert found["counts"]["elements"] == 124
    assert found["empty_mass_kg"] == pytest.approx(8235.0, rel=1e-6)
    assert len(found["zones"]) == 6


def test_check_reads_for_people(folder):
    result = CliRunner().invoke(aircraft, ["check", str(folder)])
    assert result.exit_code == 0
    assert "model is sound" in result.stdout
    assert "wing box, port" in result.stdout


def test_check_of_a_folder_without_aircraft_fails_with_the_reason(tmp_path):
    result = CliRunner().invoke(aircraft, ["check", str(tmp_path)])
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "definition.toml" in result.stderr.replace("\n", "")


def test_check_names_card_and_line_of_bad_bulk_data(folder, tmp_path):
    (tmp_path / "definition.toml").write_bytes((folder / "definition.toml").read_bytes())
    (tmp_path / "airframe.bdf").write_text("GRID,1\nCHEXA,1,1,1,2,3,4,5,6\n")
    result = CliRunner().invoke(aircraft, ["check", str(tmp_path)])
    assert result.exit_code == 2
    assert "line 2: CHEXA 1" in result.stderr.replace("\n", " ")


def test_build_writes_the_example_where_it_is_told_and_prints_the_place(tmp_path):
    target = tmp_path / "example"
    result = CliRunner().invoke(aircraft, ["build", str(target)])
    assert result.exit_code == 0
    assert result.stdout.strip() == str(target)
    definition = load_definition(target)
    assert definition.name == EXAMPLE_AIRCRAFT
    assert read_bulk_data(target / definition.bulk_data).model.node_count > 4000
