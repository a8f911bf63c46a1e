"""One chain of migrations for both databases, and the models agree with it."""

from alembic import command
from sqlalchemy import Engine, inspect

from app import migrate
from app.db import make_engine
from app.models import Base
from tests.conftest import Stack


def test_models_and_migrations_agree(stack: Stack) -> None:
    command.check(migrate.configuration(stack.settings.sqlalchemy_url))


def test_down_to_nothing_and_up_again(stack: Stack) -> None:
    url = stack.settings.sqlalchemy_url
    engine = make_engine(url)
    command.downgrade(migrate.configuration(url), "base")
    assert set(inspect(engine).get_table_names()) <= {"alembic_version"}
    assert migrate.current(engine) is None
    migrate.upgrade(url)
    assert set(inspect(engine).get_table_names()) == {*Base.metadata.tables, "alembic_version"}
    assert migrate.current(engine) == migrate.head()
    engine.dispose()


def test_migrating_twice_changes_nothing(stack: Stack) -> None:
    migrate.upgrade(stack.settings.sqlalchemy_url)
    command.check(migrate.configuration(stack.settings.sqlalchemy_url))


def test_a_commit_survives_a_power_cut(stack: Stack, engine: Engine) -> None:
    with engine.connect() as connection:
        if stack.name == "postgres+redis":
            assert connection.exec_driver_sql("SHOW synchronous_commit").scalar() == "on"
            return
        pragmas = {
            name: connection.exec_driver_sql(f"PRAGMA {name}").scalar()
            for name in ("journal_mode", "synchronous", "foreign_keys", "busy_timeout")
        }
    full = 2
    assert pragmas == {
        "journal_mode": "wal",
        "synchronous": full,
        "foreign_keys": 1,
        "busy_timeout": 15000,
    }
