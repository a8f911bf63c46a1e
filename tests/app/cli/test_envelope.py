"""`hardlanding envelope` on the mini aircraft, whose envelope is made already."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from app.cli import envelope as command
from app.cli.main import app
from app.config import get_settings
from solver.assess import AssessmentModel
from solver.envelope.store import envelope_path, save_envelope
from solver.errors import ModelError
from tests.solver.envelope.synthetic import linear_envelope
from worker.warm import Models


@pytest.fixture
def model(models: Models) -> AssessmentModel:
    return models.get("mini")


@pytest.fixture
def cache(
    model: AssessmentModel,
    aircraft_folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[Path]:
    """A cache with a linear envelope, as the command finds it; the model is there already."""
    monkeypatch.setattr("solver.envelope.build.load_assessment_model", lambda *_: model)
    monkeypatch.setenv("HL_AIRCRAFT_DIR", str(aircraft_folder))
    monkeypatch.setenv("HL_CACHE_DIR", str(tmp_path))
    get_settings.cache_clear()
    content_hash = model.content_hash
    save_envelope(
        envelope_path(tmp_path, content_hash),
        linear_envelope(4.0, 0.1, 0.3, content_hash=content_hash),
    )
    yield tmp_path
    get_settings.cache_clear()


def test_the_table_names_limits_with_their_error(cache: Path) -> None:
    result = CliRunner().invoke(app, ["envelope"], env={"COLUMNS": "160"})
    assert result.exit_code == 0
    assert "use at most 10% more than expected" in " ".join(result.output.split())
    assert "4.00 (3.64 to over 5.0), 13.1 ft/s" in result.output
    assert "Advisory only" in result.output


def test_json(cache: Path) -> None:
    result = CliRunner().invoke(app, ["envelope", "mini", "--json"])
    answer = json.loads(result.stdout)
    assert answer["aircraft"] == "mini"
    assert answer["error"]["above"] == 0.1
    rows = answer["limit_sink_rates_m_s"]
    assert {row["roll_deg"] for row in rows} >= {0.0, 2.0, 4.0}
    assert rows[0]["hard"]["value"] == pytest.approx(4.0, rel=2e-3)
    assert rows[0]["hard"]["high"] is None, "beyond the hardest of the envelope"
    assert rows[0]["inspect"]["value"] < rows[0]["hard"]["value"]


def test_pictures(cache: Path, tmp_path: Path) -> None:
    result = CliRunner().invoke(app, ["envelope", "mini", "--plots", str(tmp_path / "plots")])
    assert result.exit_code == 0
    names = sorted(path.name for path in (tmp_path / "plots").iterdir())
    assert names == ["envelope-attitude.png", "envelope-error.png", "envelope-loading.png"]


def test_an_aircraft_that_is_not_there(
    cache: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("HL_AIRCRAFT_DIR", str(tmp_path / "empty"))
    get_settings.cache_clear()
    result = CliRunner().invoke(app, ["envelope"])
    assert result.exit_code == 2
    assert "installed: none" in result.stderr


class TestMissing:
    @pytest.fixture
    def made(self, monkeypatch: pytest.MonkeyPatch) -> list[str]:
        made: list[str] = []
        monkeypatch.setattr(command.os, "nice", made.append)
        monkeypatch.setattr(command, "build_envelope", lambda folder, *_: made.append(folder.name))
        return made

    def test_what_is_there_is_left(self, cache: Path, made: list[str]) -> None:
        assert CliRunner().invoke(app, ["envelope", "--missing"]).exit_code == 0
        assert made == [19]

    def test_what_is_not_is_made_at_the_lowest_priority(self, cache: Path, made: list[str]) -> None:
        for path in cache.glob("*.npz"):
            path.unlink()
        result = CliRunner().invoke(app, ["envelope", "--missing"])
        assert made == [19, "mini"]
        assert "the envelope of mini is made" in result.stderr

    def test_an_aircraft_that_cannot_be_used_is_no_failure(
        self, cache: Path, made: list[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def refuse(*_: object) -> None:
            raise ModelError("no mesh")

        for path in cache.glob("*.npz"):
            path.unlink()
        monkeypatch.setattr(command, "build_envelope", refuse)
        result = CliRunner().invoke(app, ["envelope", "--missing"])
        assert result.exit_code == 0, "or the supervisor would start it again for ever"
        assert "no envelope of mini: no mesh" in result.stderr
