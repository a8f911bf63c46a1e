"""Conventional inertia relief against closed forms of free beams, bars and plates."""

import numpy as np
import pytest

from solver.errors import ModelError
from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.static import determinate_support, inertia_relief, steady_state
from tests.solver.inertia_relief.bodies import (
    beam_structure,
    bending_stress_to_moment,
    point_loads,
)
from verification.elements import meshes

LENGTH, COUNT, FORCE = 2.0, 48, 1000.0


def largest_moment(loads: dict[tuple[int, int], float]) -> tuple[float, float]:
    """Largest bending moment and its station [m] along a free uniform beam."""
    structure = beam_structure(LENGTH, COUNT)
    relief = inertia_relief(free_body(structure))
    displacement = relief.displacement(point_loads(structure, loads))
    recovery = build_stress_recovery(structure)
    ends = np.abs(bending_stress_to_moment(structure, recovery.beam_operator @ displacement))
    # elements miss their own inertia load: the mean of both neighbours is a node's moment
    moment = (ends[:-1, 1] + ends[1:, 0]) / 2
    where = int(np.argmax(moment))
    return float(moment[where]), (where + 1) * LENGTH / COUNT


@pytest.mark.parametrize(
    ("loads", "moment", "station"),
    [
        # inertia along the beam is linear: M(x) = F x (1 - x / L)^2 from the loaded end
        pytest.param({(0, 2): FORCE}, 4 / 27 * FORCE * LENGTH, LENGTH / 3, id="end force"),
        pytest.param(
            {(COUNT // 2, 2): FORCE}, FORCE * LENGTH / 8, LENGTH / 2, id="force at the centre"
        ),
        # M(x) = F x (1 - x / L) (1 - 2 x / L), largest at x = L / 2 (1 - 1 / sqrt 3)
        pytest.param(
            {(0, 2): FORCE, (COUNT, 2): -FORCE},
            FORCE * LENGTH / (6 * np.sqrt(3)),
            None,
            id="opposite end forces",
        ),
    ],
)
def test_free_beam_bends_as_its_closed_form_says(loads, moment, station):
    found, where = largest_moment(loads)
    assert found == pytest.approx(moment, rel=2e-3)
    if station is not None:
        assert where == pytest.approx(station, abs=LENGTH / COUNT)


def test_stress_of_a_free_plate_does_not_depend_on_the_support():
    structure = build_structure(meshes.plate(1.0, 1.4, 6, 8, thickness=0.02))
    body = free_body(structure)
    loads = point_loads(structure, {(0, 2): 100.0, (30, 0): -300.0, (61, 4): 7.0})
    recovery = build_stress_recovery(structure)
    last = 6 * (structure.model.node_count - 1)
    corner = np.arange(6)
    three_points = np.array([0, 1, 2, 6 * 6 + 1, 6 * 6 + 2, last + 2])
    supports = [None, corner, last + np.arange(6), three_points]
    results = [inertia_relief(body, support).displacement(loads) for support in supports]
    stresses = [recovery.shell_operator @ result for result in results]
    for displacement, stress in zip(results[1:], stresses[1:], strict=True):
        scale = np.abs(stresses[0]).max()
        np.testing.assert_allclose(stress, stresses[0], atol=1e-8 * scale)
        np.testing.assert_allclose(displacement, results[0], atol=1e-8 * np.abs(results[0]).max())


def test_result_lies_in_the_mean_axis_frame_and_balances_the_loads():
    structure = beam_structure()
    body = free_body(structure)
    loads = point_loads(structure, {(3, 1): 50.0, (9, 4): -20.0, (40, 0): 10.0})
    displacement = inertia_relief(body).displacement(loads)
    momentum = body.rigid_momentum.T @ displacement
    assert np.abs(momentum).max() < 1e-12 * np.abs(displacement).max() * body.total_mass
    residual = body.stiffness @ displacement - body.self_equilibrated(loads)
    assert np.abs(residual).max() < 1e-7 * np.abs(loads).max()


def test_support_that_leaves_a_mechanism_is_refused():
    body = free_body(beam_structure())
    along_one_line = np.array([0, 6, 12, 18, 24, 30])
    with pytest.raises(ModelError, match="not a statically determinate support"):
        inertia_relief(body, along_one_line)
    with pytest.raises(ModelError, match="not a statically determinate support"):
        inertia_relief(body, determinate_support(body.rigid_modes, body.gyration_radius)[:5])


def spinning_bar(rate: float) -> float:
    """Half the elongation of a free bar turning about a transverse axis through its middle [m]."""
    structure = beam_structure(length=10.0, count=60)
    body = free_body(structure)
    zero = np.zeros((1, 3))
    motion = RigidMotion(body.centre_of_gravity, zero, zero, np.array([[0.0, 0.0, rate]]), zero)
    shapes = structure.inertia.rigid_load_shapes(motion.origin)
    rhs = shapes @ motion.inertia_amplitudes()[0]
    displacement, _ = steady_state(inertia_relief(body), rhs, motion.rate[0], zero[0])
    nodal = structure.nodal_displacements(displacement)
    return float(nodal[-1, 0] - nodal[0, 0]) / 2


def test_bar_spinning_slowly_stretches_by_the_linear_closed_form():
    rate, material = 20.0, meshes.material()
    # mu w^2 L^3 / (24 E A) with mu = rho A
    expected = material.density * rate**2 * 10.0**3 / (24 * material.young_modulus)
    assert spinning_bar(rate) == pytest.approx(expected, rel=1e-3)


def test_bar_spinning_fast_shows_centrifugal_softening():
    material = meshes.material()
    rate = 0.08 * np.sqrt(material.young_modulus / material.density)
    k = rate * np.sqrt(material.density / material.young_modulus)
    expected = np.tan(k * 5.0) / k - 5.0
    linear = material.density * rate**2 * 10.0**3 / (24 * material.young_modulus)
    assert expected > 1.05 * linear
    assert spinning_bar(rate) == pytest.approx(expected, rel=1e-3)


def test_rotation_beyond_the_softening_limit_is_refused():
    material = meshes.material()
    with pytest.raises(ModelError, match="did not converge"):
        spinning_bar(np.sqrt(material.young_modulus / material.density))
