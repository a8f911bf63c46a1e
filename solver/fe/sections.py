"""Section data of elements as arrays: property and material looked up once for all elements."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.model import (
    BeamProperty,
    Beams,
    FiniteElementModel,
    Material,
    ShellProperty,
    Shells,
)

Property = TypeVar("Property", ShellProperty, BeamProperty)
Value = TypeVar("Value")


@dataclass(frozen=True, slots=True)
class ShellSections:
    """Section of every shell of one shape, each field (m,)."""

    young_modulus: Array  #: [Pa]
    shear_modulus: Array  #: [Pa]
    poisson_ratio: Array
    thickness: Array  #: [m]
    density: Array  #: [kg/m3]
    nonstructural_mass: Array  #: [kg/m2]

    @property
    def plane_stress(self) -> Array:
        """Plane-stress elasticity (m, 3, 3) for the strains x, y and engineering shear xy [Pa]."""
        matrix = np.zeros((len(self.thickness), 3, 3))
        direct = self.young_modulus / (1.0 - self.poisson_ratio**2)
        matrix[:, 0, 0] = matrix[:, 1, 1] = direct
        matrix[:, 0, 1] = matrix[:, 1, 0] = self.poisson_ratio * direct
        matrix[:, 2, 2] = self.shear_modulus
        return matrix


@dataclass(frozen=True, slots=True)
class BeamSections:
    """Section of every beam, each field (m,) unless said otherwise."""

    young_modulus: Array  #: [Pa]
    shear_modulus: Array  #: [Pa]
    density: Array  #: [kg/m3]
    area: Array  #: [m2]
    inertia_1: Array  #: bending in the element x-y plane [m4]
    inertia_2: Array  #: bending in the element x-z plane [m4]
    torsion_constant: Array  #: [m4]
    torsion_radius: Array  #: [m]
    shear_factor_1: Array
    shear_factor_2: Array
    nonstructural_mass: Array  #: [kg/m]
    stress_points: Array  #: (m, 4, 2) y and z [m]


def shell_sections(model: FiniteElementModel, shells: Shells) -> ShellSections:
    """Sections of ``shells`` in their order.

    Raises
    ------
    ModelError
        A property or its material is missing or without positive stiffness; names the element.
    """
    rows, properties, materials = _looked_up(
        shells.identifiers, shells.properties, model.shell_properties, model.materials, "shell"
    )
    for section in properties:
        if not section.thickness > 0.0:
            raise ModelError(
                f"shell property {section.identifier} has thickness {section.thickness} m"
            )
    return ShellSections(
        young_modulus=_column(materials, lambda m: m.young_modulus)[rows],
        shear_modulus=_column(materials, lambda m: m.shear_modulus)[rows],
        poisson_ratio=_column(materials, lambda m: m.poisson_ratio)[rows],
        thickness=_column(properties, lambda p: p.thickness)[rows],
        density=_column(materials, lambda m: m.density)[rows],
        nonstructural_mass=_column(properties, lambda p: p.nonstructural_mass)[rows],
    )


def beam_sections(model: FiniteElementModel, beams: Beams) -> BeamSections:
    """Sections of ``beams`` in their order; see `shell_sections` for errors."""
    rows, properties, materials = _looked_up(
        beams.identifiers, beams.properties, model.beam_properties, model.materials, "beam"
    )
    for section in properties:
        _check_beam_property(section)
    points = np.array([p.stress_points for p in properties], dtype=float).reshape(-1, 4, 2)
    return BeamSections(
        young_modulus=_column(materials, lambda m: m.young_modulus)[rows],
        shear_modulus=_column(materials, lambda m: m.shear_modulus)[rows],
        density=_column(materials, lambda m: m.density)[rows],
        area=_column(properties, lambda p: p.area)[rows],
        inertia_1=_column(properties, lambda p: p.inertia_1)[rows],
        inertia_2=_column(properties, lambda p: p.inertia_2)[rows],
        torsion_constant=_column(properties, lambda p: p.torsion_constant)[rows],
        torsion_radius=_column(properties, lambda p: p.torsion_radius)[rows],
        shear_factor_1=_column(properties, lambda p: p.shear_factor_1)[rows],
        shear_factor_2=_column(properties, lambda p: p.shear_factor_2)[rows],
        nonstructural_mass=_column(properties, lambda p: p.nonstructural_mass)[rows],
        stress_points=points[rows],
    )


def _check_beam_property(section: BeamProperty) -> None:
    stiffness = {
        "area": section.area,
        "inertia 1": section.inertia_1,
        "inertia 2": section.inertia_2,
        "torsion constant": section.torsion_constant,
    }
    for name, value in stiffness.items():
        if not value > 0.0:
            raise ModelError(
                f"beam property {section.identifier} has {name} {value}; it must be positive, "
                "or nodes held by such beams alone would be loose"
            )
    if np.shape(section.stress_points) != (4, 2):
        raise ModelError(f"beam property {section.identifier} needs four stress points (y, z)")


def _looked_up(
    identifiers: IntArray,
    properties: IntArray,
    known: Mapping[int, Property],
    materials: Mapping[int, Material],
    kind: str,
) -> tuple[IntArray, list[Property], list[Material]]:
    """Row of each element's property among those used, with these properties and materials."""
    used, rows = np.unique(properties, return_inverse=True)
    sections: list[Property] = []
    for row, identifier in enumerate(used.tolist()):
        if identifier not in known:
            element = identifiers[np.argmax(rows == row)]
            raise ModelError(f"element {element} names {kind} property {identifier}: not defined")
        sections.append(known[identifier])
    section_materials: list[Material] = []
    for section in sections:
        if section.material not in materials:
            raise ModelError(
                f"{kind} property {section.identifier} names material {section.material}: "
                "not defined"
            )
        section_materials.append(_checked(materials[section.material]))
    return rows, sections, section_materials


def _checked(material: Material) -> Material:
    if not (material.young_modulus > 0.0 and material.shear_modulus > 0.0):
        raise ModelError(
            f"material {material.identifier} has E {material.young_modulus} Pa and "
            f"G {material.shear_modulus} Pa; both must be positive"
        )
    if not -1.0 < material.poisson_ratio <= 0.5:
        raise ModelError(
            f"material {material.identifier} has Poisson ratio {material.poisson_ratio}, "
            "outside -1 to 0.5"
        )
    if not material.density >= 0.0:
        raise ModelError(f"material {material.identifier} has density {material.density} kg/m3")
    return material


def _column(values: Sequence[Value], field: Callable[[Value], float]) -> Array:
    return np.array([field(value) for value in values], dtype=float)
