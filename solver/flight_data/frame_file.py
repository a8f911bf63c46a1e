"""Recorder frames as data: TOML files of this package, or one of the user's own.

A figure is ``{ value = 8, unit = "Hz", from = "document" }``; ``[sources]`` says what stands behind
each of the words in ``from``.  ``[defaults.<parameter>]`` holds what several sources share; what a
frame leaves open there is taken from ``usual_errors.toml``.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from solver.errors import ModelError
from solver.flight_data.frame import Certainty, Figure, RecordedParameter, RecorderFrame
from solver.flight_data.parameter import KINDS, Parameter
from solver.units import Dimension, to_si

_PACKAGE = resources.files("solver.flight_data")
_FOLDER = _PACKAGE / "frames"

_FIGURES = (
    "rate",
    "resolution",
    "least",
    "greatest",
    "noise",
    "bias",
    "scale",
    "delay",
    "delay_scatter",
    "corner",
    "late_most",
)
#: Figures that are not in the parameter's own unit.
_OTHER_UNITS = {
    "rate": "Hz",
    "corner": "Hz",
    "scale": "1",
    "delay": "s",
    "delay_scatter": "s",
    "late_most": "s",
}


def frame_names() -> tuple[str, ...]:
    """Frames of this package."""
    return tuple(sorted(p.name[:-5] for p in _FOLDER.iterdir() if p.name.endswith(".toml")))


@cache
def packaged_frame(name: str) -> RecorderFrame:
    """Frame of this package by name; raises `ModelError` naming those there are."""
    if name not in frame_names():
        raise ModelError(f"no recorder frame {name!r}; there are {', '.join(frame_names())}")
    return parse_frame((_FOLDER / f"{name}.toml").read_text(encoding="utf-8"), name)


def read_frame(path: Path) -> RecorderFrame:
    """Frame from a file of the user's own."""
    return parse_frame(path.read_text(encoding="utf-8"), path.stem)


def parse_frame(text: str, name: str) -> RecorderFrame:
    """Frame from the text of its file.

    Raises
    ------
    ModelError
        Names the entry and the key.
    """
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ModelError(f"frame {name}: {error}") from error
    usual = _usual_errors()
    sources = {**usual["sources"], **document.get("sources", {})}
    for word in sources:
        if word not in list(Certainty):
            raise ModelError(f"frame {name}: [sources] knows {', '.join(Certainty)}, not {word}")
    defaults = document.get("defaults", {})
    entries = []
    for index, entry in enumerate(document.get("parameter", [])):
        where = f"frame {name}, parameter {index + 1}"
        merged: dict[str, Any] = {}
        for part in ("every", str(entry.get("name", ""))):
            merged |= {**usual["defaults"].get(part, {}), **defaults.get(part, {})}
        merged |= entry
        entries.append(_parameter(merged, where, sources))
    if not entries:
        raise ModelError(f"frame {name} holds no [[parameter]]")
    return RecorderFrame(name, str(document.get("title", name)), dict(sources), tuple(entries))


@cache
def _usual_errors() -> dict[str, Any]:
    return tomllib.loads((_PACKAGE / "usual_errors.toml").read_text(encoding="utf-8"))


def _parameter(
    entry: Mapping[str, Any], where: str, sources: Mapping[str, str]
) -> RecordedParameter:
    if entry.get("name") not in list(Parameter):
        raise ModelError(f"{where}: name {entry.get('name')!r} is not a parameter")
    parameter = Parameter(entry["name"])
    known = {"name", "source", "mnemonic", "wraps", *_FIGURES}
    if unknown := set(entry) - known:
        raise ModelError(f"{where} ({parameter}): unknown key {', '.join(sorted(unknown))}")
    figures = {}
    for key in _FIGURES:
        if key not in entry:
            raise ModelError(f"{where} ({parameter}): {key} is missing")
        figures[key] = _figure(entry[key], key, parameter, f"{where} ({parameter}).{key}", sources)
    return RecordedParameter(
        parameter=parameter,
        source=str(entry.get("source", "")),
        mnemonic=str(entry.get("mnemonic", "")),
        wraps=bool(entry.get("wraps", False)),
        **figures,
    )


def _figure(
    given: Any, key: str, parameter: Parameter, where: str, sources: Mapping[str, str]
) -> Figure:
    if not isinstance(given, Mapping) or set(given) != {"value", "unit", "from"}:
        raise ModelError(f"{where} needs value, unit and from")
    if given["from"] not in sources:
        raise ModelError(f"{where}: from {given['from']!r} is not in [sources]")
    dimension = KINDS[parameter].dimension
    wanted = _OTHER_UNITS.get(key)
    unit = given["unit"]
    if wanted is not None or dimension is None:
        if unit != (wanted or "1"):
            raise ModelError(f"{where}: unit {unit!r}, needed {wanted or '1'!r}")
        value = float(given["value"])
    else:
        value = _si(float(given["value"]), unit, dimension, where)
    return Figure(value, Certainty(given["from"]))


def _si(value: float, unit: str, dimension: Dimension, where: str) -> float:
    try:
        return to_si(value, unit, dimension)
    except KeyError as error:
        raise ModelError(f"{where}: {unit!r} is no unit of {dimension}") from error
