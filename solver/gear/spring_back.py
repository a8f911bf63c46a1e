"""Spring-back: the leg as a rigid link on a rotational spring at its pivot.

The spring gives the axle the fore-aft displacement of the bent leg under a transverse force at the
axle: a cantilever of length L and rigidity E I deflects P L^3 / (3 E I), the link L theta, and
P L = k theta, hence k = 3 E I / L.  For a cylinder (E1 I1, length L_c at the root) that holds a
piston (E2 I2) the same argument with a = L - L_c gives

    k = L^2 / (a^3 / (3 E2 I2) + (L^3 - a^3) / (3 E1 I1)),

which stiffens as the strut closes.  The compliance of pivot and drag brace adds in series.
"""

import math

import numba
import numpy as np

from solver.arrays import Array
from solver.gear.parameters import SpringBack


@numba.njit(cache=True)
def two_tube_stiffness(
    length: float,
    cylinder_rigidity: float,
    piston_rigidity: float,
    cylinder_length: float,
    attachment_stiffness: float,
) -> tuple[float, float]:
    """Rotational stiffness k [N m/rad] at the leg's length, and its slope dk/dL [N/rad]."""
    piston = max(length - cylinder_length, 0.0)
    compliance = piston**3 / (3.0 * piston_rigidity) + (length**3 - piston**3) / (
        3.0 * cylinder_rigidity
    )
    slope = piston**2 / piston_rigidity + (length**2 - piston**2) / cylinder_rigidity
    # k = 1 / (compliance / L^2 + 1 / attachment); the slope is that of its inverse.
    inverse = compliance / length**2 + 1.0 / attachment_stiffness
    inverse_slope = slope / length**2 - 2.0 * compliance / length**3
    return 1.0 / inverse, -inverse_slope / inverse**2


@numba.njit(cache=True)
def swing_damping(stiffness: float, ratio: float, mass: float, length: float) -> float:
    """Rotational damping 2 zeta sqrt(k m) L of an axle mass on the leg [N m s/rad]."""
    return 2.0 * ratio * math.sqrt(stiffness * mass) * length


def rotational_stiffness(spring_back: SpringBack, length: Array) -> Array:
    """Stiffness of the spring at given leg lengths.

    Parameters
    ----------
    spring_back : SpringBack
    length : (n,) array
        Pivot to axle [m].

    Returns
    -------
    (n,) array
        [N m/rad].
    """
    lengths = np.asarray(length, dtype=np.float64)
    if not spring_back.is_two_tube:
        return np.full(lengths.shape, spring_back.stiffness)
    return np.array(
        [
            two_tube_stiffness(
                one,
                spring_back.cylinder_rigidity,
                spring_back.piston_rigidity,
                spring_back.cylinder_length,
                spring_back.attachment_stiffness,
            )[0]
            for one in lengths
        ]
    )


def ramp_spring_back_factor(ramp_angle: float) -> float:
    """Spring-back over spin-up load for a linear drag ramp that ends at once, undamped.

    Parameters
    ----------
    ramp_angle : float
        x = omega t, swing frequency times spin-up time [rad].

    Notes
    -----
    Amplitude of the free swing of an undamped oscillator after a linear ramp to F_0 that ends at
    once, as a factor on F_0: sqrt((1 - sin x / x)^2 + ((1 - cos x) / x)^2).
    """
    x = ramp_angle
    return math.hypot(1 - math.sin(x) / x, (1 - math.cos(x)) / x)
