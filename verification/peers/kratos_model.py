"""A portable model written out for Kratos Multiphysics, whose own elements then assemble it.

Shells: ``ShellThickElement3D4N`` (MITC4 plate with an enhanced membrane) or
``ShellThinElementCorotational3D4N`` (ANDES membrane with a discrete Kirchhoff plate), triangles
``ShellThinElement3D3N``; beams ``CrLinearBeamElement3D2N``, shear-flexible; masses
``NodalConcentratedElement3D1N``; links ``LinearMasterSlaveConstraint``.
"""

import importlib
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from typing import Any

import numpy as np

from solver.fe.sections import beam_sections
from verification.peers.portable import PortableModel

THICK_QUAD = "ShellThickElement3D4N"
THIN_QUAD = "ShellThinElementCorotational3D4N"
THIN_TRIANGLE = "ShellThinElement3D3N"
BEAM = "CrLinearBeamElement3D2N"
DISPLACEMENTS = ("DISPLACEMENT_X", "DISPLACEMENT_Y", "DISPLACEMENT_Z")
ROTATIONS = ("ROTATION_X", "ROTATION_Y", "ROTATION_Z")
PACKAGES = (
    "KratosMultiphysics",
    "KratosMultiphysics.StructuralMechanicsApplication",
    "KratosMultiphysics.LinearSolversApplication",
)
DISTRIBUTIONS = (
    "KratosMultiphysics",
    "KratosStructuralMechanicsApplication",
    "KratosLinearSolversApplication",
)


def is_installed() -> bool:
    """Whether Kratos and the two applications used here are installed; nothing is imported."""
    try:
        for name in DISTRIBUTIONS:
            distribution(name)
    except PackageNotFoundError:
        return False
    return True


def kratos() -> tuple[Any, Any, Any]:
    """Kratos, its structural mechanics and its linear solvers, told to be quiet."""
    core, structural, linear = (importlib.import_module(name) for name in PACKAGES)
    core.Logger.GetDefaultOutput().SetSeverity(core.Logger.Severity.WARNING)
    return core, structural, linear


@dataclass(frozen=True)
class KratosModel:
    """A model part of Kratos and how its freedoms relate to the solver's."""

    portable: PortableModel
    owner: Any  #: the Kratos ``Model`` that keeps ``part`` alive
    part: Any

    @property
    def shell_count(self) -> int:
        """Number of shells; their element numbers are 1 to this, quadrilaterals first."""
        model = self.portable.model
        return len(model.quads.identifiers) + len(model.triangles.identifiers)


def write_model(portable: PortableModel, quad: str = THICK_QUAD) -> KratosModel:
    """Write a model into Kratos, with consistent mass everywhere (the default of Kratos)."""
    core, structural, _ = kratos()
    owner = core.Model()
    part = owner.CreateModelPart("structure")
    part.ProcessInfo[core.DOMAIN_SIZE] = 3
    for name in (
        "DISPLACEMENT",
        "ROTATION",
        "REACTION",
        "REACTION_MOMENT",
        "VELOCITY",
        "ACCELERATION",
        "ANGULAR_VELOCITY",
        "ANGULAR_ACCELERATION",
        "VOLUME_ACCELERATION",
    ):
        part.AddNodalSolutionStepVariable(getattr(core, name))
    part.AddNodalSolutionStepVariable(structural.POINT_LOAD)
    part.AddNodalSolutionStepVariable(structural.POINT_MOMENT)
    part.SetBufferSize(2)
    for number, place in enumerate(portable.coordinates.tolist(), start=1):
        part.CreateNewNode(number, *place)
    _add_freedoms(core, part, portable)
    _write_shells(core, structural, part, portable, quad)
    _write_beams(core, structural, part, portable)
    _write_masses(core, part, portable)
    _write_links(core, part, portable)
    return KratosModel(portable, owner, part)


def _add_freedoms(core: Any, part: Any, portable: PortableModel) -> None:
    for node, turns in zip(part.Nodes, portable.turning.tolist(), strict=True):
        for name in DISPLACEMENTS:
            node.AddDof(getattr(core, name), getattr(core, f"REACTION_{name[-1]}"))
        if turns:
            for name in ROTATIONS:
                node.AddDof(getattr(core, name), getattr(core, f"REACTION_MOMENT_{name[-1]}"))


def _write_shells(
    core: Any, structural: Any, part: Any, portable: PortableModel, quad: str
) -> None:
    model = portable.model
    made: dict[int, Any] = {}
    for identifier, section in model.shell_properties.items():
        material = model.materials[section.material]
        made[identifier] = properties = part.CreateNewProperties(len(made) + 1)
        properties[core.YOUNG_MODULUS] = material.young_modulus
        properties[core.POISSON_RATIO] = material.poisson_ratio
        properties[core.THICKNESS] = section.thickness
        mass = material.density * section.thickness + section.nonstructural_mass
        properties[core.DENSITY] = mass / section.thickness
        properties[core.CONSTITUTIVE_LAW] = structural.LinearElasticPlaneStress2DLaw()
    number = 0
    for kind, shells in ((quad, model.quads), (THIN_TRIANGLE, model.triangles)):
        for nodes, identifier in zip(shells.nodes + 1, shells.properties.tolist(), strict=True):
            number += 1
            part.CreateNewElement(kind, number, nodes.tolist(), made[identifier])


def _write_beams(core: Any, structural: Any, part: Any, portable: PortableModel) -> None:
    model = portable.model
    first = part.NumberOfProperties()
    made: dict[int, Any] = {}
    sections = beam_sections(model, model.beams)
    number = part.NumberOfElements()
    for row, identifier in enumerate(model.beams.properties.tolist()):
        if identifier not in made:
            made[identifier] = properties = part.CreateNewProperties(first + len(made) + 1)
            area = float(sections.area[row])
            material = model.materials[model.beam_properties[identifier].material]
            properties[core.YOUNG_MODULUS] = material.young_modulus
            properties[core.POISSON_RATIO] = material.poisson_ratio
            line_mass = material.density * area + float(sections.nonstructural_mass[row])
            properties[core.DENSITY] = line_mass / area
            properties[structural.CROSS_AREA] = area
            properties[structural.TORSIONAL_INERTIA] = float(sections.torsion_constant[row])
            properties[structural.I33] = float(sections.inertia_1[row])
            properties[structural.I22] = float(sections.inertia_2[row])
            for name, factor in (
                ("AREA_EFFECTIVE_Y", sections.shear_factor_1[row]),
                ("AREA_EFFECTIVE_Z", sections.shear_factor_2[row]),
            ):
                if factor > 0.0:
                    properties[getattr(structural, name)] = float(factor) * area
            properties[core.CONSTITUTIVE_LAW] = structural.BeamConstitutiveLaw()
        number += 1
        nodes = (portable.beam_nodes[row] + 1).tolist()
        element = part.CreateNewElement(BEAM, number, nodes, made[identifier])
        element.SetValue(core.LOCAL_AXIS_2, portable.beam_directions[row].tolist())


def _write_masses(core: Any, part: Any, portable: PortableModel) -> None:
    properties = part.CreateNewProperties(part.NumberOfProperties() + 1)
    number = part.NumberOfElements()
    for node, mass in zip(portable.mass_nodes.tolist(), portable.masses.tolist(), strict=True):
        number += 1
        element = part.CreateNewElement(
            "NodalConcentratedElement3D1N", number, [node + 1], properties
        )
        element.SetValue(core.NODAL_MASS, mass)


def _write_links(core: Any, part: Any, portable: PortableModel) -> None:
    for number, link in enumerate(portable.links, start=1):
        names = (*DISPLACEMENTS, *ROTATIONS)
        follower = part.GetNode(link.node + 1)
        used = np.flatnonzero(np.any(link.coefficients != 0.0, axis=0))
        leading = [
            part.GetNode(int(link.leaders[column // 6]) + 1).GetDof(
                getattr(core, names[column % 6])
            )
            for column in used.tolist()
        ]
        following = [
            follower.GetDof(getattr(core, name)) for name in names[: len(link.coefficients)]
        ]
        relation = core.Matrix(link.coefficients[:, used])
        part.CreateNewMasterSlaveConstraint(
            "LinearMasterSlaveConstraint",
            number,
            leading,
            following,
            relation,
            core.Vector(len(following), 0.0),
        )
