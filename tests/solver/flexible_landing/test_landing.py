"""Landings of the mini aircraft, flexible: limits, symmetry, frames, equilibrium."""

from dataclasses import replace

import numpy as np
import pytest

from solver.arrays import Array
from solver.errors import RecordError, SimulationDivergedError
from solver.flexible_landing.initial import flexible_initial_state
from solver.flexible_landing.loads import flexible_landing_loads
from solver.flexible_landing.simulate import FlexibleLanding, simulate_flexible_landing
from solver.frames import BODY_STRUCTURAL, body_structural, quaternion_from_euler, rotation_matrix
from solver.gear.pins import pin_load_matrix
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.loads import applied_shapes, equilibrium_residual
from solver.inertia_relief.static import inertia_relief
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.flexible_landing.conftest import Mini
from tests.solver.flexible_landing.flight import body_of, evaluated, fly

SHORT = SimulationOptions(time_limit=0.25, stop_when_settled=False)
CONTACT = Contact(2.5, 55.0, pitch=0.03)
ROLLED = replace(CONTACT, roll=0.04, drift=0.03, roll_rate=0.05)
FLOWN = (1.0, np.inf, 1.0, 1.0)


def strut_forces(landing: FlexibleLanding) -> Array:
    return np.stack([gear.strut_force for gear in landing.history.gears])


def test_stiff_airframe_lands_as_a_rigid_one(mini: Mini) -> None:
    # The deflections, and with them the difference, fall with the square of the frequencies.
    exact = replace(SHORT, tolerance=1e-9)
    rigid = simulate_landing(mini.aircraft, ROLLED, exact)
    expected = np.stack([gear.wrench for gear in rigid.gears])
    differences = []
    for factor in (1.0, 20.0, 40.0):
        stiff = mini.flexible.stiffened(factor)
        landing = simulate_flexible_landing(mini.aircraft, stiff, ROLLED, exact)
        found = np.stack([gear.wrench for gear in landing.history.gears])
        # Mean over time: the peaks of a difference lie where a wheel touches a moment earlier.
        differences.append(float(np.abs(found - expected).mean()) / float(np.abs(expected).mean()))
    assert differences[0] > 0.02
    assert differences[2] < 3e-4
    assert 3.0 < differences[1] / differences[2] < 5.0


@pytest.mark.parametrize("contact", [CONTACT, ROLLED])
def test_energy_closes_with_the_elastic_part(mini: Mini, contact: Contact) -> None:
    landing = simulate_flexible_landing(mini.aircraft, mini.flexible, contact, SHORT)
    impact = landing.history.energy.impact_energy
    assert landing.history.energy.closure_error < 1e-5
    # Neither part is small against that.
    assert np.ptp(landing.elastic_energy) > 1e-2 * impact
    assert landing.structural_loss[-1] > 1e-3 * impact
    assert np.diff(landing.structural_loss).min() >= 0.0


def test_two_way_coupling_changes_the_strut_forces(mini: Mini) -> None:
    rigid = simulate_landing(mini.aircraft, CONTACT, SHORT)
    landing = simulate_flexible_landing(mini.aircraft, mini.flexible, CONTACT, SHORT)
    change = np.abs(strut_forces(landing) - [gear.strut_force for gear in rigid.gears]).max()
    assert change > 1e3


def test_nothing_rings_at_the_first_instant(mini: Mini) -> None:
    # Flown on clear of the ground, the structure keeps its shape.
    body = body_of(mini.aircraft, mini.flexible)
    contact = replace(CONTACT, pitch_rate=0.0)
    state = flexible_initial_state(
        contact, body.airframe, body.gears, body.modes, body.local, np.array(FLOWN)
    )
    derivative, _, answers = evaluated(body, state, FLOWN)
    assert np.abs(derivative[body.first :]).max() < 1e-6
    assert np.max(answers["deflection"]) == pytest.approx(0.0, abs=1e-9)
    clear = state.copy()
    clear[2] -= 5.0
    flight = fly(body, clear, 0.05, course=FLOWN)
    size = body.flexible.size
    moved = np.ptp(flight.stored[:, 6]) / flight.stored[0, 6]
    assert flight.stored[0, 6] > 10.0
    assert moved < 1e-3
    assert np.abs(flight.states[:, body.first + size :]).max() < 2e-2


def test_flight_shape_is_that_of_static_inertia_relief(mini: Mini) -> None:
    # The finite-element model under the loads of the same instant, without any modes.
    # At a body rate of zero the terms left out here, for speed, are zero.
    body = body_of(mini.aircraft, mini.modes.without_second_order())
    state = flexible_initial_state(
        CONTACT, body.airframe, body.gears, body.modes, body.local, np.array(FLOWN)
    )
    _, answer, answers = evaluated(body, state, FLOWN)
    loads = []
    for gear, reply in zip(mini.aircraft.gears, answers, strict=True):
        wrench = body_structural(np.stack([reply["force"], reply["moment"]])).ravel()
        loads.append(pin_load_matrix(gear.pins, gear.pivot) @ wrench)
    air = body_structural(answer["air_force"])
    arm = np.cross(mini.aircraft.centre_of_gravity, air)
    loads += [air, body_structural(answer["air_moment"]) + arm]
    relief = inertia_relief(free_body(mini.airframe.structure, mini.inertia))
    shape = relief.displacement(applied_shapes(mini.airframe) @ np.concatenate(loads))
    at_pins = applied_shapes(mini.airframe).T @ shape
    q = state[body.first : body.first + mini.modes.size]
    first = 0
    for index, gear in enumerate(mini.aircraft.gears):
        last = first + 6 * len(gear.pins)
        expected = pin_load_matrix(gear.pins, gear.pivot).T @ at_pins[first:last]
        found = np.tile(BODY_STRUCTURAL, 2) * (mini.modes.fittings[index] @ q)
        assert np.abs(found - expected).max() < 1e-4 * np.abs(expected).max()
        first = last


def test_symmetric_landing_stays_symmetric(mini: Mini) -> None:
    landing = simulate_flexible_landing(mini.aircraft, mini.flexible, CONTACT, SHORT)
    sides = {gear.name: gear for gear in landing.history.gears}
    left, right = sides["main_left"], sides["main_right"]
    assert np.abs(left.strut_force - right.strut_force).max() < 1e-6 * left.strut_force.max()
    mirror = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    assert np.abs(left.wrench * mirror - right.wrench).max() < 1e-6 * np.abs(left.wrench).max()
    assert np.abs(landing.history.rate[:, [0, 2]]).max() < 1e-8


def test_mirrored_landing_loads_the_other_side(mini: Mini) -> None:
    mirrored = replace(ROLLED, roll=-ROLLED.roll, drift=-ROLLED.drift, roll_rate=-ROLLED.roll_rate)
    one, other = (
        strut_forces(simulate_flexible_landing(mini.aircraft, mini.flexible, contact, SHORT))
        for contact in (ROLLED, mirrored)
    )
    names = [gear.name for gear in mini.aircraft.gears]
    swapped = [names.index(name) for name in ("nose", "main_right", "main_left")]
    order = [names.index(name) for name in ("nose", "main_left", "main_right")]
    assert np.abs(one[order] - other[swapped]).max() < 1e-4 * one.max()
    assert np.abs(one - other).max() > 0.1 * one.max()


def test_forces_do_not_depend_on_the_direction_of_the_runway(mini: Mini) -> None:
    body = body_of(mini.aircraft, mini.flexible)
    state = flexible_initial_state(
        ROLLED, body.airframe, body.gears, body.modes, body.local, np.array(FLOWN)
    )
    turned = state.copy()
    half = quaternion_from_euler(0.0, 0.0, 1.234)
    w, x, y, z = half
    product = np.array([[w, -x, -y, -z], [x, w, -z, y], [y, z, w, -x], [z, -y, x, w]])
    turned[3:7] = product @ state[3:7]
    turned[7:10] = rotation_matrix(half) @ state[7:10]
    one, other = (fly(body, start, 0.1, course=FLOWN) for start in (state, turned))
    force = one.gear_answers["force"]
    assert np.abs(force).max() > 1e4
    assert np.abs(force - other.gear_answers["force"]).max() < 1e-6 * np.abs(force).max()


def test_loads_balance_the_undeformed_airframe(mini: Mini) -> None:
    landing = simulate_flexible_landing(mini.aircraft, mini.flexible, ROLLED, SHORT)
    loads = flexible_landing_loads(mini.airframe, mini.aircraft, landing.history)
    body = free_body(mini.airframe.structure, mini.inertia)
    residual = equilibrium_residual(
        body.rigid_modes.T @ applied_shapes(mini.airframe),
        loads.applied_amplitudes(),
        body.rigid_modes.T @ mini.inertia.rigid_load_shapes(loads.motion.origin),
        loads.motion.inertia_amplitudes(),
        np.full(len(loads.time), 9.8 * mini.aircraft.mass),
        body.gyration_radius,
    )
    assert residual < 1e-12
    # The undeformed arms change little, as the analysis of stress takes for granted.
    turned = loads.motion.rate_derivative * BODY_STRUCTURAL
    largest = np.abs(landing.history.rate_derivative).max()
    assert np.abs(turned - landing.history.rate_derivative).max() < 0.05 * largest


def test_impossible_landings_are_refused(mini: Mini) -> None:
    with pytest.raises(RecordError, match="sink_rate"):
        simulate_flexible_landing(mini.aircraft, mini.flexible, replace(CONTACT, sink_rate=-1.0))
    with pytest.raises(SimulationDivergedError, match="energy account"):
        simulate_flexible_landing(
            mini.aircraft, mini.flexible, CONTACT, replace(SHORT, energy_bound=1e-12)
        )
