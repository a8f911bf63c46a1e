"""Commands that keep the service: migrate and key."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from typer.testing import CliRunner

from app import migrate
from app.cli.main import app
from app.config import Settings, get_settings
from app.db import get_engine, make_engine
from app.main import create_app


@pytest.fixture
def settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Settings]:
    """An empty folder for the state, as the commands find it."""
    monkeypatch.setenv("HL_VAR", str(tmp_path / "var"))
    monkeypatch.setenv("HL_LOG_FORMAT", "console")
    monkeypatch.chdir(tmp_path)
    get_settings.cache_clear()
    get_engine.cache_clear()
    yield get_settings()
    if get_engine.cache_info().currsize:
        get_engine().dispose()
    get_settings.cache_clear()
    get_engine.cache_clear()


def run(*arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(app, arguments)
    return result.exit_code, result.output


def test_migrate_makes_the_database(settings: Settings) -> None:
    code, said = run("migrate")
    assert code == 0
    assert migrate.head() in said
    engine = make_engine(settings.sqlalchemy_url)
    assert migrate.current(engine) == migrate.head()
    engine.dispose()


def test_a_key_from_its_making_to_its_end(settings: Settings) -> None:
    run("migrate")
    code, said = run("key", "create", "--operator", "alpha", "--scopes", "read,post")
    secret = said.strip()
    assert code == 0
    with TestClient(create_app(settings), headers={"X-API-Key": secret}) as client:
        assert client.get("/v1/aircraft").status_code == 200
        _, listed = run("key", "list")
        assert "alpha" in listed
        assert secret[:10] in listed
        assert secret not in listed
        assert "post read\tin use" in listed
        assert run("key", "revoke", secret[:10])[0] == 0
        assert client.get("/v1/aircraft").status_code == 401
    assert "revoked" in run("key", "list")[1]


def test_an_unknown_scope_is_refused_by_name(settings: Settings) -> None:
    run("migrate")
    code, said = run("key", "create", "--operator", "alpha", "--scopes", "read,fly")
    assert code == 2
    assert "fly" in said
    assert "post, read, review, admin" in said


def test_an_unknown_key_cannot_be_revoked(settings: Settings) -> None:
    run("migrate")
    code, said = run("key", "revoke", "hl_nobody")
    assert code == 1
    assert "hl_nobody" in said
