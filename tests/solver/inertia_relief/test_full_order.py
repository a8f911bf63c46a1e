"""Full-order integration against modal series, exact oscillators and other axes."""

import itertools

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from solver.arrays import Array
from solver.fe.structure import Structure
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.static import inertia_relief
from tests.solver.inertia_relief.bodies import (
    balanced_landing,
    beam_structure,
    full_order_peaks,
    point_loads,
    turned_landing,
    winged_body,
)

UNDAMPED = RayleighDamping(0.0)
LENGTH, COUNT = 2.0, 24
#: beta L of the symmetric modes of a free-free uniform beam, tan(b / 2) + tanh(b / 2) = 0.
SYMMETRIC = np.array([4.7300407449, 10.9956078380, 17.2787596574, 23.5619449020, 29.8451302091])


def central_step(structure: Structure, time: Array, spin: float = 0.0) -> BodyLoads:
    """Transverse force at the middle, from zero to 10 N within one sample, then constant."""
    body = free_body(structure)
    force = point_loads(structure, {(COUNT // 2, 2): 1.0})
    amplitude = np.full((len(time), 1), 10.0)
    amplitude[0] = 0.0
    acceleration = np.zeros((len(time), 3))
    acceleration[:, 2] = amplitude[:, 0] / body.total_mass
    zero = np.zeros((len(time), 3))
    rate = zero.copy()
    rate[:, 0] = spin
    motion = RigidMotion(body.centre_of_gravity, acceleration, zero, rate, zero)
    return BodyLoads(time, force[:, None], amplitude, motion)


def history(body: FreeBody, loads: BodyLoads, damping: RayleighDamping, substeps: int) -> Array:
    samples = []
    integrate_full_order(
        body, loads, damping, lambda _, u: samples.append(u.copy()), substeps, block=50
    )
    return np.hstack(samples)


def beam_constants(structure: Structure) -> tuple[float, float]:
    """Bending stiffness EI in the x-z plane [N m2] and mass for each length [kg/m]."""
    section, material = structure.model.beam_properties[1], structure.model.materials[1]
    return material.young_modulus * section.inertia_2, material.density * section.area


def symmetric_shapes(x: Array) -> Array:
    """Symmetric free-free modes (5, nx) of unit length, about the middle; value 2 at the ends."""
    half = SYMMETRIC[:, None] / 2
    return np.cos(2 * half * x) / np.cos(half) + np.cosh(2 * half * x) / np.cosh(half)


def test_free_beam_under_a_step_load_follows_its_modal_series():
    structure = beam_structure(LENGTH, COUNT, 0.02, 0.01)
    stiffness, density = beam_constants(structure)
    time = np.arange(201) * 5e-4
    body = free_body(structure)
    motion = history(body, central_step(structure, time), UNDAMPED, substeps=8)
    x = np.linspace(-0.5, 0.5, COUNT + 1)
    shapes = symmetric_shapes(x)
    frequency = SYMMETRIC**2 * np.sqrt(stiffness / (density * LENGTH**4))
    # modal mass is m L times the mean square of the shape, which is one for end value two
    force = 10.0 * shapes[:, COUNT // 2] / (density * LENGTH)
    ramp, w = time[1], frequency[:, None]
    response = 1 - (np.sin(w * time) - np.sin(w * (time - ramp))) / (w * ramp)
    response[:, 0] = 0.0
    expected = shapes.T @ (force[:, None] / w**2 * response)
    found = np.stack([structure.nodal_displacements(u)[:, 2] for u in motion.T], axis=1)
    np.testing.assert_allclose(found, expected, atol=5e-3 * np.abs(expected).max())


def test_beam_spinning_about_its_axis_answers_at_its_frequencies_plus_and_minus_the_spin():
    """In space the deflection is a beam under a turning force: an exact modal oscillator."""
    structure = beam_structure(LENGTH, COUNT, 0.01, 0.01)
    stiffness, density = beam_constants(structure)
    spin = 40.0
    time = np.arange(161) * 1e-3
    motion = history(
        free_body(structure), central_step(structure, time, spin), UNDAMPED, substeps=20
    )
    nodal = np.stack([structure.nodal_displacements(u)[0, 1:3] for u in motion.T], axis=1)
    frequency = SYMMETRIC**2 * np.sqrt(stiffness / (density * LENGTH**4))
    shapes = symmetric_shapes(np.array([-0.5, 0.0]))
    expected = np.zeros(len(time), dtype=complex)
    for w, (end, middle) in zip(frequency, shapes, strict=True):
        # z'' + 2 i W z' + (w^2 - W^2) z = f with z = y + i z the deflection in turning axes
        generator = np.zeros((4, 4), dtype=complex)
        generator[:2, :2] = [[0, 1], [spin**2 - w**2, -2j * spin]]
        generator[1, 2] = generator[2, 3] = 1.0
        advance = expm(generator * time[1])[:2]
        force = 1j * 10.0 * middle / (density * LENGTH)
        state = np.zeros(2, dtype=complex)
        for n in range(1, len(time)):
            slope = force / time[1] if n == 1 else 0.0
            state = advance @ np.array([*state, 0.0 if n == 1 else force, slope])
            expected[n] += end * state[0]
    scale = np.abs(expected).max()
    np.testing.assert_allclose(nodal[0] + 1j * nodal[1], expected, atol=1e-2 * scale)
    assert np.abs(nodal[0]).max() > 0.2 * scale  # the Coriolis force moves it out of the plane


def test_time_integration_converges_with_second_order():
    structure = beam_structure(LENGTH, COUNT, 0.05, 0.04)
    body = free_body(structure)
    time = np.arange(41) * 2.5e-3
    loads = central_step(structure, time, spin=3.0)
    smooth = BodyLoads(
        loads.time,
        loads.shapes,
        np.sin(np.pi * np.minimum(time / time[-1], 1.0))[:, None] * 10.0,
        RigidMotion(
            loads.motion.origin,
            np.zeros_like(loads.motion.gravity),
            loads.motion.gravity,
            loads.motion.rate,
            loads.motion.rate_derivative,
        ),
    )
    damping = RayleighDamping(0.03, 60.0, 600.0)
    results = [history(body, smooth, damping, substeps) for substeps in (16, 32, 64)]
    changes = [np.abs(a - b).max() for a, b in itertools.pairwise(results)]
    orders = np.log2(np.array(changes[:-1]) / np.array(changes[1:]))
    np.testing.assert_allclose(orders, 2.0, atol=0.15)


def test_constant_loads_leave_the_structure_in_its_steady_state():
    winged = winged_body(6, 8)
    factors = np.array([0.5, 0.5])
    body = winged.body(factors)
    time = np.arange(11) * 1e-3
    rate = np.broadcast_to([0.05, -0.1, 0.08], (11, 3))
    derivative = np.broadcast_to([0.2, 0.1, -0.3], (11, 3))
    zero = np.zeros((11, 3))
    motion = RigidMotion(body.centre_of_gravity, zero, zero, rate, derivative)
    amplitudes = np.ones((11, winged.applied.shape[1])) * 1e3
    loads = BodyLoads(time, winged.applied, amplitudes, motion)
    found = history(body, loads, RayleighDamping(), substeps=2)
    np.testing.assert_allclose(
        found, np.repeat(found[:, :1], 11, axis=1), atol=1e-8 * np.abs(found).max()
    )
    still = inertia_relief(body).displacement(winged.applied @ amplitudes[0])
    assert np.abs(found[:, 0] - still).max() > 1e-5 * np.abs(still).max()  # W terms take part


@pytest.mark.parametrize("seed", [3, 8])
def test_peaks_do_not_depend_on_origin_and_direction_of_the_axes(seed):
    turn = Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
    shift = np.array([30.0, -4.0, 9.0])
    factors = np.array([0.7, 0.1])
    straight = winged_body(6, 8)
    turned = winged_body(6, 8, turn, shift)
    loads = balanced_landing(straight, factors, seed, duration=0.1)
    peaks = full_order_peaks(straight, factors, loads, RayleighDamping())
    other = full_order_peaks(turned, factors, turned_landing(loads, turn, shift), RayleighDamping())
    np.testing.assert_allclose(other.stress, peaks.stress, rtol=1e-6)


def test_peaks_keep_the_earliest_largest_value_of_any_block():
    winged = winged_body(6, 8)
    factors = np.array([0.0, 1.0])
    loads = balanced_landing(winged, factors, 1, duration=0.08)
    body_loads = BodyLoads(loads.time, winged.applied, loads.applied_amplitudes(), loads.motion)
    whole = history(winged.body(factors), body_loads, RayleighDamping(), 1)
    recovery = winged.recovery
    stress = recovery.von_mises(recovery.shell_operator @ whole, recovery.beam_operator @ whole)
    peaks = full_order_peaks(winged, factors, loads, RayleighDamping())
    np.testing.assert_array_equal(peaks.sample, stress.argmax(axis=1))
    np.testing.assert_allclose(peaks.stress, stress.max(axis=1), rtol=1e-13)
