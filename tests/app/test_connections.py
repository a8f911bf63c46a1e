"""Connections that the database has forgotten."""

import pytest
from sqlalchemy import Engine, text

from app import db
from app.db import make_engine, reading
from tests.conftest import Stack


def backend(engine: Engine) -> int:
    with reading(engine) as session:
        number: int = session.execute(text("SELECT pg_backend_pid()")).scalar_one()
        return number


def test_one_that_died_while_it_lay_idle_is_replaced(
    stack: Stack, engine: Engine, monkeypatch: pytest.MonkeyPatch
) -> None:
    if stack.settings.database_url is None:
        pytest.skip("SQLite has no connections to lose")
    monkeypatch.setattr(db, "TRUSTED_IDLE", 0.0)
    first = backend(engine)
    assert backend(engine) == first
    other = make_engine(stack.settings.sqlalchemy_url)
    with reading(other) as session:
        # waits for its end, ten seconds at most
        session.execute(text("SELECT pg_terminate_backend(:first, 10000)"), {"first": first})
    other.dispose()
    assert backend(engine) != first
