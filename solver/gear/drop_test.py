"""Drop test of a landing gear, NACA Report 1154 (Milwitzky & Cook, 1953).

A mass W = W_1 + W_2 falls at V on a vertical gear while a lift K_L W acts on the upper mass.
First the strut is rigid, one degree of freedom z:

    (W / g) z'' = W (1 - K_L) - F(z)

until the force it transmits reaches its preload, F = (W / W_1) (p_0 A_a + K_L W_2).  Then two
degrees of freedom, s = z_1 - z_2:

    (W_1 / g) z_1'' = W_1 - K_L W - F_S        (W_2 / g) z_2'' = W_2 + F_S - F(z_2)
    F_S = C s' |s'| + p_0 A_a (V_0 / (V_0 - A_a s))^n,   C = rho A_h^3 / (2 (C_d A_n)^2)

A strut that comes back to full extension strikes its stop: the two masses go on together, momentum
is kept, the energy lost counts as dissipated, and the strut is rigid again until it next breaks
out.  A strut whose preload is never exceeded stays rigid, its stroke is zero.  The test ends when
the tyre leaves the ground with both masses on their way up, or at `TIME_LIMIT`.

The parameters know no full stroke; the gas volume limits the stroke to V_0 / A_a.  With n >= 1 the
gas law itself stops the mass before; should the volume shrink to a millionth (possible only for
n < 1 or absurd loads) the test ends with an error rather than an invented stop.

Each phase is integrated by DOP853 (Hairer, Norsett & Wanner) with events at break-out, return and
lift-off, to a relative tolerance of 1e-10; peaks are refined on its dense output.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from solver.arrays import Array
from solver.errors import RecordError, SimulationDivergedError, StrutBottomedError
from solver.gear.oleo import SMALLEST_VOLUME, gas_energy, gas_force, hydraulic_force
from solver.gear.parameters import hydraulic_coefficient
from solver.gear.tyre import vertical_energy, vertical_force

#: Standard acceleration of gravity (ISO 80000-3) [m/s2].
GRAVITY = 9.80665
#: Longest test [s].
TIME_LIMIT = 3.0
#: Relative tolerance of the integration.
TOLERANCE = 1e-10
#: Break-outs and returns after which a test counts as chattering.
PHASE_LIMIT = 200
#: How long a strut that opens up again at once goes on before its return is looked for [s].
CLEARANCE_TIME = 1e-5
#: Samples per phase among which peaks are looked for.
SAMPLES = 1500


@dataclass(frozen=True, slots=True)
class DropTestParameters:
    """One drop test."""

    upper_mass: float  #: W_1 / g [kg]
    lower_mass: float  #: W_2 / g [kg]
    pneumatic_area: float  #: A_a [m2]
    hydraulic_area: float  #: A_h [m2]
    orifice_area: float  #: A_n, net [m2]
    discharge_coefficient: float  #: C_d
    fluid_density: float  #: rho [kg/m3]
    initial_gas_pressure: float  #: p_0 [Pa]
    initial_gas_volume: float  #: V_0 [m3]
    polytropic_exponent: float  #: n
    tyre_coefficient: float  #: m of F = m z^r [N/m^r]
    tyre_exponent: float  #: r
    lift_ratio: float  #: K_L
    contact_speed: float  #: V [m/s]

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            may_vanish = name in ("lift_ratio", "polytropic_exponent")
            if not (math.isfinite(value) and (value > 0 or (may_vanish and value == 0))):
                raise RecordError(f"{name} {value:g} must be finite and above 0")

    @property
    def mass(self) -> float:
        """Of both parts [kg]."""
        return self.upper_mass + self.lower_mass

    @property
    def preload(self) -> float:
        """p_0 A_a [N]."""
        return self.initial_gas_pressure * self.pneumatic_area

    @property
    def breakout_force(self) -> float:
        """Ground force at which the strut starts to move [N]."""
        lift_share = self.lift_ratio * self.lower_mass * GRAVITY
        return self.mass / self.upper_mass * (self.preload + lift_share)

    @property
    def stroke_limit(self) -> float:
        """Stroke at which the gas volume would be used up [m]."""
        return self.initial_gas_volume / self.pneumatic_area


@dataclass(frozen=True, slots=True)
class DropTestHistory:
    """Course of a test; each (nt,)."""

    time: Array  #: from contact [s]
    upper_displacement: Array  #: z_1 [m]
    tyre_deflection: Array  #: z_2, negative off the ground [m]
    stroke: Array  #: [m]
    closure_speed: Array  #: s' [m/s]
    ground_force: Array  #: [N]
    strut_force: Array  #: transmitted to the upper mass [N]
    upper_acceleration: Array  #: upward [m/s2]


@dataclass(frozen=True, slots=True)
class DropTestResult:
    """Peaks of a test.  Times that never come are None."""

    breakout_time: float | None  #: [s]
    peak_ground_force: float  #: [N]
    peak_ground_force_time: float  #: [s]
    maximum_stroke: float  #: [m]
    maximum_stroke_time: float | None  #: [s]
    peak_tyre_deflection: float  #: [m]
    maximum_closure_speed: float  #: [m/s]
    peak_upper_acceleration: float  #: upward [m/s2]
    energy_error: float  #: imbalance at the end over the kinetic energy at contact
    history: DropTestHistory


@dataclass(frozen=True, slots=True)
class _Phase:
    """A stretch without events: states z_1, z_1', z_2, z_2', energy lost in the oil."""

    start: float
    end: float
    states: Callable[[Array], Array]  #: dense output, (nt,) to (5, nt)
    is_rigid: bool


class _Equations:
    """Right-hand sides and forces of one test."""

    def __init__(self, parameters: DropTestParameters) -> None:
        self.parameters = parameters
        p = parameters
        self.coefficient = hydraulic_coefficient(
            p.fluid_density, p.hydraulic_area, p.discharge_coefficient, p.orifice_area
        )

    def ground_force(self, deflection: float) -> float:
        p = self.parameters
        force: float = vertical_force(
            deflection, p.tyre_coefficient, p.tyre_exponent, math.inf, 0.0
        )
        return force

    def oil_force(self, rate: float) -> float:
        force: float = hydraulic_force(rate, self.coefficient, self.coefficient)
        return force

    def free_strut_force(self, stroke: float, rate: float) -> float:
        p = self.parameters
        gas: float = gas_force(
            stroke,
            p.pneumatic_area,
            p.initial_gas_pressure,
            p.initial_gas_volume,
            p.polytropic_exponent,
        )
        return gas + self.oil_force(rate)

    def strut_force(self, state: Array, is_rigid: bool) -> float:
        """Force on the upper mass [N]; a rigid strut transmits what the motion asks for."""
        p = self.parameters
        if is_rigid:
            share = p.upper_mass / p.mass
            lift = p.lift_ratio * p.lower_mass * GRAVITY
            return share * self.ground_force(state[2]) - lift
        return self.free_strut_force(state[0] - state[2], state[1] - state[3])

    def upper_acceleration(self, strut_force: float) -> float:
        """Downward [m/s2]."""
        p = self.parameters
        return GRAVITY - (p.lift_ratio * p.mass * GRAVITY + strut_force) / p.upper_mass

    def rigid(self, _time: float, state: Array) -> list[float]:
        p = self.parameters
        fall = GRAVITY * (1 - p.lift_ratio) - self.ground_force(state[2]) / p.mass
        return [state[1], fall, state[3], fall, 0.0]

    def free(self, _time: float, state: Array) -> list[float]:
        rate = state[1] - state[3]
        force = self.free_strut_force(state[0] - state[2], rate)
        lower = GRAVITY + (force - self.ground_force(state[2])) / self.parameters.lower_mass
        return [
            state[1],
            self.upper_acceleration(force),
            state[3],
            lower,
            self.oil_force(rate) * rate,
        ]

    def stored(self, state: Array) -> float:
        """Energy of motion, tyre, gas and position, lift taken off [J]."""
        p = self.parameters
        kinetic = 0.5 * (p.upper_mass * state[1] ** 2 + p.lower_mass * state[3] ** 2)
        tyre: float = vertical_energy(state[2], p.tyre_coefficient, p.tyre_exponent, math.inf, 0.0)
        gas: float = gas_energy(
            state[0] - state[2],
            p.pneumatic_area,
            p.initial_gas_pressure,
            p.initial_gas_volume,
            p.polytropic_exponent,
        )
        weight = (p.upper_mass * state[0] + p.lower_mass * state[2]) * GRAVITY
        return float(kinetic + tyre + gas - weight + p.lift_ratio * p.mass * GRAVITY * state[0])


def drop_test(parameters: DropTestParameters) -> DropTestResult:
    """Run one drop test.

    Raises
    ------
    StrutBottomedError
        The gas volume is used up.
    SimulationDivergedError
        The strut breaks out and returns without end, or the integration fails.
    """
    equations = _Equations(parameters)
    phases, impact_loss, final = _phases(equations)
    before = 0.5 * parameters.mass * parameters.contact_speed**2
    imbalance = equations.stored(final) + final[4] + impact_loss - before

    broken_out = [phase.start for phase in phases if not phase.is_rigid]

    def ground(state: Array, _is_rigid: bool) -> float:
        return equations.ground_force(state[2])

    def upward(state: Array, is_rigid: bool) -> float:
        return -equations.upper_acceleration(equations.strut_force(state, is_rigid))

    force_time, force = _peak(phases, ground)
    stroke_time, stroke = _peak(phases, lambda state, _: float(state[0] - state[2]))
    closure = _peak(phases, lambda state, _: float(state[1] - state[3]))[1]
    return DropTestResult(
        breakout_time=broken_out[0] if broken_out else None,
        peak_ground_force=force,
        peak_ground_force_time=force_time,
        maximum_stroke=stroke if broken_out else 0.0,
        maximum_stroke_time=stroke_time if broken_out else None,
        peak_tyre_deflection=_peak(phases, lambda state, _: float(state[2]))[1],
        maximum_closure_speed=closure if broken_out else 0.0,
        peak_upper_acceleration=_peak(phases, upward)[1],
        energy_error=float(abs(imbalance) / before),
        history=_history(equations, phases),
    )


def _phases(equations: _Equations) -> tuple[list[_Phase], float, Array]:
    """Integrate phase by phase; also the energy lost at the stop [J], and the last state."""
    p = equations.parameters

    def breaks_out(_time: float, state: Array) -> float:
        return equations.ground_force(state[2]) - p.breakout_force

    def returns(_time: float, state: Array) -> float:
        return float(state[0] - state[2])

    def leaves_ground(_time: float, state: Array) -> float:
        return float(state[2])

    def lands(_time: float, state: Array) -> float:
        return float(state[2])

    def bottoms(_time: float, state: Array) -> float:
        return float(state[0] - state[2] - p.stroke_limit * (1 - 2 * SMALLEST_VOLUME))

    _terminal(breaks_out, 1)
    _terminal(returns, -1)
    _terminal(leaves_ground, -1)
    _terminal(lands, 1)
    _terminal(bottoms, 1)

    time, is_rigid, is_on_ground, impact_loss = 0.0, True, True, 0.0
    state = np.array([0.0, p.contact_speed, 0.0, p.contact_speed, 0.0])
    phases: list[_Phase] = []
    for _ in range(PHASE_LIMIT):
        events = [leaves_ground if is_on_ground else lands]
        events += [breaks_out] if is_rigid else [returns, bottoms]
        solution = solve_ivp(
            equations.rigid if is_rigid else equations.free,
            (time, TIME_LIMIT),
            state,
            method="DOP853",
            rtol=TOLERANCE,
            atol=1e-13,
            max_step=0.01,
            events=events,
            dense_output=True,
        )
        if not solution.success:
            raise SimulationDivergedError(f"the drop test's integration failed: {solution.message}")
        end = float(solution.t[-1])
        if end > time:
            phases.append(_Phase(time, end, solution.sol, is_rigid))
        time, state = end, solution.y[:, -1].copy()
        if solution.status == 0:
            return phases, impact_loss, state
        crossed, other = len(solution.t_events[0]) > 0, len(solution.t_events[1]) > 0
        if not is_rigid and len(solution.t_events[2]) > 0:
            raise StrutBottomedError(
                f"the strut reaches {p.stroke_limit:.4g} m, where its gas volume is used up, "
                f"{time:.4g} s after contact"
            )
        if crossed:
            is_on_ground = not is_on_ground
            if not is_on_ground and state[1] < 0 and state[1] <= state[3]:
                return phases, impact_loss, state
        if other and is_rigid:
            is_rigid = False
        elif other:
            closing = state[1] - state[3]
            reduced = p.upper_mass * p.lower_mass / p.mass
            impact_loss += 0.5 * reduced * closing**2
            state[1] = state[3] = (p.upper_mass * state[1] + p.lower_mass * state[3]) / p.mass
            state[0] = state[2]
            is_rigid = breaks_out(time, state) <= 0
            if not is_rigid:
                # More than the break-out force is on the tyre and the strut opens up again at
                # once; the return event must not see its start at zero stroke.
                part = solve_ivp(
                    equations.free,
                    (time, time + CLEARANCE_TIME),
                    state,
                    method="DOP853",
                    rtol=TOLERANCE,
                    atol=1e-13,
                    dense_output=True,
                )
                phases.append(_Phase(time, time + CLEARANCE_TIME, part.sol, is_rigid=False))
                time, state = time + CLEARANCE_TIME, part.y[:, -1].copy()
    raise SimulationDivergedError(f"the strut broke out or returned {PHASE_LIMIT} times")


def _terminal(event: Any, direction: int) -> None:  # solve_ivp reads attributes of the function
    event.terminal = True
    event.direction = direction


def _peak(phases: list[_Phase], quantity: Callable[[Array, bool], float]) -> tuple[float, float]:
    """Time and value of a quantity's largest value over all phases, refined between samples."""
    best = (0.0, -math.inf)
    for phase in phases:
        times = np.linspace(phase.start, phase.end, SAMPLES)
        states = phase.states(times)
        values = [quantity(states[:, i], phase.is_rigid) for i in range(SAMPLES)]
        index = int(np.argmax(values))
        if values[index] > best[1]:
            best = (float(times[index]), values[index])
        low, high = times[max(index - 1, 0)], times[min(index + 1, SAMPLES - 1)]
        refined = minimize_scalar(
            lambda time, phase=phase: -quantity(phase.states(time), phase.is_rigid),
            bounds=(low, high),
            method="bounded",
            options={"xatol": 1e-12},
        )
        if -refined.fun > best[1]:
            best = (float(refined.x), float(-refined.fun))
    return best


def _history(equations: _Equations, phases: list[_Phase]) -> DropTestHistory:
    """Course at half milliseconds and at the ends of the phases."""
    columns = []
    for phase in phases:
        count = max(2, math.ceil((phase.end - phase.start) / 5e-4) + 1)
        times = np.linspace(phase.start, phase.end, count)
        for time, state in zip(times, phase.states(times).T, strict=True):
            force = equations.strut_force(state, phase.is_rigid)
            columns.append(
                [
                    time,
                    state[0],
                    state[2],
                    state[0] - state[2],
                    state[1] - state[3],
                    equations.ground_force(state[2]),
                    force,
                    -equations.upper_acceleration(force),
                ]
            )
    return DropTestHistory(*np.array(columns).T)
