"""Force laws of the oleo-pneumatic strut: gas, oil, the stops at both ends, friction.

Axial forces are compression positive, strokes count from full extension.  The paper's equations
(3) to (6) and its Fig. 10: F_s = F_h + F_a + F_f and a stiff linear stop for negative stroke.

At full extension the gas still pushes with its preload p_0 A_a and the extension stop carries it.
With the stop's stiffness k the strut rests at s = -(preload + hanging weight) / k, a fraction of a
millimetre; until an outer force exceeds the preload it moves by no more than that, so it is rigid
as far as the landing can tell, without any switch that could chatter.

A stop is a spring with damping in proportion to its deflection (Hunt & Crossley, Journal of
Applied Mechanics 42, 1975): force k d (1 + c d'), never pulling.  It starts from zero, so contact
begins without a jump, and over any closed cycle it takes energy and gives none.
"""

import math

import numba
import numpy as np

from solver.arrays import Array
from solver.gear.parameters import Strut

#: Share of the initial gas volume below which the gas law is frozen.  No admissible motion gets
#: there (the closed stop comes first); it keeps a rejected trial step of an integrator finite.
SMALLEST_VOLUME = 1e-6


@numba.njit(cache=True)
def gas_force(stroke: float, area: float, pressure: float, volume: float, exponent: float) -> float:
    """Polytropic gas spring, p_0 A_a (V_0 / (V_0 - A_a s))^n [N]; paper equation (6)."""
    share = max(1.0 - area * stroke / volume, SMALLEST_VOLUME)
    return pressure * area * math.pow(share, -exponent)


@numba.njit(cache=True)
def gas_energy(
    stroke: float, area: float, pressure: float, volume: float, exponent: float
) -> float:
    """Integral of `gas_force` from full extension to ``stroke`` [J]."""
    share = max(1.0 - area * stroke / volume, SMALLEST_VOLUME)
    if abs(exponent - 1.0) < 1e-9:
        return -pressure * volume * math.log(share)
    return pressure * volume * (math.pow(share, 1.0 - exponent) - 1.0) / (exponent - 1.0)


@numba.njit(cache=True)
def hydraulic_force(
    rate: float, compression_coefficient: float, rebound_coefficient: float
) -> float:
    """Force of the oil through its orifice, sign(s') C s'^2 [N]; paper equation (5).

    ``compression_coefficient`` is that of the orifice at the present stroke.
    """
    if rate > 0.0:
        return compression_coefficient * rate * rate
    return -rebound_coefficient * rate * rate


@numba.njit(cache=True)
def area_ratio(stroke: float, strokes: Array, ratios: Array, count: int) -> float:
    """Net orifice area over its reference, linear in the table, constant beyond its ends.

    The first ``count`` entries of the table count; without any the ratio is 1.
    """
    if count == 0:
        return 1.0
    if stroke <= strokes[0]:
        return float(ratios[0])
    for i in range(1, count):
        if stroke < strokes[i]:
            share = (stroke - strokes[i - 1]) / (strokes[i] - strokes[i - 1])
            return float(ratios[i - 1] + share * (ratios[i] - ratios[i - 1]))
    return float(ratios[count - 1])


@numba.njit(cache=True)
def stop_force(deflection: float, rate: float, stiffness: float, damping: float) -> float:
    """Force of a stop, k d (1 + c d') and never negative [N]; zero when not touched."""
    if deflection <= 0.0:
        return 0.0
    return max(0.0, stiffness * deflection * (1.0 + damping * rate))


@numba.njit(cache=True)
def friction_force(rate: float, friction: float, fading_rate: float) -> float:
    """Dry friction with a smooth change of sign, F tanh(s' / s'_0) [N]."""
    return friction * math.tanh(rate / fading_rate)


def oleo_force(stroke: Array, rate: Array, strut: Strut) -> Array:
    """Axial force of a strut with its stops and friction, compression positive.

    Parameters
    ----------
    stroke : (n,) array
        From full extension [m]; slightly negative on the extension stop.
    rate : (n,) array
        Closure rate [m/s], negative while the strut extends.
    strut : Strut

    Returns
    -------
    (n,) array
        Force on the airframe along the strut axis [N].
    """
    strokes = np.array([point[0] for point in strut.metering], dtype=np.float64)
    ratios = np.array([point[1] for point in strut.metering], dtype=np.float64)
    force = np.empty(np.broadcast(stroke, rate).shape)
    for index, (s, ds) in enumerate(np.broadcast(stroke, rate)):
        coefficient = (
            strut.compression_coefficient / area_ratio(s, strokes, ratios, len(strokes)) ** 2
        )
        k, c = strut.stop_stiffness, strut.stop_damping
        force.flat[index] = (
            gas_force(
                s,
                strut.pneumatic_area,
                strut.initial_gas_pressure,
                strut.initial_gas_volume,
                strut.polytropic_exponent,
            )
            + hydraulic_force(ds, coefficient, strut.rebound_coefficient)
            + friction_force(ds, strut.seal_friction, strut.friction_speed)
            + stop_force(s - strut.full_stroke, ds, k, c)
            - stop_force(-s, -ds, k, c)
        )
    return force
