"""The drop test in the paper's own form, integrated independently of `solver.gear.drop_test`.

One set of equations for all times: the strut is always free, and a stiff linear stop for s < 0
(paper Fig. 10) carries the preload.  Classical Runge-Kutta at a fixed step.  No code is shared with
the solver.  The start hangs the lower mass on the stop in equilibrium, so that nothing rings.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

GRAVITY = 9.80665


class Peaks(NamedTuple):
    ground_force: float
    ground_force_time: float
    stroke: float
    tyre_deflection: float
    closure_speed: float
    upper_acceleration: float


def stopper_form(
    given: Mapping[str, float], stop: float = 3e8, step: float = 2e-5, duration: float = 0.3
) -> Peaks:
    """Peaks of one drop; keys of ``given`` as in the command's parameter file."""
    m1, m2 = given["upper_mass_kg"], given["lower_mass_kg"]
    area = given["pneumatic_area_m2"]
    p0, v0 = given["initial_gas_pressure_pa"], given["initial_gas_volume_m3"]
    n, r = given["polytropic_exponent"], given["tyre_exponent"]
    m = given["tyre_coefficient_n_per_m_r"]
    oil = (
        given["fluid_density_kg_m3"]
        * given["hydraulic_area_m2"] ** 3
        / (2 * (given["discharge_coefficient"] * given["orifice_area_m2"]) ** 2)
    )
    lift = given["lift_ratio"] * (m1 + m2) * GRAVITY
    preload = p0 * area

    def ground(z: float) -> float:
        return m * z**r if z > 0 else 0.0

    def strut(s: float, ds: float) -> float:
        gas = preload * (1 - area * s / v0) ** -n if s > 0 else preload + stop * s
        return gas + oil * ds * abs(ds)

    def slope(y: tuple[float, ...]) -> tuple[float, ...]:
        z1, w1, z2, w2 = y
        force = strut(z1 - z2, w1 - w2)
        return (w1, GRAVITY - (lift + force) / m1, w2, GRAVITY + (force - ground(z2)) / m2)

    fall = GRAVITY * (1 - given["lift_ratio"])
    hanging = preload + m2 * (GRAVITY - fall)
    y: tuple[float, ...] = (
        -hanging / stop,
        given["contact_speed_m_s"],
        0.0,
        given["contact_speed_m_s"],
    )
    best = [0.0, 0.0, 0.0, 0.0, 0.0, -math.inf]
    time = 0.0
    while time < duration:
        k1 = slope(y)
        k2 = slope(tuple(a + step / 2 * b for a, b in zip(y, k1, strict=True)))
        k3 = slope(tuple(a + step / 2 * b for a, b in zip(y, k2, strict=True)))
        k4 = slope(tuple(a + step * b for a, b in zip(y, k3, strict=True)))
        y = tuple(
            a + step / 6 * (b + 2 * c + 2 * d + e)
            for a, b, c, d, e in zip(y, k1, k2, k3, k4, strict=True)
        )
        time += step
        z1, w1, z2, w2 = y
        if ground(z2) > best[0]:
            best[0], best[1], best[3] = ground(z2), time, z2
        best[2] = max(best[2], z1 - z2)
        best[4] = max(best[4], w1 - w2)
        best[5] = max(best[5], -slope(y)[1])
    return Peaks(*best)
