"""Four-node shell: membrane with incompatible modes and drilling, DKMQ plate, warpage link.

Theory
------
The element is flat.  Its plane passes through the mean of the four nodes, normal to the cross
product of the diagonals; each node then lies a distance z_i above or below it, alternating in
sign.  The plane's corner is joined to the node by a rigid link, u_corner = u + theta x d with
d = -z_i e3.  The link carries every rigid motion exactly, so that a warped quadrilateral stores
no energy in one.

*Membrane.*  Bilinear displacements plus Wilson's incompatible modes (1 - xi^2), (1 - eta^2) in
each direction, with derivatives formed from the Jacobian at the centre (R. L. Taylor, P. J.
Beresford, E. L. Wilson, A non-conforming element for stress analysis, Int. J. Num. Meth. Eng. 10,
1976, 1211-1219), which makes it pass the patch test on any convex quadrilateral.

*Drilling.*  The rotation theta about the normal is an independent bilinear field, held to the
in-plane rotation of the displacement field by 1/2 integral gamma (theta - (v,x - u,y)/2)^2 t dA
(T. J. R. Hughes, F. Brezzi, On drilling degrees of freedom, Comp. Meth. Appl. Mech. Eng. 72,
1989, 105-121), gamma = G as they advise.  Two deviations.  The in-plane
rotation includes the incompatible modes, so that theta follows the true rotation in bending.
And the full gamma acts on the element's mean alone (one point); the remaining patterns of theta
get `PATTERN_SHARE` of it, with 2 x 2 points, so that none is free.  Measured on Raasch's hook,
the hemisphere and the twisted beam: gamma = G at all four points locks the coarse hemisphere
(0.14 of its deflection with 4 x 4 elements, 0.98 with one point), because corner rotations of
neighbouring facets do not share a plane; a small gamma at all points frees the hemisphere but
lets the hook and the twisted beam go limp (2.7 and 75 times too soft at 1e-6 G), because twist
must pass as in-plane rotation round a fold.  The mean alone carries the twist.

*Plate.*  The discrete Kirchhoff-Mindlin quadrilateral of `plate_quad`, shear correction 5/6.

Local axes: e3 normal to the diagonals, e1 along the bisector that runs from side 4-1 to side 2-3.
"""

import numpy as np

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.bilinear import GAUSS_POINTS, jacobian, quadratic, shape_functions
from solver.fe.plate_quad import central_curvature, plate_stiffness
from solver.fe.sections import ShellSections
from solver.frames import skew

#: Stiffness of the drilling patterns with zero mean, as a share of the coupling of the mean.
PATTERN_SHARE = 1e-3


def quad_frames(coordinates: Array) -> Array:
    """Local axes (m, 3, 3), rows e1, e2, e3, of quadrilaterals with corners (m, 4, 3) [m]."""
    x1, x2, x3, x4 = (coordinates[:, k] for k in range(4))
    normal = np.cross(x3 - x1, x4 - x2)
    e3 = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    along = (x2 + x3) - (x1 + x4)
    along = along - np.sum(along * e3, axis=1, keepdims=True) * e3
    e1 = along / np.linalg.norm(along, axis=1, keepdims=True)
    return np.stack([e1, np.cross(e3, e1), e3], axis=1)


def check_quads(coordinates: Array, identifiers: IntArray) -> None:
    """Refuse quadrilaterals without area, or not convex when seen along their normal.

    Raises
    ------
    ModelError
        Names the first bad element and its corner Jacobians relative to its area.
    """
    x1, x2, x3, x4 = (coordinates[:, k] for k in range(4))
    normal = np.cross(x3 - x1, x4 - x2)
    size = np.max(np.ptp(coordinates, axis=1), axis=1, initial=0.0)
    double_area = np.linalg.norm(normal, axis=1)
    flat = double_area <= 1e-10 * size**2
    if np.any(flat):
        worst = int(np.argmax(flat))
        raise ModelError(
            f"quadrilateral {identifiers[worst]} has no area: {double_area[worst] / 2:.3g} m2"
        )
    local = _flat_corners(coordinates, quad_frames(coordinates))[0]
    before = np.roll(local, 1, axis=1) - local
    after = np.roll(local, -1, axis=1) - local
    corner = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
    smallest = corner.min(axis=1) / double_area
    bad = smallest <= 1e-6
    if np.any(bad):
        worst = int(np.argmax(bad))
        raise ModelError(
            f"quadrilateral {identifiers[worst]} is not convex: corner Jacobian "
            f"{smallest[worst]:.3g} of twice its area; check the order of its nodes"
        )


def quad_stiffness(coordinates: Array, sections: ShellSections) -> Array:
    """Stiffness (m, 24, 24) in structural axes, node-wise ux uy uz rx ry rz [N/m, N, N m].

    Parameters
    ----------
    coordinates : (m, 4, 3) array
        Corners, counter-clockwise about the normal [m].
    sections : ShellSections
        Material and thickness of each element.
    """
    frames = quad_frames(coordinates)
    corners, warpage = _flat_corners(coordinates, frames)
    count = len(coordinates)
    elasticity = sections.plane_stress
    thickness = sections.thickness
    membrane = elasticity * thickness[:, None, None]
    drilling = sections.shear_modulus * thickness

    # Membrane unknowns: 24 nodal freedoms, then the four incompatible amplitudes.
    sheet = np.zeros((count, 28, 28))
    centre_inverse, centre_determinant = jacobian(corners, 0.0, 0.0)
    mean_spin = _mean_spin(centre_inverse)
    sheet += quadratic(mean_spin, (4.0 * drilling * centre_determinant)[:, None, None])
    for xi, eta in GAUSS_POINTS:
        inverse, determinant = jacobian(corners, xi, eta)
        values, parent = shape_functions(xi, eta)
        gradients = inverse @ parent
        ratio = (centre_determinant / determinant)[:, None, None]
        modes = ratio * (centre_inverse @ np.array([[-2.0 * xi, 0.0], [0.0, -2.0 * eta]]))
        strain, spin = _membrane_operators(gradients, values, modes)
        sheet += quadratic(strain, membrane * determinant[:, None, None])
        sheet += quadratic(spin, (PATTERN_SHARE * drilling * determinant)[:, None, None])
    coupling = np.linalg.solve(sheet[:, 24:, 24:], sheet[:, 24:, :24])
    local = plate_stiffness(corners, sections) + sheet[:, :24, :24] - sheet[:, :24, 24:] @ coupling
    link = _link(frames, warpage)
    stiffness = np.swapaxes(link, 1, 2) @ local @ link
    symmetric: Array = 0.5 * (stiffness + np.swapaxes(stiffness, 1, 2))
    return symmetric


def quad_strains(coordinates: Array, sections: ShellSections) -> Array:
    """Operator (m, 6, 24) of membrane strains and curvatures at the centroid, local axes.

    Rows: strains x, y, engineering shear xy of the mid-surface [-], then the curvatures k such
    that the strain at height z above the mid-surface is their sum, e + z k [1/m].  The
    incompatible modes have no gradient at the centroid.
    """
    frames = quad_frames(coordinates)
    corners, warpage = _flat_corners(coordinates, frames)
    inverse = jacobian(corners, 0.0, 0.0)[0]
    gradients = inverse @ shape_functions(0.0, 0.0)[1]
    strain = _membrane_operators(gradients, np.zeros(4), np.zeros((len(corners), 2, 2)))[0]
    local = np.concatenate([strain[:, :, :24], central_curvature(corners, sections)], axis=1)
    operator: Array = local @ _link(frames, warpage)
    return operator


def quad_mass_shapes(coordinates: Array) -> Array:
    """Integrals (m, 4, 4) of products of shape functions over the bilinear surface [m2]."""
    shapes = np.zeros((len(coordinates), 4, 4))
    for xi, eta in GAUSS_POINTS:
        values, parent = shape_functions(xi, eta)
        tangents = parent @ coordinates
        area = np.linalg.norm(np.cross(tangents[:, 0], tangents[:, 1]), axis=1)
        shapes += area[:, None, None] * np.outer(values, values)
    return shapes


def _flat_corners(coordinates: Array, frames: Array) -> tuple[Array, Array]:
    """Corners in the mean plane (m, 4, 2) and height of the nodes above it (m, 4)."""
    local = (coordinates - coordinates.mean(axis=1, keepdims=True)) @ np.swapaxes(frames, 1, 2)
    return local[..., :2], local[..., 2]


def _membrane_operators(gradients: Array, values: Array, modes: Array) -> tuple[Array, Array]:
    """In-plane strains (m, 3, 28) and drilling against in-plane rotation (m, 1, 28).

    The last four columns are the incompatible amplitudes: two modes in u, two in v.
    """
    count = len(gradients)
    strain = np.zeros((count, 3, 28))
    spin = np.zeros((count, 1, 28))
    nodal_u, nodal_v, nodal_theta = slice(0, 24, 6), slice(1, 24, 6), slice(5, 24, 6)
    for columns_u, columns_v, gradient in (
        (nodal_u, nodal_v, gradients),
        (slice(24, 26), slice(26, 28), modes),
    ):
        strain[:, 0, columns_u] = gradient[:, 0]
        strain[:, 1, columns_v] = gradient[:, 1]
        strain[:, 2, columns_u] = gradient[:, 1]
        strain[:, 2, columns_v] = gradient[:, 0]
        spin[:, 0, columns_u] = 0.5 * gradient[:, 1]
        spin[:, 0, columns_v] = -0.5 * gradient[:, 0]
    spin[:, 0, nodal_theta] = values
    return strain, spin


def _mean_spin(centre_inverse: Array) -> Array:
    """Drilling against in-plane rotation at the centre (m, 1, 28); the modes are flat there."""
    values, parent = shape_functions(0.0, 0.0)
    flat = np.zeros((len(centre_inverse), 2, 2))
    return _membrane_operators(centre_inverse @ parent, values, flat)[1]


def _link(frames: Array, warpage: Array) -> Array:
    """Local corner freedoms from structural node freedoms (m, 24, 24), rigid link included."""
    link = np.zeros((len(frames), 24, 24))
    normal = np.array([0.0, 0.0, 1.0])
    for corner in range(4):
        at = 6 * corner
        link[:, at : at + 3, at : at + 3] = frames
        link[:, at + 3 : at + 6, at + 3 : at + 6] = frames
        lever = -warpage[:, corner, None] * normal
        link[:, at : at + 3, at + 3 : at + 6] = -skew(lever) @ frames
    return link
