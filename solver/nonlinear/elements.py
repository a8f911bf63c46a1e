"""All elements of a model in corotating frames, with the stiffness of the linear analysis.

Element-independent corotational formulation (C. C. Rankin, F. A. Brogan, An element independent
corotational procedure for the treatment of large rotations, J. Pressure Vessel Tech. 108, 1986,
165-174): the element matrices of `solver.fe`, made once, act on the deformation that is left when
the turn of the element's own frame is taken out.  At small displacements the internal forces are
those of the linear model to rounding; only geometry makes the difference.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.fe.beam import BeamGeometry, beam_geometry, beam_stiffness, beam_stresses
from solver.fe.model import FiniteElementModel, Shells
from solver.fe.sections import ShellSections, beam_sections, shell_sections
from solver.fe.shell_quad import quad_frames, quad_stiffness, quad_strains
from solver.fe.shell_triangle import (
    side_lumping,
    triangle_frames,
    triangle_stiffness,
    triangle_strains,
)
from solver.fe.stress import shell_face_stresses
from solver.nonlinear.beam_kernels import DEFORMATIONS, beam_deformations, beam_loads
from solver.nonlinear.configuration import Configuration
from solver.nonlinear.shell_kernels import shell_deformations, shell_loads

#: Freedoms of a beam's linear matrices that its seven deformations are, in its own axes.
_BEAM_FREEDOMS = np.array([6, 3, 4, 5, 9, 10, 11])


@dataclass(frozen=True, slots=True)
class ElementGroup(ABC):
    """Elements of one shape, m of them with k nodes and d deformations."""

    nodes: IntArray  #: (m, k)
    frames: Array  #: (m, 3, 3) initial, rows e1, e2, e3
    stiffness: Array  #: (m, d, d)
    stress: Array  #: (m, r, d) rows of `solver.fe.stress` from the deformations [Pa]

    @abstractmethod
    def deformations(self, at: Configuration) -> Array:
        """Deformations (m, d) in a configuration [m, rad]."""

    @abstractmethod
    def add_loads(self, at: Configuration, deformations: Array, forces: Array, out: Array) -> None:
        """Add nodal loads of corotated forces; see `CorotationalElements.add_loads`."""


@dataclass(frozen=True, slots=True)
class ShellGroup(ElementGroup):
    """Quadrilaterals or triangles; deformations in initial axes, node by node."""

    corners: Array  #: (m, k, 3) initial, about their mean [m]
    flat: Array  #: (m, k, 2) the same along e1 and e2 [m]

    def deformations(self, at: Configuration) -> Array:
        """Deformations (m, 6 k) [m, rad]."""
        out = np.empty((len(self.nodes), 6 * self.nodes.shape[1]))
        shell_deformations(
            self.nodes, self.corners, self.frames, self.flat, at.positions, at.rotations, out
        )
        return out

    def add_loads(self, at: Configuration, deformations: Array, forces: Array, out: Array) -> None:
        """Add nodal loads of corotated forces; see `CorotationalElements.add_loads`."""
        shell_loads(self.nodes, self.frames, self.flat, at.positions, deformations, forces, out)


@dataclass(frozen=True, slots=True)
class BeamGroup(ElementGroup):
    """Beams; deformations are extension and end rotations in the beam's axes."""

    offsets: Array  #: (m, 2, 3) from nodes to ends [m]
    lengths: Array  #: (m,) [m]

    def deformations(self, at: Configuration) -> Array:
        """Deformations (m, 7) [m, rad]."""
        out = np.empty((len(self.nodes), DEFORMATIONS))
        beam_deformations(
            self.nodes,
            self.offsets,
            self.frames,
            self.lengths,
            at.positions,
            at.rotations,
            out,
        )
        return out

    def add_loads(self, at: Configuration, deformations: Array, forces: Array, out: Array) -> None:
        """Add nodal loads of corotated forces; see `CorotationalElements.add_loads`."""
        beam_loads(
            self.nodes,
            self.offsets,
            self.frames,
            at.positions,
            at.rotations,
            deformations,
            forces,
            out,
        )


@dataclass(frozen=True, slots=True)
class CorotationalElements:
    """Quadrilaterals, triangles and beams of a model."""

    quads: ShellGroup
    triangles: ShellGroup
    beams: BeamGroup

    @property
    def groups(self) -> tuple[ElementGroup, ElementGroup, ElementGroup]:
        """All groups in the solver's element order."""
        return self.quads, self.triangles, self.beams

    def deformations(self, at: Configuration) -> "Deformations":
        """Deformations of all elements; zero after any rigid motion."""
        return Deformations(tuple(group.deformations(at) for group in self.groups))

    def forces(self, deformations: "Deformations") -> "Deformations":
        """Corotated forces K d, conjugate to the deformations."""
        return Deformations(
            tuple(
                element_products(group.stiffness, part)
                for group, part in zip(self.groups, deformations.parts, strict=True)
            )
        )

    def add_loads(
        self, at: Configuration, deformations: "Deformations", forces: "Deformations", out: Array
    ) -> None:
        """Add the nodal loads that hold the elements still in a configuration.

        Parameters
        ----------
        at : Configuration
            Gives frames and lever arms.
        deformations, forces : Deformations
            Rotation vectors that the forces work on, and the forces.
        out : (n, 6) array
            Forces and moments on all nodes, inertial axes [N, N m].
        """
        for group, moved, force in zip(self.groups, deformations.parts, forces.parts, strict=True):
            group.add_loads(at, moved, force, out)

    def static_loads(self, at: Configuration) -> Array:
        """Nodal loads (n, 6) that hold the elements still: the gradient of the strain energy."""
        loads = np.zeros((len(at.positions), 6))
        deformations = self.deformations(at)
        self.add_loads(at, deformations, self.forces(deformations), loads)
        return loads

    def strain_energy(self, deformations: "Deformations") -> float:
        """Strain energy [J], half of d' K d."""
        return 0.5 * self.forces(deformations).work(deformations)

    def stresses(self, deformations: "Deformations") -> tuple[Array, Array]:
        """Stress rows (6 n_shells,) and (9 n_beams,) as `solver.fe.stress` has them [Pa]."""
        quads, triangles, beams = (
            element_products(group.stress, part).ravel()
            for group, part in zip(self.groups, deformations.parts, strict=True)
        )
        return np.concatenate([quads, triangles]), beams


@dataclass(frozen=True, slots=True)
class Deformations:
    """Deformations of all elements, or forces conjugate to them: one array (m, d) for a group."""

    parts: tuple[Array, ...]

    def combined(self, factor: float, other: "Deformations", other_factor: float) -> "Deformations":
        """Sum of ``factor`` times these and ``other_factor`` times others."""
        return Deformations(
            tuple(
                factor * a + other_factor * b for a, b in zip(self.parts, other.parts, strict=True)
            )
        )

    def work(self, other: "Deformations") -> float:
        """Sum of the products with others: forces with deformations give work [J]."""
        return float(sum(np.vdot(a, b) for a, b in zip(self.parts, other.parts, strict=True)))


def corotational_elements(model: FiniteElementModel) -> CorotationalElements:
    """Prepare the elements of a model that `solver.fe.structure.build_structure` accepts."""
    quad_corners = model.coordinates[model.quads.nodes]
    triangle_corners = model.coordinates[model.triangles.nodes]
    quads = shell_sections(model, model.quads)
    triangles = shell_sections(model, model.triangles)
    lumping = side_lumping(model.triangles.nodes, model.quads.nodes, model.node_count)
    return CorotationalElements(
        quads=_shell_group(
            model.quads,
            quad_corners,
            quad_frames(quad_corners),
            quad_stiffness(quad_corners, quads),
            quad_strains(quad_corners, quads),
            quads,
        ),
        triangles=_shell_group(
            model.triangles,
            triangle_corners,
            triangle_frames(triangle_corners),
            triangle_stiffness(triangle_corners, triangles, lumping),
            triangle_strains(triangle_corners, triangles, lumping),
            triangles,
        ),
        beams=_beam_group(model),
    )


def _shell_group(
    shells: Shells,
    coordinates: Array,
    frames: Array,
    stiffness: Array,
    strains: Array,
    sections: ShellSections,
) -> ShellGroup:
    corners = coordinates - coordinates.mean(axis=1, keepdims=True)
    flat = (corners @ np.swapaxes(frames, 1, 2))[..., :2]
    return ShellGroup(
        nodes=np.ascontiguousarray(shells.nodes, dtype=np.int64),
        frames=frames,
        stiffness=np.ascontiguousarray(stiffness),
        stress=np.ascontiguousarray(shell_face_stresses(strains, sections)),
        corners=np.ascontiguousarray(corners),
        flat=np.ascontiguousarray(flat),
    )


def _beam_group(model: FiniteElementModel) -> BeamGroup:
    """Turn the linear matrices, which act on node freedoms, back to the beams' own axes."""
    geometry = beam_geometry(model.coordinates, model.beams)
    sections = beam_sections(model, model.beams)
    release = _freedoms_of_deformations(geometry)
    stiffness: Array = np.swapaxes(release, 1, 2) @ beam_stiffness(geometry, sections) @ release
    return BeamGroup(
        nodes=np.ascontiguousarray(model.beams.nodes, dtype=np.int64),
        frames=geometry.frames,
        stiffness=np.ascontiguousarray(0.5 * (stiffness + np.swapaxes(stiffness, 1, 2))),
        stress=np.ascontiguousarray(beam_stresses(geometry, sections) @ release),
        offsets=np.ascontiguousarray(model.beams.offsets, dtype=np.float64),
        lengths=geometry.lengths,
    )


def _freedoms_of_deformations(geometry: BeamGeometry) -> Array:
    """Find node freedoms (m, 12, 7) in structural axes that give each deformation by itself."""
    selected = np.zeros((12, DEFORMATIONS))
    selected[_BEAM_FREEDOMS, np.arange(DEFORMATIONS)] = 1.0
    freedoms = np.linalg.solve(
        geometry.link, np.broadcast_to(selected, (len(geometry.lengths), 12, DEFORMATIONS))
    )
    return np.asarray(freedoms, dtype=np.float64)


@numba.njit(cache=True, error_model="numpy")
def _multiply(matrices: Array, vectors: Array, out: Array) -> None:
    """Matrices (m, r, d) times vectors (m, d), element by element."""
    for m in range(matrices.shape[0]):
        for i in range(matrices.shape[1]):
            total = 0.0
            for j in range(matrices.shape[2]):
                total += matrices[m, i, j] * vectors[m, j]
            out[m, i] = total


def element_products(matrices: Array, vectors: Array) -> Array:
    """Matrices (m, r, d) times vectors (m, d), element by element; (m, r)."""
    out = np.empty(matrices.shape[:2])
    _multiply(matrices, vectors, out)
    return out
