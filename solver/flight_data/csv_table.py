"""Comma-separated files: long form (time, parameter, value, unit) and wide form with a header.

Nothing is executed and nothing guessed: a cell that is neither number, state, nor a mark for "no
value" is an error that names its line and column.
"""

import csv
import io
import math
import re
from collections.abc import Iterator
from datetime import UTC, datetime

from solver.errors import FlightDataError
from solver.flight_data.table import (
    MISSING,
    PARAMETER_NAMES,
    STATES,
    TIME_NAMES,
    Column,
    Limits,
)

_CLOCK = re.compile(r"^(\d{1,2}):(\d{2}):(\d{2}(?:\.\d+)?)$")
_FORMULA = re.compile(r"^[=@\t]|^[+-](?![\d.])(?!inf|nan)", re.IGNORECASE)
_DAY = 86400.0


def read_csv(content: bytes, limits: Limits) -> tuple[Column, ...]:
    """Columns of a comma-, semicolon- or tab-separated file.

    Raises
    ------
    FlightDataError
        Names line and column, what stands there and what is allowed.
    """
    text = _decoded(content)
    comments, rows = _rows(text, limits)
    header_line, header = next(rows, (0, []))
    plain = [re.sub(r"[^a-z0-9]", "", cell.lower()) for cell in header]
    time_at = next((i for i, name in enumerate(plain) if name in TIME_NAMES), None)
    if time_at is None:
        raise FlightDataError(
            f"line {max(header_line, 1)}",
            f"no time column among {', '.join(header)[:200]!r}" if header else "no header",
            "a header with a column t_s (or time), in seconds",
        )
    if len(header) > limits.columns:
        raise FlightDataError(
            f"line {header_line}", f"{len(header)} columns", f"up to {limits.columns}"
        )
    clock = _Clock()
    if any(name in PARAMETER_NAMES for name in plain) and "value" in plain:
        return _long(rows, plain, time_at, clock)
    return _wide(rows, header, time_at, clock, comments)


def _decoded(content: bytes) -> str:
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise FlightDataError("byte 0", "UTF-16 text", "UTF-8 text")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise FlightDataError(
            f"line {line}, byte {error.start}",
            f"byte 0x{content[error.start]:02x} is not UTF-8",
            "UTF-8 text",
        ) from error
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise FlightDataError(f"line {line}", "a null byte: this is no text file", "UTF-8 text")
    return text


def _rows(text: str, limits: Limits) -> tuple[list[str], Iterator[tuple[int, list[str]]]]:
    """Comment lines before the header, and the rows from the header on with their lines."""
    comments: list[str] = []
    start = number = 0
    for line in io.StringIO(text):
        stripped = line.strip()
        if stripped and not stripped.startswith("#"):
            break
        if stripped:
            comments.append(stripped[1:])
        start += len(line)
        number += 1
    first = text[start:].split("\n", 1)[0]
    delimiter = max(",;\t", key=first.count)
    return comments, _split(text[start:], number, delimiter, limits)


def _split(
    text: str, before: int, delimiter: str, limits: Limits
) -> Iterator[tuple[int, list[str]]]:
    # Quotes are not interpreted: an unclosed one would swallow the rest of the file.
    reader = csv.reader(io.StringIO(text), delimiter=delimiter, quoting=csv.QUOTE_NONE)
    width = 0
    try:
        for count, row in enumerate(reader):
            line = before + reader.line_num
            if count > limits.rows:
                raise FlightDataError(f"line {line}", "more rows", f"up to {limits.rows} rows")
            cells = [cell.strip().strip('"').strip() for cell in row]
            if not any(cells):
                continue
            width = width or len(cells)
            if len(cells) != width:
                raise FlightDataError(
                    f"line {line}",
                    f"{len(cells)} fields where the header has {width}; the file may be cut off",
                    f"{width} fields in every line",
                )
            for column, cell in enumerate(cells, start=1):
                _check_cell(cell, f"line {line}, column {column}", limits)
            yield line, cells
    except csv.Error as error:
        raise FlightDataError(f"line {before + reader.line_num}", str(error), "CSV text") from error


def _check_cell(cell: str, where: str, limits: Limits) -> None:
    if len(cell) > limits.cell:
        raise FlightDataError(where, f"{len(cell)} characters", f"up to {limits.cell}")
    if _FORMULA.match(cell) and cell.lower() not in MISSING:
        raise FlightDataError(where, f"a formula {cell[:40]!r}", "numbers and names")


def _long(
    rows: Iterator[tuple[int, list[str]]], plain: list[str], time_at: int, clock: "_Clock"
) -> tuple[Column, ...]:
    name_at = next(i for i, name in enumerate(plain) if name in PARAMETER_NAMES)
    value_at = plain.index("value")
    unit_at = plain.index("unit") if "unit" in plain else None
    valid_at = plain.index("valid") if "valid" in plain else None
    columns: dict[tuple[str, str], Column] = {}
    for line, row in rows:
        name = row[name_at]
        unit = "" if unit_at is None else row[unit_at]
        column = columns.setdefault((name, unit), Column(name, unit))
        time = clock.seconds(row[time_at], f"line {line}, column {time_at + 1}")
        is_valid = valid_at is None or row[valid_at].lower() in ("", "1", "true", "valid")
        value = _number(row[value_at], f"line {line}, column {value_at + 1} ({name})")
        _append(column, time, value if is_valid else None)
    return tuple(columns.values())


def _wide(
    rows: Iterator[tuple[int, list[str]]],
    header: list[str],
    time_at: int,
    clock: "_Clock",
    comments: list[str],
) -> tuple[Column, ...]:
    units = [""] * len(header)
    for comment in comments:  # the last one as wide as the header states the units (G1000)
        cells = [cell.strip() for cell in comment.split(",")]
        if len(cells) == len(header):
            units = cells
    columns = [Column(name, unit) for name, unit in zip(header, units, strict=True)]
    skipped = [
        i == time_at or re.sub(r"[^a-z]", "", name.lower()) in ("lcldate", "utcofst", "date")
        for i, name in enumerate(header)
    ]
    for line, row in rows:
        time = clock.seconds(row[time_at], f"line {line}, column {time_at + 1}")
        for index, cell in enumerate(row):
            if skipped[index] or columns[index].words:
                continue
            where = f"line {line}, column {index + 1} ({header[index]})"
            try:
                value = _number(cell, where)
            except FlightDataError:
                if columns[index].value:
                    raise
                # A column of words, as the identifier of the next waypoint; its reader decides.
                columns[index].words = f"{where}, {cell[:40]!r}"
                continue
            _append(columns[index], time, value)
    return tuple(column for i, column in enumerate(columns) if not skipped[i])


def _append(column: Column, time: float | None, value: float | None) -> None:
    if time is None or value is None:
        column.missing += 1
    else:
        column.time.append(time)
        column.value.append(value)


def _number(cell: str, where: str) -> float | None:
    low = cell.lower()
    if low in MISSING:
        return None
    if low in STATES:
        return STATES[low]
    try:
        value = float(cell)
    except ValueError as error:
        raise FlightDataError(
            where, f"{cell[:40]!r}", "a number with a decimal point, or empty"
        ) from error
    return value if math.isfinite(value) else None


class _Clock:
    """Seconds from numbers, times of day (midnight passed over) and ISO 8601 times."""

    def __init__(self) -> None:
        self._last: float | None = None
        self._days = 0.0

    def seconds(self, cell: str, where: str) -> float | None:
        if cell.lower() in MISSING:
            return None
        if clock := _CLOCK.match(cell):
            time = int(clock[1]) * 3600.0 + int(clock[2]) * 60.0 + float(clock[3])
            if self._last is not None and time + self._days < self._last - _DAY / 2:
                self._days += _DAY
            self._last = time + self._days
            return self._last
        try:
            value = float(cell)
        except ValueError:
            return self._iso(cell, where)
        if not abs(value) < 1e11:
            raise FlightDataError(where, f"time {cell[:40]!r}", "seconds within 1e11 of zero")
        return value

    def _iso(self, cell: str, where: str) -> float:
        try:
            moment = datetime.fromisoformat(cell)
        except ValueError as error:
            raise FlightDataError(
                where, f"time {cell[:40]!r}", "seconds, hh:mm:ss or ISO 8601"
            ) from error
        if moment.tzinfo is None:
            moment = moment.replace(tzinfo=UTC)
        return moment.timestamp()
