"""Wheel spin-up and the leg's answer to it."""

from dataclasses import replace

import numpy as np
import pytest

from solver.gear.parameters import Gear, SpringBack, Strut, Tyre
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.history import LandingHistory
from solver.landing.peaks import GearPeaks, gear_peaks
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.landing.business_jet import business_jet, rigid_legged

HELD = Lift(LiftModel.HELD)
LEVEL = Contact(3.048, 55.0, pitch=np.radians(1.0), lift=HELD)


def peaks(history: LandingHistory, gear: str) -> GearPeaks:
    return next(peak for peak in gear_peaks(history) if peak.gear == gear)


def test_spin_up_load_of_14_cfr_23_appendix_d() -> None:
    # F = (1/r) sqrt(2 I V n F_v / t_s) is exact for constant friction n and a vertical force that
    # grows linearly, F_v t / t_s; a linear tyre under a mass that nothing stops has F_v/t_s = k w.
    # Fiala's force falls short of n F_v by n F_v / (4 C kappa), while kappa = 1 - (t / t_su)^2: to
    # first order the largest force lies sqrt(2 a) below, a = n F_v / (4 C).
    stiffness, sink, speed, friction, radius, inertia = 1e6, 1.0, 50.0, 0.5, 20.0, 1600.0
    expected = np.sqrt(2 * inertia * speed * friction * stiffness * sink) / radius
    tyre = Tyre(
        free_radius=radius,
        vertical_coefficient=stiffness,
        vertical_exponent=1.0,
        longitudinal_stiffness=1e8,
        cornering_stiffness=1e6,
        maximum_friction=friction,
        minimum_friction=friction,
        width=0.2,
        wheel_inertia=inertia,
    )
    strut = Strut(  # preloaded beyond all that comes: a rigid link
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
    gear = Gear("one", strut, tyre, SpringBack.rigid(), 100.0, np.array([0.0, 0.0, 0.0]))
    aircraft = LandingAircraft(1e8, np.array([0.0, 0.0, 1.0]), 1e9 * np.eye(3), (gear,))
    history = simulate_landing(
        aircraft,
        Contact(sink, speed, lift=HELD),
        SimulationOptions(
            time_limit=0.04, output_interval=2e-5, tolerance=1e-9, stop_when_settled=False
        ),
    )
    drag = peaks(history, "one").drag_force
    below = np.sqrt(2 * expected / (4 * 1e8))
    assert below < 0.01
    assert drag.value == pytest.approx(expected * (1 - below), rel=2e-3)
    assert drag.time == pytest.approx(expected / (friction * stiffness * sink), rel=1e-2)
    # Slip gone, drag gone: the wheel rolls.
    assert abs(history.gears[0].ground_force[-1, 0]) < 0.02 * expected


def test_wheel_ends_at_its_rolling_speed() -> None:
    history = simulate_landing(
        rigid_legged(), LEVEL, SimulationOptions(time_limit=0.3, stop_when_settled=False)
    )
    left = history.gears[0]
    assert left.wheel_speed[0] == 0.0
    forward = history.velocity[-1, 0]
    rolling = forward / (0.27559 - left.tyre_deflection[-1] / 3)
    assert left.wheel_speed[-1] == pytest.approx(rolling, rel=5e-3)


def test_spring_back_reverses_the_drag_and_hardly_touches_the_vertical_force() -> None:
    options = SimulationOptions(time_limit=0.3, stop_when_settled=False)
    stiff = simulate_landing(rigid_legged(), LEVEL, options)
    springy = simulate_landing(business_jet(rigid_legged().aerodynamics), LEVEL, options)
    for gear in ("left", "nose"):
        rigid, swung = peaks(stiff, gear), peaks(springy, gear)
        # Paper Fig. 17: large in the longitudinal force, negligible in the vertical one.
        assert swung.vertical_force.value == pytest.approx(rigid.vertical_force.value, rel=0.02)
        assert swung.stroke.value == pytest.approx(rigid.stroke.value, rel=0.01)
        assert swung.pivot_drag_force.value > 1.2 * rigid.pivot_drag_force.value
        assert swung.pivot_forward_force.value > 0.4 * swung.pivot_drag_force.value
        assert rigid.pivot_forward_force.value < 0.1 * rigid.pivot_drag_force.value
        assert swung.pivot_forward_force.time > swung.pivot_drag_force.time
    left = springy.gears[0]
    assert left.bending_angle.max() > 0.02  # aft first
    assert left.bending_angle.min() < -0.01


def test_stiff_legs_approach_rigid_ones() -> None:
    options = SimulationOptions(time_limit=0.1, stop_when_settled=False)
    rigid = simulate_landing(rigid_legged(), LEVEL, options)
    differences = []
    for frequency in (100.0, 200.0, 400.0):
        plain = rigid_legged()
        gears = tuple(
            replace(gear, spring_back=SpringBack.from_frequency(frequency, gear.unsprung_mass, 1.1))
            for gear in plain.gears
        )
        stiff = simulate_landing(replace(plain, gears=gears), LEVEL, options)
        differences.append(
            abs(
                peaks(stiff, "left").pivot_drag_force.value
                / peaks(rigid, "left").pivot_drag_force.value
                - 1
            )
        )
    assert differences[2] < differences[1] < differences[0]
    assert differences[2] < 0.01
