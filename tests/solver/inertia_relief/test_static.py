"""Conventional inertia relief against closed forms of free beams, bars and plates."""

import numpy as np
import pytest

from solver.errors import ModelError
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.static import determinate_support, inertia_relief
from verification.elements import meshes
from verification.inertia_relief.free_beam import beam_structure, point_loads
from verification.inertia_relief.statics import (
    COUNT,
    FREE_BEAM_CASES,
    LENGTH,
    bar_extension,
    largest_moment,
    plate_supports,
    spinning_bar,
)


@pytest.mark.parametrize("case", FREE_BEAM_CASES, ids=lambda case: case.name)
def test_free_beam_bends_as_its_closed_form_says(case):
    found, where = largest_moment(case.loads)
    assert found == pytest.approx(case.moment, rel=2e-3)
    if case.station is not None:
        assert where == pytest.approx(case.station, abs=LENGTH / COUNT)


def test_stress_of_a_free_plate_does_not_depend_on_the_support():
    choice = plate_supports()
    assert choice.stress < 1e-8
    assert choice.displacement < 1e-8


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


def test_bar_spinning_slowly_stretches_by_the_linear_closed_form():
    linear, _ = bar_extension(20.0)
    assert spinning_bar(20.0) == pytest.approx(linear, rel=1e-3)


def test_bar_spinning_fast_shows_centrifugal_softening():
    material = meshes.material()
    rate = 0.08 * np.sqrt(material.young_modulus / material.density)
    linear, softened = bar_extension(rate)
    assert softened > 1.05 * linear
    assert spinning_bar(rate) == pytest.approx(softened, rel=1e-3)


def test_rotation_beyond_the_softening_limit_is_refused():
    material = meshes.material()
    with pytest.raises(ModelError, match="did not converge"):
        spinning_bar(np.sqrt(material.young_modulus / material.density))
