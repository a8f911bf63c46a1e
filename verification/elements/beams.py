"""Beam elements against closed forms: deflections, curved and twisted chains, frequencies."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eigh

from solver.arrays import Array
from solver.fe.structure import Structure, build_structure
from verification.elements.figures import Figure
from verification.elements.meshes import (
    beam_chain,
    material,
    rectangle_section,
    straight_beam,
)
from verification.elements.supported import frequencies, nothing_fixed, static

LENGTH, FORCE = 1.7, 230.0
#: beta L of the bending modes of a free beam: cos(b) cosh(b) = 1.
FREE_BEAM = np.array([4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913])
SECTION = rectangle_section(0.03, 0.05)


def tip_motion(structure: Structure, load: Array) -> Array:
    """Displacement (6,) of the last node under a load (6,) there, the first node clamped."""
    fixed = nothing_fixed(structure)
    fixed[0] = True
    loads = np.zeros(fixed.shape)
    loads[-1] = load
    tip: Array = static(structure, fixed, loads)[-1]
    return tip


def cantilever(count: int = 1) -> list[Figure]:
    """Tip deflections with shear, P L^3 / (3 E I) + P L / (K G A), twist and extension."""
    structure = build_structure(straight_beam(LENGTH, count, SECTION))
    substance = material()
    young, shear = substance.young_modulus, substance.shear_modulus
    sheared = FORCE * LENGTH / (5 / 6 * shear * SECTION.area)
    bent = FORCE * LENGTH**3 / (3 * young)
    cases = (
        ("extension", 0, FORCE * LENGTH / (young * SECTION.area)),
        ("deflection about the weak axis", 1, bent / SECTION.inertia_1 + sheared),
        ("deflection about the strong axis", 2, bent / SECTION.inertia_2 + sheared),
        ("twist", 3, FORCE * LENGTH / (shear * SECTION.torsion_constant)),
    )
    figures: list[Figure] = []
    for name, component, target in cases:
        tip = tip_motion(structure, FORCE * np.eye(6)[component])
        figures.append(Figure(f"cantilever, {name}", float(tip[component]), target))
    return figures


def offset_cantilever() -> list[Figure]:
    """Axial force P at the node, axis at offset e: it bends with the moment P e."""
    offset = 0.08
    structure = build_structure(straight_beam(LENGTH, 3, SECTION, offset=(0, 0, offset)))
    young = material().young_modulus
    tip = tip_motion(structure, FORCE * np.eye(6)[0])
    bending = FORCE * LENGTH / (young * SECTION.inertia_2)
    stretch = FORCE * LENGTH / (young * SECTION.area)
    cases = (
        ("extension", 0, stretch + bending * offset**2),
        ("deflection", 2, bending * offset * LENGTH / 2),
        ("rotation", 4, -bending * offset),
    )
    return [
        Figure(f"beam with offset ends, {name}", float(tip[component]), target)
        for name, component, target in cases
    ]


def curved_cantilever(count: int = 24) -> list[Figure]:
    """Quarter circle of straight beams: MacNeal and Harder's curved beam by Castigliano's theorem.

    In plane pi P R^3 / (4 E I) + pi P R / 4 (1 / (E A) + 1 / (K G A)); out of plane
    P R^3 (pi / (4 E I) + (3 pi / 4 - 2) / (G J)) + pi P R / (2 K G A).
    """
    radius, substance = 4.22, material(1e7, 0.25)
    section = rectangle_section(0.2, 0.1)  # along the radius, and along z
    angle = np.linspace(0, np.pi / 2, count + 1)
    points = radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    middle = (angle[1:] + angle[:-1]) / 2
    outward = np.stack([np.cos(middle), np.sin(middle), 0 * middle], axis=1)
    structure = build_structure(
        beam_chain(points, section, orientation=outward, substance=substance)
    )
    young, shear = substance.young_modulus, substance.shear_modulus
    sheared = 5 / 6 * shear * section.area
    in_plane = np.pi * radius**3 / (4 * young * section.inertia_1)
    in_plane += np.pi * radius / 4 * (1 / (young * section.area) + 1 / sheared)
    out_of_plane = np.pi / (4 * young * section.inertia_2)
    out_of_plane += (3 * np.pi / 4 - 2) / (shear * section.torsion_constant)
    out_of_plane = out_of_plane * radius**3 + np.pi * radius / (2 * sheared)
    found = [tip_motion(structure, np.eye(6)[k])[k] for k in (1, 2)]
    return [
        Figure(f"quarter circle of {count} beams, in-plane", float(found[0]), in_plane),
        Figure(f"quarter circle of {count} beams, out-of-plane", float(found[1]), out_of_plane),
    ]


def twisted_cantilever(count: int = 24) -> list[Figure]:
    """Beam 12 x 1.1 x 0.32 twisted by 90 degrees, its section turned from beam to beam.

    The exact deflection is the integral of (L - x)^2 [cos^2 / (E I_a) + sin^2 / (E I_b)] plus
    shear, with the angle pi x / (2 L) (Euler-Bernoulli, section's axes turning).
    """
    length, substance = 12.0, material(29e6, 0.22)
    section = rectangle_section(1.1, 0.32)
    points = np.zeros((count + 1, 3))
    points[:, 0] = np.linspace(0, length, count + 1)
    angle = np.pi / 2 * (np.arange(count) + 0.5) / count
    wide = np.stack([0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    structure = build_structure(beam_chain(points, section, orientation=wide, substance=substance))
    at, weight = np.polynomial.legendre.leggauss(40)
    x, turn = length * (at + 1) / 2, np.pi * (at + 1) / 4
    arm = length / 2 * weight * (length - x) ** 2 / substance.young_modulus
    sheared = length / (5 / 6 * substance.shear_modulus * section.area)
    weak, strong = section.inertia_2, section.inertia_1  # bending across and along 1.1
    figures: list[Figure] = []
    # at the tip the section stands along z: a force along z is in plane
    for name, component, along in (("in-plane", 2, np.sin), ("out-of-plane", 1, np.cos)):
        share = along(turn) ** 2  # of the curvature that bends the width
        target = float(arm @ (share / strong + (1 - share) / weak)) + sheared
        found = tip_motion(structure, np.eye(6)[component])[component]
        figures.append(Figure(f"twisted chain of {count} beams, {name}", float(found), target))
    return figures


def free_beam_eigenvalues(count: int = 24, offset: ArrayLike | None = None) -> tuple[Array, Array]:
    """Lowest fourteen w^2 of a free beam of depth L / 1000, and the exact ones of the last eight.

    Six rigid motions, then pairs of equal bending modes, Euler-Bernoulli: E I / (rho A) beta^4.
    """
    length = 20.0
    section = rectangle_section(0.02, 0.02)
    structure = build_structure(straight_beam(length, count, section, offset=offset))
    stiffness = structure.stiffness.toarray()
    mass = structure.inertia.mass_matrix().toarray()
    values = eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 13])
    line = material().young_modulus * section.inertia_1 / (material().density * section.area)
    return values, np.repeat((FREE_BEAM / length) ** 4 * line, 2)


def free_beam_frequencies(count: int = 24) -> list[Figure]:
    """Bending frequencies [rad/s] of a free uniform beam."""
    values, exact = free_beam_eigenvalues(count)
    return [
        Figure(f"free beam, beta L = {root:.4f}", float(found), float(target))
        for root, found, target in zip(
            FREE_BEAM, np.sqrt(values[6::2]), np.sqrt(exact[::2]), strict=True
        )
    ]


def thick_beam_frequencies(count: int = 60) -> list[Figure]:
    """Lowest frequencies [rad/s] of a simply supported beam of depth L / 10.

    T. C. Huang, J. Appl. Mech. 28, 1961: with k = n pi / L, the lower root w^2 of
    rho^2 I / (K G) w^4 - (rho A + rho I k^2 (1 + E / (K G))) w^2 + E I k^4 = 0.
    """
    length, section, substance = 1.0, rectangle_section(0.1, 0.1), material()
    structure = build_structure(straight_beam(length, count, section))
    fixed = nothing_fixed(structure)
    fixed[:, [0, 2, 3, 4]] = True
    fixed[[0, -1], 1] = True
    found = 2 * np.pi * frequencies(structure, fixed, 3)
    density, young = substance.density, substance.young_modulus
    shear, inertia = 5 / 6 * substance.shear_modulus, section.inertia_1
    k = np.pi * np.arange(1, 4) / length
    a = density**2 * inertia / shear
    b = density * section.area + density * inertia * k**2 * (1 + young / shear)
    c = young * inertia * k**4
    exact = np.sqrt((b - np.sqrt(b**2 - 4 * a * c)) / (2 * a))
    return [
        Figure(f"thick supported beam, mode {n + 1}", float(found[n]), float(exact[n]))
        for n in range(3)
    ]
