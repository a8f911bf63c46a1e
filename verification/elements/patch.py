"""Patch tests: states of constant strain on distorted meshes, in a tilted plane.

The shell patch, its boundary displacements and its stresses are those of R. H. MacNeal and R. L.
Harder, A proposed standard set of problems to test finite element accuracy, Finite Elements in
Analysis and Design 1, 1985, 3-20, table 1 and figure 1.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from solver.arrays import Array
from solver.fe.sections import shell_sections
from solver.fe.shell_quad import quad_stiffness
from solver.fe.stress import build_stress_recovery
from solver.fe.structure import Structure, build_structure
from verification.elements.meshes import beam_chain, material, model, rectangle_section, split
from verification.elements.supported import nothing_fixed, prescribed

CORNERS = [[0, 0], [0.24, 0], [0.24, 0.12], [0, 0.12]]
INNER = [[0.04, 0.02], [0.18, 0.03], [0.16, 0.08], [0.08, 0.08]]
POINTS = np.array(CORNERS + INNER)
QUADS = np.array([[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]])
THICKNESS = 1e-3
TURN: Array = Rotation.from_rotvec([0.4, -1.1, 0.7]).as_matrix()
#: Stations of the chain of unequal beams [m].
STATIONS = np.array([0.0, 0.13, 0.41, 0.55, 1.0])


@dataclass(frozen=True, slots=True)
class PatchResult:
    """A solved patch: its nodes follow ``exact`` on the boundary and are free inside."""

    found: Array  #: (n, 6) displacements
    exact: Array  #: (n, 6)
    stress: Array  #: shells (m, 2 faces, 3); beams (m, 9)

    @property
    def displacement_error(self) -> float:
        """Largest error of the translations relative to the largest translation."""
        scale = np.abs(self.exact[:, :3]).max()
        return float(np.abs(self.found - self.exact)[:, :3].max() / scale)


def in_plane(local: Array) -> Array:
    """Displacements (n, 6) of the patch's own axes, in those of the space it is tilted in."""
    return np.concatenate([local[:, :3] @ TURN.T, local[:, 3:] @ TURN.T], axis=1)


def patch(shape: str, thickness: float = THICKNESS) -> Structure:
    """Build the patch of ``quads``, of ``triangles``, or of ``both`` (triangles in the middle)."""
    coordinates = np.column_stack([POINTS, np.zeros(8)]) @ TURN.T + [3.0, -2.0, 5.0]
    quads = {"quads": QUADS, "triangles": None, "both": QUADS[:4]}[shape]
    triangles = {"quads": None, "triangles": split(QUADS), "both": split(QUADS[4:])}[shape]
    return build_structure(
        model(
            coordinates,
            quads=quads,
            triangles=triangles,
            thickness=thickness,
            substance=material(1e6, 0.25),
        )
    )


def solved_patch(shape: str, local: Array, thickness: float = THICKNESS) -> PatchResult:
    """Solve for the inner nodes, the outer four following ``local`` (8, 6) in the patch's axes."""
    structure = patch(shape, thickness)
    exact = in_plane(local)
    known = nothing_fixed(structure)
    known[:4] = True
    found = prescribed(structure, known, exact)
    stresses = build_stress_recovery(structure).shell_operator @ found.ravel()
    return PatchResult(found, exact, stresses.reshape(-1, 2, 3))


def stretched() -> Array:
    """State u = 1e-3 (x + y / 2), v = 1e-3 (y + x / 2): constant membrane strains and shear."""
    x, y = POINTS.T
    local = np.zeros((8, 6))
    local[:, 0], local[:, 1] = 1e-3 * (x + y / 2), 1e-3 * (y + x / 2)
    return local


def bent() -> Array:
    """State w = 1e-3 (x^2 + x y + y^2) / 2 with its slopes: constant curvatures and twist."""
    x, y = POINTS.T
    local = np.zeros((8, 6))
    local[:, 2] = 1e-3 * (x * x + x * y + y * y) / 2
    local[:, 3], local[:, 4] = 1e-3 * (y + x / 2), -1e-3 * (x + y / 2)
    return local


def sheared() -> Array:
    """State u = 1e-3 y with its drilling rotation: constant in-plane shear and rigid rotation."""
    local = np.zeros((8, 6))
    local[:, 0], local[:, 5] = 1e-3 * POINTS[:, 1], -0.5e-3
    return local


#: Stresses (x, y, xy) of the states above in the patch's axes; of the bent one at its upper face.
STRETCHED_STRESS = np.array([4000 / 3, 4000 / 3, 400.0])
SHEARED_STRESS = np.array([0.0, 0.0, 1e6 / 2.5 * 1e-3])
BENT_STRESS = np.array([2 / 3, 2 / 3, 0.2])


def invariants(stresses: Array) -> Array:
    """Sum and Mohr radius of stresses (..., 3), which no choice of element axes changes."""
    x, y, xy = np.moveaxis(stresses, -1, 0)
    return np.stack([x + y, np.hypot((x - y) / 2, xy)], axis=-1)


def racked_rectangle(thickness: float) -> tuple[float, float]:
    """Energy of a rectangle a x b racked, w = x without rotations, and that of a clamped strip.

    A strip of plate whose ends move apart by w without turning holds 12 D b / (a^3 (1 + phi)) w,
    phi = 12 D / (5/6 G t a^2) (Timoshenko's beam with the stiffness D of a plate, clamped at both
    ends): bending when it is thin, shear when it is thick.
    """
    length, width, young, ratio = 0.24, 0.12, 1e6, 0.25
    corners = np.array([[0.0, 0, 0], [length, 0, 0], [length, width, 0], [0, width, 0]])
    mesh = model(
        corners,
        quads=np.array([[0, 1, 2, 3]]),
        thickness=thickness,
        substance=material(young, ratio),
    )
    stiffness = quad_stiffness(corners[None], shell_sections(mesh, mesh.quads))[0]
    motion = np.zeros((4, 6))
    motion[:, 2] = corners[:, 0]
    energy = 0.5 * motion.ravel() @ stiffness @ motion.ravel()
    bending = 12 * young * thickness**3 / (12 * (1 - ratio**2)) / length**2
    shear = 5 / 6 * young / (2 * (1 + ratio)) * thickness
    return float(energy), 0.5 * length * width * bending / (1 + bending / shear)


def solved_chain(
    strain: float, curvature_1: float, curvature_2: float, twist: float
) -> tuple[PatchResult, Array]:
    """Chain of unequal beams in a tilted direction, its ends held; with the exact stress (4, 9).

    Stress sigma = E (strain - y k1 - z k2), torsional shear = G r twist (r the torsion radius).
    """
    section, substance = rectangle_section(0.03, 0.05), material()
    s = STATIONS
    structure = build_structure(
        beam_chain(s[:, None] * TURN[:, 0], section, orientation=TURN[:, 1], substance=substance)
    )
    local = np.zeros((5, 6))
    local[:, 0] = strain * s
    local[:, 1], local[:, 5] = curvature_1 * s**2 / 2, curvature_1 * s
    local[:, 2], local[:, 4] = curvature_2 * s**2 / 2, -curvature_2 * s
    local[:, 3] = twist * s
    exact = in_plane(local)
    known = nothing_fixed(structure)
    known[[0, -1]] = True
    found = prescribed(structure, known, exact)
    rows = (build_stress_recovery(structure).beam_operator @ found.ravel()).reshape(4, 9)
    y, z = section.stress_points.T
    normal = substance.young_modulus * (strain - y * curvature_1 - z * curvature_2)
    shear = substance.shear_modulus * section.torsion_radius * twist
    expected = np.tile(np.concatenate([normal, normal, [shear]]), (4, 1))
    return PatchResult(found, exact, rows), expected
