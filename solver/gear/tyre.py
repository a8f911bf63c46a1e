"""Tyre: the vertical law of NACA Report 1154 and the forces of the Fiala model.

Axes at the contact: x forward along the wheel's heading, y to its right, z down; forces act on the
tyre.  The paper (2.1.2) keeps Fiala's longitudinal and lateral laws and replaces the linear
vertical spring by F = m d^r.  Equations as published for the Fiala tyre of MSC ADAMS and Project
Chrono (``ChFialaTire``): comprehensive slip, friction falling linearly with it from mu_max at rest
to mu_min in full sliding.

Deviations, all deliberate:

* The published model forms the longitudinal and the lateral force apart, so that a locked wheel
  keeps its whole cornering force and exceeds the friction available by up to 41 %, while a sliding
  tread can only be pushed against the direction in which it slides.  Here the lateral force and the
  aligning moment are multiplied by sqrt(1 - (F_x / (U F_z))^2), the share that the friction circle
  leaves.  Pure slip in either direction is untouched.
* The rolling radius is R - d / 3 rather than the deflected radius R - d (Smiley & Horne, NACA TR
  R-64, 1960: the tread is hardly extensible); `Tyre.rolling_share` holds the factor.
* The slips are divided by max(|V_x|, `SLIP_SPEED`), so that the model passes through standstill
  with forces linear in the sliding speed instead of a division by zero.
"""

import math

import numba
import numpy as np

from solver.arrays import Array
from solver.gear.parameters import Tyre

#: Forward speed below which the slips are regularised [m/s].
SLIP_SPEED = 1.0

#: Rolling speed over which the rolling resistance fades in [m/s].
ROLLING_SPEED = 0.5


@numba.njit(cache=True)
def vertical_force(
    deflection: float,
    coefficient: float,
    exponent: float,
    bottoming_deflection: float,
    rim_stiffness: float,
) -> float:
    """Elastic force of one tyre, m d^r, plus a stiff linear rim beyond bottoming [N]."""
    if deflection <= 0.0:
        return 0.0
    force = coefficient * math.pow(deflection, exponent)
    if deflection > bottoming_deflection:
        force += rim_stiffness * (deflection - bottoming_deflection)
    return force


@numba.njit(cache=True)
def vertical_energy(
    deflection: float,
    coefficient: float,
    exponent: float,
    bottoming_deflection: float,
    rim_stiffness: float,
) -> float:
    """Integral of `vertical_force` from zero to ``deflection`` [J]."""
    if deflection <= 0.0:
        return 0.0
    energy = coefficient * math.pow(deflection, exponent + 1.0) / (exponent + 1.0)
    if deflection > bottoming_deflection:
        energy += 0.5 * rim_stiffness * (deflection - bottoming_deflection) ** 2
    return energy


@numba.njit(cache=True)
def fiala_forces(
    normal: float,
    longitudinal_slip: float,
    lateral_slip: float,
    longitudinal_stiffness: float,
    cornering_stiffness: float,
    maximum_friction: float,
    minimum_friction: float,
    width: float,
) -> tuple[float, float, float]:
    """Longitudinal force, lateral force and aligning moment of one tyre [N, N, N m].

    Parameters
    ----------
    normal : float
        F_z, supporting force [N].
    longitudinal_slip : float
        kappa = -V_sx / |V_x|, minus one for a locked wheel that moves forward.
    lateral_slip : float
        tan(alpha) = V_y / |V_x|.
    longitudinal_stiffness, cornering_stiffness : float
        C_slip [N], C_alpha [N/rad].
    maximum_friction, minimum_friction : float
        Friction at no slip and in full sliding.
    width : float
        Tyre width, lever of the aligning moment [m].
    """
    if normal <= 0.0:
        return 0.0, 0.0, 0.0
    slip = min(1.0, math.sqrt(longitudinal_slip**2 + lateral_slip**2))
    available = (maximum_friction - (maximum_friction - minimum_friction) * slip) * normal

    if abs(longitudinal_slip) < available / (2.0 * longitudinal_stiffness):
        longitudinal = longitudinal_stiffness * longitudinal_slip
    else:
        longitudinal = math.copysign(
            available - available**2 / (4.0 * abs(longitudinal_slip) * longitudinal_stiffness),
            longitudinal_slip,
        )

    angle = math.atan(lateral_slip)
    if abs(angle) <= math.atan(3.0 * available / cornering_stiffness):
        adhesion = 1.0 - cornering_stiffness * abs(lateral_slip) / (3.0 * available)
        lateral = -math.copysign(available * (1.0 - adhesion**3), angle)
        moment = math.copysign(available * width * (1.0 - adhesion) * adhesion**3, angle)
    else:
        lateral = -math.copysign(available, angle)
        moment = 0.0

    left = math.sqrt(max(0.0, 1.0 - (longitudinal / available) ** 2))
    return longitudinal, left * lateral, left * moment


@numba.njit(cache=True)
def slips(forward: float, sliding: float, sideways: float) -> tuple[float, float]:
    """Slips kappa and tan(alpha) from speeds at the contact [m/s], regularised near standstill.

    Parameters
    ----------
    forward : float
        V_x of the hub.
    sliding : float
        V_sx = V_x - omega R_e of the tread.
    sideways : float
        V_y of the contact.
    """
    speed = max(abs(forward), SLIP_SPEED)
    return -sliding / speed, sideways / speed


@numba.njit(cache=True)
def rolling_moment(normal: float, rolling_speed: float, resistance: float) -> float:
    """Rolling-resistance moment against the wheel's spin, positive when it rolls forward [N m].

    ``resistance`` [m] times the normal force, faded in linearly up to `ROLLING_SPEED`.
    """
    return resistance * normal * min(1.0, max(-1.0, rolling_speed / ROLLING_SPEED))


def tyre_vertical_force(deflection: Array, tyre: Tyre) -> Array:
    """Elastic vertical force of ALL tyres of an axle.

    Parameters
    ----------
    deflection : (n,) array
        [m]; negative values are off the ground.
    tyre : Tyre

    Returns
    -------
    (n,) array
        [N].
    """
    laws = [
        vertical_force(
            d,
            tyre.vertical_coefficient,
            tyre.vertical_exponent,
            tyre.bottoming_deflection,
            tyre.rim_stiffness,
        )
        for d in np.asarray(deflection, dtype=np.float64)
    ]
    return tyre.count * np.array(laws)
