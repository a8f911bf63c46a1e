"""Kinematics of corotated shells: their frames, deformations, and the loads of their forces.

The frame of a shell turns with its corners (C. A. Felippa, B. Haugen, A unified formulation of
small-strain corotational finite elements, Comp. Meth. Appl. Mech. Eng. 194, 2005, 2285-2335): e3
is normal to the diagonals (to two sides of a triangle), and about e3 the frame turns so that the
in-plane positions of the corners fit the initial ones best (polar decomposition), which does not
depend on where the numbering of the corners begins.  Measured against the frame that the same rule
gives at first, a rigid motion of any size leaves no deformation, warped or not.

Deformations stand in the initial (structural) axes: ``R' (x - x_mean) - X`` for a corner, the
rotation vector of ``R' R_node`` for its node, R being the turn of the frame.  The loads of forces f
on them are the exact gradient: with S the total moment of the turned forces, every corner gets its
turned force less ``G' S``, where G is the spin of the frame from the corners' displacements.
Force and moment of every element's loads are thereby zero, whatever f is.
"""

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.nonlinear.rotations import moment_of_rotation_vector, rotation_vector


@numba.njit(cache=True, error_model="numpy")
def _gather(nodes: IntArray, positions: Array, corners: Array) -> None:
    """Corners (k, 3) about their mean."""
    count = len(nodes)
    for c in range(3):
        mean = 0.0
        for a in range(count):
            corners[a, c] = positions[nodes[a], c]
            mean += corners[a, c]
        mean /= count
        for a in range(count):
            corners[a, c] -= mean


@numba.njit(cache=True, error_model="numpy")
def _frame(corners: Array, flat: Array, frame: Array) -> None:
    """Rows e1, e2, e3 of the frame at ``corners`` (k, 3) that fits ``flat`` (k, 2) best."""
    count = len(corners)
    one, other, along = np.empty(3), np.empty(3), np.empty(3)
    for c in range(3):
        if count == 4:
            one[c] = corners[2, c] - corners[0, c]
            other[c] = corners[3, c] - corners[1, c]
        else:
            one[c] = corners[1, c] - corners[0, c]
            other[c] = corners[2, c] - corners[0, c]
        along[c] = one[c] - other[c]
    frame[2, 0] = one[1] * other[2] - one[2] * other[1]
    frame[2, 1] = one[2] * other[0] - one[0] * other[2]
    frame[2, 2] = one[0] * other[1] - one[1] * other[0]
    size = np.sqrt(frame[2, 0] ** 2 + frame[2, 1] ** 2 + frame[2, 2] ** 2)
    length = np.sqrt(along[0] ** 2 + along[1] ** 2 + along[2] ** 2)
    for c in range(3):
        frame[2, c] /= size
        along[c] /= length
    across0 = frame[2, 1] * along[2] - frame[2, 2] * along[1]
    across1 = frame[2, 2] * along[0] - frame[2, 0] * along[2]
    across2 = frame[2, 0] * along[1] - frame[2, 1] * along[0]
    sine, cosine = 0.0, 0.0
    for a in range(count):
        x = corners[a, 0] * along[0] + corners[a, 1] * along[1] + corners[a, 2] * along[2]
        y = corners[a, 0] * across0 + corners[a, 1] * across1 + corners[a, 2] * across2
        sine += flat[a, 0] * y - flat[a, 1] * x
        cosine += flat[a, 0] * x + flat[a, 1] * y
    size = np.sqrt(sine * sine + cosine * cosine)
    sine, cosine = sine / size, cosine / size
    frame[0, 0] = cosine * along[0] + sine * across0
    frame[0, 1] = cosine * along[1] + sine * across1
    frame[0, 2] = cosine * along[2] + sine * across2
    frame[1, 0] = cosine * across0 - sine * along[0]
    frame[1, 1] = cosine * across1 - sine * along[1]
    frame[1, 2] = cosine * across2 - sine * along[2]


@numba.njit(cache=True, error_model="numpy")
def _turn(frame: Array, initial: Array, turn: Array) -> None:
    """Turn R = frame' initial of the frame since the beginning."""
    for i in range(3):
        for j in range(3):
            turn[i, j] = (
                frame[0, i] * initial[0, j]
                + frame[1, i] * initial[1, j]
                + frame[2, i] * initial[2, j]
            )


@numba.njit(cache=True, error_model="numpy")
def shell_deformations(
    nodes: IntArray,
    initial_corners: Array,
    initial_frames: Array,
    flat: Array,
    positions: Array,
    rotations: Array,
    out: Array,
) -> None:
    """Deformations (m, 6 k) of shells, node by node as their stiffness, initial axes.

    Parameters
    ----------
    nodes : (m, k) array
    initial_corners : (m, k, 3) array
        About their mean [m].
    initial_frames : (m, 3, 3) array
        Rows e1, e2, e3.
    flat : (m, k, 2) array
        Initial corners along e1 and e2 [m].
    positions, rotations : (n, 3) and (n, 3, 3) arrays
        Of all nodes [m]; turns since the beginning.
    """
    width = nodes.shape[1]
    corners, frame, turn = np.empty((width, 3)), np.empty((3, 3)), np.empty((3, 3))
    relative = np.empty((3, 3))
    for m in range(len(nodes)):
        _gather(nodes[m], positions, corners)
        _frame(corners, flat[m], frame)
        _turn(frame, initial_frames[m], turn)
        for a in range(width):
            node = nodes[m, a]
            for i in range(3):
                out[m, 6 * a + i] = (
                    turn[0, i] * corners[a, 0]
                    + turn[1, i] * corners[a, 1]
                    + turn[2, i] * corners[a, 2]
                    - initial_corners[m, a, i]
                )
                for j in range(3):
                    relative[i, j] = (
                        turn[0, i] * rotations[node, 0, j]
                        + turn[1, i] * rotations[node, 1, j]
                        + turn[2, i] * rotations[node, 2, j]
                    )
            rotation_vector(relative, out[m, 6 * a + 3 : 6 * a + 6])


@numba.njit(cache=True, error_model="numpy")
def shell_loads(
    nodes: IntArray,
    initial_frames: Array,
    flat: Array,
    positions: Array,
    deformations: Array,
    forces: Array,
    loads: Array,
) -> None:
    """Add the nodal loads (n, 6) that hold shells with corotated ``forces`` (m, 6 k) still.

    Parameters
    ----------
    deformations : (m, 6 k) array
        Their rotation vectors tell what moments the forces do work with.
    """
    width = nodes.shape[1]
    corners, frame, turn = np.empty((width, 3)), np.empty((3, 3)), np.empty((3, 3))
    local, turned, moment = np.empty((width, 3)), np.empty((width, 6)), np.empty(3)
    total, in_frame = np.empty(3), np.empty(3)
    for m in range(len(nodes)):
        _gather(nodes[m], positions, corners)
        _frame(corners, flat[m], frame)
        _turn(frame, initial_frames[m], turn)
        total[:] = 0.0
        for a in range(width):
            at = 6 * a
            moment_of_rotation_vector(
                deformations[m, at + 3 : at + 6], forces[m, at + 3 : at + 6], moment
            )
            for i in range(3):
                turned[a, i] = (
                    turn[i, 0] * forces[m, at]
                    + turn[i, 1] * forces[m, at + 1]
                    + turn[i, 2] * forces[m, at + 2]
                )
                turned[a, 3 + i] = (
                    turn[i, 0] * moment[0] + turn[i, 1] * moment[1] + turn[i, 2] * moment[2]
                )
                local[a, i] = (
                    frame[i, 0] * corners[a, 0]
                    + frame[i, 1] * corners[a, 1]
                    + frame[i, 2] * corners[a, 2]
                )
            x, y, z = corners[a, 0], corners[a, 1], corners[a, 2]
            total[0] += turned[a, 3] + y * turned[a, 2] - z * turned[a, 1]
            total[1] += turned[a, 4] + z * turned[a, 0] - x * turned[a, 2]
            total[2] += turned[a, 5] + x * turned[a, 1] - y * turned[a, 0]
        for i in range(3):
            in_frame[i] = frame[i, 0] * total[0] + frame[i, 1] * total[1] + frame[i, 2] * total[2]
        _subtract_frame_forces(flat[m], local, in_frame, frame, turned)
        for a in range(width):
            for i in range(6):
                loads[nodes[m, a], i] += turned[a, i]


@numba.njit(cache=True, error_model="numpy")
def _subtract_frame_forces(
    flat: Array, local: Array, moment: Array, frame: Array, loads: Array
) -> None:
    """Take from ``loads`` (k, 6) the forces G' S that do the work of ``moment`` on the frame.

    Spin of the frame, local axes: with (a1, b1), (a2, b2) the diagonals, D their cross product and
    w the relative displacement of their ends along e3, ``D s1 = a1 w2 - a2 w1`` and
    ``D s2 = b1 w2 - b2 w1``.  Best fit in the plane demands ``sum of P x p = 0``, hence
    ``s3 sum P.p = sum (Px uy - Py ux) + s1 sum Px z + s2 sum Py z``.
    """
    count = len(local)
    if count == 4:
        first_start, first_end, second_start, second_end = 0, 2, 1, 3
    else:
        first_start, first_end, second_start, second_end = 0, 1, 0, 2
    a1 = local[first_end, 0] - local[first_start, 0]
    b1 = local[first_end, 1] - local[first_start, 1]
    a2 = local[second_end, 0] - local[second_start, 0]
    b2 = local[second_end, 1] - local[second_start, 1]
    double_area = a1 * b2 - b1 * a2
    spread, lift_x, lift_y = 0.0, 0.0, 0.0
    for a in range(count):
        spread += flat[a, 0] * local[a, 0] + flat[a, 1] * local[a, 1]
        lift_x += flat[a, 0] * local[a, 2]
        lift_y += flat[a, 1] * local[a, 2]
    in_plane = moment[2] / spread
    about_1 = moment[0] + in_plane * lift_x
    about_2 = moment[1] + in_plane * lift_y
    first = -(a2 * about_1 + b2 * about_2) / double_area
    second = (a1 * about_1 + b1 * about_2) / double_area
    for a in range(count):
        along_3 = 0.0
        if a == first_end:
            along_3 += first
        if a == first_start:
            along_3 -= first
        if a == second_end:
            along_3 += second
        if a == second_start:
            along_3 -= second
        along_1, along_2 = -flat[a, 1] * in_plane, flat[a, 0] * in_plane
        for i in range(3):
            loads[a, i] -= along_1 * frame[0, i] + along_2 * frame[1, i] + along_3 * frame[2, i]
