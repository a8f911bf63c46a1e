"""Large-rotation statics against published and closed solutions, on coarse meshes."""

import numpy as np
import pytest

from solver.errors import ModelError
from solver.nonlinear.static import equilibrium_path
from tests.solver.nonlinear.bodies import mixed
from verification.nonlinear.large_rotation import (
    BEND,
    SHEARED_STRIP,
    bend,
    rolled_strip,
    sheared_strip,
)


@pytest.mark.parametrize("triangular", [False, True])
def test_strip_under_end_shear_meets_the_published_tip(triangular):
    strip = sheared_strip(16, triangular)
    assert (strip.back[-1], strip.up[-1]) == pytest.approx(SHEARED_STRIP, rel=0.005)


def test_strip_under_end_moment_closes_to_a_circle():
    # eight flat elements bend to a closed octagon: each end turns by exactly an eighth
    strip = rolled_strip(8)
    assert strip.back[-1] == pytest.approx(12.0, abs=1e-6)
    assert strip.up[-1] == pytest.approx(0.0, abs=1e-6)
    # on the way the tip of n chords around a circle is where the closed form puts it
    angle = 2 * np.pi * strip.levels / 8
    steps = np.arange(8)[:, None] * angle + angle / 2
    chord = 12.0 / 8  # elements do not stretch
    np.testing.assert_allclose(strip.back, 12.0 - chord * np.cos(steps).sum(axis=0), atol=1e-6)


def test_curved_beam_bends_out_of_its_plane_as_published():
    np.testing.assert_allclose(bend(8, levels=6), BEND, rtol=0.01)


def test_structures_with_constraints_are_refused():
    structure = mixed()
    loads = np.zeros((structure.model.node_count, 6))
    with pytest.raises(ModelError, match="without constraints"):
        equilibrium_path(structure, loads == 0, loads, np.array([1.0]))
