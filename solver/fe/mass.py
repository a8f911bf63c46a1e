"""Mass of shells and beams as mass points and rotary bodies.

Shells: the nodes are the mass points; their masses are the integrals of products of the shape
functions, the same for all three directions (consistent mass, also on warped quadrilaterals, whose
bilinear surface the shape functions describe).  Beams: see `beam.beam_mass_points`.

The rotary inertia of sections is lumped at the nodes: rho t^3/12 per area of a shell about any
axis in its plane, and the section's second moments of a beam.  About its normal a shell has no
rotary inertia of its own; `DRILLING_SHARE` of the in-plane figure is given to it so that every
free freedom has mass and the mass matrix is positive definite, as long as the material at every
node has density.  Where it has none, the mass matrix is only semidefinite; K + c M, with which
time integration works, stays regular, since only rigid modes escape K and they have mass.
"""

import numpy as np
from scipy.sparse import block_diag, coo_array, csr_array, diags_array, vstack

from solver.arrays import Array, IntArray
from solver.fe.beam import (
    BeamGeometry,
    beam_mass_points,
    beam_rotary_inertia,
)
from solver.fe.inertia import Inertia, attached_points, node_rotations, point_mass_inertia
from solver.fe.model import FiniteElementModel
from solver.fe.sections import BeamSections, ShellSections
from solver.fe.shell_quad import quad_frames, quad_mass_shapes
from solver.fe.shell_triangle import triangle_frames, triangle_mass_shapes

#: Rotary inertia of a shell about its normal, as a share of that about its plane.  The figure
#: is a thousandth of a term that is itself (t/L)^2 of the panel's own inertia.
DRILLING_SHARE = 1e-3


def structural_inertia(
    model: FiniteElementModel,
    transformation: csr_array,
    quads: ShellSections,
    triangles: ShellSections,
    beams: BeamSections,
    geometry: BeamGeometry,
) -> Inertia:
    """Inertia of elements, nonstructural mass and lumped masses of a model.

    Parameters
    ----------
    transformation : (6 n, n_free) sparse array
        From `constraints.constraint_transformation`.
    quads, triangles, beams : sections
        Of the model's elements in their order.
    geometry : BeamGeometry
        Of the model's beams.
    """
    count = model.node_count
    scalar, shell_nodes, shell_rotary = shell_mass(model, quads, triangles)
    positions, masses, shapes = beam_mass_points(geometry, beams)
    halves = 0.5 * np.repeat(beam_rotary_inertia(geometry, beams), 2, axis=0)
    lumped = point_mass_inertia(transformation, model.coordinates, model.point_masses)

    on_shells = np.unique(
        np.concatenate([model.quads.nodes.ravel(), model.triangles.nodes.ravel()])
    )
    at_nodes = attached_points(on_shells, np.zeros((len(on_shells), 3)), count)
    interpolation = vstack([at_nodes, _beam_interpolation(model, shapes)]) @ transformation
    masses_of_points = block_diag(
        [scalar[on_shells][:, on_shells], diags_array(masses.ravel()), lumped.scalar_mass]
    )

    rotary = np.zeros((count, 3, 3))
    np.add.at(rotary, shell_nodes, shell_rotary)
    np.add.at(rotary, model.beams.nodes.ravel(), halves)
    np.add.at(rotary, model.point_masses.nodes, model.point_masses.inertias)
    turning = np.flatnonzero(np.any(rotary != 0.0, axis=(1, 2)))
    return Inertia(
        points=np.concatenate(
            [model.coordinates[on_shells], positions.reshape(-1, 3), lumped.points]
        ),
        interpolation=csr_array(vstack([interpolation, lumped.interpolation])),
        scalar_mass=csr_array(masses_of_points),
        rotary_interpolation=csr_array(node_rotations(turning, count) @ transformation),
        rotary=rotary[turning],
    )


def shell_mass(
    model: FiniteElementModel, quads: ShellSections, triangles: ShellSections
) -> tuple[csr_array, IntArray, Array]:
    """Scalar mass (n, n) of all nodes, and the sections' rotary inertia lumped at nodes."""
    rows, columns, values = [], [], []
    nodes, tensors = [], []
    for shells, sections, shapes_of, frames_of in (
        (model.quads, quads, quad_mass_shapes, quad_frames),
        (model.triangles, triangles, triangle_mass_shapes, triangle_frames),
    ):
        coordinates = model.coordinates[shells.nodes]
        shapes = shapes_of(coordinates)
        per_area = sections.density * sections.thickness + sections.nonstructural_mass
        corners = shells.nodes.shape[1]
        rows.append(np.repeat(shells.nodes, corners, axis=1).ravel())
        columns.append(np.tile(shells.nodes, (1, corners)).ravel())
        values.append((per_area[:, None, None] * shapes).ravel())
        nodes.append(shells.nodes.ravel())
        tensors.append(_section_rotary(sections, shapes, frames_of(coordinates)[:, 2]))
    at = (np.concatenate(rows), np.concatenate(columns))
    mass = coo_array((np.concatenate(values), at), shape=(model.node_count,) * 2)
    return csr_array(mass), np.concatenate(nodes), np.concatenate(tensors)


def _section_rotary(sections: ShellSections, shapes: Array, normals: Array) -> Array:
    """Rotary inertia (m * corners, 3, 3) of shell sections at their corners [kg m2]."""
    tangent = np.eye(3) - (1.0 - DRILLING_SHARE) * normals[:, :, None] * normals[:, None, :]
    per_area = sections.density * sections.thickness**3 / 12.0
    shares = per_area[:, None] * shapes.sum(axis=2)
    tensors: Array = shares[:, :, None, None] * tangent[:, None]
    return tensors.reshape(-1, 3, 3)


def _beam_interpolation(model: FiniteElementModel, shapes: Array) -> csr_array:
    """Displacement (3 p, 6 n) of the beams' mass points, from shapes (m, stations, 3, 12)."""
    count, stations = shapes.shape[:2]
    rows = np.arange(count * stations * 3).reshape(count, stations, 3, 1)
    freedoms = (6 * model.beams.nodes[:, :, None] + np.arange(6)).reshape(count, 1, 1, 12)
    at = (
        np.broadcast_to(rows, shapes.shape).ravel(),
        np.broadcast_to(freedoms, shapes.shape).ravel(),
    )
    matrix = csr_array(coo_array((shapes.ravel(), at), shape=(rows.size, 6 * model.node_count)))
    matrix.eliminate_zeros()
    return matrix
