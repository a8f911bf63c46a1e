"""The database: one declarative base, one clock, and transactions that suit both engines."""

from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from functools import lru_cache
from time import monotonic
from typing import Any

import psycopg
from sqlalchemy import (
    DateTime,
    Engine,
    MetaData,
    String,
    create_engine,
    event,
)
from sqlalchemy.engine import Dialect
from sqlalchemy.exc import InvalidatePoolError
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.orm import DeclarativeBase, Session
from sqlalchemy.pool import ConnectionPoolEntry
from sqlalchemy.sql.compiler import SQLCompiler
from sqlalchemy.sql.elements import ColumnElement
from sqlalchemy.sql.visitors import InternalTraversal
from sqlalchemy.types import TypeDecorator
from uuid_utils import uuid7

from app.config import get_settings

#: A connection that was used this recently is taken to be alive.
TRUSTED_IDLE = 1.0  #: [s]

#: Batch migrations on SQLite rebuild tables and must be able to name every constraint.
NAMING = {
    "ix": "ix_%(table_name)s_%(column_0_N_name)s",
    "uq": "uq_%(table_name)s_%(column_0_N_name)s",
    "ck": "ck_%(table_name)s_%(constraint_name)s",
    "fk": "fk_%(table_name)s_%(column_0_N_name)s_%(referred_table_name)s",
    "pk": "pk_%(table_name)s",
}


class Base(DeclarativeBase):
    metadata = MetaData(naming_convention=NAMING)


class UtcDateTime(TypeDecorator[datetime]):
    """A moment in UTC; SQLite forgets zones, so they are put back on the way out."""

    impl = DateTime(timezone=True)
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        if value is None:
            return None
        if value.tzinfo is None:
            raise ValueError(f"a moment needs a time zone: {value.isoformat()}")
        moment = value.astimezone(UTC)
        return moment.replace(tzinfo=None) if dialect.name == "sqlite" else moment

    def process_result_value(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        del dialect
        if value is None:
            return None
        return value.replace(tzinfo=UTC) if value.tzinfo is None else value.astimezone(UTC)


class DatabaseTime(ColumnElement[datetime]):
    """The database's own clock, shifted: workers on other hosts may have other clocks."""

    type = UtcDateTime()
    # Statements with the same shift are compiled once.
    _traverse_internals: Any = [("seconds", InternalTraversal.dp_plain_obj)]  # noqa: RUF012
    inherit_cache = True

    def __init__(self, seconds: float = 0.0) -> None:
        self.seconds = float(seconds)


@compiles(DatabaseTime, "sqlite")
def _sqlite_time(element: DatabaseTime, compiler: SQLCompiler, **_: Any) -> str:
    del compiler
    # Padded to microseconds, so that it compares as text with what the driver writes.
    return f"strftime('%Y-%m-%d %H:%M:%f000', 'now', '{element.seconds:+.3f} seconds')"


@compiles(DatabaseTime, "postgresql")
def _postgres_time(element: DatabaseTime, compiler: SQLCompiler, **_: Any) -> str:
    del compiler
    return f"(clock_timestamp() + {element.seconds:.3f} * interval '1 second')"


class NewToken(ColumnElement[str]):
    """A fresh random text, made by the database for each row that a statement touches."""

    type = String()
    _traverse_internals: Any = []  # noqa: RUF012
    inherit_cache = True


@compiles(NewToken, "sqlite")
def _sqlite_token(_element: NewToken, _compiler: SQLCompiler, **_: Any) -> str:
    return "lower(hex(randomblob(16)))"


@compiles(NewToken, "postgresql")
def _postgres_token(_element: NewToken, _compiler: SQLCompiler, **_: Any) -> str:
    return "CAST(gen_random_uuid() AS text)"


class UnhurriedCommit(ColumnElement[str]):
    """Selected by a statement, it lets that transaction's commit not wait for the disk.

    For what a power cut may undo without harm.  It counts for this one transaction.
    """

    type = String()
    _traverse_internals: Any = []  # noqa: RUF012
    inherit_cache = True


@compiles(UnhurriedCommit, "sqlite")
def _sqlite_commit(_element: UnhurriedCommit, _compiler: SQLCompiler, **_: Any) -> str:
    return "NULL"


@compiles(UnhurriedCommit, "postgresql")
def _postgres_commit(_element: UnhurriedCommit, _compiler: SQLCompiler, **_: Any) -> str:
    return "set_config('synchronous_commit', 'off', true)"


def new_id() -> str:
    """A time-ordered identifier, so that indices grow at their end."""
    return str(uuid7())


def make_engine(url: str, *, is_for_claims: bool = False) -> Engine:
    """Engine with the durability this service promises, on either database.

    One for claims keeps Postgres to the order of its indices, see `_keep_to_indices`.
    """
    if not url.startswith("sqlite"):
        engine = create_engine(
            url, pool_size=10, max_overflow=30, connect_args={"connect_timeout": 5}
        )
        event.listen(engine, "checkin", _note_idle)
        event.listen(engine, "checkout", _test_after_a_pause)
        event.listen(engine, "connect", _plan_anew)
        if is_for_claims:
            event.listen(engine, "connect", _keep_to_indices)
        return engine
    engine = create_engine(url, pool_size=40, connect_args={"timeout": 15.0})
    event.listen(engine, "connect", _configure_sqlite)
    event.listen(engine, "begin", _begin_sqlite)
    return engine


def _note_idle(_connection: Any, record: ConnectionPoolEntry) -> None:
    record.info["idle_since"] = monotonic()


def _test_after_a_pause(connection: Any, record: ConnectionPoolEntry, _proxy: Any) -> None:
    """Replace connections that a restarted server has forgotten.

    Only what has lain idle is asked: a busy connection would pay a round trip for each transaction
    and may be cut in the middle of it all the same.
    """
    idle_since = record.info.pop("idle_since", None)
    if idle_since is None or monotonic() - idle_since < TRUSTED_IDLE:
        return
    try:
        connection.autocommit = True  # or the question would cost a transaction
        connection.execute("SELECT 1")
        connection.autocommit = False
    except psycopg.Error as error:
        raise InvalidatePoolError from error


def _plan_anew(connection: Any, _record: ConnectionPoolEntry) -> None:
    """A plan made while a table was small is not kept: a back-fill makes it large in a minute."""
    connection.execute("SET plan_cache_mode = force_custom_plan")
    connection.commit()


def _keep_to_indices(connection: Any, _record: ConnectionPoolEntry) -> None:
    """A claim reads the first rows of an index, whatever the planner believes.

    After a back-fill its statistics are old for up to a minute: it takes the queue for short, reads
    all of it and sorts, which costs 45 ms for each claim behind 100,000 in place of one.
    """
    connection.execute(
        "SET enable_sort = off; SET enable_bitmapscan = off; "
        # Of a table that was counted while it was nearly empty it would read everything to join.
        "SET enable_seqscan = off; SET enable_hashjoin = off; SET enable_mergejoin = off; "
        # A few sorted rows stay necessary; their fictitious costs would call the compiler.
        "SET jit = off"
    )
    connection.commit()


def _configure_sqlite(connection: Any, _record: Any) -> None:
    # The driver's own transaction control would begin reads late and writes later still.
    connection.isolation_level = None
    for pragma in (
        "journal_mode=WAL",
        # NORMAL may lose the last commits on power loss; an accepted landing may not be lost.
        "synchronous=FULL",
        "busy_timeout=15000",
        "foreign_keys=ON",
    ):
        connection.execute(f"PRAGMA {pragma}")


def _begin_sqlite(connection: Any) -> None:
    # A read that turns into a write cannot wait for another writer, it fails at once; so a
    # transaction that will write says so when it begins.
    writes = connection.get_execution_options().get("writes", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


@lru_cache(maxsize=1)
def get_engine() -> Engine:
    """Engine of a worker's process; made on first use, never before a fork."""
    settings = get_settings()
    if settings.database_url is None:
        settings.var.mkdir(parents=True, exist_ok=True)
    return make_engine(settings.sqlalchemy_url, is_for_claims=True)


@contextmanager
def writing(engine: Engine) -> Iterator[Session]:
    """One transaction that may write: commits at the end, rolls back on any exception."""
    with (
        Session(engine.execution_options(writes=True), expire_on_commit=False) as session,
        session.begin(),
    ):
        yield session


@contextmanager
def writing_once(engine: Engine) -> Iterator[Session]:
    """A single statement that writes; on Postgres it is its own transaction, in one round trip."""
    if engine.dialect.name == "sqlite":
        with writing(engine) as session:
            yield session
        return
    with _without_transaction(engine) as session:
        yield session


@contextmanager
def reading(engine: Engine) -> Iterator[Session]:
    """Statements that only read; on SQLite all of them see one and the same state.

    On Postgres each statement has its own view in any case (READ COMMITTED), so none of them needs
    a transaction around it, which would cost two round trips more.
    """
    if engine.dialect.name == "sqlite":
        with Session(engine, expire_on_commit=False) as session:
            yield session
        return
    with _without_transaction(engine) as session:
        yield session


def _without_transaction(engine: Engine) -> Session:
    autocommit = engine.execution_options(isolation_level="AUTOCOMMIT")
    return Session(autocommit, expire_on_commit=False)
