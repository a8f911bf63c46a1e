"""Critical loads against closed forms, and their convergence."""

import numpy as np
import pytest

from solver.fe.structure import build_structure
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.static import inertia_relief
from solver.nonlinear.buckling import buckling_modes, geometric_stiffness
from solver.nonlinear.structure import nonlinear_structure
from verification.elements import meshes
from verification.nonlinear.buckling import column_factor, plate_factor


def test_column_converges_to_euler_with_second_order():
    errors = [column_factor(count) - 1.0 for count in (4, 8)]
    assert errors[1] < 0.02
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("triangular", [False, True])
def test_plate_converges_to_the_closed_form(triangular):
    errors = [plate_factor(count, triangular) - 1.0 for count in (4, 8)]
    assert 0.0 < errors[1] < 0.04
    assert errors[0] / errors[1] > 3.0


def test_turning_the_plate_as_a_whole_changes_nothing():
    """Turned by 0.02 about any axis, twice its thickness over its side, on top of the strain."""
    still = plate_factor(4)
    for axis in range(3):
        turn = np.zeros(3)
        turn[axis] = 0.02
        assert plate_factor(4, turn=turn) == pytest.approx(still, rel=1e-6)


def test_free_column_pushed_at_both_ends_buckles_at_eulers_load():
    # nothing holds it: the two forces balance, and any determinate support serves
    count, width, height, length = 16, 0.02, 0.01, 1.0
    model = meshes.straight_beam(length, count, meshes.rectangle_section(width, height))
    linear = build_structure(model)
    relief = inertia_relief(free_body(linear))
    loads = np.zeros((count + 1, 6))
    loads[0, 0] = np.pi**2 * 70e9 * width * height**3 / 12 / length**2
    loads[-1, 0] = -loads[0, 0]
    displacement = relief.displacement(loads.ravel())
    geometric = geometric_stiffness(nonlinear_structure(model), displacement)
    moving = np.setdiff1d(np.arange(6 * (count + 1)), relief.support)
    modes = buckling_modes(linear.stiffness, geometric, moving, 4)
    bending = np.abs(modes.factors - 1.0).min()
    assert bending < 0.005
