"""Loadings that stand for an uncertain mass and centre of gravity."""

from dataclasses import replace

import numpy as np
import pytest

from solver.assess import AssessmentModel
from solver.probability.loadings import CENTRE, LoadingPoints, loading_points
from solver.probability.normals import sobol_normals
from tests.solver.probability.conftest import landing


def test_drawn_loadings_have_the_stated_mean_and_deviations(mini: AssessmentModel) -> None:
    """Five points: exact to the third moment where tanks and bays have room."""
    record = replace(landing(mini, 2.0), mass_deviation=120.0, centre_of_gravity_deviation=0.02)
    airframe = mini.airframe
    loading = airframe.loading_for()
    points = loading_points(airframe, record, loading)
    drawn = [LoadingPoints.point_of(z) for z in sobol_normals(1, 8, 128, 3).ravel()]
    masses, centres = np.array(
        [
            (mass, centre[0])
            for mass, centre in (
                airframe.mass_states.gross(points.factors[point]) for point in drawn
            )
        ]
    ).T
    assert masses.mean() == pytest.approx(loading.mass, abs=1.0)
    assert masses.std() == pytest.approx(120.0, rel=0.02)
    balanced = [airframe.mass_states.gross(points.factors[point])[1][0] for point in (1, 3)]
    middle = airframe.mass_states.gross(points.factors[CENTRE])[1][0]
    np.testing.assert_allclose(
        np.array(balanced) - middle, np.array([-1.0, 1.0]) * np.sqrt(3.0) * 0.02, rtol=1e-6
    )
    assert np.all(np.abs(centres - middle) < 0.1)
    np.testing.assert_array_equal(points.factors[CENTRE], loading.factors)


def test_shares_of_the_points() -> None:
    drawn = [LoadingPoints.point_of(z) for z in sobol_normals(1, 8, 256, 3).ravel()]
    shares = np.bincount(drawn, minlength=5) / len(drawn)
    np.testing.assert_allclose(shares, np.array([1, 1, 2, 1, 1]) / 6, atol=0.002)


def test_no_tank_holds_more_than_fits(mini: AssessmentModel) -> None:
    record = replace(landing(mini, 2.0), mass_deviation=5000.0)
    points = loading_points(mini.airframe, record, mini.airframe.loading_for())
    for factors in points.factors:
        assert np.all((factors >= 0.0) & (factors <= 1.0))
