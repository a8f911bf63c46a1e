"""From standard normal variables to landings."""

from dataclasses import replace

import numpy as np
import pytest

from solver.aircraft.scatter import AllowableBasis
from solver.assess import AssessmentModel
from solver.errors import RecordError
from solver.landing.contact import Lift, LiftModel
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS, ContactUncertainty
from solver.probability.corner import DISTANCE, corners
from solver.probability.normals import sobol_normals
from solver.probability.variables import SOFTEST, LandingVariables, Sample
from tests.solver.probability.conftest import DEGREE, landing


def samples_of(model: AssessmentModel, record, count: int = 8) -> list[Sample]:
    variables = LandingVariables(model.airframe, record)
    normals = sobol_normals(variables.count, count, 32, 7)
    return [variables.sample(row) for row in normals.reshape(-1, variables.count)]


def states(samples: list[Sample]) -> np.ndarray:
    return np.array(
        [
            [
                sample.contacts[0].lift.fraction
                if name == "lift_fraction"
                else getattr(sample.contacts[0], name)
                for name in CONTACT_COMPONENTS
            ]
            for sample in samples
        ]
    )


def with_covariance(record, covariance: np.ndarray, **contact: object):
    return replace(
        record,
        contacts=(replace(record.contacts[0], **contact),),
        uncertainties=(ContactUncertainty.from_matrix(covariance),),
    )


def test_samples_have_the_records_covariance(mini: AssessmentModel) -> None:
    """A random covariance of full rank, sampled 2,048 times; lift below the weight."""
    deviations = np.array([0.2, 0.01, 0.01, 0.02, 1.0, 0.01, 0.02, 0.01, 0.03])
    mixed = np.random.default_rng(2).normal(size=(9, 9))
    covariance = mixed @ mixed.T
    scale = deviations / np.sqrt(np.diag(covariance))
    covariance *= np.outer(scale, scale)
    record = with_covariance(landing(mini, 2.0), covariance, lift=Lift(fraction=0.8))
    found = states(samples_of(mini, record, 64))
    recorded = record.contacts[0]
    np.testing.assert_allclose(found.mean(axis=0)[0], recorded.sink_rate, atol=0.01)
    correlation = np.cov(found.T) / np.outer(deviations, deviations)
    expected = covariance / np.outer(deviations, deviations)
    np.testing.assert_allclose(correlation, expected, atol=0.08)


def test_components_that_move_together_do(mini: AssessmentModel) -> None:
    """A singular covariance: sink rate and pitch rate known by one number only."""
    covariance = np.zeros((9, 9))
    direction = np.zeros(9)
    direction[[0, 5]] = 0.3, -0.02
    covariance[:] = np.outer(direction, direction)
    record = with_covariance(landing(mini, 2.0), covariance)
    found = states(samples_of(mini, record))
    np.testing.assert_allclose(found[:, 5], (found[:, 0] - 2.0) * -0.02 / 0.3, atol=1e-12)
    assert np.std(found[:, 0]) == pytest.approx(0.3, rel=0.1)


def test_the_spoilers_come_out_once_for_all_contacts(mini: AssessmentModel) -> None:
    """Two contacts, spoilers 0.6 s after the first: the later one sees what is left, or none."""
    scatter = mini.airframe.definition.scatter
    first = landing(mini, 2.0)
    lift = Lift(fraction=0.9, decay_start=0.6)
    for apart in (0.5, 0.7, 3.0):
        contact = replace(first.contacts[0], lift=lift)
        later = replace(contact, time=apart, lift=lift.seen_from(apart))
        record = replace(
            first, contacts=(contact, later), uncertainties=(first.uncertainties[0],) * 2
        )
        starts = np.array(
            [[c.lift.decay_start for c in s.contacts] for s in samples_of(mini, record)]
        )
        inside = starts[:, 0] > 0.0
        np.testing.assert_allclose(
            starts[inside, 1], np.maximum(starts[inside, 0] - apart, 0.0), atol=1e-12
        )
        assert starts[:, 0].std() == pytest.approx(scatter.lift_decay_start, rel=0.1)


def test_a_course_of_the_lift_that_is_known_better_scatters_less(mini: AssessmentModel) -> None:
    """What the record does not state scatters as the definition says; lognormal, median kept."""
    first = landing(mini, 2.0)
    lift = Lift(fraction=0.9, decay_start=0.6, decay_time=0.8, residual_fraction=0.4)
    known = replace(first.uncertainties[0], lift_course=(0.02, 0.05, None))
    record = replace(
        first, contacts=(replace(first.contacts[0], lift=lift),), uncertainties=(known,)
    )
    found = [sample.contacts[0].lift for sample in samples_of(mini, record, 64)]
    assert np.std([each.decay_start for each in found]) == pytest.approx(0.02, rel=0.05)
    time = np.array([each.decay_time for each in found])
    assert np.median(time) == pytest.approx(0.8, rel=0.01)
    assert np.std(time) == pytest.approx(0.05 * 0.8, rel=0.05)
    usual = mini.airframe.definition.scatter.residual_lift_fraction
    assert np.std([each.residual_fraction for each in found]) == pytest.approx(usual, rel=0.05)


def test_nothing_lands_upwards_or_flies_away(mini: AssessmentModel) -> None:
    record = landing(mini, 0.3, deviations={"sink_rate": 0.5, "lift_fraction": 0.2})
    found = states(samples_of(mini, record))
    assert found[:, 0].min() == SOFTEST
    assert found[:, 8].max() == 1.0
    assert found[:, 8].min() < 0.7


def test_recorded_lift_above_the_weight_is_kept(mini: AssessmentModel) -> None:
    record = landing(mini, 1.0, deviations={"lift_fraction": 0.05})
    lift = Lift(LiftModel.TRIMMED, recorded_normal_acceleration=1.04)
    record = replace(record, contacts=(replace(record.contacts[0], lift=lift),))
    found = [s.contacts[0].lift.recorded_normal_acceleration for s in samples_of(mini, record)]
    assert max(found) == 1.04
    assert min(found) < 0.95


def test_factors_have_the_definitions_scatter(mini: AssessmentModel) -> None:
    """Lognormal with median one; friction is one for all gears, pressures are their own."""
    scatter = mini.airframe.definition.scatter
    samples = samples_of(mini, landing(mini, 2.0), 32)
    pressure = np.array([sample.gears[:, 0] for sample in samples])
    friction = np.array([sample.friction for sample in samples])
    assert np.std(pressure) == pytest.approx(scatter.gas_pressure, rel=0.1)
    assert np.median(friction) == pytest.approx(1.0, abs=0.02)
    assert np.std(friction) == pytest.approx(scatter.tyre_friction, rel=0.1)
    assert np.abs(np.corrcoef(pressure.T) - np.eye(pressure.shape[1])).max() < 0.15


def test_friction_that_was_measured_scatters_by_what_was_measured(mini: AssessmentModel) -> None:
    record = replace(landing(mini, 2.0), runway_friction=0.6, runway_friction_deviation=0.03)
    friction = np.array([sample.friction for sample in samples_of(mini, record, 32)])
    assert np.std(friction) == pytest.approx(0.03 / 0.6, rel=0.1)


def test_a_sample_changes_its_gears_and_nothing_else(mini: AssessmentModel) -> None:
    sample = samples_of(mini, landing(mini, 2.0))[0]
    nominal = mini.airframe.landing_aircraft(mini.airframe.loading_for().factors)
    found = sample.aircraft(nominal)
    for gear, defined, factors in zip(found.gears, nominal.gears, sample.gears, strict=True):
        pressure, damping, stiffness = factors
        strut, tyre = defined.strut, defined.tyre
        assert gear.strut.initial_gas_pressure == pressure * strut.initial_gas_pressure
        assert gear.strut.compression_coefficient == damping * strut.compression_coefficient
        assert gear.strut.rebound_coefficient == damping * strut.rebound_coefficient
        assert gear.tyre.vertical_coefficient == stiffness * tyre.vertical_coefficient
        assert gear.tyre.maximum_friction == sample.friction * tyre.maximum_friction
        assert gear.strut.full_stroke == strut.full_stroke
    assert found.mass == nominal.mass


@pytest.mark.parametrize(("basis", "share"), [("A", 0.99), ("B", 0.90)])
def test_allowables_of_a_basis_are_exceeded_by_its_share(
    mini: AssessmentModel, basis: str, share: float
) -> None:
    """MMPDS: 99 % and 90 % of specimens are stronger than A- and B-basis values."""
    scatter = replace(
        mini.airframe.definition.scatter, allowable=0.05, allowable_basis=AllowableBasis(basis)
    )
    airframe = replace(mini.airframe, definition=replace(mini.airframe.definition, scatter=scatter))
    samples = samples_of(replace(mini, airframe=airframe), landing(mini, 2.0), 16)
    strength = np.array([sample.zone_strength for sample in samples])
    assert np.mean(strength > 1.0) == pytest.approx(share, abs=0.01)
    assert np.std(strength) / np.mean(strength) == pytest.approx(0.05, rel=0.1)


def test_each_contact_needs_its_uncertainty(mini: AssessmentModel) -> None:
    record = landing(mini, 2.0)
    twice = replace(record, contacts=record.contacts * 2)
    with pytest.raises(RecordError, match="1 contacts, the record has 2"):
        LandingVariables(mini.airframe, twice)


class TestCorners:
    def test_distance_and_side(self, mini: AssessmentModel) -> None:
        """Rolled to port: the corner rolls further that way, the mirrored one back."""
        record = landing(mini, 2.0, roll=-1.0 * DEGREE)
        variables = LandingVariables(mini.airframe, record)
        stress, side = corners(variables, record.contacts[0], 0)
        back, _ = corners(variables, record.contacts[0], 0, mirrored=True)
        for normals in (stress, side, back):
            assert np.linalg.norm(normals) == pytest.approx(DISTANCE)
        contact = variables.sample(stress).contacts[0]
        assert contact.sink_rate > 2.0
        assert contact.roll < -1.0 * DEGREE
        assert variables.sample(back).contacts[0].roll > -1.0 * DEGREE

    def test_the_corner_is_the_worst_point_of_a_linear_limit_at_its_distance(
        self, mini: AssessmentModel
    ) -> None:
        """For a correlated state it is covariance times slopes (Hasofer and Lind, 1974)."""
        covariance = np.zeros((9, 9))
        covariance[np.ix_([0, 2], [0, 2])] = [[0.04, 0.0012], [0.0012, 0.0001]]
        record = with_covariance(landing(mini, 2.0), covariance)
        variables = LandingVariables(mini.airframe, record)
        sample = variables.sample(next(corners(variables, record.contacts[0], 0)))
        change = np.array([sample.contacts[0].sink_rate - 2.0, sample.contacts[0].roll])
        wanted = covariance[np.ix_([0, 2], [0, 2])] @ [0.35, 6.0]
        np.testing.assert_allclose(change / change[0], wanted / wanted[0], rtol=1e-9)
