"""Nastran bulk data out: a `FiniteElementModel` becomes a file that reads back the same.

Cards with reals are written in large-field format.  Of the decimal forms that fit its 16
characters the closest is chosen, so that numbers with up to 10 digits are exact.  The others keep
14 digits as a rule, 12 at least if they are from 1e-9 to 1e12 in size (a sign and an exponent cost
a digit each), 10 at worst.  What was read once is written and read again without any change.
"""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from pathlib import Path

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.fe.model import BeamProperty, FiniteElementModel, Shells

_WIDTH = 16
_Field = int | float | str


def write_bulk_data(model: FiniteElementModel, path: Path, comments: Sequence[str] = ()) -> None:
    """Write a model; ``comments`` stand at the top of the file."""
    path.write_text(format_bulk_data(model, comments), encoding="ascii")


def format_bulk_data(model: FiniteElementModel, comments: Sequence[str] = ()) -> str:
    """Bulk data of a model as text.

    Raises
    ------
    ModelError
        A beam property has a torsion radius but no named shape, which no card can say; or a
        number is not finite.
    """
    lines = [f"$ {line}" for line in comments]
    lines.append("BEGIN BULK")
    for cards in (
        _materials(model),
        _shell_properties(model),
        _beam_properties(model.beam_properties),
        _nodes(model),
        _shells(model, "CQUAD4", model.quads),
        _shells(model, "CTRIA3", model.triangles),
        _beams(model),
        _point_masses(model),
        _constraints(model),
    ):
        lines.extend(cards)
    lines.append("ENDDATA")
    return "\n".join(lines) + "\n"


def format_real(value: float) -> str:
    """Closest decimal form of at most 16 characters, with a decimal point and no letter E."""
    if not np.isfinite(value):
        raise ModelError(f"{value} cannot be written to bulk data")
    if value == 0.0:
        return "0."
    best, smallest = "", np.inf
    for text in _candidates(float(value)):
        error = abs(_parsed(text) - value)
        if error < smallest:
            best, smallest = text, error
        if error == 0.0:
            break
    if not best:
        raise ModelError(f"{value} cannot be written to bulk data")
    return best


def _candidates(value: float) -> Iterator[str]:
    """Forms that fit: shortest exact, positional, mantissa with exponent (0 or 1 digit ahead)."""
    power = int(f"{value:e}".split("e")[1])
    if -4 <= power <= 14:
        for text in (repr(value), *(f"{value:.{places}f}" for places in range(17, -1, -1))):
            text = _trimmed(text)
            if "e" not in text and len(text) <= _WIDTH:
                yield text
                break
    for shift in (0, 1):
        suffix = f"{power + shift:+d}"
        mantissa = Decimal(value).scaleb(-power - shift)
        for digits in range(_WIDTH, 0, -1):
            text = _trimmed(f"{mantissa:.{digits}f}")
            if len(text) + len(suffix) <= _WIDTH:
                yield text + suffix
                break


def _trimmed(text: str) -> str:
    """Without trailing zeros and without a zero before the point."""
    text = text.rstrip("0") if "." in text else text + "."
    if text.startswith("0.") and len(text) > 2:
        return text[1:]
    if text.startswith("-0.") and len(text) > 3:
        return "-" + text[2:]
    return text


def _parsed(text: str) -> float:
    for sign in "+-":
        place = text.rfind(sign)
        if place > 0:
            return float(f"{text[:place]}e{text[place:]}")
    return float(text)


def _small(name: str, fields: Sequence[_Field]) -> Iterator[str]:
    """Lines of a card of whole numbers and words, eight fields of eight characters each."""
    for first in range(0, len(fields), 8):
        head = name if first == 0 else "+"
        body = "".join(f"{field:>8}" for field in fields[first : first + 8])
        yield f"{head:<8}{body}"


def _large(name: str, fields: Sequence[_Field]) -> Iterator[str]:
    """Lines of a card with reals, four fields of sixteen characters each."""
    texts = [format_real(field) if isinstance(field, float) else str(field) for field in fields]
    while texts and not texts[-1]:
        texts.pop()
    for first in range(0, len(texts), 4):
        head = f"{name}*" if first == 0 else "*"
        body = "".join(f"{text:>16}" for text in texts[first : first + 4])
        yield f"{head:<8}{body}".rstrip()


def _reals(values: Array) -> list[float]:
    return [float(value) for value in np.ravel(values)]


def _materials(model: FiniteElementModel) -> Iterator[str]:
    for material in model.materials.values():
        yield from _large(
            "MAT1",
            [
                material.identifier,
                material.young_modulus,
                material.shear_modulus,
                material.poisson_ratio,
                material.density,
            ],
        )


def _shell_properties(model: FiniteElementModel) -> Iterator[str]:
    for section in model.shell_properties.values():
        fields: list[_Field] = [section.identifier, section.material, float(section.thickness)]
        fields += [section.material, "", section.material, ""]
        if section.nonstructural_mass:
            fields.append(float(section.nonstructural_mass))
        yield from _large("PSHELL", fields)


def _beam_properties(properties: Mapping[int, BeamProperty]) -> Iterator[str]:
    for section in properties.values():
        mass = float(section.nonstructural_mass)
        head: list[_Field] = [section.identifier, section.material]
        if section.shape:
            dimensions = [float(value) for value in section.dimensions]
            tail = [mass] if mass else []
            yield from _large(
                "PBARL", [*head, "", section.shape, "", "", "", "", *dimensions, *tail]
            )
            continue
        if section.torsion_radius:
            raise ModelError(
                f"beam property {section.identifier}: a torsion radius needs a named shape (PBARL)"
            )
        figures = [
            section.area, section.inertia_1, section.inertia_2, section.torsion_constant, mass
        ]  # fmt: skip
        yield from _large(
            "PBAR",
            [
                *head,
                *(float(figure) for figure in figures),
                "",
                *_reals(section.stress_points),
                float(section.shear_factor_1),
                float(section.shear_factor_2),
            ],
        )


def _nodes(model: FiniteElementModel) -> Iterator[str]:
    for identifier, position in zip(model.node_identifiers, model.coordinates, strict=True):
        yield from _large("GRID", [int(identifier), "", *_reals(position)])


def _shells(model: FiniteElementModel, name: str, shells: Shells) -> Iterator[str]:
    nodes = model.node_identifiers[shells.nodes]
    for k, identifier in enumerate(shells.identifiers):
        yield from _small(name, [int(identifier), int(shells.properties[k]), *nodes[k].tolist()])


def _beams(model: FiniteElementModel) -> Iterator[str]:
    beams = model.beams
    nodes = model.node_identifiers[beams.nodes]
    for k, identifier in enumerate(beams.identifiers):
        fields: list[_Field] = [int(identifier), int(beams.properties[k]), *nodes[k].tolist()]
        fields += _reals(beams.orientations[k])
        if np.any(beams.offsets[k]):
            fields += ["GGG", "", "", *_reals(beams.offsets[k])]
        yield from _large("CBAR", fields)


def _point_masses(model: FiniteElementModel) -> Iterator[str]:
    masses = model.point_masses
    for k, identifier in enumerate(masses.identifiers):
        node = int(model.node_identifiers[masses.nodes[k]])
        fields: list[_Field] = [int(identifier), node, 0, float(masses.masses[k])]
        inertia = masses.inertias[k]
        if np.any(masses.offsets[k]) or np.any(inertia):
            fields += [*_reals(masses.offsets[k]), ""]
        if np.any(inertia):
            # the card holds products of inertia, which the tensor has with the other sign
            fields += [
                float(inertia[0, 0]), float(-inertia[1, 0]), float(inertia[1, 1]),
                float(-inertia[2, 0]), float(-inertia[2, 1]), float(inertia[2, 2]),
            ]  # fmt: skip
        yield from _large("CONM2", fields)


def _constraints(model: FiniteElementModel) -> Iterator[str]:
    names = model.node_identifiers
    for body in model.rigid_bodies:
        dependents = names[body.dependents].tolist()
        yield from _small(
            "RBE2", [body.identifier, int(names[body.independent]), 123456, *dependents]
        )
    for mean in model.interpolations:
        fields: list[_Field] = [mean.identifier, "", int(names[mean.reference]), 123456]
        for node, weight in zip(mean.nodes, mean.weights, strict=True):
            fields += [float(weight), 123, int(names[node])]
        yield from _large("RBE3", fields)
