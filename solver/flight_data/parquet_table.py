"""Parquet files, with the optional extra ``parquet``."""

import io
import math
from importlib import import_module
from typing import Any

from solver.errors import FlightDataError
from solver.flight_data.table import PARAMETER_NAMES, TIME_NAMES, Column, Limits

MAGIC = b"PAR1"


def read_parquet(content: bytes, limits: Limits) -> tuple[Column, ...]:
    """Columns of a Parquet file in long or wide form; what it declares is checked before reading.

    Raises
    ------
    FlightDataError
        The extra is not installed, the file is damaged or declares more than the limits allow.
    """
    try:
        # Not in the core: it weighs 55 MB, and most senders have CSV.
        parquet: Any = import_module("pyarrow.parquet")
    except ImportError as error:
        raise FlightDataError(
            "file", "Parquet, which needs pyarrow", "pip install 'hardlanding[parquet]', or CSV"
        ) from error
    if content[-4:] != MAGIC:
        raise FlightDataError("end of file", "no Parquet footer; the file is cut off", "PAR1")
    try:
        file = parquet.ParquetFile(io.BytesIO(content))
        names = _checked(file, limits)
        table = file.read(columns=names).to_pydict()
    except (OSError, ValueError, KeyError, NotImplementedError) as error:
        raise FlightDataError("file", f"damaged Parquet: {error}"[:300], "a whole file") from error
    return _columns(table)


def _checked(file: Any, limits: Limits) -> list[str]:
    metadata = file.metadata
    if metadata.num_rows > limits.rows:
        raise FlightDataError("file", f"{metadata.num_rows} rows", f"up to {limits.rows} rows")
    if metadata.num_columns > limits.columns:
        raise FlightDataError("file", f"{metadata.num_columns} columns", f"up to {limits.columns}")
    declared = sum(metadata.row_group(i).total_byte_size for i in range(metadata.num_row_groups))
    # A few kilobytes can unpack to gigabytes; four times the file limit is more than any window.
    if declared > 4 * limits.size:
        raise FlightDataError("file", f"{declared} bytes unpacked", f"up to {4 * limits.size}")
    names = [str(name) for name in file.schema_arrow.names]
    if not any(name.lower().replace("_", "") in TIME_NAMES for name in names):
        raise FlightDataError("schema", f"no time column among {names}"[:300], "t_s in seconds")
    return names


def _columns(table: dict[str, list[Any]]) -> tuple[Column, ...]:
    plain = {name.lower().replace("_", ""): name for name in table}
    times = table[next(plain[name] for name in plain if name in TIME_NAMES)]
    parameter = next((plain[name] for name in plain if name in PARAMETER_NAMES), None)
    columns: dict[tuple[str, str], Column] = {}
    if parameter is not None and "value" in plain:
        none = [None] * len(times)
        units = table.get(plain.get("unit", ""), none)
        valid = table.get(plain.get("valid", ""), none)
        values = table[plain["value"]]
        for time, name, value, unit, good in zip(
            times, table[parameter], values, units, valid, strict=True
        ):
            key = (str(name)[:200], str(unit or "")[:40])
            column = columns.setdefault(key, Column(*key))
            _append(column, time, None if good is False else value)
        return tuple(columns.values())
    for name, values in table.items():
        if name not in plain.values() or values is times:
            continue
        column = columns.setdefault((name, ""), Column(name, ""))
        for time, value in zip(times, values, strict=True):
            _append(column, time, value)
    return tuple(columns.values())


def _append(column: Column, time: Any, value: Any) -> None:
    is_number = isinstance(time, int | float) and isinstance(value, int | float)
    if is_number and math.isfinite(time) and math.isfinite(value):
        column.time.append(float(time))
        column.value.append(float(value))
    else:
        column.missing += 1
