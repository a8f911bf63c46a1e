"""Three-node shell: Felippa's optimal membrane triangle with drilling, DKMT plate.

Theory
------
*Membrane.*  The ANDES template with nine freedoms u, v, theta per corner and the parameters OPT
(C. A. Felippa, A study of optimal membrane triangles with drilling freedoms, Comp. Meth. Appl.
Mech. Eng. 192, 2003, 2125-2168): basic stiffness with alpha_b = 3/2, higher-order stiffness
with beta_0 = (1 - 4 nu^2)/2, at least 0.01, and beta_1..9 = 1 2 1 0 1 -1 -1 -1 -2.  Pairs of such
triangles bend in their plane without locking at any aspect ratio.  The drilling freedom is part
of the element (it is the corner's in-plane rotation), so no coupling parameter has to be chosen:
only patterns in which the drilling freedoms turn against the mean rotation of the triangle store
energy, through beta_0.  The price: on thin, strongly curved shells, where neighbouring facets do
not share a plane, the corner rotations hold the shell back until the mesh is fine (hemisphere of
R/t = 250: 0.50, 0.93, 0.99 of its deflection with 8, 16, 32 elements a side; the quadrilateral
has 0.99 with 8).  Triangles with constant strain and a loose drilling freedom were tried: 0.95
there, but 0.11 in place of 1.00 of the in-plane deflection of a slender cantilever.

Deviation: the share alpha_b belongs to the side, not to the element, and is 0 on a side shared
with a quadrilateral.  The template passes the patch test only if both neighbours lump the stress
on their common side alike (P. G. Bergan, C. A. Felippa, A triangular membrane element with
rotational degrees of freedom, Comp. Meth. Appl. Mech. Eng. 50, 1985, 25-69), and the
quadrilateral lumps no moments: with 3/2 on all sides the stress of a mixed patch was wrong by up to
77 % (radius of its Mohr circle).

*Plate.*  Discrete Kirchhoff-Mindlin triangle DKMT (I. Katili, A new discrete Kirchhoff-Mindlin
element based on Mindlin-Reissner plate theory and assumed shear strain fields, part I, Int. J.
Num. Meth. Eng. 36, 1993, 1859-1883).  Rotations are quadratic along the sides; the excess at the
middle of a side follows from w, from the corner rotations and from a constant shear strain along
the side, in the ratio phi = 12 D_b / (D_s l^2) of bending to shear.  Thin shells give the discrete
Kirchhoff triangle DKT (J. L. Batoz, K. J. Bathe, L. W. Ho, Int. J. Num. Meth. Eng. 15, 1980,
1771-1812).  Quadrilaterals carry bending and twist along a common side alike (`plate_sides`), so
that patches of both bend exactly.  With shear left out, Raasch's hook stays 4.5 %
too stiff.

Local axes: e1 along side 1-2, e3 the normal.
"""

import numpy as np

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.bilinear import quadratic
from solver.fe.plate_sides import SHEAR_CORRECTION, shear_ratios, side_excess, side_shear
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


def side_lumping(triangles: IntArray, quads: IntArray, node_count: int) -> Array:
    """Share alpha_b (m, 3) of drilling moments in the lumping of sides 1-2, 2-3, 3-1.

    Zero on sides that a triangle shares with a quadrilateral, whose sides carry none.

    Parameters
    ----------
    triangles, quads : (m, 3) and (q, 4) arrays
        Node rows.
    """

    def keys(first: IntArray, second: IntArray) -> IntArray:
        return np.minimum(first, second) * node_count + np.maximum(first, second)

    of_quads = keys(quads, np.roll(quads, -1, axis=1))
    of_triangles = keys(triangles, np.roll(triangles, -1, axis=1))
    return np.where(np.isin(of_triangles, of_quads), 0.0, ALPHA_BASIC)


def triangle_stiffness(coordinates: Array, sections: ShellSections, lumping: Array) -> Array:
    """Stiffness (m, 18, 18) in structural axes, node-wise ux uy uz rx ry rz [N/m, N, N m].

    Parameters
    ----------
    coordinates : (m, 3, 3) array
        Corners, counter-clockwise about the normal [m].
    sections : ShellSections
        Material and thickness of each element.
    lumping : (m, 3) array
        From `side_lumping`.
    """
    frames = triangle_frames(coordinates)
    corners = _flat_corners(coordinates, frames)
    areas = triangle_areas(coordinates)
    elasticity = sections.plane_stress
    thickness = sections.thickness
    local = np.zeros((len(coordinates), 18, 18))

    basic = _mean_strain(corners, areas, lumping)
    membrane = quadratic(basic, elasticity * (thickness * areas)[:, None, None])
    membrane += _higher_order(corners, areas, sections)
    local[:, MEMBRANE_FREEDOMS[:, None], MEMBRANE_FREEDOMS] = membrane

    bending = elasticity * (thickness**3 / 12.0 * areas / 3.0)[:, None, None]
    shear = (SHEAR_CORRECTION * sections.shear_modulus * thickness * areas / 3.0)[:, None, None]
    ratios = shear_ratios(corners, SIDES, sections)
    corner_shear = _corner_shear(corners, ratios)
    for point in MIDPOINTS:
        local += quadratic(_curvature(corners, areas, ratios, point), bending)
        local += quadratic(np.einsum("i,mifd->mfd", point, corner_shear), shear * np.eye(2))
    turn = _turn(frames)
    stiffness = np.swapaxes(turn, 1, 2) @ local @ turn
    symmetric: Array = 0.5 * (stiffness + np.swapaxes(stiffness, 1, 2))
    return symmetric


def triangle_strains(coordinates: Array, sections: ShellSections, lumping: Array) -> Array:
    """Operator (m, 6, 18) of membrane strains and curvatures at the centroid, local axes.

    Rows as in `shell_quad.quad_strains`.  The membrane strain is the mean strain of the basic
    stiffness; the higher-order strains vanish at the centroid.
    """
    frames = triangle_frames(coordinates)
    corners = _flat_corners(coordinates, frames)
    areas = triangle_areas(coordinates)
    local = np.zeros((len(coordinates), 6, 18))
    local[:, :3, MEMBRANE_FREEDOMS] = _mean_strain(corners, areas, lumping)
    local[:, 3:] = _curvature(corners, areas, shear_ratios(corners, SIDES, sections), CENTROID)
    operator: Array = local @ _turn(frames)
    return operator


def triangle_mass_shapes(coordinates: Array) -> Array:
    """Integrals (m, 3, 3) of products of linear shape functions over each triangle [m2]."""
    shapes: Array = triangle_areas(coordinates)[:, None, None] / 12.0 * (np.eye(3) + 1.0)
    return shapes


def _flat_corners(coordinates: Array, frames: Array) -> Array:
    local: Array = (coordinates - coordinates[:, :1]) @ np.swapaxes(frames, 1, 2)
    return local[..., :2]


def _mean_strain(corners: Array, areas: Array, lumping: Array) -> Array:
    """Mean strains (m, 3, 9) from u, v, theta: the transposed lumping matrix over the volume.

    Constant stress on a side is lumped as forces at its ends and, with the share alpha, as the
    moments -+ alpha l^2 sigma_nn / 12 of a clamped beam under it.
    """
    x, y = corners[..., 0], corners[..., 1]
    operator = np.zeros((len(corners), 3, 9))
    for side, (i, j) in enumerate(SIDES):
        k = 3 - i - j
        operator[:, 0, 3 * k] = operator[:, 2, 3 * k + 1] = y[:, i] - y[:, j]
        operator[:, 1, 3 * k + 1] = operator[:, 2, 3 * k] = x[:, j] - x[:, i]
        dx, dy = x[:, j] - x[:, i], y[:, j] - y[:, i]
        normal = np.stack([dy * dy, dx * dx, -2.0 * dx * dy], axis=1)
        moment = lumping[:, side, None] / 6.0 * normal
        operator[:, :, 3 * i + 2] -= moment
        operator[:, :, 3 * j + 2] += moment
    return operator / (2.0 * areas)[:, None, None]


def _higher_order(corners: Array, areas: Array, sections: ShellSections) -> Array:
    """Higher-order membrane stiffness (m, 9, 9) of Felippa 2003, template OPT."""
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
        core += quadratic(scale * corner, elasticity)
    beta_0 = np.maximum(0.5 * (1.0 - 4.0 * sections.poisson_ratio**2), BETA_FLOOR)
    factor = 0.75 * beta_0 * sections.thickness * areas
    return quadratic(hierarchical, factor[:, None, None] * core)


def _corner_shear(corners: Array, ratios: Array) -> Array:
    """Transverse shear strains (m, corner, 2, 18) from those along the two sides that meet.

    Along a side the shear strain is -2/3 phi times the excess rotation (Katili 1993).
    """
    excess, directions = side_excess(corners, SIDES, ratios)
    along = side_shear(excess, ratios)
    shear = np.zeros((len(corners), 3, 2, 18))
    for corner, (one, other) in enumerate(((2, 0), (0, 1), (1, 2))):
        shear[:, corner] = np.linalg.solve(directions[:, [one, other]], along[:, [one, other]])
    return shear


def _curvature(corners: Array, areas: Array, ratios: Array, point: Array) -> Array:
    """Curvatures (m, 3, 18) of the plate at an area coordinate.

    u = z beta_x, v = z beta_y with beta_x = ry, beta_y = -rx at corners; along side i-j the
    tangential rotation is linear plus 4 L_i L_j times the excess at its middle.
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
    excesses, directions = side_excess(corners, SIDES, ratios)
    for side, (i, j) in enumerate(SIDES):
        excess, c, s = excesses[:, side], directions[:, side, 0], directions[:, side, 1]
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
