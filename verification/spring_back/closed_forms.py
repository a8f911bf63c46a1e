"""Spin-up and spring-back under the assumptions of their closed forms.

Spin-up (14 CFR 23 appendix D, D23.1, after NACA TN 863): with constant friction n and a vertical
force that grows as F_V t / t_s, the wheel of inertia I_w and rolling radius r_e reaches the speed V
of the ground when the drag is

    F_H = sqrt(2 I_w V n F_V / t_s) / r_e.

Fiala's drag stays below n F_v while it slides, by n F_v / (4 C kappa), and the slip is
kappa = 1 - (t / t_su)^2; its largest value lies sqrt(2 a) below to first order, a = n F_v / (4 C).

Spring-back: an undamped leg under that ramp, which ends at once, swings freely with an amplitude of
F_H times the factor of `solver.gear.spring_back.ramp_spring_back_factor`.

The simulation is set alike: a linear tyre under a mass that nothing stops, a strut preloaded beyond
all that comes, and a leg whose unsprung mass and stiffness leave the ground's force no lever.
"""

from collections.abc import Sequence

import numpy as np

from solver.arrays import Array
from solver.gear.parameters import Gear, SpringBack, Strut, Tyre
from solver.gear.spring_back import ramp_spring_back_factor
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.history import GearHistory, LandingHistory
from solver.landing.peaks import refined_peak
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.chapter import Plot
from verification.comparison import Comparison
from verification.plots import Line, Panel, line_plot

STIFFNESS = 1e6  #: of the tyre [N/m]
SINK = 1.0  #: [m/s]
SPEED = 50.0  #: [m/s]
FRICTION = 0.5
RADIUS = 20.0  #: large against the tyre's deflection [m]
WHEEL_INERTIA = 1600.0  #: [kg m2]
UNSPRUNG_MASS = 3e4  #: large against WHEEL_INERTIA / RADIUS^2 [kg]
AIRCRAFT_MASS = 1e8  #: that nothing stops [kg]

#: Slip stiffnesses over which the drag approaches the closed form [N].
SLIP_STIFFNESSES = (1e6, 1e7, 1e8, 1e9)

#: Swing frequency times spin-up time.
RAMP_ANGLES = (1.0, 2.0, 3.0, 4.0, 5.0, 2 * np.pi, 8.0, 10.0)

APPENDIX_D = "14 CFR 23 appendix D, D23.1, closed form for constant friction and a linear ramp"


def spin_up_load() -> float:
    """Drag at the end of the spin-up by the closed form [N]."""
    ramp = STIFFNESS * SINK  # F_V / t_s
    return float(np.sqrt(2 * WHEEL_INERTIA * SPEED * FRICTION * ramp) / RADIUS)


def spin_up_time() -> float:
    """Time until the wheel rolls [s]."""
    return spin_up_load() / (FRICTION * STIFFNESS * SINK)


def simulated(slip_stiffness: float, ramp_angle: float | None = None) -> LandingHistory:
    """Set the simulation alike; without a ``ramp_angle`` the leg is rigid."""
    duration = 1.2 * spin_up_time()
    leg = SpringBack.rigid()
    if ramp_angle is not None:
        frequency = ramp_angle / spin_up_time()
        leg = SpringBack(stiffness=frequency**2 * UNSPRUNG_MASS, damping_ratio=0.0)
        duration = spin_up_time() + 1.1 * 2 * np.pi / frequency
    tyre = Tyre(
        free_radius=RADIUS,
        vertical_coefficient=STIFFNESS,
        vertical_exponent=1.0,
        longitudinal_stiffness=slip_stiffness,
        cornering_stiffness=1e6,
        maximum_friction=FRICTION,
        minimum_friction=FRICTION,
        width=0.2,
        wheel_inertia=WHEEL_INERTIA,
    )
    strut = Strut(
        pneumatic_area=0.1,
        initial_gas_pressure=1e8,
        initial_gas_volume=0.1,
        polytropic_exponent=1.0,
        compression_coefficient=0.0,
        rebound_coefficient=0.0,
        full_stroke=0.5,
        extended_length=1.0,
        stop_stiffness=1e10,
    )
    gear = Gear("gear", strut, tyre, leg, UNSPRUNG_MASS, np.zeros(3))
    aircraft = LandingAircraft(AIRCRAFT_MASS, np.array([0, 0, 1.0]), 1e9 * np.eye(3), (gear,))
    return simulate_landing(
        aircraft,
        Contact(SINK, SPEED, lift=Lift(LiftModel.HELD)),
        SimulationOptions(
            time_limit=duration, output_interval=2e-5, tolerance=1e-9, stop_when_settled=False
        ),
    )


def spin_up() -> tuple[Plot, tuple[Comparison, ...]]:
    """Drag against its closed form, and how it approaches it as the tyre stiffens."""
    load, time = spin_up_load(), spin_up_time()
    gears = [simulated(stiffness).gears[0] for stiffness in SLIP_STIFFNESSES]
    times = simulated_times(gears)
    peaks = [
        refined_peak(t, -gear.ground_force[:, 0]) for t, gear in zip(times, gears, strict=True)
    ]
    short = np.array([1 - peak / load for _, peak in peaks])
    stiffnesses = np.array(SLIP_STIFFNESSES)
    first_order = np.sqrt(load / (2 * stiffnesses))
    instants = np.array([0.0, time])
    plot = line_plot(
        "spring-back-spin-up",
        "Drag of a wheel that spins up under a vertical force growing in proportion to time, "
        "against the closed form of 14 CFR 23 appendix D; and by how much its peak falls short "
        "as the tyre yields to slip, against the first order of Fiala's law.",
        [
            Panel(
                "time [ms]",
                "drag [kN]",
                [
                    *[
                        Line(
                            t * 1e3, -gear.ground_force[:, 0] / 1e3, f"{c:.0e} N".replace("+0", "")
                        )
                        for t, gear, c in list(zip(times, gears, SLIP_STIFFNESSES, strict=True))[
                            ::2
                        ]
                    ],
                    Line(instants * 1e3, instants / time * load / 1e3, "closed form", "dashed"),
                ],
                "Spin-up at two slip stiffnesses",
            ),
            Panel(
                "slip stiffness of the tyre [N]",
                "short of the closed form",
                [
                    Line(stiffnesses, first_order, "first order", "dotted", colour=4),
                    Line(stiffnesses, short, "simulated", "marked", colour=0),
                ],
                "Approach",
                log="xy",
            ),
        ],
    )
    found_time, found = peaks[2]
    slope = float(np.polyfit(np.log(stiffnesses), np.log(short), 1)[0])
    return plot, (
        Comparison(
            "largest drag, slip stiffness 1e8 N",
            found,
            load * (1 - float(first_order[2])),
            2e-3,
            "N",
            APPENDIX_D + ", less the first order of the tyre's slip",
            "second order of the slip, a tenth of the first at this stiffness",
        ),
        Comparison(
            "time of the largest drag, slip stiffness 1e8 N",
            found_time,
            time,
            1e-2,
            "s",
            APPENDIX_D,
            "the slip of the last instants, of the size of the first-order term",
        ),
        Comparison(
            "largest drag, slip stiffness 1e9 N",
            peaks[3][1],
            load,
            5e-3,
            "N",
            APPENDIX_D,
            "the first order of the tyre's slip is 0.27 % here",
        ),
        Comparison(
            "order in the tyre's compliance to slip",
            -slope,
            0.5,
            0.1,
            "",
            "first order of Fiala's law",
            "second order at the softest tyre",
        ),
    )


def simulated_times(gears: Sequence[GearHistory]) -> list[Array]:
    """Instants of histories on the fine grid of `simulated` [s]."""
    return [np.asarray(2e-5 * np.arange(len(gear.stroke))) for gear in gears]


def ramp_response() -> tuple[Plot, tuple[Comparison, ...]]:
    """Forward load of the leg after the spin-up over the spin-up load."""
    load, time = spin_up_load(), spin_up_time()
    rows, factors = [], []
    for angle in RAMP_ANGLES:
        history = simulated(1e8, angle)
        after = history.time > time
        factors.append(float(history.gears[0].wrench[after, 0].max()) / load)
        rows.append(
            Comparison(
                f"forward load over spin-up load, ω t = {angle:.3g}",
                factors[-1],
                ramp_spring_back_factor(angle),
                2e-3,
                "",
                "undamped oscillator after a linear ramp that ends at once",
                "the tyre's slip rounds the ramp's end; the wheel adds 0.01 % to the swinging mass",
            )
        )
    fine = np.linspace(0.2, 12.0, 240)
    shown = history_of_swing(4.0)
    plot = line_plot(
        "spring-back-ramp",
        "Spring-back after a ramp of drag: the load of the leg on the airframe, aft positive, at "
        "a product of swing frequency and spin-up time of 4; and the largest forward load over the "
        "spin-up load against that product, simulated and in closed form.",
        [
            Panel(
                "time [ms]",
                "load [kN]",
                [
                    Line(shown[0] * 1e3, shown[1] / 1e3, "ground", colour=1),
                    Line(shown[0] * 1e3, shown[2] / 1e3, "airframe", colour=0),
                ],
                "Drag at the ground and on the airframe",
            ),
            Panel(
                "swing frequency times spin-up time [rad]",
                "forward over spin-up load",
                [
                    Line(
                        fine,
                        np.array([ramp_spring_back_factor(x) for x in fine]),
                        "closed form",
                        colour=1,
                    ),
                    Line(
                        np.array(RAMP_ANGLES),
                        np.array(factors),
                        "simulated",
                        "points",
                        colour=0,
                        label_at=10.0,
                    ),
                ],
                "Amplitude",
            ),
        ],
    )
    return plot, tuple(rows)


def history_of_swing(angle: float) -> tuple[Array, Array, Array]:
    """Time [s], drag of the ground and load on the airframe, aft positive [N]."""
    history = simulated(1e8, angle)
    gear = history.gears[0]
    return history.time, -gear.ground_force[:, 0], -gear.wrench[:, 0]
