"""Two-node Timoshenko beam with offset ends.

Theory
------
The stiffness is exact for a prismatic beam loaded at its ends, shear flexibility included
(J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968, section 5.6): with
Phi = 12 E I / (G K A L^2) in each principal plane, Phi = 0 where the shear factor K is 0.

The mass uses the displacement shapes of the same static solution (the Hermite cubics with their
shear terms), sampled at four Gauss points along the axis, which integrates their squares
exactly.  Each sample is a mass point that is free to move in three directions, so that every
inertia term of a turning frame follows from the positions of the points alone.

Ends lie at node + offset and follow their nodes as rigid bodies, u_end = u + theta x offset.
Local axes: e1 from end A to end B, e3 = e1 x orientation, e2 = e3 x e1; plane 1 is e1-e2.  The
section's axes must be principal; the product of inertia is taken as zero.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.fe.model import Beams
from solver.fe.sections import BeamSections
from solver.frames import skew

MASS_POINTS, MASS_WEIGHTS = np.polynomial.legendre.leggauss(4)
#: Sampling stations along the beam from 0 to 1 and their share of its length.
STATIONS = 0.5 * (1.0 + MASS_POINTS)
STATION_SHARES = 0.5 * MASS_WEIGHTS
#: Freedoms of bending in each plane: deflection and rotation of end A, then of end B.
PLANE_1 = np.array([1, 5, 7, 11])
PLANE_2 = np.array([2, 4, 8, 10])


@dataclass(frozen=True, slots=True)
class BeamGeometry:
    """Where beams lie."""

    ends: Array  #: (m, 2, 3) end points, offsets included [m]
    frames: Array  #: (m, 3, 3) rows e1, e2, e3
    lengths: Array  #: (m,) [m]
    link: Array  #: (m, 12, 12) local end freedoms from structural node freedoms


def beam_geometry(coordinates: Array, beams: Beams) -> BeamGeometry:
    """Find ends, axes, lengths and rigid links of beams on nodes at ``coordinates`` (n, 3) [m].

    Raises
    ------
    ModelError
        A beam has no length, or its orientation vector runs along it; names the element.
    """
    ends = coordinates[beams.nodes] + beams.offsets
    span = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(span, axis=1)
    reach = np.max(np.abs(ends), axis=(1, 2), initial=0.0)
    short = ~(lengths > 1e-9 * reach)
    if np.any(short):
        worst = int(np.argmax(short))
        raise ModelError(f"beam {beams.identifiers[worst]} has length {lengths[worst]:.3g} m")
    e1 = span / lengths[:, None]
    normal = np.cross(e1, beams.orientations)
    size = np.linalg.norm(normal, axis=1)
    collinear = ~(size > 1e-6 * np.linalg.norm(beams.orientations, axis=1))
    if np.any(collinear):
        worst = int(np.argmax(collinear))
        raise ModelError(
            f"beam {beams.identifiers[worst]} has its orientation vector "
            f"{beams.orientations[worst].tolist()} along its axis {e1[worst].tolist()}"
        )
    e3 = normal / size[:, None]
    frames = np.stack([e1, np.cross(e3, e1), e3], axis=1)
    link = np.zeros((len(lengths), 12, 12))
    for end in range(2):
        at = 6 * end
        link[:, at : at + 3, at : at + 3] = frames
        link[:, at + 3 : at + 6, at + 3 : at + 6] = frames
        link[:, at : at + 3, at + 3 : at + 6] = -frames @ skew(beams.offsets[:, end])
    return BeamGeometry(ends=ends, frames=frames, lengths=lengths, link=link)


def beam_stiffness(geometry: BeamGeometry, sections: BeamSections) -> Array:
    """Stiffness (m, 12, 12) in structural axes at the nodes [N/m, N, N m]."""
    stiffness = np.swapaxes(geometry.link, 1, 2) @ _local_stiffness(geometry, sections)
    stiffness = stiffness @ geometry.link
    symmetric: Array = 0.5 * (stiffness + np.swapaxes(stiffness, 1, 2))
    return symmetric


def beam_stresses(geometry: BeamGeometry, sections: BeamSections) -> Array:
    """Stress operator (m, 9, 12): normal stress at C D E F of end A, then B, torsional shear [Pa].

    Normal stress is N/A - M_z y / I1 + M_y z / I2 with the section forces of each end, tension
    positive; shear is torque times torsion radius over torsion constant.
    """
    forces = _local_stiffness(geometry, sections) @ geometry.link
    stresses = np.zeros((len(geometry.lengths), 9, 12))
    # End forces act on the beam: at end A they are the opposite of the section forces.
    for end, sign in ((0, -1.0), (1, 1.0)):
        at = 6 * end
        axial = sign * forces[:, at] / sections.area[:, None]
        about_y = sign * forces[:, at + 4] / sections.inertia_2[:, None]
        about_z = sign * forces[:, at + 5] / sections.inertia_1[:, None]
        for point in range(4):
            y = sections.stress_points[:, point, 0, None]
            z = sections.stress_points[:, point, 1, None]
            stresses[:, 4 * end + point] = axial - y * about_z + z * about_y
    factor = sections.torsion_radius / sections.torsion_constant
    stresses[:, 8] = factor[:, None] * forces[:, 9]
    return stresses


def beam_mass_points(geometry: BeamGeometry, sections: BeamSections) -> tuple[Array, Array, Array]:
    """Mass points of beams: positions, masses and displacement shapes.

    Returns
    -------
    positions : (m, 4, 3) array
        On the axis between the ends [m].
    masses : (m, 4) array
        Including nonstructural mass [kg].
    shapes : (m, 4, 3, 12) array
        Displacement of the points in structural axes from the node freedoms.
    """
    start, span = geometry.ends[:, 0], geometry.ends[:, 1] - geometry.ends[:, 0]
    positions = start[:, None] + STATIONS[:, None] * span[:, None]
    per_length = sections.density * sections.area + sections.nonstructural_mass
    masses = (per_length * geometry.lengths)[:, None] * STATION_SHARES
    phi_1, phi_2 = _shear_ratios(geometry, sections)
    shapes = np.zeros((len(masses), len(STATIONS), 3, 12))
    for row, station in enumerate(STATIONS):
        local = np.zeros((len(masses), 3, 12))
        local[:, 0, 0], local[:, 0, 6] = 1.0 - station, station
        in_plane_1 = _deflection(station, geometry.lengths, phi_1)
        in_plane_2 = _deflection(station, geometry.lengths, phi_2)
        local[:, 1, PLANE_1] = in_plane_1
        # A positive rotation about e2 tilts the axis towards -e3.
        local[:, 2, PLANE_2] = in_plane_2 * np.array([1.0, -1.0, 1.0, -1.0])
        shapes[:, row] = np.swapaxes(geometry.frames, 1, 2) @ local @ geometry.link
    return positions, masses, shapes


def beam_rotary_inertia(geometry: BeamGeometry, sections: BeamSections) -> Array:
    """Section inertia (m, 3, 3) of whole beams about their axis, structural axes [kg m2].

    rho L (I1 + I2) about the axis (the section's true polar moment, not its torsion constant),
    rho L I2 about e2 and rho L I1 about e3.
    """
    line = sections.density * geometry.lengths
    principal = np.stack(
        [
            line * (sections.inertia_1 + sections.inertia_2),
            line * sections.inertia_2,
            line * sections.inertia_1,
        ],
        axis=1,
    )
    frames = geometry.frames
    tensor: Array = np.swapaxes(frames, 1, 2) @ (principal[:, :, None] * frames)
    return tensor


def _shear_ratios(geometry: BeamGeometry, sections: BeamSections) -> tuple[Array, Array]:
    """Phi of planes 1 and 2 (m,)."""
    ratios = []
    for inertia, factor in (
        (sections.inertia_1, sections.shear_factor_1),
        (sections.inertia_2, sections.shear_factor_2),
    ):
        shear = sections.shear_modulus * factor * sections.area * geometry.lengths**2
        bending = 12.0 * sections.young_modulus * inertia
        ratios.append(np.divide(bending, shear, out=np.zeros_like(bending), where=factor > 0.0))
    return ratios[0], ratios[1]


def _local_stiffness(geometry: BeamGeometry, sections: BeamSections) -> Array:
    length = geometry.lengths
    stiffness = np.zeros((len(length), 12, 12))
    axial = sections.young_modulus * sections.area / length
    torsion = sections.shear_modulus * sections.torsion_constant / length
    for value, a, b in ((axial, 0, 6), (torsion, 3, 9)):
        stiffness[:, a, a] = stiffness[:, b, b] = value
        stiffness[:, a, b] = stiffness[:, b, a] = -value
    phi_1, phi_2 = _shear_ratios(geometry, sections)
    for inertia, phi, rows, sign in (
        (sections.inertia_1, phi_1, PLANE_1, 1.0),
        (sections.inertia_2, phi_2, PLANE_2, -1.0),
    ):
        rigidity = sections.young_modulus * inertia / ((1.0 + phi) * length**3)
        one, lever = np.ones_like(length), sign * length
        near, far = (4.0 + phi) * length**2, (2.0 - phi) * length**2
        block = np.array(
            [
                [12.0 * one, 6.0 * lever, -12.0 * one, 6.0 * lever],
                [6.0 * lever, near, -6.0 * lever, far],
                [-12.0 * one, -6.0 * lever, 12.0 * one, -6.0 * lever],
                [6.0 * lever, far, -6.0 * lever, near],
            ]
        )
        stiffness[:, rows[:, None], rows] = np.moveaxis(rigidity * block, 2, 0)
    return stiffness


def _deflection(station: float, length: Array, phi: Array) -> Array:
    """Give the static shapes (m, 4) of v_A, theta_A, v_B, theta_B at a station 0 to 1."""
    s, s2, s3 = station, station**2, station**3
    shapes = np.stack(
        [
            1.0 - 3.0 * s2 + 2.0 * s3 + phi * (1.0 - s),
            length * (s - 2.0 * s2 + s3 + 0.5 * phi * (s - s2)),
            3.0 * s2 - 2.0 * s3 + phi * s,
            length * (s3 - s2 - 0.5 * phi * (s - s2)),
        ],
        axis=1,
    )
    scaled: Array = shapes / (1.0 + phi)[:, None]
    return scaled
