"""Materials and sections from their bulk-data cards: MAT1, PSHELL, PBAR, PBARL."""

import math

import numpy as np

from solver.aircraft.nastran_cards import Card
from solver.aircraft.nastran_sections import SHAPES, section_property
from solver.errors import ModelError
from solver.fe.model import BeamProperty, Material, ShellProperty


def material(card: Card) -> Material:
    """MAT1: any two of E, G and NU give the third, as in Nastran.

    Thermal data (A, TREF) and the stress limits (ST, SC, SS) are passed over: temperature plays no
    part, and limit allowables stand in the aircraft definition.  Material damping GE is refused,
    as damping is stated there too.
    """
    card.refuse_beyond(12)
    card.refuse(7, "GE", "damping is stated in the aircraft definition")
    card.refuse(11, "MCSID", "materials are isotropic")
    missing = math.nan
    young = card.real(1, "E", missing)
    shear = card.real(2, "G", missing)
    poisson = card.real(3, "NU", missing)
    if math.isnan(young):
        young = 2 * shear * (1 + poisson)
    elif math.isnan(shear):
        shear = young / (2 * (1 + poisson)) if poisson != -1 else missing
    elif math.isnan(poisson):
        poisson = young / (2 * shear) - 1 if shear else missing
    if math.isnan(young + shear + poisson):
        raise card.error("two of E, G and NU are needed")
    if young <= 0 or shear <= 0 or not -1 < poisson <= 0.5:
        raise card.error(
            f"E = {young:g}, G = {shear:g}, NU = {poisson:g}: E and G must be above zero, "
            "NU above -1 and not above 0.5"
        )
    density = card.real(4, "RHO", 0.0)
    if density < 0:
        raise card.error(f"field RHO = {density:g} must not be negative")
    return Material(
        identifier=card.integer(0, "MID"),
        young_modulus=young,
        shear_modulus=shear,
        poisson_ratio=poisson,
        density=density,
    )


def shell_property(card: Card) -> ShellProperty:
    """PSHELL of a homogeneous plate: one material in membrane and bending, solid section.

    MID3 may be blank (Nastran then neglects transverse shear); the shells here are always
    shear-flexible, which for thin walls makes no difference.  Z1 and Z2, where Nastran prints
    stresses, are passed over: here stresses are taken at both faces.
    """
    card.refuse_beyond(11)
    membrane = card.integer(1, "MID1")
    if card.integer(3, "MID2", 0, minimum=0) != membrane:
        raise card.error(f"field MID2 must be {membrane} like MID1: only homogeneous shells")
    if card.integer(5, "MID3", membrane) != membrane:
        raise card.error(f"field MID3 must be {membrane} like MID1 or blank")
    if abs(card.real(4, "12I/T**3", 1.0) - 1.0) > 1e-9:
        raise card.error("field 12I/T**3 must be 1.0: only homogeneous shells")
    if abs(card.real(6, "TS/T", 5 / 6) - 5 / 6) > 1e-3:
        raise card.error("field TS/T must be 0.8333: only homogeneous shells")
    thickness = card.real(2, "T")
    if thickness <= 0:
        raise card.error(f"field T = {thickness:g} must be above zero")
    mass = card.real(7, "NSM", 0.0)
    if mass < 0:
        raise card.error(f"field NSM = {mass:g} must not be negative")
    card.real(8, "Z1", 0.0)
    card.real(9, "Z2", 0.0)
    card.refuse(10, "MID4", "membrane and bending do not couple")
    return ShellProperty(
        identifier=card.integer(0, "PID"),
        material=membrane,
        thickness=thickness,
        nonstructural_mass=mass,
    )


def bar_property(card: Card) -> BeamProperty:
    """PBAR; the product of inertia I12 must be zero.

    As in Nastran a PBAR gives no torsional shear stress (it does not say how the section is made)
    and no shear flexibility where K1 or K2 is blank or zero.
    """
    card.refuse_beyond(19)
    card.refuse(7, "9", "must be blank")
    card.refuse(18, "I12", "give the principal axes")
    names = ("C1", "C2", "D1", "D2", "E1", "E2", "F1", "F2")
    points = [card.real(8 + k, name, 0.0) for k, name in enumerate(names)]
    values = {
        name: card.real(index, name, 0.0)
        for index, name in ((2, "A"), (3, "I1"), (4, "I2"), (5, "J"), (6, "NSM"), (16, "K1"),
                            (17, "K2"))
    }  # fmt: skip
    for name, value in values.items():
        if value < 0:
            raise card.error(f"field {name} = {value:g} must not be negative")
    return BeamProperty(
        identifier=card.integer(0, "PID"),
        material=card.integer(1, "MID"),
        area=values["A"],
        inertia_1=values["I1"],
        inertia_2=values["I2"],
        torsion_constant=values["J"],
        stress_points=np.array(points).reshape(4, 2),
        shear_factor_1=values["K1"],
        shear_factor_2=values["K2"],
        nonstructural_mass=values["NSM"],
    )


def named_bar_property(card: Card) -> BeamProperty:
    """PBARL of the shapes in `solver.aircraft.nastran_sections`."""
    if card.text(2) not in ("", "MSCBML0"):
        raise card.error(f"field GROUP = {card.text(2)!r}: only MSCBML0 is known")
    for index in range(4, 8):
        card.refuse(index, str(index + 2), "must be blank")
    dimensions = [card.real(index, f"DIM{index - 7}") for index in range(8, len(card.fields))
                  if any(card.fields[index:])]  # fmt: skip
    shape = card.text(3)
    expected = len(SHAPES[shape][0]) if shape in SHAPES else len(dimensions)
    mass = dimensions.pop() if len(dimensions) == expected + 1 else 0.0
    if mass < 0:
        raise card.error(f"field NSM = {mass:g} must not be negative")
    try:
        return section_property(
            card.integer(0, "PID"), card.integer(1, "MID"), shape, dimensions, mass
        )
    except ModelError as error:
        raise card.error(str(error)) from error
