import json
from pathlib import Path

import pytest
from typer import Typer
from typer.testing import CliRunner

from app.cli.simulate import simulate

EXAMPLE = Path(__file__).parents[3] / "examples" / "landing_level_10fps.json"

command = Typer()
command.command()(simulate)
runner = CliRunner()


def test_json_answer_reproduces_the_reference_landing() -> None:
    result = runner.invoke(command, [str(EXAMPLE), "--json"])
    assert result.exit_code == 0
    answer = json.loads(result.stdout)
    # An independent multibody solution (a second code agrees to 0.001 %).
    gears = answer["gears"]
    assert gears["left"]["peak_vertical_force_n"] == pytest.approx(88425.58, rel=1e-3)
    assert gears["nose"]["peak_vertical_force_n"] == pytest.approx(37987.56, rel=1e-3)
    assert gears["nose"]["peak_drag_force_n"] == pytest.approx(22961.73, rel=1e-3)
    assert answer["outcome"] == "time_limit"
    assert answer["energy"]["closure_error"] < 1e-4
    assert {contact["gear"] for contact in answer["contacts"]} == {"left", "right", "nose"}


def test_table_and_histories_for_a_reader(tmp_path: Path) -> None:
    path = tmp_path / "histories.csv"
    result = runner.invoke(command, [str(EXAMPLE), "--csv", str(path)])
    assert result.exit_code == 0
    assert "88.4" in result.stdout
    rows = path.read_text().splitlines()
    assert len(rows) == 4002  # one second at 0.25 ms, and the heading
    assert "left_ground_force_z_n" in rows[0]


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        (("contact", "sink_rate_m_s"), -1, ["contact.sink_rate_m_s", "-1", "at least 0.01"]),
        (("contact", "pitch_deg"), 1, ["contact.pitch_deg", "unknown field", "pitch_rad"]),
        (("lift", "model"), "none", ["lift.model", "none", "decaying"]),
        (("aircraft_description", "airframe_mass_kg"), 0, ["airframe_mass_kg", "more than 0"]),
        (("mass_kg",), 9000.0, ["aircraft_description", "mass"]),
    ],
)
def test_bad_input_is_named(
    tmp_path: Path, place: tuple[str, ...], value: object, words: list[str]
) -> None:
    document = json.loads(EXAMPLE.read_text())
    target = document
    for part in place[:-1]:
        target = target[part]
    target[place[-1]] = value
    path = tmp_path / "landing.json"
    path.write_text(json.dumps(document))
    result = runner.invoke(command, [str(path), "--json"])
    assert result.exit_code == 2
    assert result.stdout == ""
    assert all(word in result.stderr for word in words)


def test_impossible_gear_is_refused_by_the_solver(tmp_path: Path) -> None:
    document = json.loads(EXAMPLE.read_text())
    document["aircraft_description"]["gears"][0]["strut"]["full_stroke_m"] = 0.5
    path = tmp_path / "landing.json"
    path.write_text(json.dumps(document))
    result = runner.invoke(command, [str(path)])
    assert result.exit_code == 2
    assert "gas volume is used up" in result.stderr


def test_unknown_aircraft_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    path = tmp_path / "landing.json"
    path.write_text(
        json.dumps(
            {"contact": {"sink_rate_m_s": 1, "ground_speed_m_s": 60}, "aircraft": "no-such-jet"}
        )
    )
    result = runner.invoke(command, [str(path)])
    assert result.exit_code == 2
    assert "unknown 'no-such-jet'" in result.stderr
