"""Samples of a landing: symmetric, steeper the harder it lands, and none left out that matters."""

from dataclasses import replace

import numpy as np
import pytest

from solver.aircraft.scatter import AllowableBasis, Scatter
from solver.assess import AssessmentModel
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.landing.simulate import SimulationOptions, simulate_landing
from solver.probability import exceedance
from solver.probability.exceedance import LandingSampler
from solver.probability.limit_probability import chosen_elements
from solver.probability.loadings import CENTRE
from solver.probability.normals import sobol_normals
from solver.probability.variables import Sample
from tests.solver.probability.conftest import DEGREE, RECORDER, assessed, landing

NO_SCATTER = Scatter(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, AllowableBasis.LIMIT)


def exact(model: AssessmentModel) -> AssessmentModel:
    """An aircraft that is exactly as defined."""
    definition = replace(model.airframe.definition, scatter=NO_SCATTER)
    return replace(model, airframe=replace(model.airframe, definition=definition))


def sampler(model: AssessmentModel, record, threads: int = 1) -> LandingSampler:
    return LandingSampler(model.airframe, model.reduced, assessed(model, record), threads)


def drawn(landings: LandingSampler, count: int = 16) -> list[Sample]:
    variables = landings.variables
    normals = sobol_normals(variables.count, 1, count, 5)[0]
    return [variables.sample(row) for row in normals]


def test_the_landing_as_recorded_is_the_assessment(mini: AssessmentModel) -> None:
    landings = sampler(mini, landing(mini, 2.0))
    every = np.arange(mini.reduced.element_count)
    record = landings.nominal.record
    sample = Sample.as_recorded(record.contacts, mini.airframe.definition)
    found = landings.watch(every, [0]).utilisations([sample])
    full = landings.nominal.stress[0] / mini.airframe.allowables
    np.testing.assert_allclose(found.airframe[0].max(), full.max(), rtol=1e-6)
    history = landings.nominal.histories[0]
    gears = exceedance.gear_utilisations(mini.airframe, history)
    np.testing.assert_allclose(found.gears[0].max(), gears.max(), rtol=1e-6)


def test_samples_are_those_of_the_full_path(mini: AssessmentModel) -> None:
    """Rolled and drifting samples of a level landing, as the assessment would treat them."""
    given = RECORDER | {"roll": 1.0 * DEGREE, "drift": 1.0 * DEGREE}
    landings = sampler(mini, landing(mini, 2.4, deviations=given))
    samples = [
        replace(sample, point=CENTRE, structural_damping=1.0) for sample in drawn(landings, 4)
    ]
    every = np.arange(mini.reduced.element_count)
    found = landings.watch(every, [0]).utilisations(samples).airframe
    nominal = landings.nominal
    aircraft = mini.airframe.landing_aircraft(nominal.loading.factors)
    for sample, used in zip(samples, found, strict=True):
        history = simulate_landing(
            sample.aircraft(aircraft), sample.contacts[0], SimulationOptions(time_limit=2.5)
        )
        response = landing_response(nominal.reduced, landing_loads(mini.airframe, history))
        full = find_peaks(mini.reduced, response).stress / mini.airframe.allowables
        matters = full > 0.5 * full.max()
        np.testing.assert_allclose(used[matters], full[matters], rtol=0.05)
        assert used.max() == pytest.approx(full.max(), rel=0.01)


def test_threads_change_nothing(mini: AssessmentModel) -> None:
    elements = np.arange(0, mini.reduced.element_count, 9)
    record = landing(mini, 2.0)
    found = []
    for threads in (1, 3):
        landings = sampler(mini, record, threads)
        found.append(landings.watch(elements, [0]).utilisations(drawn(landings, 8)))
    np.testing.assert_array_equal(found[0].airframe, found[1].airframe)
    np.testing.assert_array_equal(found[0].gears, found[1].gears)


def test_port_and_starboard_are_alike(mini: AssessmentModel) -> None:
    """A landing rolled the other way, everything else the same, is the same in its mirror."""
    model = exact(mini)
    given = {"sink_rate": 0.3, "lift_fraction": 0.05}
    every = np.arange(mini.reduced.element_count)
    largest = []
    for side in (-1.0, 1.0):
        record = landing(model, 2.0, roll=side * 2.0 * DEGREE, deviations=given)
        landings = sampler(model, record)
        largest.append(landings.watch(every, [0]).utilisations(drawn(landings, 8)).largest)
    np.testing.assert_allclose(largest[0], largest[1], rtol=2e-3)


def test_harder_landings_exceed_more_often(mini: AssessmentModel) -> None:
    elements = np.arange(0, mini.reduced.element_count, 9)
    shares, middles = [], []
    for sink_rate in (2.0, 2.8, 3.6):
        landings = sampler(mini, landing(mini, sink_rate, deviations=RECORDER))
        largest = landings.watch(elements, [0]).utilisations(drawn(landings)).largest
        shares.append(np.mean(largest > 1.0))
        middles.append(np.median(largest))
    assert shares[0] <= shares[1] <= shares[2]
    assert shares[0] < 0.2
    assert shares[2] > 0.8
    assert middles[0] < middles[1] < middles[2]


def test_elements_left_out_could_not_have_mattered(mini: AssessmentModel) -> None:
    """Of every element in every sample, the one that comes first to its limit is watched."""
    landings = sampler(mini, landing(mini, 2.6, roll=1.0 * DEGREE))
    used = landings.nominal.stress[0] / mini.airframe.allowables
    chosen = chosen_elements([used])
    every = landings.watch(np.arange(len(used)), [0]).utilisations(drawn(landings))
    assert len(chosen) < 0.5 * len(used)
    np.testing.assert_array_equal(every.airframe.max(axis=1), every.airframe[:, chosen].max(axis=1))


def test_what_cannot_be_simulated_counts_as_exceeding(
    mini: AssessmentModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    landings = sampler(mini, landing(mini, 1.0))
    watched = landings.watch(np.array([0, 1]), [0])
    options = replace(exceedance.SAMPLE_OPTIONS, energy_bound=0.0)
    monkeypatch.setattr(exceedance, "SAMPLE_OPTIONS", options)
    assert np.all(np.isinf(watched.utilisations(drawn(landings, 2)).largest))
