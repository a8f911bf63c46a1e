"""Stress recovery: from free freedoms to the stresses of every element, as two sparse maps."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array, vstack

from solver.arrays import Array, IntArray
from solver.fe.beam import beam_geometry, beam_stresses
from solver.fe.sections import ShellSections, beam_sections, shell_sections
from solver.fe.shell_quad import quad_strains
from solver.fe.shell_triangle import side_lumping, triangle_strains
from solver.fe.structure import Structure

SHELL_ROWS = 6
BEAM_ROWS = 9


@dataclass(frozen=True, slots=True)
class StressRecovery:
    """Linear stress operators and the measures made from them.

    Element order: quadrilaterals, triangles, beams, as `FiniteElementModel.element_identifiers`.
    """

    #: (6 n_shells, n_free): bottom face sx, sy, txy, then top face, at the centroid in element
    #: axes [Pa]; bottom is the side that the normal points away from.
    shell_operator: csr_array
    #: (9 n_beams, n_free): normal stress at points C D E F of end A, then of end B, then the
    #: torsional shear [Pa].
    beam_operator: csr_array

    @property
    def n_shells(self) -> int:
        """Number of shells."""
        return int(self.shell_operator.shape[0]) // SHELL_ROWS

    @property
    def n_beams(self) -> int:
        """Number of beams."""
        return int(self.beam_operator.shape[0]) // BEAM_ROWS

    def von_mises(self, shell_rows: Array, beam_rows: Array) -> Array:
        """Von Mises stress of every element (n_elements, nt) [Pa].

        Shells: the larger of both faces, sqrt(sx^2 - sx sy + sy^2 + 3 txy^2).  Beams: the
        largest of the eight points, sqrt(s^2 + 3 t^2) with the torsional shear.

        Parameters
        ----------
        shell_rows : (6 n_shells, nt) array
            ``shell_operator @ u`` [Pa].
        beam_rows : (9 n_beams, nt) array
            ``beam_operator @ u`` [Pa].
        """
        faces = _faces(shell_rows)
        x, y, xy = faces[:, :, 0], faces[:, :, 1], faces[:, :, 2]
        shells = np.sqrt(np.max(x * x - x * y + y * y + 3.0 * xy * xy, axis=1))
        sections = _by_element(beam_rows, BEAM_ROWS)
        normal = np.max(np.abs(sections[:, :8]), axis=1)
        beams = np.sqrt(normal**2 + 3.0 * sections[:, 8] ** 2)
        return np.concatenate([shells, beams])

    def principal(self, shell_rows: Array) -> tuple[Array, Array, Array]:
        """Principal stresses of shells at both faces.

        Parameters
        ----------
        shell_rows : (6 n_shells, nt) array
            ``shell_operator @ u`` [Pa].

        Returns
        -------
        major, minor : (n_shells, 2, nt) arrays
            Bottom face, then top face [Pa].
        angle : (n_shells, 2, nt) array
            From element axis e1 to the major direction, towards e2 [rad].
        """
        faces = _faces(shell_rows)
        x, y, xy = faces[:, :, 0], faces[:, :, 1], faces[:, :, 2]
        centre, radius = 0.5 * (x + y), np.hypot(0.5 * (x - y), xy)
        return centre + radius, centre - radius, 0.5 * np.arctan2(2.0 * xy, x - y)


def build_stress_recovery(structure: Structure) -> StressRecovery:
    """Stress operators of all elements of a structure."""
    model = structure.model
    size = 6 * model.node_count
    sections = shell_sections(model, model.quads)
    quads = shell_face_stresses(
        quad_strains(model.coordinates[model.quads.nodes], sections), sections
    )
    sections = shell_sections(model, model.triangles)
    lumping = side_lumping(model.triangles.nodes, model.quads.nodes, model.node_count)
    triangles = shell_face_stresses(
        triangle_strains(model.coordinates[model.triangles.nodes], sections, lumping), sections
    )
    geometry = beam_geometry(model.coordinates, model.beams)
    beams = beam_stresses(geometry, beam_sections(model, model.beams))
    shells = vstack(
        [
            _scattered(quads, model.quads.nodes, size),
            _scattered(triangles, model.triangles.nodes, size),
        ]
    )
    return StressRecovery(
        shell_operator=csr_array(shells @ structure.transformation),
        beam_operator=csr_array(
            _scattered(beams, model.beams.nodes, size) @ structure.transformation
        ),
    )


def shell_face_stresses(strains: Array, sections: ShellSections) -> Array:
    """Stress at both faces (m, 6, nd) from membrane strains and curvatures (m, 6, nd)."""
    half = (0.5 * sections.thickness)[:, None, None]
    membrane, curvature = strains[:, :3], strains[:, 3:]
    elasticity = sections.plane_stress
    return np.concatenate(
        [elasticity @ (membrane - half * curvature), elasticity @ (membrane + half * curvature)],
        axis=1,
    )


def _scattered(operators: Array, nodes: IntArray, size: int) -> csr_array:
    """Sparse rows (m * r, 6 n) of element operators (m, r, 6 k)."""
    count, height = operators.shape[:2]
    freedoms = (6 * nodes[:, :, None] + np.arange(6)).reshape(count, 1, operators.shape[2])
    rows = np.arange(count * height).reshape(count, height, 1)
    at = (
        np.broadcast_to(rows, operators.shape).ravel(),
        np.broadcast_to(freedoms, operators.shape).ravel(),
    )
    matrix = csr_array(coo_array((operators.ravel(), at), shape=(count * height, size)))
    matrix.eliminate_zeros()
    return matrix


def _by_element(rows: Array, height: int) -> Array:
    return rows.reshape(-1, height, *rows.shape[1:])


def _faces(shell_rows: Array) -> Array:
    """Stresses (n_shells, 2 faces, 3, ...)."""
    return shell_rows.reshape(-1, 2, 3, *shell_rows.shape[1:])
