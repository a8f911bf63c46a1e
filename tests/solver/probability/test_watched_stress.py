"""Peaks of watched elements against the search through all of them."""

import numpy as np
import pytest

from solver.assess import AssessmentModel
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.modal_recursion import modal_response, step_coefficients
from solver.probability.watched_kernels import fill_departures
from solver.probability.watched_stress import watch, watched_stress
from tests.solver.probability.conftest import DEGREE, assessed, landing


@pytest.mark.parametrize(("sink_rate", "roll"), [(1.0, 0.0), (2.5, 2.0)])
def test_peaks_are_those_of_the_full_search(
    mini: AssessmentModel, sink_rate: float, roll: float
) -> None:
    """Shells and beams; W terms left out, patterns and modes found in another landing."""
    nominal = assessed(mini, landing(mini, sink_rate, roll=roll * DEGREE))
    example = assessed(mini, landing(mini, 1.8, roll=3.0 * DEGREE))
    every = np.arange(mini.reduced.element_count)
    watched = watched_stress(
        nominal.reduced,
        watch(mini.reduced, every),
        mini.airframe.allowables,
        [landing_loads(mini.airframe, example.histories[0])],
        float((example.stress / mini.airframe.allowables).max()),
    )
    found = watched.peaks(landing_loads(mini.airframe, nominal.histories[0]))
    full = nominal.stress[0]
    used = full / mini.airframe.allowables
    assert 0 < watched.watched.shells < len(every)
    matters = used > 0.5 * used.max()
    np.testing.assert_allclose(found[matters], full[matters], rtol=0.015)
    np.testing.assert_allclose(found / full.max(), full / full.max(), atol=0.01)


def test_elements_may_come_in_any_order(mini: AssessmentModel) -> None:
    elements = np.array([7, 3, 120, 3])
    rows = watch(mini.reduced, elements)
    np.testing.assert_array_equal(rows.elements, [3, 7, 120])
    assert rows.rows.shape == (18, mini.reduced.size)


def test_departures_are_displacement_minus_load() -> None:
    """Against the recursion of the full path, for slow, fast and overdamped modes."""
    frequency, ratio = np.array([5.0, 300.0, 40.0]), np.array([0.02, 0.3, 1.5])
    step = step_coefficients(frequency, ratio, 2e-3)
    load = np.random.default_rng(1).normal(size=(200, 3)).cumsum(axis=0)
    found = np.empty(load.shape, dtype=np.float32)
    fill_departures(
        np.ascontiguousarray(step.displacement.T),
        np.ascontiguousarray(step.velocity.T),
        load,
        found,
    )
    displacement, _ = modal_response(step, load.T)
    np.testing.assert_allclose(found, displacement.T - load, atol=1e-5)
