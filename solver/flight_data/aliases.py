"""The many names of a parameter, and the many spellings of a unit."""

import re
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources

from solver.errors import FlightDataError
from solver.flight_data.parameter import KINDS, Parameter
from solver.units import Dimension, allowed_units, to_si

_SOURCE = re.compile(r"^(.*?)[ _]*[\[(]?([A-DLR]|[1-3])[\])]?$", re.IGNORECASE)
_BRACKETED = re.compile(r"^(.*?)\s*[\[(]([^\[\]()]*)[\])]\s*$")

_SPELLINGS = {
    "fpm": "ft/min",
    "ftmin": "ft/min",
    "ft/m": "ft/min",
    "fps": "ft/s",
    "mps": "m/s",
    "ms": "m/s",
    "kts": "kt",
    "knots": "kt",
    "kn": "kt",
    "feet": "ft",
    "degree": "deg",
    "degrees": "deg",
    "°": "deg",
    "lbs": "lb",
    "m/s^2": "m/s2",
    "m/s²": "m/s2",
    "bool": "1",
    "discrete": "1",
    "": "",
}


@dataclass(frozen=True, slots=True)
class Alias:
    """What a name stands for."""

    parameter: Parameter
    source: str
    unit: str  #: of a column that states none
    sign: float


@dataclass(frozen=True, slots=True)
class Refused:
    """A known name whose values must not carry a verdict."""

    reason: str


def find_alias(name: str) -> tuple[Alias | Refused | None, str]:
    """Find what a name stands for, and the unit it states ("" if none)."""
    stated = ""
    bracketed = _BRACKETED.match(name)
    if bracketed and _is_unit(bracketed[2]):
        name, stated = bracketed[1], bracketed[2]
    found = _lookup(name)
    if found is None and "_" in name:
        last, _, ending = name.rpartition("_")
        # As in "track_deg" or "vertical_speed_m_s".
        for stem, suffix in ((last, ending), _split_compound(name)):
            if stem and _is_unit(suffix) and (found := _lookup(stem)) is not None:
                return found, suffix
    return found, stated


def to_window_unit(value: float, unit: str, parameter: Parameter, where: str) -> float:
    """Value in the window's unit: SI, load factors in g; raises `FlightDataError` for the unit."""
    dimension = KINDS[parameter].dimension
    canonical = canonical_unit(unit, dimension)
    if canonical is None:
        allowed = ", ".join(allowed_units(dimension)) if dimension else "1"
        raise FlightDataError(where, f"unit {unit[:40]!r} of {parameter}", allowed)
    return value if dimension is None else to_si(value, canonical, dimension)


def canonical_unit(unit: str, dimension: Dimension | None) -> str | None:
    """Put a unit into the spelling of `solver.units`; None if it is no unit of that dimension."""
    plain = unit.strip()
    spelled = _SPELLINGS.get(plain.lower().replace(" ", ""), plain)
    if dimension is None:
        return "1" if spelled in ("", "1") else None
    known = allowed_units(dimension)
    if dimension is Dimension.LOAD_FACTOR:
        known = (*known, "mg")
    by_case = {name.lower(): name for name in known}
    return by_case.get(spelled.lower())


def _is_unit(text: str) -> bool:
    return any(canonical_unit(text, kind.dimension) for kind in KINDS.values() if text.strip())


def _split_compound(name: str) -> tuple[str, str]:
    """``("vertical_speed", "m/s")`` from ``vertical_speed_m_s``."""
    parts = name.rsplit("_", 2)
    return (parts[0], f"{parts[1]}/{parts[2]}") if len(parts) == 3 else ("", "")


def _plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.lower())


def _lookup(name: str) -> Alias | Refused | None:
    table = _table()
    if (found := table.get(_plain(name))) is not None:
        return found
    marked = _SOURCE.match(name.strip())
    if marked and (found := table.get(_plain(marked[1]))) is not None and isinstance(found, Alias):
        return Alias(found.parameter, marked[2].upper(), found.unit, found.sign)
    return None


@cache
def _table() -> dict[str, Alias | Refused]:
    text = (resources.files("solver.flight_data") / "aliases.toml").read_text(encoding="utf-8")
    document = tomllib.loads(text)
    table: dict[str, Alias | Refused] = {}
    for entry in document["alias"]:
        alias = Alias(Parameter(entry["parameter"]), "", entry["unit"], float(entry.get("sign", 1)))
        table |= {_plain(name): alias for name in entry["names"]}
    for parameter in Parameter:  # as `writing` names them, with our own signs and units
        table[_plain(f"hl_{parameter}")] = Alias(parameter, "", "", 1.0)
    for entry in document["refused"]:
        table |= {_plain(name): Refused(entry["reason"]) for name in entry["names"]}
    return table
