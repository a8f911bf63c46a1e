"""Three-node shell: Felippa's optimal membrane triangle with drilling, DKT plate.

Theory
------
*Membrane.*  The ANDES template with nine freedoms u, v, theta per corner and the parameters OPT
(C. A. Felippa, A study of optimal membrane triangles with drilling freedoms, Comp. Meth. Appl.
Mech. Eng. 192, 2003, 2125-2168): basic stiffness with alpha_b = 3/2 (section 4.1), higher-order
stiffness with beta_0 = (1 - 4 nu^2)/2, at least 0.01, and beta_1..9 = 1 2 1 0 1 -1 -1 -1 -2
(section 5.5, table 1).  Pairs of such triangles bend in their plane without locking at any
aspect ratio.  The drilling freedom is part of the element (it is the corner's in-plane rotation),
so no coupling parameter has to be chosen: only the mode in which the three drilling freedoms
turn against a still element stores energy, and that through beta_0.

*Plate.*  Discrete Kirchhoff triangle (J. L. Batoz, K. J. Bathe, L. W. Ho, A study of three-node
triangular plate bending elements, Int. J. Num. Meth. Eng. 15, 1980, 1771-1812, section 4).  The
rotations are quadratic, with the Kirchhoff hypothesis at corners and middles of sides; transverse
shear does not deform it, so use quadrilaterals where a shell is thick.

Local axes: e1 along side 1-2, e3 the normal.
"""

import numpy as np

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.sections import ShellSections

#: Midpoints of the sides in area coordinates; exact for the squares of linear fields.
MIDPOINTS = np.array([[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]])
CENTROID = np.full(3, 1.0 / 3.0)
ALPHA_BASIC = 1.5
BETA_FLOOR = 0.01
#: Sides in the order 1-2, 2-3, 3-1.
SIDES = ((0, 1), (1, 2), (2, 0))
MEMBRANE_FREEDOMS = np.array([0, 1, 5, 6, 7, 11, 12, 13, 17])


def triangle_frames(coordinates: Array) -> Array:
    """Local axes (m, 3, 3), rows e1, e2, e3, of triangles with corners (m, 3, 3) [m]."""
    along = coordinates[:, 1] - coordinates[:, 0]
    normal = np.cross(along, coordinates[:, 2] - coordinates[:, 0])
    e1 = along / np.linalg.norm(along, axis=1, keepdims=True)
    e3 = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return np.stack([e1, np.cross(e3, e1), e3], axis=1)


def triangle_areas(coordinates: Array) -> Array:
    """Area (m,) of triangles with corners (m, 3, 3) [m2]."""
    normal = np.cross(coordinates[:, 1] - coordinates[:, 0], coordinates[:, 2] - coordinates[:, 0])
    areas: Array = 0.5 * np.linalg.norm(normal, axis=1)
    return areas


def check_triangles(coordinates: Array, identifiers: IntArray) -> None:
    """Refuse triangles without area.

    Raises
    ------
    ModelError
        Names the first bad element and its area.
    """
    areas = triangle_areas(coordinates)
    size = np.max(np.ptp(coordinates, axis=1), axis=1, initial=0.0)
    flat = areas <= 1e-10 * size**2
    if np.any(flat):
        worst = int(np.argmax(flat))
        raise ModelError(f"triangle {identifiers[worst]} has no area: {areas[worst]:.3g} m2")


def triangle_stiffness(coordinates: Array, sections: ShellSections) -> Array:
    """Stiffness (m, 18, 18) in structural axes, node-wise ux uy uz rx ry rz [N/m, N, N m]."""
    frames = triangle_frames(coordinates)
    corners = _flat_corners(coordinates, frames)
    areas = triangle_areas(coordinates)
    elasticity = sections.plane_stress
    thickness = sections.thickness
    local = np.zeros((len(coordinates), 18, 18))

    basic = _mean_strain(corners, areas)
    membrane = _quadratic(basic, elasticity * (thickness * areas)[:, None, None])
    membrane += _higher_order(corners, areas, sections)
    local[:, MEMBRANE_FREEDOMS[:, None], MEMBRANE_FREEDOMS] = membrane

    bending = elasticity * (thickness**3 / 12.0 * areas / 3.0)[:, None, None]
    for point in MIDPOINTS:
        local += _quadratic(_curvature(corners, areas, point), bending)
    turn = _turn(frames)
    stiffness = np.swapaxes(turn, 1, 2) @ local @ turn
    symmetric: Array = 0.5 * (stiffness + np.swapaxes(stiffness, 1, 2))
    return symmetric


def triangle_strains(coordinates: Array) -> Array:
    """Operator (m, 6, 18) of membrane strains and curvatures at the centroid, local axes.

    Rows as in `shell_quad.quad_strains`.  The membrane strain is the mean strain of the basic
    stiffness; the higher-order strains vanish at the centroid.
    """
    frames = triangle_frames(coordinates)
    corners = _flat_corners(coordinates, frames)
    areas = triangle_areas(coordinates)
    local = np.zeros((len(coordinates), 6, 18))
    local[:, :3, MEMBRANE_FREEDOMS] = _mean_strain(corners, areas)
    local[:, 3:] = _curvature(corners, areas, CENTROID)
    operator: Array = local @ _turn(frames)
    return operator


def triangle_mass_shapes(coordinates: Array) -> Array:
    """Integrals (m, 3, 3) of products of linear shape functions over each triangle [m2]."""
    shapes: Array = triangle_areas(coordinates)[:, None, None] / 12.0 * (np.eye(3) + 1.0)
    return shapes


def _flat_corners(coordinates: Array, frames: Array) -> Array:
    local: Array = (coordinates - coordinates[:, :1]) @ np.swapaxes(frames, 1, 2)
    return local[..., :2]


def _quadratic(operator: Array, weight: Array) -> Array:
    product: Array = np.swapaxes(operator, 1, 2) @ (weight @ operator)
    return product


def _mean_strain(corners: Array, areas: Array) -> Array:
    """Mean strains (m, 3, 9) from u, v, theta: the transposed lumping matrix over the volume."""
    x, y = corners[..., 0], corners[..., 1]
    operator = np.zeros((len(corners), 3, 9))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        y_jk, x_kj = y[:, j] - y[:, k], x[:, k] - x[:, j]
        y_ik, y_ji = y[:, i] - y[:, k], y[:, j] - y[:, i]
        x_ki, x_ij = x[:, k] - x[:, i], x[:, i] - x[:, j]
        operator[:, 0, 3 * i] = y_jk
        operator[:, 2, 3 * i] = x_kj
        operator[:, 1, 3 * i + 1] = x_kj
        operator[:, 2, 3 * i + 1] = y_jk
        operator[:, 0, 3 * i + 2] = ALPHA_BASIC / 6.0 * y_jk * (y_ik - y_ji)
        operator[:, 1, 3 * i + 2] = ALPHA_BASIC / 6.0 * x_kj * (x_ki - x_ij)
        operator[:, 2, 3 * i + 2] = ALPHA_BASIC / 3.0 * (x_ki * y_ik - x_ij * y_ji)
    return operator / (2.0 * areas)[:, None, None]


def _higher_order(corners: Array, areas: Array, sections: ShellSections) -> Array:
    """Higher-order membrane stiffness (m, 9, 9), Felippa 2003, eqs 27-34."""
    count = len(corners)
    x, y = corners[..., 0], corners[..., 1]
    sides = np.stack([corners[:, j] - corners[:, i] for i, j in SIDES], axis=1)
    squares = np.sum(sides**2, axis=2)
    # Strains along the three sides from the Cartesian ones, inverted.
    along = np.concatenate([sides**2, sides[..., :1] * sides[..., 1:]], axis=2)
    natural = np.linalg.inv(along / squares[..., None])
    elasticity = np.swapaxes(natural, 1, 2) @ sections.plane_stress @ natural

    # Rotations of the corners against the mean rotation of the triangle.
    hierarchical = np.zeros((count, 3, 9))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        hierarchical[:, :, 3 * i] = (x[:, k] - x[:, j])[:, None]
        hierarchical[:, :, 3 * i + 1] = (y[:, k] - y[:, j])[:, None]
        hierarchical[:, i, 3 * i + 2] = 4.0 * areas
    hierarchical /= (4.0 * areas)[:, None, None]

    q1 = np.array([[1.0, 2.0, 1.0], [0.0, 1.0, -1.0], [-1.0, -1.0, -2.0]])
    q2 = np.array([[-2.0, -1.0, -1.0], [1.0, 1.0, 2.0], [-1.0, 0.0, 1.0]])
    q3 = np.array([[1.0, -1.0, 0.0], [-1.0, -2.0, -1.0], [2.0, 1.0, 1.0]])
    core = np.zeros((count, 3, 3))
    scale = (2.0 / 3.0 * areas[:, None] / squares)[:, :, None]
    for corner in ((q1 + q2) / 2.0, (q2 + q3) / 2.0, (q3 + q1) / 2.0):
        core += _quadratic(scale * corner, elasticity)
    beta_0 = np.maximum(0.5 * (1.0 - 4.0 * sections.poisson_ratio**2), BETA_FLOOR)
    factor = 0.75 * beta_0 * sections.thickness * areas
    return _quadratic(hierarchical, factor[:, None, None] * core)


def _curvature(corners: Array, areas: Array, point: Array) -> Array:
    """Curvatures (m, 3, 18) of the discrete Kirchhoff triangle at an area coordinate.

    u = z beta_x, v = z beta_y with beta_x = ry, beta_y = -rx at corners.  Along side i-j the
    tangential rotation is quadratic; its excess over the linear one at the middle is
    -3/(2 l) (w_j - w_i) - 3/4 (beta_s,i + beta_s,j).
    """
    count = len(corners)
    x, y = corners[..., 0], corners[..., 1]
    gradients = np.zeros((count, 2, 3))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        gradients[:, 0, i] = y[:, j] - y[:, k]
        gradients[:, 1, i] = x[:, k] - x[:, j]
    gradients /= (2.0 * areas)[:, None, None]

    # Gradient (m, direction, component of beta, freedom).
    slope = np.zeros((count, 2, 2, 18))
    for i in range(3):
        slope[:, :, 0, 6 * i + 4] += gradients[:, :, i]
        slope[:, :, 1, 6 * i + 3] -= gradients[:, :, i]
    for i, j in SIDES:
        side = corners[:, j] - corners[:, i]
        length = np.linalg.norm(side, axis=1)
        c, s = side[:, 0] / length, side[:, 1] / length
        excess = np.zeros((count, 18))
        excess[:, 6 * i + 2] = 1.5 / length
        excess[:, 6 * j + 2] = -1.5 / length
        for corner in (i, j):
            excess[:, 6 * corner + 4] = -0.75 * c
            excess[:, 6 * corner + 3] = 0.75 * s
        bubble = 4.0 * (gradients[:, :, i] * point[j] + gradients[:, :, j] * point[i])
        slope[:, :, 0] += (bubble * c[:, None])[:, :, None] * excess[:, None, :]
        slope[:, :, 1] += (bubble * s[:, None])[:, :, None] * excess[:, None, :]
    return np.stack([slope[:, 0, 0], slope[:, 1, 1], slope[:, 1, 0] + slope[:, 0, 1]], axis=1)


def _turn(frames: Array) -> Array:
    """Local freedoms from structural ones (m, 18, 18)."""
    turn = np.zeros((len(frames), 18, 18))
    for block in range(6):
        at = 3 * block
        turn[:, at : at + 3, at : at + 3] = frames
    return turn
