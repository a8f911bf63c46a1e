"""Kinematics of corotated beams: frames, deformations, loads of their forces, and mass points.

The frame of a beam has e1 from end to end and e2 in the plane of e1 and the mean of what the two
nodes made of the initial e2 (J.-M. Battini, C. Pacoste, Co-rotational beam elements with warping
effects in instability problems, Comp. Meth. Appl. Mech. Eng. 191, 2002, 1755-1789).  Ends lie at
their nodes plus turned offsets.  Seven numbers deform a beam: its extension, then the rotation
vectors of both ends against the frame, in the frame's axes.  As for shells the loads are the exact
gradient and without resultant, whatever the forces.

Mass points lie on ``(1 - s) A + s B + sum of N_i t_i``, t_i the axis carried by the node at end i
and N_i its static deflection shape across the frame: the linear element's shapes, turned with it.
"""

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.nonlinear.rotations import moment_of_rotation_vector, rotation_vector

EXTENSION, END_A, END_B, DEFORMATIONS = 0, 1, 4, 7


@numba.njit(cache=True, error_model="numpy")
def _ends(nodes: IntArray, offsets: Array, rotations: Array, arms: Array) -> None:
    """Turn the offsets of both ends (2, 3)."""
    for end in range(2):
        turn = rotations[nodes[end]]
        for i in range(3):
            arms[end, i] = (
                turn[i, 0] * offsets[end, 0]
                + turn[i, 1] * offsets[end, 1]
                + turn[i, 2] * offsets[end, 2]
            )


@numba.njit(cache=True, error_model="numpy")
def _frame(
    nodes: IntArray,
    arms: Array,
    initial: Array,
    positions: Array,
    rotations: Array,
    carried: Array,
    frame: Array,
) -> float:
    """Rows e1, e2, e3 of the frame, the carried initial e2 of both ends (2, 3), the length."""
    a, b = nodes[0], nodes[1]
    for i in range(3):
        frame[0, i] = positions[b, i] + arms[1, i] - positions[a, i] - arms[0, i]
        for end in range(2):
            turn = rotations[nodes[end]]
            carried[end, i] = (
                turn[i, 0] * initial[1, 0] + turn[i, 1] * initial[1, 1] + turn[i, 2] * initial[1, 2]
            )
    length = np.sqrt(frame[0, 0] ** 2 + frame[0, 1] ** 2 + frame[0, 2] ** 2)
    for i in range(3):
        frame[0, i] /= length
    q0 = 0.5 * (carried[0, 0] + carried[1, 0])
    q1 = 0.5 * (carried[0, 1] + carried[1, 1])
    q2 = 0.5 * (carried[0, 2] + carried[1, 2])
    frame[2, 0] = frame[0, 1] * q2 - frame[0, 2] * q1
    frame[2, 1] = frame[0, 2] * q0 - frame[0, 0] * q2
    frame[2, 2] = frame[0, 0] * q1 - frame[0, 1] * q0
    size = np.sqrt(frame[2, 0] ** 2 + frame[2, 1] ** 2 + frame[2, 2] ** 2)
    for i in range(3):
        frame[2, i] /= size
    frame[1, 0] = frame[2, 1] * frame[0, 2] - frame[2, 2] * frame[0, 1]
    frame[1, 1] = frame[2, 2] * frame[0, 0] - frame[2, 0] * frame[0, 2]
    frame[1, 2] = frame[2, 0] * frame[0, 1] - frame[2, 1] * frame[0, 0]
    return float(length)


@numba.njit(cache=True, error_model="numpy")
def beam_deformations(
    nodes: IntArray,
    offsets: Array,
    initial_frames: Array,
    lengths: Array,
    positions: Array,
    rotations: Array,
    out: Array,
) -> None:
    """Deformations (m, 7) of beams: extension [m], rotation vectors of ends A and B [rad].

    Parameters
    ----------
    nodes, offsets : (m, 2) and (m, 2, 3) arrays
        Offsets from nodes to ends, initial axes [m].
    initial_frames : (m, 3, 3) array
        Rows e1, e2, e3.
    lengths : (m,) array
        Initial [m].
    positions, rotations : (n, 3) and (n, 3, 3) arrays
        Of all nodes [m]; turns since the beginning.
    """
    arms, carried, frame = np.empty((2, 3)), np.empty((2, 3)), np.empty((3, 3))
    half, relative = np.empty((3, 3)), np.empty((3, 3))
    for m in range(len(nodes)):
        initial = initial_frames[m]
        _ends(nodes[m], offsets[m], rotations, arms)
        length = _frame(nodes[m], arms, initial, positions, rotations, carried, frame)
        out[m, 0] = length - lengths[m]
        for end in range(2):
            turn = rotations[nodes[m, end]]
            for i in range(3):
                for j in range(3):
                    half[i, j] = (
                        frame[i, 0] * turn[0, j]
                        + frame[i, 1] * turn[1, j]
                        + frame[i, 2] * turn[2, j]
                    )
            for i in range(3):
                for j in range(3):
                    relative[i, j] = (
                        half[i, 0] * initial[j, 0]
                        + half[i, 1] * initial[j, 1]
                        + half[i, 2] * initial[j, 2]
                    )
            rotation_vector(relative, out[m, 1 + 3 * end : 4 + 3 * end])


@numba.njit(cache=True, error_model="numpy")
def _spread_frame_moment(
    moment: Array, length: float, frame: Array, carried: Array, ends: Array
) -> None:
    """Add to loads of the ends (2, 6) those that do the work of ``moment``, local, on the frame.

    Spin of the frame: ``s2 = -(wB - wA) / L``, ``s3 = (vB - vA) / L`` and ``s1 = (dq_z + s2 q_x) /
    q_y`` with q the mean of the carried e2.
    """
    local = np.empty((2, 2))
    for end in range(2):
        for i in range(2):
            local[end, i] = (
                frame[i, 0] * carried[end, 0]
                + frame[i, 1] * carried[end, 1]
                + frame[i, 2] * carried[end, 2]
            )
    q_x, q_y = 0.5 * (local[0, 0] + local[1, 0]), 0.5 * (local[0, 1] + local[1, 1])
    shear_3 = -(moment[1] + moment[0] * q_x / q_y) / length
    shear_2 = moment[2] / length
    for end in range(2):
        sign = -1.0 if end == 0 else 1.0
        about_1 = 0.5 * moment[0] * local[end, 1] / q_y
        about_2 = -0.5 * moment[0] * local[end, 0] / q_y
        for i in range(3):
            ends[end, i] += sign * (shear_2 * frame[1, i] + shear_3 * frame[2, i])
            ends[end, 3 + i] += about_1 * frame[0, i] + about_2 * frame[1, i]


@numba.njit(cache=True, error_model="numpy")
def _to_nodes(nodes: IntArray, arms: Array, ends: Array, loads: Array) -> None:
    """Carry loads of the ends (2, 6) to their nodes, along the turned offsets."""
    for end in range(2):
        at = nodes[end]
        x, y, z = arms[end, 0], arms[end, 1], arms[end, 2]
        for i in range(6):
            loads[at, i] += ends[end, i]
        loads[at, 3] += y * ends[end, 2] - z * ends[end, 1]
        loads[at, 4] += z * ends[end, 0] - x * ends[end, 2]
        loads[at, 5] += x * ends[end, 1] - y * ends[end, 0]


@numba.njit(cache=True, error_model="numpy")
def beam_loads(
    nodes: IntArray,
    offsets: Array,
    initial_frames: Array,
    positions: Array,
    rotations: Array,
    deformations: Array,
    forces: Array,
    loads: Array,
) -> None:
    """Add the nodal loads (n, 6) that hold beams with corotated ``forces`` (m, 7) still."""
    arms, carried, frame = np.empty((2, 3)), np.empty((2, 3)), np.empty((3, 3))
    ends, moment, total = np.empty((2, 6)), np.empty(3), np.empty(3)
    for m in range(len(nodes)):
        _ends(nodes[m], offsets[m], rotations, arms)
        length = _frame(nodes[m], arms, initial_frames[m], positions, rotations, carried, frame)
        total[:] = 0.0
        for end in range(2):
            at = 1 + 3 * end
            axial = -forces[m, 0] if end == 0 else forces[m, 0]
            moment_of_rotation_vector(deformations[m, at : at + 3], forces[m, at : at + 3], moment)
            for i in range(3):
                total[i] -= moment[i]
                ends[end, i] = axial * frame[0, i]
                ends[end, 3 + i] = (
                    moment[0] * frame[0, i] + moment[1] * frame[1, i] + moment[2] * frame[2, i]
                )
        _spread_frame_moment(total, length, frame, carried, ends)
        _to_nodes(nodes[m], arms, ends, loads)


@numba.njit(cache=True, error_model="numpy")
def beam_points(
    nodes: IntArray,
    offsets: Array,
    initial_frames: Array,
    stations: Array,
    shapes: Array,
    positions: Array,
    rotations: Array,
    out: Array,
) -> None:
    """Positions (m, s, 3) of the beams' mass points [m].

    Parameters
    ----------
    stations : (s,) array
        Places along the axis, 0 to 1.
    shapes : (m, s, 2, 2) array
        Deflection in plane 1 and 2 from the slopes at ends A and B there [m].
    """
    arms, carried, frame = np.empty((2, 3)), np.empty((2, 3)), np.empty((3, 3))
    slopes = np.empty((2, 2))
    for m in range(len(nodes)):
        _ends(nodes[m], offsets[m], rotations, arms)
        _frame(nodes[m], arms, initial_frames[m], positions, rotations, carried, frame)
        _slopes(nodes[m], initial_frames[m], frame, rotations, slopes)
        for p in range(len(stations)):
            s = stations[p]
            in_1 = shapes[m, p, 0, 0] * slopes[0, 0] + shapes[m, p, 0, 1] * slopes[1, 0]
            in_2 = shapes[m, p, 1, 0] * slopes[0, 1] + shapes[m, p, 1, 1] * slopes[1, 1]
            for i in range(3):
                a = positions[nodes[m, 0], i] + arms[0, i]
                b = positions[nodes[m, 1], i] + arms[1, i]
                out[m, p, i] = (1.0 - s) * a + s * b + in_1 * frame[1, i] + in_2 * frame[2, i]


@numba.njit(cache=True, error_model="numpy")
def _slopes(nodes: IntArray, initial: Array, frame: Array, rotations: Array, slopes: Array) -> None:
    """Components along e2 and e3 of the initial e1 carried by each end, (2, 2)."""
    for end in range(2):
        turn = rotations[nodes[end]]
        for row in range(2):
            value = 0.0
            for i in range(3):
                axis = (
                    turn[i, 0] * initial[0, 0]
                    + turn[i, 1] * initial[0, 1]
                    + turn[i, 2] * initial[0, 2]
                )
                value += frame[row + 1, i] * axis
            slopes[end, row] = value


@numba.njit(cache=True, error_model="numpy")
def beam_point_loads(
    nodes: IntArray,
    offsets: Array,
    initial_frames: Array,
    stations: Array,
    shapes: Array,
    positions: Array,
    rotations: Array,
    places: Array,
    forces: Array,
    loads: Array,
) -> None:
    """Add the nodal loads (n, 6) of ``forces`` (m, s, 3) on the beams' mass points.

    They are applied at ``places`` (m, s, 3); where these are not the points' own, both nodes share
    the couple that makes up for it, so that the moment is that of the forces at their places.
    """
    arms, carried, frame = np.empty((2, 3)), np.empty((2, 3)), np.empty((3, 3))
    slopes, ends, across = np.empty((2, 2)), np.empty((2, 6)), np.empty((2, 2))
    local, moment, couple = np.empty(3), np.empty(3), np.empty(3)
    for m in range(len(nodes)):
        _ends(nodes[m], offsets[m], rotations, arms)
        length = _frame(nodes[m], arms, initial_frames[m], positions, rotations, carried, frame)
        _slopes(nodes[m], initial_frames[m], frame, rotations, slopes)
        ends[:], across[:], moment[:], couple[:] = 0.0, 0.0, 0.0, 0.0
        for p in range(len(stations)):
            s, force = stations[p], forces[m, p]
            for i in range(3):
                ends[0, i] += (1.0 - s) * force[i]
                ends[1, i] += s * force[i]
                local[i] = frame[i, 0] * force[0] + frame[i, 1] * force[1] + frame[i, 2] * force[2]
            in_1 = shapes[m, p, 0, 0] * slopes[0, 0] + shapes[m, p, 0, 1] * slopes[1, 0]
            in_2 = shapes[m, p, 1, 0] * slopes[0, 1] + shapes[m, p, 1, 1] * slopes[1, 1]
            moment[0] += in_1 * local[2] - in_2 * local[1]
            moment[1] += in_2 * local[0]
            moment[2] -= in_1 * local[0]
            for end in range(2):
                across[end, 0] += shapes[m, p, 0, end] * local[1]
                across[end, 1] += shapes[m, p, 1, end] * local[2]
            # where the point stands beside the place of its force
            for i in range(3):
                a = positions[nodes[m, 0], i] + arms[0, i]
                b = positions[nodes[m, 1], i] + arms[1, i]
                local[i] = places[m, p, i] - (
                    (1.0 - s) * a + s * b + in_1 * frame[1, i] + in_2 * frame[2, i]
                )
            couple[0] += local[1] * force[2] - local[2] * force[1]
            couple[1] += local[2] * force[0] - local[0] * force[2]
            couple[2] += local[0] * force[1] - local[1] * force[0]
        for end in range(2):
            along = _along(rotations[nodes[m, end]], initial_frames[m], frame)
            in_1, in_2 = slopes[end, 0], slopes[end, 1]
            twist = in_1 * across[end, 1] - in_2 * across[end, 0]
            about_2, about_3 = -along * across[end, 1], along * across[end, 0]
            moment[0] -= twist
            moment[1] -= about_2
            moment[2] -= about_3
            for i in range(3):
                ends[end, 3 + i] += (
                    twist * frame[0, i]
                    + about_2 * frame[1, i]
                    + about_3 * frame[2, i]
                    + 0.5 * couple[i]
                )
        _spread_frame_moment(moment, length, frame, carried, ends)
        _to_nodes(nodes[m], arms, ends, loads)


@numba.njit(cache=True, error_model="numpy")
def _along(turn: Array, initial: Array, frame: Array) -> float:
    """Component along e1 of the initial e1 carried by a node."""
    value = 0.0
    for i in range(3):
        axis = turn[i, 0] * initial[0, 0] + turn[i, 1] * initial[0, 1] + turn[i, 2] * initial[0, 2]
        value += frame[0, i] * axis
    return float(value)
