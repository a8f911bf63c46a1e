"""Figures as they are printed: digits that the tolerance asks for, prefixes, aligned points."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from verification.comparison import Comparison

#: Prefixes that a unit takes, largest first.
_LARGE = ((1e9, "G"), (1e6, "M"), (1e3, "k"))
_SMALL = ((1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_PREFIXES = dict.fromkeys(("N", "Pa", "J", "W", "N m", "N/m", "N m/rad"), _LARGE) | dict.fromkeys(
    ("m", "s"), _SMALL
)

_NUMBER = re.compile(r"[−+-]?(10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+|\d[\d.]*( ?%| × 10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?)")
_EXPONENTIAL = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?\d{1,3})(?!\w)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell of a table; the room of ``hidden``, zeros and a point, follows the text unseen."""

    text: str
    hidden: str = ""
    is_number: bool = False


@dataclass(frozen=True, slots=True)
class ComparedFigures:
    """A comparison as it is printed."""

    found: str
    target: str
    unit: str
    difference: str
    tolerance: str


def compared(row: Comparison, most_digits: int = 9) -> ComparedFigures:
    """Print a comparison with as many digits as its tolerance can tell apart."""
    if row.target == 0:
        return ComparedFigures(
            short(row.found, 3),
            "0",
            _typeset(row.unit),
            *(_difference(x, row) for x in (row.difference, row.tolerance)),
        )
    size = max(abs(row.target), abs(row.found)) if math.isfinite(row.found) else abs(row.target)
    factor, unit = _prefixed(size, row.unit)
    scale = abs(row.target) if row.scale is None else row.scale
    finest = row.tolerance * scale
    decimals = _decimals(size / factor, finest / factor, most_digits)
    return ComparedFigures(
        found=fixed(row.found / factor, decimals),
        target=fixed(row.target / factor, decimals),
        unit=unit,
        difference=_difference(row.difference, row),
        tolerance=_difference(row.tolerance, row),
    )


def fixed(value: float, decimals: int) -> str:
    """Print with fixed decimals and a true minus; very large and very small as powers of ten."""
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else ("∞" if value > 0 else "−∞")
    if value == 0:
        return "0"
    if abs(value) >= 1e7 or abs(value) < 1e-3:
        lead = math.floor(math.log10(abs(value)))
        return power_of_ten(value, min(max(lead + decimals + 1, 2), 9))
    return f"{value:.{min(decimals, 9)}f}".replace("-", "−")


def power_of_ten(value: float, digits: int = 2) -> str:
    """Print as a number times a power of ten."""
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa} × 10{str(int(exponent)).translate(_RAISED)}".replace("-", "−")


def typeset(text: str) -> str:
    """Print the figures of a text that are written like 1.5e-7 as powers of ten."""
    return _EXPONENTIAL.sub(_raised, text)


def _raised(found: re.Match[str]) -> str:
    mantissa, exponent = found.groups()
    power = "10" + str(int(exponent)).translate(_RAISED)
    return power if mantissa == "1" else f"{mantissa} × {power}"


def short(value: float, digits: int = 2) -> str:
    """Print with a few significant digits."""
    if value == 0:
        return "0"
    if not math.isfinite(value):
        return fixed(value, 0)
    if not 1e-3 <= abs(value) < 1e5:
        return power_of_ten(value, digits)
    return fixed(value, max(0, digits - 1 - math.floor(math.log10(abs(value)))))


def share(value: float) -> str:
    """Print a share as a percentage, very small ones as powers of ten."""
    if value == 0 or not math.isfinite(value):
        return fixed(value, 0)
    return f"{short(100 * value)} %" if value >= 1e-5 else power_of_ten(value)


def duration(seconds: float) -> str:
    """Print a duration as one would say it."""
    if seconds < 1:
        return f"{seconds:.2f} s"
    if seconds < 100:
        return f"{seconds:.0f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest:02d} s"


def aligned(columns: Sequence[Sequence[str]]) -> list[list[Cell]]:
    """Cells of columns; in a column of numbers the decimal points stand above each other."""
    result = []
    for column in columns:
        if not any(_is_number(text) for text in column):
            result.append([Cell(text) for text in column])
            continue
        # What follows the point, for plain numbers only: 1.2 × 10⁻³ stands by itself.
        tails = [
            text[text.index(".") :] if _is_plain(text) and "." in text else "" for text in column
        ]
        longest = max((tail.rstrip(" %") for tail in tails), key=len, default="")
        cells = []
        for text, tail in zip(column, tails, strict=True):
            digits = tail.rstrip(" %")
            lacks = longest[len(digits) :] if _is_plain(text) and not text.endswith("%") else ""
            number = _is_number(text) or text in ("", "–")
            cells.append(Cell(text, re.sub(r"\d", "0", lacks), number))
        result.append(cells)
    return result


def _is_number(text: str) -> bool:
    return _NUMBER.fullmatch(text) is not None


def _is_plain(text: str) -> bool:
    stripped = text.lstrip("−-+").rstrip(" %")
    return stripped.replace(".", "", 1).isdigit()


def _prefixed(size: float, unit: str) -> tuple[float, str]:
    for factor, prefix in _PREFIXES.get(unit, ()):
        if size >= factor * 0.9999999:
            return factor, prefix + _typeset(unit)
    return 1.0, _typeset(unit)


def _typeset(unit: str) -> str:
    """Raise the exponents; "1" is no unit."""
    if unit == "1":
        return ""
    return re.sub(r"(?<=[a-z])-?\d", lambda found: found.group().translate(_RAISED), unit)


def _decimals(size: float, finest: float, most_digits: int) -> int:
    """Decimals that show a tenth of the finest difference, with three digits at least."""
    if size == 0 or not math.isfinite(size):
        return 3
    lead = math.floor(math.log10(size))
    digits = most_digits if finest == 0 else math.ceil(lead - math.log10(finest)) + 2
    return max(0, min(max(digits, 3), most_digits) - 1 - lead)


def _difference(value: float, row: Comparison) -> str:
    if row.is_relative:
        return share(value)
    return f"{short(value)} {_typeset(row.unit)}".rstrip()
