"""Reading makers' rules: files of this package by name, or one in the aircraft's own folder."""

from importlib import resources
from importlib.resources.abc import Traversable
from itertools import pairwise, product
from pathlib import Path

from solver.aircraft.toml_document import read_document
from solver.assessment import Verdict
from solver.errors import ModelError
from solver.units import Dimension, allowed_units, from_si, to_si
from solver.verdict import makers_rule as values
from solver.verdict import makers_rule_file as file
from solver.verdict.limit_curve import LimitCurve, Outside

_FOLDER = resources.files("solver.verdict") / "rules"

#: What a limit, or the argument of one, can be [g, m/s, rad/s, rad, kg]: wide enough for any
#: aeroplane, narrow enough to catch one unit put where another belongs.
_RANGES = {
    Dimension.LOAD_FACTOR: (0.05, 10.0),
    Dimension.SPEED: (0.3, 10.0),
    Dimension.ANGULAR_RATE: (0.005, 1.1),
    Dimension.ANGLE: (0.0, 0.8),
    Dimension.MASS: (0.0, 1e6),
}


def packaged_rules() -> tuple[str, ...]:
    """Names of the rules of this package."""
    return tuple(sorted(p.name[:-5] for p in _FOLDER.iterdir() if p.name.endswith(".toml")))


def load_makers_rule(folder: Path, name: str | None) -> values.MakersRule | None:
    """Read the rule that an aircraft's definition names.

    Parameters
    ----------
    folder : Path
        The aircraft's folder; a name that ends in ``.toml`` is a file there.
    name : str, optional
        Otherwise the name of a rule of this package; None gives None.

    Raises
    ------
    ModelError
        The file is missing or malformed; says which file, which key, and what is allowed.
    """
    if name is None:
        return None
    if name.endswith(".toml"):
        return read_makers_rule(folder / name)
    return packaged_rule(name)


def packaged_rule(name: str) -> values.MakersRule:
    """Rule of this package; raises `ModelError` naming those there are."""
    if name not in packaged_rules():
        raise ModelError(f"no maker's rule {name!r}; there are {', '.join(packaged_rules())}")
    return read_makers_rule(_FOLDER / f"{name}.toml")


def read_makers_rule(path: Path | Traversable) -> values.MakersRule:
    """Read a rule file; raises `ModelError` as `load_makers_rule` does."""
    checked = read_document(path, file.RuleFile)
    try:
        return _rule(path.name.removesuffix(".toml"), checked)
    except ModelError as error:
        raise ModelError(f"{path}: {error}") from error


def _rule(name: str, checked: file.RuleFile) -> values.MakersRule:
    sources = {
        label: values.Source(source.text, values.Certainty(source.certainty))
        for label, source in checked.sources.items()
    }
    margin = checked.overweight_margin
    return values.MakersRule(
        name=name,
        title=checked.title,
        note=checked.note,
        overweight_margin=0.0
        if margin is None
        else _si(margin.value, margin.unit, Dimension.MASS, "overweight_margin"),
        criteria=tuple(
            _criterion(section, f"criterion[{index}]", sources)
            for index, section in enumerate(checked.criterion)
        ),
    )


def _criterion(
    section: file.CriterionSection, key: str, sources: dict[str, values.Source]
) -> values.Criterion:
    quantity = values.Quantity(section.quantity)
    limits = []
    for index, limit in enumerate(section.limit):
        where = f"{key}.limit[{index}]"
        if limit.source not in sources:
            known = ", ".join(sources)
            raise ModelError(f"{where}.source: {limit.source!r} is not in [sources] ({known})")
        dimension = values.DIMENSIONS[quantity]
        is_load_factor = dimension is Dimension.LOAD_FACTOR
        if is_load_factor != (limit.rate_hz is not None):
            needed = "is needed for" if is_load_factor else "does not belong to"
            raise ModelError(f"{where}.rate_hz: {needed} a limit of the {quantity}")
        limits.append(
            values.Limit(
                curve=_curve(limit, section.unit, dimension, where),
                over=_argument(limit),
                source=sources[limit.source],
                rate=limit.rate_hz,
                weight=None if limit.weight is None else values.WeightClass(limit.weight),
                greatest=None
                if limit.greatest is None
                else _si(limit.greatest, section.unit, dimension, f"{where}.greatest"),
            )
        )
        if limit.greatest is not None and limits[-1].greatest != max(
            limits[-1].greatest or 0.0, *limits[-1].curve.values
        ):
            raise ModelError(f"{where}.greatest: must not be less than the limit itself")
    _refuse_gaps(limits, key)
    return values.Criterion(
        name=section.name,
        quantity=quantity,
        unit=section.unit,
        action=Verdict(section.action),
        main_gear_first=section.main_gear_first,
        limits=tuple(limits),
        onset=None if section.onset is None else _onset(section.onset, f"{key}.onset"),
    )


def _refuse_gaps(limits: list[values.Limit], key: str) -> None:
    """Every weight must find one limit, and only one, at every rate."""
    rates = dict.fromkeys(limit.rate for limit in limits)
    for rate, weight in product(rates, values.WeightClass):
        count = sum(limit.rate == rate and limit.weight in (None, weight) for limit in limits)
        if count != 1:
            at = "" if rate is None else f" at {rate:g} Hz"
            raise ModelError(f"{key}.limit: {count} limits {weight}{at}, needed exactly one")


def _onset(section: file.OnsetSection, key: str) -> values.Onset:
    curve = _curve(section, "g", Dimension.LOAD_FACTOR, key)
    return values.Onset(curve, _argument(section), section.rate_hz)


def _argument(section: file.CurveSection) -> values.Argument | None:
    over = section.over
    return None if over is None else values.Argument(values.Quantity(over.quantity), over.unit)


def _curve(section: file.CurveSection, unit: str, dimension: Dimension, key: str) -> LimitCurve:
    if section.points is None or section.over is None:
        number = section.value or 0.0
        return LimitCurve((0.0,), (_si(number, unit, dimension, f"{key}.value"),))
    over = values.DIMENSIONS[values.Quantity(section.over.quantity)]
    arguments, limits = [], []
    for index, (argument, limit) in enumerate(section.points):
        where = f"{key}.points[{index}]"
        arguments.append(_si(argument, section.over.unit, over, where))
        limits.append(_si(limit, unit, dimension, where))
    for before, after in pairwise(arguments):
        if after < before:
            raise ModelError(f"{key}.points: {section.over.quantity} must not fall")
    return LimitCurve(tuple(arguments), tuple(limits), Outside(section.outside))


def _si(number: float, unit: str, dimension: Dimension, key: str) -> float:
    units = allowed_units(dimension)
    if unit not in units:
        raise ModelError(f"{key}: {unit!r} is no unit of {dimension} ({', '.join(units)})")
    value = to_si(number, unit, dimension)
    low, high = _RANGES[dimension]
    if not low <= value <= high:
        allowed = " to ".join(f"{from_si(bound, unit, dimension):.4g}" for bound in (low, high))
        raise ModelError(f"{key}: {number:g} {unit} is outside {allowed} {unit}")
    return value
