"""`read_window`: a file in, a window in SI with everything that was noticed on the way."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from solver.errors import FlightDataError
from solver.flight_data.aliases import Alias, Refused, find_alias, to_window_unit
from solver.flight_data.cleaning import clean
from solver.flight_data.csv_table import read_csv
from solver.flight_data.frame import RecorderFrame
from solver.flight_data.parameter import Parameter
from solver.flight_data.parquet_table import MAGIC, read_parquet
from solver.flight_data.table import Column, Limits
from solver.flight_data.window import Channel, Note, Window

#: First bytes of packed files, which could unpack to any size.
_PACKED = {b"\x1f\x8b": "gzip", b"PK": "zip", b"\x28\xb5\x2f\xfd": "zstandard", b"BZh": "bzip2"}


def read_window(
    source: Path | bytes, frame: RecorderFrame | None = None, limits: Limits | None = None
) -> Window:
    """Window from a CSV or Parquet file.

    Parameters
    ----------
    source : Path or bytes
        File, or its content.
    frame : RecorderFrame, optional
        What is known of the recorder.
    limits : Limits, optional

    Raises
    ------
    FlightDataError
        The file cannot be read; says where, what was found and what is allowed.

    Notes
    -----
    A parameter that is not known is noted and left out; a window without any known one is still a
    window, and whoever judges it says that it cannot tell.
    """
    limits = limits or Limits()
    content = _content(source, limits)
    if not content.strip():
        raise FlightDataError("file", "no content", "CSV or Parquet")
    for magic, name in _PACKED.items():
        if content.startswith(magic):
            raise FlightDataError("byte 0", f"a {name} file", "CSV or Parquet, not packed")
    is_parquet = content.startswith(MAGIC)
    columns = read_parquet(content, limits) if is_parquet else read_csv(content, limits)
    channels: list[Channel] = []
    notes: list[Note] = []
    for column in columns:
        _understand(column, channels, notes)
    return Window(tuple(_distinct(channels, notes)), frame, tuple(notes))


def _content(source: Path | bytes, limits: Limits) -> bytes:
    if isinstance(source, bytes):
        size, content = len(source), source
    else:
        try:
            size = source.stat().st_size
            content = b""
            if size <= limits.size:
                with source.open("rb") as file:
                    content = file.read(limits.size + 1)  # it may have grown, or be no real file
        except OSError as error:
            raise FlightDataError(str(source), error.strerror or "unreadable", "a file") from error
        size = max(size, len(content))
    if size > limits.size:
        raise FlightDataError("file", f"{size} bytes", f"up to {limits.size} bytes")
    return content


def _understand(column: Column, channels: list[Channel], notes: list[Note]) -> None:
    found, unit = find_alias(column.name)
    name = column.name[:60]
    if found is None:
        notes.append(Note("unknown_column", f"{name!r} is not a known parameter; left out"))
        return
    if isinstance(found, Refused):
        notes.append(Note("refused", f"{name!r} left out: {found.reason}"))
        return
    if column.words:
        raise FlightDataError(column.words, "no number", "a number with a decimal point, or empty")
    if column.missing:
        notes.append(Note("missing", f"{name}: {column.missing} cells without a value"))
    time, raw = column.arrays()
    given = column.unit or unit
    factor = to_window_unit(1.0, given or found.unit, found.parameter, f"column {name!r}")
    if not given and found.unit != "1":
        notes.append(Note("unit_assumed", f"{name}: states no unit, taken as {found.unit}"))
    value = found.sign * factor * raw
    made, done = clean(found.parameter, found.source, time, value)
    notes += done
    channels += [_total_acceleration(channel, notes, found) for channel in made]


def _total_acceleration(channel: Channel, notes: list[Note], alias: Alias) -> Channel:
    """Add the one g that some loggers subtract (NormAc of the G1000 is Nz - 1)."""
    if alias.parameter is not Parameter.NORMAL_ACCELERATION:
        return channel
    middle = float(np.median(channel.value))
    if abs(middle) < 0.3:
        notes.append(
            Note("one_g_added", f"{channel.label}: about {middle:.2f} g in rest, so it is Nz - 1")
        )
        return replace(channel, value=channel.value + 1.0)
    if middle < -0.5:
        notes.append(Note("sign", f"{channel.label}: about {middle:.2f} g in rest; sign turned"))
        return replace(channel, value=-channel.value)
    return channel


def _distinct(channels: list[Channel], notes: list[Note]) -> list[Channel]:
    """Every parameter and source once; names that mean the same are numbered."""
    seen: dict[tuple[Parameter, str], int] = {}
    result = []
    for channel in channels:
        key = (channel.parameter, channel.source)
        seen[key] = seen.get(key, 0) + 1
        if seen[key] > 1:
            notes.append(Note("same_parameter", f"{channel.label}: given {seen[key]} times"))
            channel = replace(channel, source=f"{channel.source}#{seen[key]}")
        result.append(channel)
    return result
