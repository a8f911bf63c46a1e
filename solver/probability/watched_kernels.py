"""Kernels of the watched elements' stress; they leave the interpreter's lock."""

import math

import numba

from solver.arrays import Array, Single


@numba.njit(cache=True, nogil=True, fastmath={"contract"})
def fill_departures(
    a: Array, b: Array, load: Array, out: Single
) -> None:  # pragma: no cover - compiled
    """By how much each mode departs from following its load at once, at rest to begin with.

    Parameters
    ----------
    a, b : (4, d) arrays
        Transposed `StepCoefficients`.
    load : (nt, d) array
        Displacement that the load of each sample would cause if applied slowly.
    out : (nt, d) array
        Filled with displacement minus ``load``.
    """
    modes = load.shape[1]
    q, v = load[0].copy(), load[0] * 0.0
    for i in range(modes):
        out[0, i] = 0.0
    for n in range(1, len(load)):
        for i in range(modes):
            q0, v0, p0, p1 = q[i], v[i], load[n - 1, i], load[n, i]
            q[i] = a[0, i] * q0 + a[1, i] * v0 + a[2, i] * p0 + a[3, i] * p1
            v[i] = b[0, i] * q0 + b[1, i] * v0 + b[2, i] * p0 + b[3, i] * p1
            out[n, i] = q[i] - p1


@numba.njit(cache=True, nogil=True, fastmath={"contract", "reassoc"})
def fill_peaks(
    rows: Single, points: Single, shells: int, history: Array, out: Array
) -> None:  # pragma: no cover - compiled
    """Largest von Mises stress of every element, a parabola laid through its sample's neighbours.

    Parameters
    ----------
    rows : (6 n, nt) array
        Stress rows, see `ReducedStress`; shells first.
    points : (n - shells, 8, 5) array
    shells : int
    history : (nt,) array
        Room.
    out : (n,) array
        Filled.
    """
    count = rows.shape[1]
    for element in range(len(out)):
        first = 6 * element
        for t in range(count):
            history[t] = 0.0
        if element < shells:
            for face in range(2):
                at = first + 3 * face
                for t in range(count):
                    square = rows[at, t] ** 2 + rows[at + 1, t] ** 2 + rows[at + 2, t] ** 2
                    if square > history[t]:
                        history[t] = square
        else:
            for point in range(8):
                w = points[element - shells, point]
                for t in range(count):
                    normal = (
                        w[0] * rows[first, t]
                        + w[1] * rows[first + 1, t]
                        + w[2] * rows[first + 2, t]
                        + w[3] * rows[first + 3, t]
                        + w[4] * rows[first + 4, t]
                    )
                    square = normal**2 + rows[first + 5, t] ** 2
                    if square > history[t]:
                        history[t] = square
        top = 0
        for t in range(1, count):
            if history[t] > history[top]:
                top = t
        peak = math.sqrt(history[top])
        if 0 < top < count - 1:
            left, right = math.sqrt(history[top - 1]), math.sqrt(history[top + 1])
            bend = left - 2.0 * peak + right
            if bend < 0.0:
                peak -= (left - right) ** 2 / (8.0 * bend)
        out[element] = peak
