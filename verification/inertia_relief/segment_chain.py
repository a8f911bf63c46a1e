"""A planar beam as a chain of point masses on springs: geometrically exact, in space.

The finite-segment method (R. L. Huston, Multibody Dynamics, 1990): every segment carries an axial
spring E A / h, every joint a bending spring E I / h on the angle between its segments, every node
its share of mass.  Rotation, Coriolis and centrifugal forces and geometric stiffness need no terms
of their own, for nothing here turns but the beam.  It converges with the square of the segment's
length and shares no line with the solver.  Explicit central differences in time.
"""

from dataclasses import dataclass

import numba
import numpy as np
from scipy.interpolate import CubicSpline

from solver.arrays import Array


@dataclass(frozen=True, slots=True)
class UniformBeam:
    """Stiffness and mass of a beam."""

    axial: float  #: E A [N]
    bending: float  #: E I [N m2]
    density: float  #: rho A [kg/m]


#: The beam of J. C. Simo and L. Vu-Quoc, On the dynamics of flexible beams under large overall
#: motions - the plane case: part II, J. Appl. Mech. 53, 1986.
SIMO_BEAM = UniformBeam(2.8e7, 1.4e4, 1.2)


@numba.njit(cache=True)
def _forces(
    x: Array, y: Array, h: float, axial: float, bending: float, fx: Array, fy: Array
) -> None:  # pragma: no cover - compiled
    count = len(x) - 1
    fx[:] = 0.0
    fy[:] = 0.0
    px, py, pl = 0.0, 0.0, 1.0
    for i in range(count):
        dx, dy = x[i + 1] - x[i], y[i + 1] - y[i]
        length = np.sqrt(dx * dx + dy * dy)
        pull = axial * (length / h - 1.0) / length
        fx[i] += pull * dx
        fy[i] += pull * dy
        fx[i + 1] -= pull * dx
        fy[i + 1] -= pull * dy
        if i > 0:
            angle = np.arctan2(px * dy - py * dx, px * dx + py * dy)
            moment = bending / h * angle
            # the moment turns the segments against each other: force pairs across each
            ax, ay = -py / (pl * pl) * moment, px / (pl * pl) * moment
            bx, by = -dy / (length * length) * moment, dx / (length * length) * moment
            fx[i - 1] -= ax
            fy[i - 1] -= ay
            fx[i] += ax + bx
            fy[i] += ay + by
            fx[i + 1] -= bx
            fy[i + 1] -= by
        px, py, pl = dx, dy, length


@numba.njit(cache=True)
def _march(
    x: Array,
    y: Array,
    mass: Array,
    h: float,
    axial: float,
    bending: float,
    drive: Array,
    is_clamped: bool,
    step: float,
    every: int,
    out: Array,
) -> None:  # pragma: no cover - compiled
    """Step from rest; ``drive`` is the couple at the middle or the angle of the clamped root."""
    vx, vy = np.zeros_like(x), np.zeros_like(y)
    fx, fy = np.zeros_like(x), np.zeros_like(y)
    middle = (len(x) - 1) // 2
    first = 1 if is_clamped else 0
    out[0, 0], out[0, 1] = x, y
    for n in range(len(drive) - 1):
        _forces(x, y, h, axial, bending, fx, fy)
        if is_clamped:
            dx, dy = x[1] - x[0], y[1] - y[0]
            rx, ry = np.cos(drive[n]), np.sin(drive[n])
            # half a segment of curvature lies between the root and the first joint
            moment = 2 * bending / h * np.arctan2(rx * dy - ry * dx, rx * dx + ry * dy)
            fx[1] += moment * dy / (dx * dx + dy * dy)
            fy[1] -= moment * dx / (dx * dx + dy * dy)
        else:
            dx, dy = x[middle + 1] - x[middle - 1], y[middle + 1] - y[middle - 1]
            pair = drive[n] / (dx * dx + dy * dy)
            fx[middle + 1] -= pair * dy
            fy[middle + 1] += pair * dx
            fx[middle - 1] += pair * dy
            fy[middle - 1] -= pair * dx
        # central differences: the first velocity is that of half a step
        share = 0.5 if n == 0 else 1.0
        for i in range(first, len(x)):
            vx[i] += share * step * fx[i] / mass[i]
            vy[i] += share * step * fy[i] / mass[i]
            x[i] += step * vx[i]
            y[i] += step * vy[i]
        if (n + 1) % every == 0:
            out[(n + 1) // every, 0], out[(n + 1) // every, 1] = x, y


def chain_motion(
    beam: UniformBeam,
    ends: tuple[float, float],
    segments: int,
    samples: Array,
    drive: Array,
    is_clamped: bool,
) -> Array:
    """Positions (nt, 2, nodes) [m] of a chain that starts at rest along x.

    Parameters
    ----------
    ends : (float, float)
        x of the first and the last node [m].
    samples : (nt,) array
        Uniform times [s].
    drive : (nt,) array
        Couple at the middle node [N m], or angle of the root [rad]; splined between samples.
    """
    x = np.linspace(*ends, segments + 1)
    h = float(x[1] - x[0])
    mass = np.full(segments + 1, beam.density * h)
    mass[[0, -1]] /= 2
    interval = float(samples[1] - samples[0])
    stable = h / np.sqrt(beam.axial / beam.density)
    every = int(np.ceil(interval / (0.4 * stable)))
    steps = np.linspace(samples[0], samples[-1], every * (len(samples) - 1) + 1)
    driven = CubicSpline(samples, drive)(steps)
    out = np.zeros((len(samples), 2, segments + 1))
    _march(
        x,
        np.zeros_like(x),
        mass,
        h,
        beam.axial,
        beam.bending,
        driven,
        is_clamped,
        interval / every,
        every,
        out,
    )
    return out


def seen_from_mean_axes(positions: Array, reference: Array) -> tuple[Array, Array]:
    """Displacements (nt, 2, nodes) in the mean-axis frame, and its angle (nt,).

    The frame's origin is the centre of mass; its angle makes the displacement's moment of momentum
    about it vanish, sum m X x u = 0.

    Parameters
    ----------
    positions : (nt, 2, nodes) array
        Of a chain with end masses of one half [m].
    reference : (nodes,) array
        x of the nodes at rest, from the centre [m].
    """
    share = np.ones(len(reference))
    share[[0, -1]] = 0.5
    share /= share.sum()
    centred = positions - (positions @ share)[:, :, None]
    along = centred @ (share * reference)
    angle = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    seen = np.stack(
        [
            cos * centred[:, 0] + sin * centred[:, 1] - reference,
            cos * centred[:, 1] - sin * centred[:, 0],
        ],
        axis=1,
    )
    return seen, angle
