"""Spring-back in a landing of the example aircraft: with it and without it, main and nose gear."""

from dataclasses import dataclass, replace

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.frames import rotation_matrix
from solver.gear.parameters import Gear, SpringBack
from solver.gear.spring_back import ramp_spring_back_factor
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.history import GearHistory, LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.chapter import Plot, Table
from verification.comparison import Comparison
from verification.plots import Line, Panel, line_plot

#: 10 ft/s at the maximum landing mass, the design landing of 14 CFR 25.473.
CONTACT = Contact(sink_rate=3.048, ground_speed=55.0, pitch=float(np.radians(3.0)))
DURATION = 0.5  #: [s]
RULE_FRICTION = 0.8  #: n of 14 CFR 23 appendix D
GEARS = ("main_left", "nose")
TITLES = {"main_left": "main gear", "nose": "nose gear"}


@dataclass(frozen=True, slots=True)
class GearForces:
    """One gear in one landing; forces of the gear on the airframe in earth axes."""

    gear: Gear
    history: GearHistory
    time: Array  #: (nt,) [s]
    contact: float  #: instant at which it meets the ground [s]
    aft: Array  #: (nt,) longitudinal force on the airframe, aft positive [N]
    upward: Array  #: (nt,) vertical force of the ground [N]
    drag: Array  #: (nt,) longitudinal force of the ground, aft positive [N]

    @property
    def spin_up(self) -> int:
        """Index of the largest drag of the ground."""
        return int(self.drag.argmax())

    @property
    def swing_frequency(self) -> Array:
        """Of the unsprung mass on the leg at its present length (nt,) [rad/s]."""
        length = self.gear.strut.extended_length - self.history.stroke
        root: float = np.sqrt(self.gear.spring_back.stiffness / self.gear.unsprung_mass)
        return np.asarray(root / length)


@dataclass(frozen=True, slots=True)
class Landings:
    """The same landing with spring-back and with rigid legs."""

    with_it: dict[str, GearForces]
    without: dict[str, GearForces]
    energy_errors: tuple[float, float]


def landings(airframe: Airframe) -> Landings:
    """Simulate both."""
    loading = airframe.loading_for(mass=airframe.definition.masses.maximum_landing)
    aircraft = airframe.landing_aircraft(loading.factors)
    rigid = replace(
        aircraft,
        gears=tuple(replace(gear, spring_back=SpringBack.rigid()) for gear in aircraft.gears),
    )
    springy_history, rigid_history = _simulated(aircraft), _simulated(rigid)
    return Landings(
        _forces(aircraft, springy_history),
        _forces(rigid, rigid_history),
        (springy_history.energy.closure_error, rigid_history.energy.closure_error),
    )


def _simulated(aircraft: LandingAircraft) -> LandingHistory:
    return simulate_landing(
        aircraft,
        CONTACT,
        SimulationOptions(time_limit=DURATION, output_interval=2.5e-4, stop_when_settled=False),
    )


def _forces(aircraft: LandingAircraft, history: LandingHistory) -> dict[str, GearForces]:
    turns = np.array([rotation_matrix(attitude) for attitude in history.attitude])
    result = {}
    for gear, course in zip(aircraft.gears, history.gears, strict=True):
        on_airframe = np.einsum("tij,tj->ti", turns, course.wrench[:, :3])
        result[gear.name] = GearForces(
            gear=gear,
            history=course,
            time=history.time,
            contact=next(c.start for c in history.contacts if c.gear == gear.name),
            aft=-on_airframe[:, 0],
            upward=-course.ground_force[:, 2],
            drag=-course.ground_force[:, 0],
        )
    return result


def forces_plot(both: Landings) -> Plot:
    """Draw the forces in the form of the paper's Fig. 17."""
    panels = []
    for quantity, title in (("aft", "longitudinal"), ("upward", "vertical")):
        for name in GEARS:
            lines = [
                Line(
                    forces.time,
                    getattr(forces, quantity) / 1e3,
                    words,
                    width=width,
                    colour=colour,
                )
                for forces, words, width, colour in (
                    (both.without[name], "without", 2.6, 1),
                    (both.with_it[name], "with", 1.1, 0),
                )
            ]
            panels.append(
                Panel("time [s]", "force [kN]", lines, f"{TITLES[name].capitalize()}, {title}")
            )
    return line_plot(
        "spring-back-landing",
        "Forces in a landing at 10 ft/s with spring-back and without it, in the form of the "
        "paper's Fig. 17: longitudinal force of the gear on the airframe, aft positive, and "
        "vertical force of the ground.",
        panels,
    )


def summary(both: Landings) -> Table:
    """Write what spring-back does to each gear."""
    rows = []
    for name in GEARS:
        springy, rigid = both.with_it[name], both.without[name]
        until = slice(0, springy.spin_up + 1)
        angle = float(springy.swing_frequency[until].mean()) * (
            springy.time[springy.spin_up] - springy.contact
        )
        vertical = np.abs(springy.upward - rigid.upward).max() / rigid.upward.max()
        rows += [
            (TITLES[name], "largest aft force", _kn(rigid.aft.max()), _kn(springy.aft.max())),
            ("", "largest forward force", _kn((-rigid.aft).max()), _kn((-springy.aft).max())),
            (
                "",
                "forward over aft force",
                f"{(-rigid.aft).max() / rigid.aft.max():.3f}",
                f"{(-springy.aft).max() / springy.aft.max():.3f}",
            ),
            ("", "largest drag at the ground", _kn(rigid.drag.max()), _kn(springy.drag.max())),
            ("", "largest vertical force", _kn(rigid.upward.max()), _kn(springy.upward.max())),
            ("", "vertical curves apart at most, over the peak [%]", "–", f"{100 * vertical:.2f}"),
            (
                "",
                "largest bending aft and forward [deg]",
                "–",
                f"{np.degrees(springy.history.bending_angle.max()):.2f}, "
                f"{-np.degrees(springy.history.bending_angle.min()):.2f}",
            ),
            ("", "swing frequency times spin-up time [rad]", "–", f"{angle:.2f}"),
            ("", "  ramp factor at that product", "–", f"{ramp_spring_back_factor(angle):.2f}"),
        ]
    return Table(
        "What spring-back does",
        ("gear", "quantity", "without [kN]", "with [kN]"),
        tuple(rows),
        "Forces in kN, in earth axes. The ramp factor is that of an undamped leg after a linear "
        "ramp that ends at once; here the leg is damped, its frequency rises as the strut closes, "
        "and the drag fades over tens of milliseconds, so that less comes forward.",
    )


def comparisons(both: Landings) -> tuple[Comparison, ...]:
    """Vertical forces are left alone; the longitudinal one does not turn without spring-back."""
    rows = []
    for name in GEARS:
        springy, rigid = both.with_it[name], both.without[name]
        title = TITLES[name]
        tilt = springy.history.bending_angle.max() * springy.drag.max() / rigid.upward.max()
        rows += [
            Comparison(
                f"{title}: largest vertical force, with spring-back",
                float(springy.upward.max()),
                float(rigid.upward.max()),
                0.03,
                "N",
                "the same landing with rigid legs",
                "the drag acts along the bent leg with at most its bending angle, "
                f"{100 * tilt:.1f} % of the force; the paper calls the effect negligible",
            ),
            Comparison(
                f"{title}: largest stroke, with spring-back",
                float(springy.history.stroke.max()),
                float(rigid.history.stroke.max()),
                0.01,
                "m",
                "the same landing with rigid legs",
                "as for the force, over the longer time of the stroke",
            ),
            Comparison(
                f"{title}: largest forward over largest aft force, rigid legs",
                float((-rigid.aft).max() / rigid.aft.max()),
                0.0,
                0.05,
                "",
                "a tyre that is dragged to speed pulls aft only",
                "inertia of the unsprung mass as the aircraft pitches",
                scale=1.0,
            ),
            Comparison(
                f"{title}: largest forward force over the largest drag at the ground",
                float((-springy.aft).max() / springy.drag.max()),
                1.0,
                0.5,
                "",
                "14 CFR 23 appendix D: the spring-back load is the spin-up load reversed",
                "a convention; undamped legs have 0.5 to 1.26 of it after a ramp, damped ones less",
            ),
            _impulse(title, springy),
        ]
    rows.append(
        Comparison(
            "imbalance of energy over the impact energy, the larger of both landings",
            max(both.energy_errors),
            0.0,
            1e-5,
            "",
            "conservation of energy",
            "ten times the tolerance of one step",
            scale=1.0,
        )
    )
    return tuple(rows)


def _impulse(title: str, forces: GearForces) -> Comparison:
    """Angular momentum of the wheels against the impulse of the drag about the axle."""
    tyre, course = forces.gear.tyre, forces.history
    lever = np.where(forces.upward > 0, tyre.free_radius - course.tyre_deflection, 0.0)
    impulse = float(np.trapezoid(forces.drag * lever, forces.time))
    momentum = float(tyre.count * tyre.wheel_inertia * course.wheel_speed[-1])
    return Comparison(
        f"{title}: angular momentum of the wheels after spin-up",
        momentum,
        impulse,
        2e-3,
        "kg m2/s",
        "impulse of the ground's drag about the axle, by quadrature of the history",
        "trapezoids over 0.25 ms, and the aircraft's own pitch rate beside the wheel's",
    )


def appendix_d(both: Landings) -> Table:
    """Drag of the landing beside the rule's closed form, for information."""
    rows = []
    for name in GEARS:
        forces = both.with_it[name]
        tyre = forces.gear.tyre
        peak = int(forces.upward.argmax())
        rise = forces.time[peak] - forces.contact
        end = forces.spin_up
        spin_up_time = forces.time[end] - forces.contact
        radius = tyre.free_radius - tyre.rolling_share * forces.history.tyre_deflection[end]
        momentum = 2 * tyre.count * tyre.wheel_inertia * CONTACT.ground_speed
        limit = RULE_FRICTION * forces.upward[peak]
        whole, early = (
            min(float(np.sqrt(momentum * RULE_FRICTION * ramp) / radius), limit)
            for ramp in (forces.upward[peak] / rise, forces.upward[end] / spin_up_time)
        )
        rows.append(
            (
                TITLES[name],
                _kn(forces.upward[peak]),
                f"{1e3 * rise:.1f}",
                f"{1e3 * spin_up_time:.1f}",
                _kn(whole),
                _kn(early),
                _kn(forces.drag[end]),
            )
        )
    return Table(
        "Spin-up in the landing beside 14 CFR 23 appendix D",
        (
            "gear",
            "largest vertical [kN]",
            "after [ms]",
            "spin-up in [ms]",
            "rule [kN]",
            "rule, own ramp [kN]",
            "simulated [kN]",
        ),
        tuple(rows),
        "For information. The rule is meant for light aeroplanes and takes the vertical force to "
        "grow linearly up to its peak, with a friction of 0.8; the preloaded strut of this gear "
        "makes it rise fast and then stay, so that the wheel is at speed long before the peak. "
        "With the ramp up to the end of the spin-up instead (own ramp) the rule lies above the "
        "simulation: its friction is 0.8 throughout, here it is 0.5 in full sliding and 0.8 near "
        "rolling only. Neither exceeds 0.8 of the largest vertical force, the rule's own limit.",
    )


def spin_up_plot(both: Landings) -> Plot:
    """Speed of the wheels and drag at the ground."""
    panels = [
        Panel(
            "time [s]",
            "drag [kN]",
            [
                Line(f.time, f.drag / 1e3, TITLES[name])
                for name, f in both.with_it.items()
                if name in GEARS
            ],
            "Drag of the ground",
        ),
        Panel(
            "time [s]",
            "wheel speed [rad/s]",
            [
                Line(f.time, f.history.wheel_speed, TITLES[name])
                for name, f in both.with_it.items()
                if name in GEARS
            ],
            "Speed of the wheels",
        ),
    ]
    return line_plot(
        "spring-back-wheels",
        "Drag of the ground and speed of the wheels in the landing with spring-back.",
        panels,
    )


def _kn(force: float) -> str:
    return f"{force / 1e3:.2f}".replace("-", "−")
