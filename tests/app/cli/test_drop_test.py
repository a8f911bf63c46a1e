import json
from pathlib import Path

import pytest
from typer import Typer
from typer.testing import CliRunner

from app.cli.drop_test import ANSWER, drop_test

EXAMPLE = Path(__file__).parents[3] / "examples" / "drop_test_naca1154.json"
KEYS = [
    "breakout_time_s",
    "peak_ground_force_n",
    "peak_ground_force_time_s",
    "maximum_stroke_m",
    "maximum_stroke_time_s",
    "peak_tyre_deflection_m",
    "maximum_closure_speed_m_s",
    "peak_upper_acceleration_m_s2",
    "energy_error",
]

command = Typer()
command.command()(drop_test)
runner = CliRunner()


def write(folder: Path, **changes: object) -> Path:
    values = json.loads(EXAMPLE.read_text()) | changes
    path = folder / "parameters.json"
    path.write_text(
        json.dumps({key: value for key, value in values.items() if value != "left out"})
    )
    return path


def test_json_answer_has_exactly_the_documented_keys() -> None:
    result = runner.invoke(command, [str(EXAMPLE), "--json"])
    assert result.exit_code == 0
    answer = json.loads(result.stdout)
    assert list(answer) == KEYS == list(ANSWER)
    # Converged solution of the report's equations by independent codes.
    assert answer["peak_ground_force_n"] == pytest.approx(28872.124, rel=5e-6)


def test_time_that_never_comes_is_null(tmp_path: Path) -> None:
    path = write(tmp_path, contact_speed_m_s=0.05)
    answer = json.loads(runner.invoke(command, [str(path), "--json"]).stdout)
    assert answer["breakout_time_s"] is None
    assert answer["maximum_stroke_m"] == 0.0


def test_table_and_history_for_a_reader(tmp_path: Path) -> None:
    history = tmp_path / "history.csv"
    result = runner.invoke(command, [str(EXAMPLE), "--csv", str(history)])
    assert result.exit_code == 0
    assert "28.872 kN" in result.stdout
    rows = history.read_text().splitlines()
    assert rows[0].startswith("time_s,upper_displacement_m,tyre_deflection_m,stroke_m")
    forces = [float(row.split(",")[5]) for row in rows[1:]]
    assert max(forces) == pytest.approx(28872.1, rel=1e-4)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"lower_mass_kg": -3}, ["lower_mass_kg", "-3", "more than 0"]),
        ({"lift_ratio": 99}, ["lift_ratio", "99", "at most 3"]),
        ({"tyre_exponent": "1.3"}, ["tyre_exponent", "1.3"]),
        ({"lower_mass": 3}, ["lower_mass", "unknown field", "lower_mass_kg"]),
        ({"upper_mass_kg": "left out"}, ["upper_mass_kg", "missing"]),
        ({"lift_ratio": float("nan")}, ["lift_ratio", "finite"]),
    ],
)
def test_bad_parameter_is_named_with_value_and_range(
    tmp_path: Path, changes: dict[str, object], words: list[str]
) -> None:
    result = runner.invoke(command, [str(write(tmp_path, **changes)), "--json"])
    assert result.exit_code == 2
    assert result.stdout == ""
    assert all(word in result.stderr for word in words)


def test_file_that_is_no_json_or_not_there(tmp_path: Path) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text("{")
    assert runner.invoke(command, [str(broken)]).exit_code == 2
    missing = runner.invoke(command, [str(tmp_path / "none.json")])
    assert missing.exit_code == 2
    assert "none.json" in missing.stderr


def test_used_up_gas_volume_is_said(tmp_path: Path) -> None:
    path = write(tmp_path, polytropic_exponent=0.0, orifice_area_m2=5e-4)
    result = runner.invoke(command, [str(path), "--json"])
    assert result.exit_code == 2
    assert "gas volume is used up" in result.stderr
