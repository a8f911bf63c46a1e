"""`hardlanding flight-data`: what is understood of a recorder window."""

import json
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from typer import Typer
from typer.testing import CliRunner

from app.cli.flight_data import flight_data
from app.config import Settings
from solver.aircraft.airframe import load_airframe
from solver.flight_data.fleet import synthetic_landing
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import aircraft_geometry
from solver.flight_data.writing import long_form
from tests.solver.landing.business_jet import business_jet

command = Typer()
command.command()(flight_data)
runner = CliRunner(env={"COLUMNS": "200"})


@pytest.fixture(scope="module")
def window_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    aircraft = business_jet()
    frame = packaged_frame("business-jet-16")
    landing = synthetic_landing(aircraft, aircraft_geometry(aircraft), frame, 12)
    path = tmp_path_factory.mktemp("windows") / "window.csv"
    path.write_text(long_form(landing.window), encoding="utf-8")
    return path


def test_json_holds_contacts_with_states_and_units(window_file: Path) -> None:
    result = runner.invoke(command, [str(window_file), "--json", "--frame", "business-jet-16"])
    assert result.exit_code == 0, result.output
    answer = json.loads(result.stdout)
    assert answer["can_tell"] is True
    assert {c["parameter"] for c in answer["channels"]} >= {"normal_acceleration", "pitch"}
    first = answer["contacts"][0]
    assert first["kind"] == "first"
    assert abs(first["time_s"]) < 0.1  # the synthetic contact is at time 0
    sink = first["state"]["sink_rate_m_s"]
    assert sink["sd"] > 0
    assert {"name", "time_s", "sd_s", "agrees"} == set(first["indicators"][0])


def test_table_for_a_reader(window_file: Path) -> None:
    result = runner.invoke(command, [str(window_file)])
    assert result.exit_code == 0, result.output
    assert "normal acceleration" in result.stdout
    assert "at the accelerometer" in result.stdout


@pytest.mark.skipif(find_spec("matplotlib") is None, reason="needs the extra plot")
@pytest.mark.parametrize("ending", ["svg", "png"])
def test_plot_is_drawn(ending: str, window_file: Path, tmp_path: Path) -> None:
    path = tmp_path / f"window.{ending}"
    result = runner.invoke(command, [str(window_file), "--plot", str(path), "--json"])
    assert result.exit_code == 0, result.output
    assert path.stat().st_size > 10_000


def test_slow_window_says_what_would_settle_it(tmp_path: Path) -> None:
    path = tmp_path / "slow.csv"
    rows = [f"{t},{90 - t},{60 - t / 10},1.0" for t in np.arange(0.0, 60.0)]
    path.write_text("t_s,RALT,GS,VRTG\n" + "\n".join(rows) + "\n", encoding="utf-8")
    result = runner.invoke(command, [str(path)])
    assert result.exit_code == 0, result.output
    assert "cannot tell: normal acceleration at 1 Hz" in result.stdout
    assert "would be settled by normal acceleration at 4 Hz or more" in result.stdout


def test_file_that_is_no_window_is_refused_with_its_place(tmp_path: Path) -> None:
    path = tmp_path / "bad.csv"
    path.write_text("t_s,param,value,unit\n0,VRTG,=1+1,g\n", encoding="utf-8")
    result = runner.invoke(command, [str(path)])
    assert result.exit_code == 2
    assert "line 2, column 3: a formula" in result.stderr


def test_unknown_frame_is_refused_with_those_there_are(window_file: Path) -> None:
    result = runner.invoke(command, [str(window_file), "--frame", "dc-3"])
    assert result.exit_code == 2
    assert "737-3c" in result.stderr


def test_unknown_aircraft_is_refused(window_file: Path) -> None:
    result = runner.invoke(command, [str(window_file), "--aircraft", "no-such"])
    assert result.exit_code == 2
    assert "no aircraft 'no-such'" in result.stderr


def test_without_an_aircraft_no_response_is_compared_and_that_is_said(window_file: Path) -> None:
    result = runner.invoke(command, [str(window_file), "--json"])
    for response in json.loads(result.stdout)["responses"]:
        assert response["compared"] is None
        assert response["unused_because"] == "no --aircraft to simulate"


@pytest.fixture
def mini_window(
    aircraft_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> list[str]:
    """Arguments that show a window of the mini aircraft."""
    settings = Settings(aircraft_dir=aircraft_folder)
    monkeypatch.setattr("app.cli.flight_data.get_settings", lambda: settings)
    airframe = load_airframe(aircraft_folder / "mini")
    loading = airframe.loading_for(mass=None, fuel={}, payload={})
    aircraft = airframe.landing_aircraft(loading.factors)
    frame = packaged_frame("business-jet-16")
    landing = synthetic_landing(aircraft, aircraft_geometry(aircraft), frame, 21)
    path = tmp_path / "mini.csv"
    path.write_text(long_form(landing.window), encoding="utf-8")
    return [str(path), "--frame", "business-jet-16", "--aircraft", "mini"]


def test_the_response_is_shown_before_and_after(mini_window: list[str]) -> None:
    result = runner.invoke(command, mini_window)
    assert result.exit_code == 0, result.output
    assert "response to contact 1 (first): normal acceleration peaked at" in result.stdout
    assert "Before and after the response" in result.stdout


def test_a_measured_friction_narrows_what_is_believed_of_it(mini_window: list[str]) -> None:
    known = ["--runway-friction", "0.6", "--runway-friction-sd", "0.03", "--json"]
    prior = []
    for arguments in ([*mini_window, "--json"], [*mini_window, *known]):
        result = runner.invoke(command, arguments)
        assert result.exit_code == 0, result.output
        (response, *_) = json.loads(result.stdout)["responses"]
        (friction,) = [
            each for each in response["compared"]["parameters"] if each["name"] == "tyre_friction"
        ]
        prior.append(friction["prior_sd"])
    assert prior == [pytest.approx(0.15), pytest.approx(0.05)]
