"""The drop test in two phases in the report's units, converged; shares nothing with the solver.

Before the strut breaks out the gear is one mass on a nonlinear spring: energy gives its speed,

    v(z)^2 = V^2 + 2 g (1 - K_L) z - 2 g m z^(r+1) / ((r+1) W),

and a quadrature of dz / v the time.  With the strut moving,

    (W_1 / g) z_1'' = W_1 - K_L W - F_S,    (W_2 / g) z_2'' = W_2 + F_S - m z_2^r,
    F_S = A s' |s'| + p_0 A_a (V_0 / (V_0 - A_a s))^n,    A = rho A_h^3 / (2 (C_d A_n)^2),

(NACA Report 1154, the paper's equations 3 to 6) is integrated by the implicit Radau method of order
five at 1e-12, quintic between its steps, which values, slopes and curvatures at their ends fix.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.interpolate import BPoly
from scipy.optimize import minimize_scalar

from solver.arrays import Array
from verification.gear.naca1154 import FOOT, POUND, POUND_FORCE, DropTestSet

#: Acceleration of gravity in the report's units [ft/s2].
GRAVITY = POUND_FORCE / POUND / FOOT


@dataclass(frozen=True, slots=True)
class TwoPhaseSolution:
    """Peaks and histories, SI units."""

    breakout_time: float  #: [s]
    breakout_deflection: float  #: [m]
    peak_ground_force: float  #: [N]
    peak_ground_force_time: float  #: [s]
    maximum_stroke: float  #: [m]
    maximum_stroke_time: float  #: [s]
    peak_tyre_deflection: float  #: [m]
    maximum_closure_speed: float  #: [m/s]
    peak_upper_acceleration: float  #: upward [m/s2]
    time: Array  #: (nt,) after break-out [s]
    ground_force: Array  #: (nt,) [N]
    stroke: Array  #: (nt,) [m]

    def force_at(self, time: Array) -> Array:
        """Ground force at instants after break-out [N]."""
        return np.interp(time, self.time, self.ground_force)

    def stroke_at(self, time: Array) -> Array:
        """Stroke at instants after break-out [m]."""
        return np.interp(time, self.time, self.stroke)


def two_phase_solution(given: DropTestSet, end: float = 0.3) -> TwoPhaseSolution:
    """Solve up to ``end`` [s], before which the tyre must not leave the ground."""
    weight = given.upper_weight + given.lower_weight
    m, r = given.tyre_coefficient, given.tyre_exponent
    preload = given.gas_pressure * given.pneumatic_area
    orifice = given.discharge_coefficient * given.orifice_area
    oil = given.fluid_density * given.hydraulic_area**3 / (2 * orifice**2)
    lift = given.lift_ratio * weight
    upper, lower = given.upper_weight / GRAVITY, given.lower_weight / GRAVITY

    share = weight / given.upper_weight
    breakout_force = share * (preload + given.lift_ratio * given.lower_weight)
    start = (breakout_force / m) ** (1 / r)

    def speed(z: float) -> float:
        gained = 2 * GRAVITY * (1 - given.lift_ratio) * z
        spent = 2 * GRAVITY * m * z ** (r + 1) / ((r + 1) * weight)
        return float(np.sqrt(given.contact_speed**2 + gained - spent))

    breakout_time = quad(lambda z: 1 / speed(z), 0.0, start, epsabs=0.0, epsrel=1e-13)[0]

    def strut(s: float, rate: float) -> float:
        gas = preload * (1 - given.pneumatic_area * s / given.gas_volume) ** (
            -given.polytropic_exponent
        )
        return float(gas + oil * rate * abs(rate))

    def slope(_time: float, y: Array) -> list[float]:
        z1, w1, z2, w2 = y
        force = strut(z1 - z2, w1 - w2)
        return [
            w1,
            (given.upper_weight - lift - force) / upper,
            w2,
            (given.lower_weight + force - m * abs(z2) ** r) / lower,
        ]

    v = speed(start)
    solution = solve_ivp(
        slope,
        (breakout_time, end),
        [start, v, start, v],
        method="Radau",
        rtol=1e-12,
        atol=1e-13,
        max_step=2.5e-4,
    )
    time, states = solution.t, solution.y
    rates = np.array([slope(0.0, y) for y in states.T]).T
    place = _quintic(time, states[2], states[3], rates[3])
    stroke = _quintic(time, states[0] - states[2], states[1] - states[3], rates[1] - rates[3])
    closure = stroke.derivative()

    def upward(t: float) -> float:
        force = strut(float(stroke(t)), float(closure(t)))
        return (force + lift - given.upper_weight) / upper

    deepest_time, deepest = _peak(time, place)
    stroke_time, longest = _peak(time, stroke)
    fine = np.linspace(breakout_time, end, 20001)
    return TwoPhaseSolution(
        breakout_time=float(breakout_time),
        breakout_deflection=start * FOOT,
        peak_ground_force=m * deepest**r * POUND_FORCE,
        peak_ground_force_time=deepest_time,
        maximum_stroke=longest * FOOT,
        maximum_stroke_time=stroke_time,
        peak_tyre_deflection=deepest * FOOT,
        maximum_closure_speed=_peak(time, closure)[1] * FOOT,
        peak_upper_acceleration=_peak(time, upward)[1] * FOOT,
        time=fine,
        ground_force=m * np.abs(place(fine)) ** r * POUND_FORCE,
        stroke=stroke(fine) * FOOT,
    )


def _quintic(time: Array, value: Array, rate: Array, acceleration: Array) -> BPoly:
    """Interpolate with the slopes and curvatures that the equations give."""
    return BPoly.from_derivatives(time, np.stack([value, rate, acceleration], axis=1))


def _peak(time: Array, function: Callable[[float], float]) -> tuple[float, float]:
    """Time and value of the largest value, refined between instants."""
    best = int(np.argmax([function(t) for t in time]))
    around = (time[max(best - 1, 0)], time[min(best + 1, len(time) - 1)])
    found = minimize_scalar(
        lambda t: -float(function(t)), bounds=around, method="bounded", options={"xatol": 1e-12}
    )
    return float(found.x), -float(found.fun)
