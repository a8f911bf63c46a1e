"""Many rows in one round trip."""

import json
from collections.abc import Callable, Sequence
from operator import itemgetter
from typing import Any

import psycopg
from sqlalchemy import JSON, insert, select
from sqlalchemy.exc import DBAPIError
from sqlalchemy.orm import Session

from app.db import Base

#: From here on a stream is cheaper than statements.
_SMALLEST_COPY = 100


def insert_rows(session: Session, table: type[Base], rows: Sequence[dict[str, Any]]) -> None:
    """Insert rows of the same columns in one round trip, many of them by COPY where there is one.

    What the rows leave out gets its column's default.
    """
    if session.get_bind().dialect.name == "sqlite" or len(rows) < _SMALLEST_COPY:
        if rows:
            session.execute(insert(table), rows)
        return
    all_columns: Any = table.__table__.columns
    columns = [c for c in all_columns if c.name in rows[0] or c.default is not None]
    makers = [_maker(session, column, column.name in rows[0]) for column in columns]
    names = ", ".join(f'"{column.name}"' for column in columns)
    statement = f'COPY "{table.__tablename__}" ({names}) FROM STDIN'
    driver: Any = session.connection().connection.driver_connection
    try:
        with driver.cursor() as cursor, cursor.copy(statement) as stream:
            for row in rows:
                stream.write_row([make(row) for make in makers])
    except psycopg.Error as error:
        raise DBAPIError.instance(statement, None, error, psycopg.Error) from error


def _maker(session: Session, column: Any, is_given: bool) -> Callable[[dict[str, Any]], object]:
    """How a column's value comes out of a row."""
    name, default = column.name, column.default
    if is_given:
        if isinstance(column.type, JSON):
            # What a JSON column lacks is the database's null, as in a statement.
            return lambda row: None if row[name] is None else json.dumps(row[name])
        return itemgetter(name)
    if default.is_callable:
        return lambda _row: default.arg(None)
    # The database's clock is asked once.
    value = session.scalar(select(default.arg)) if default.is_clause_element else default.arg
    return lambda _row: value
