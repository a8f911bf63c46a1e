"""Many landings of one loading against each by itself."""

import numpy as np
import pytest

from solver.errors import EquilibriumError
from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.landings import landing_peaks, peaks_of_landings
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.peaks import LANDINGS_AT_ONCE
from verification.inertia_relief.winged_body import balanced_landing, reduced, winged_body

FACTORS = np.array([0.85, 0.3])


@pytest.fixture(scope="module")
def winged():
    return winged_body(6, 8)


@pytest.fixture(scope="module")
def model(winged):
    return reduced(winged, BasisSettings(modes=20), RayleighDamping(0.02, 3.0, 40.0))


def test_many_landings_are_each_by_itself(winged, model):
    """More than are taken at once, some short, in the order in which they came."""
    landings = [
        balanced_landing(winged, FACTORS, seed, duration=0.03 + 0.01 * (seed % 3))
        for seed in range(LANDINGS_AT_ONCE + 2)
    ]
    found = list(peaks_of_landings(assemble(model, FACTORS), iter(landings)))
    assert len(found) == len(landings)
    for loads, together in zip(landings, found, strict=True):
        alone = landing_peaks(model, FACTORS, loads)
        assert np.array_equal(together.peaks.stress, alone.peaks.stress)
        assert np.array_equal(together.peaks.sample, alone.peaks.sample)
        assert together.equilibrium_residual == alone.equilibrium_residual


def test_floors_go_through_to_the_search(winged, model):
    loads = balanced_landing(winged, FACTORS, 3, duration=0.05)
    everything = landing_peaks(model, FACTORS, loads).peaks.stress
    floor = 0.5 * everything.max()
    found = landing_peaks(model, FACTORS, loads, floor).peaks
    assert np.array_equal(found.below_floor, everything <= floor)
    assert np.array_equal(found.stress, np.maximum(everything, floor))


def test_a_landing_out_of_balance_among_others_is_refused(winged, model):
    landings = [balanced_landing(winged, factors, 3, 0.03) for factors in (FACTORS, FACTORS + 0.01)]
    with pytest.raises(EquilibriumError):
        list(peaks_of_landings(assemble(model, FACTORS), landings))
