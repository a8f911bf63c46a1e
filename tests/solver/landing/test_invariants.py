"""What no landing may violate: momentum, energy, equilibrium, symmetry, frame independence."""

from dataclasses import replace

import numpy as np
import pytest

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.frames import body_structural, quaternion_from_euler, rotation_matrix
from solver.gear.parameters import SpringBack
from solver.gear.pins import resultant_matrix
from solver.landing.aircraft import Aerodynamics, LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.equations import AIRFRAME_STATES, GEAR_STATES
from solver.landing.history import LandingHistory
from solver.landing.initial import initial_state
from solver.landing.peaks import gear_peaks
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.landing.business_jet import business_jet, rigid_legged
from tests.solver.landing.free_flight import Flight, fly, moving_state, records

STILL_AIR = Aerodynamics()
SHORT = SimulationOptions(time_limit=0.4, stop_when_settled=False)


def momenta(flight: Flight, row: int) -> tuple[Array, Array]:
    """Linear and angular momentum about the earth's origin, from the states, by definition."""
    state = flight.states[row]
    turn = rotation_matrix(state[3:7])
    rate = state[10:13]
    linear = flight.airframe["mass"] * state[7:10]
    angular = np.cross(state[0:3], linear) + turn @ (flight.airframe["inertia"] @ rate)
    for index, gear in enumerate(flight.gears):
        answer = flight.gear_answers[row, index]
        place = state[0:3] + turn @ answer["arm"]
        push = gear["unsprung_mass"] * (turn @ answer["axle_velocity"])
        axle = answer["lateral"]
        spin = state[AIRFRAME_STATES + GEAR_STATES * index + 4]
        along = (rate @ axle) * axle
        wheel = gear["transverse_inertia"] * (rate - along)
        wheel = wheel + gear["spin_inertia"] * (along - spin * axle)
        linear = linear + push
        angular = angular + np.cross(place, push) + turn @ wheel
    return linear, angular


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("legs", ["rigid", "springy"])
def test_momentum_is_conserved_without_outer_forces(seed: int, legs: str) -> None:
    aircraft = rigid_legged() if legs == "rigid" else business_jet(STILL_AIR)
    airframe, gears = records(aircraft, gravity=0.0)
    state = moving_state(gears, seed, height=100.0)
    if legs == "rigid":
        for index in range(len(gears)):
            at = AIRFRAME_STATES + GEAR_STATES * index
            state[at + 2 : at + 4] = 0.0
    flight = fly(airframe, gears, state, 0.2)
    linear, angular = momenta(flight, 0)
    linear_end, angular_end = momenta(flight, -1)
    assert np.linalg.norm(linear_end - linear) < 1e-8 * np.linalg.norm(linear)
    # The angular momentum exchanged inside is that of the turning airframe, some 1e5 kg m2/s.
    assert np.linalg.norm(angular_end - angular) < 1e-7 * np.linalg.norm(angular)
    assert np.linalg.norm(flight.states[-1, 10:13] - state[10:13]) > 1e-4


@pytest.mark.parametrize("seed", [4, 5])
def test_energy_of_undamped_gears_is_conserved(seed: int) -> None:
    plain = business_jet(STILL_AIR)
    two_tube = SpringBack(
        cylinder_rigidity=1.1e6, piston_rigidity=4e5, cylinder_length=0.55, damping_ratio=0.0
    )
    gears = tuple(
        replace(
            gear,
            spring_back=two_tube,
            strut=replace(
                gear.strut, compression_coefficient=0.0, rebound_coefficient=0.0, stop_damping=0.0
            ),
        )
        for gear in plain.gears
    )
    airframe, rows = records(replace(plain, gears=gears))
    flight = fly(airframe, rows, moving_state(rows, seed, height=100.0), 0.2)
    energy = flight.stored.sum(axis=1)
    exchanged = np.ptp(flight.stored[:, 2:5], axis=0).sum()
    assert exchanged > 1e3
    assert np.ptp(energy) < 1e-5 * exchanged


def random_landing(seed: int) -> tuple[LandingAircraft, Contact]:
    generator = np.random.default_rng(seed)
    aircraft = business_jet()
    if seed % 2:
        aircraft = replace(
            aircraft,
            aerodynamics=replace(aircraft.aerodynamics, lift_slope_area=230.0),
            gears=tuple(
                replace(
                    gear,
                    axis=np.array([0.1, 0.02, -np.sqrt(1 - 0.0104)]),
                    strut=replace(gear.strut, seal_friction=800.0),
                    tyre=replace(gear.tyre, rolling_resistance=0.004, vertical_damping=0.05),
                )
                for gear in aircraft.gears
            ),
        )
    roll, pitch, drift = generator.uniform([-0.07, -0.03, -0.1], [0.07, 0.1, 0.1])
    return aircraft, Contact(
        sink_rate=generator.uniform(0.4, 4.0),
        ground_speed=generator.uniform(45.0, 75.0),
        pitch=pitch,
        roll=roll,
        drift=drift,
        pitch_rate=generator.uniform(-0.1, 0.1),
        roll_rate=generator.uniform(-0.1, 0.1),
        yaw_rate=generator.uniform(-0.05, 0.05),
        lift=Lift(fraction=generator.uniform(0.8, 1.1), residual_fraction=0.2),
    )


def balance(aircraft: LandingAircraft, history: LandingHistory) -> float:
    """Largest residual of the airframe's equations over the largest force, or moment over 1 m."""
    inertia = body_structural(body_structural(aircraft.inertia).T).T
    force = aircraft.mass * (history.gravity - history.acceleration) + history.air_wrench[:, :3]
    moment = history.air_wrench[:, 3:] - history.rate_derivative @ inertia.T
    moment = moment - np.cross(history.rate, history.rate @ inertia.T)
    largest = 0.0
    for gear in history.gears:
        arm = body_structural(gear.reference_point - history.origin)
        force = force + gear.wrench[:, :3]
        moment = moment + gear.wrench[:, 3:] + np.cross(arm, gear.wrench[:, :3])
        largest = max(largest, float(np.abs(gear.wrench).max()))
    return max(float(np.abs(force).max()), float(np.abs(moment).max())) / largest


@pytest.mark.parametrize("seed", range(6))
def test_energy_closes_and_the_airframe_balances_in_any_landing(seed: int) -> None:
    aircraft, contact = random_landing(seed)
    history = simulate_landing(aircraft, contact)
    assert history.energy.closure_error < 1e-4
    assert balance(aircraft, history) < 1e-12
    for sink in ("dissipated_hydraulic", "dissipated_other"):
        assert np.diff(getattr(history.energy, sink)).min() > -1e-6 * history.energy.impact_energy
    for gear, parameters in zip(history.gears, aircraft.gears, strict=True):
        assert np.isfinite(gear.wrench).all()
        matrix = resultant_matrix(parameters.pins, gear.reference_point)
        loads = body_structural(gear.pin_loads.reshape(-1, 3, 2, 3)).reshape(-1, 18)
        wrench = body_structural(gear.wrench.reshape(-1, 2, 3)).reshape(-1, 6)
        assert np.abs(loads @ matrix.T - wrench).max() < 1e-9 * np.abs(wrench).max()


def test_whole_aircraft_falls_as_outer_forces_say() -> None:
    # Newton for the whole aircraft, gears' own motion included: a check of the gears' wrenches
    # that does not use them.  The common centre of gravity moves by ground, lift, drag and weight.
    aircraft, contact = random_landing(2)
    airframe, gears = records(aircraft)
    course = (1.0, np.inf, 1.0, 1.0)
    state = initial_state(contact, airframe, gears, np.array(course))
    flight = fly(airframe, gears, state, 0.15, course=course, interval=1e-4)
    momentum = np.array([momenta(flight, row)[0] for row in range(len(flight.time))])
    turn = rotation_matrix(flight.states[:, 3:7])
    force = np.einsum("tij,tj->ti", turn, flight.answers["air_force"])
    force = force + np.einsum("tij,tgj->ti", turn, flight.gear_answers["ground_force"])
    force[:, 2] += aircraft.total_mass * 9.80665
    # Simpson's rule over the stored instants.
    weights = np.ones(len(flight.time))
    weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
    impulse = (weights[:, None] * force).sum(axis=0) * 1e-4 / 3
    assert np.linalg.norm(momentum[-1] - momentum[0] - impulse) < 1e-5 * np.linalg.norm(impulse)


@pytest.mark.parametrize(
    "changes",
    [{"roll": 0.05}, {"drift": 0.08}, {"roll": 0.03, "roll_rate": 0.1, "yaw_rate": -0.05}],
)
def test_mirrored_landing_loads_the_other_side(changes: dict[str, float]) -> None:
    aircraft = business_jet()
    base = Contact(2.5, 60.0, pitch=0.03)
    one = simulate_landing(aircraft, replace(base, **changes), SHORT)
    mirrored = replace(base, **{name: -value for name, value in changes.items()})
    other = simulate_landing(aircraft, mirrored, SHORT)
    left, right, nose = one.gears
    mirror_left, mirror_right, mirror_nose = other.gears
    sides = np.array([1.0, -1.0, 1.0])
    scale = np.abs(left.ground_force).max()
    for a, b in ((left, mirror_right), (right, mirror_left), (nose, mirror_nose)):
        assert np.abs(a.ground_force * sides - b.ground_force).max() < 2e-5 * scale
        assert np.abs(a.stroke - b.stroke).max() < 1e-5
    assert np.abs(left.ground_force * sides - right.ground_force).max() > 0.01 * scale


def test_forces_do_not_depend_on_the_direction_of_the_runway() -> None:
    aircraft, contact = random_landing(0)
    airframe, gears = records(aircraft)
    course = (1.0, np.inf, 1.0, 1.0)
    state = initial_state(contact, airframe, gears, np.array(course))
    turned = state.copy()
    half = quaternion_from_euler(0.0, 0.0, 1.234)
    w, x, y, z = half
    product = np.array([[w, -x, -y, -z], [x, w, -z, y], [y, z, w, -x], [z, -y, x, w]])
    turned[3:7] = product @ state[3:7]
    turned[7:10] = rotation_matrix(half) @ state[7:10]
    one = fly(airframe, gears, state, 0.15, course=course)
    other = fly(airframe, gears, turned, 0.15, course=course)
    force = one.gear_answers["force"]
    assert np.abs(force).max() > 1e4
    assert np.abs(force - other.gear_answers["force"]).max() < 1e-6 * np.abs(force).max()


def test_peaks_converge_with_the_tolerance_of_the_steps() -> None:
    aircraft, contact = random_landing(2)

    def peaks(tolerance: float) -> Array:
        history = simulate_landing(aircraft, contact, replace(SHORT, tolerance=tolerance))
        return np.array(
            [
                value
                for peak in gear_peaks(history)
                for value in (peak.vertical_force.value, peak.drag_force.value, peak.stroke.value)
            ]
        )

    exact = peaks(1e-11)
    loose, default, tight = (
        float(np.max(np.abs(peaks(tolerance) / exact - 1))) for tolerance in (1e-5, 1e-6, 1e-8)
    )
    assert default < 1e-4
    assert tight < 1e-6
    assert tight < default <= loose * 1.5


def test_run_that_does_not_close_is_refused() -> None:
    with pytest.raises(SimulationDivergedError, match="energy account"):
        simulate_landing(business_jet(), Contact(2.0, 60.0), replace(SHORT, energy_bound=1e-14))


def test_held_lift_course_is_the_inputs_own() -> None:
    held = Contact(1.0, 60.0, lift=Lift(LiftModel.HELD, fraction=0.7))
    history = simulate_landing(rigid_legged(), held, SHORT)
    turn = rotation_matrix(history.attitude)
    upward = -np.einsum("ti,ti->t", turn[:, 2, :], history.air_wrench[:, :3])
    weight = rigid_legged().total_mass * 9.80665
    assert upward == pytest.approx(np.full(len(upward), 0.7 * weight), rel=1e-12)
