"""From a simulated landing of a whole aircraft to its peaks, reduced and at full order."""

from math import radians

import numpy as np
import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.basis import BasisSettings, elastic_modes, extended
from solver.inertia_relief.build import airframe_damping, project, reduced_model
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import applied_shapes, landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.aircraft.mini import write_mini_aircraft

#: Fuel in port and starboard tank, then three bays: unlike any mass state of the basis.
FACTORS = np.array([0.45, 0.3, 0.8, 0.1, 0.6])
#: A hard landing on one gear first.
CONTACT = Contact(
    sink_rate=2.8,
    ground_speed=58.0,
    pitch=radians(4.0),
    roll=radians(3.0),
    roll_rate=radians(2.0),
)
SETTINGS = BasisSettings(modes=60)


@pytest.fixture(scope="module")
def jet(tmp_path_factory) -> Airframe:
    """Return the example business jet on a coarse mesh."""
    folder = tmp_path_factory.mktemp("coarse-jet")
    build_bizjet(folder, refinement=0.25)
    return load_airframe(folder)


@pytest.fixture(scope="module")
def jet_loads(jet):
    options = SimulationOptions(time_limit=0.25, stop_when_settled=False)
    return landing_loads(jet, simulate_landing(jet.landing_aircraft(FACTORS), CONTACT, options))


@pytest.fixture(scope="module")
def jet_peaks(jet, jet_loads):
    """Return peaks of the full-order integration with half-millisecond steps."""
    peaks = PeakAccumulator(jet.recovery)
    loads = BodyLoads(
        jet_loads.time, applied_shapes(jet), jet_loads.applied_amplitudes(), jet_loads.motion
    )
    body = free_body(jet.structure, jet.inertia(FACTORS))
    integrate_full_order(body, loads, airframe_damping(jet), peaks, substeps=2)
    return peaks.stress


def test_reduced_peaks_agree_with_the_full_order_within_one_percent(jet, jet_loads, jet_peaks):
    model = reduced_model(jet, settings=SETTINGS)
    response = landing_response(assemble(model, FACTORS), jet_loads)
    assert response.equilibrium_residual < 1e-11
    peaks = find_peaks(model, response)
    stressed = jet_peaks > 0.2 * jet_peaks.max()
    assert stressed.sum() > 100
    np.testing.assert_allclose(peaks.stress[stressed], jet_peaks[stressed], rtol=0.01)


def test_modes_without_residual_vectors_miss_the_gear_fittings(jet, jet_loads, jet_peaks):
    base, groups = jet.structure.inertia, tuple(group.inertia for group in jet.groups)
    frequencies, shapes = elastic_modes(free_body(jet.structure, jet.inertia(FACTORS)), 150)
    none = np.zeros((len(shapes), 0))
    basis = extended(jet.structure.stiffness, none, shapes / frequencies, 1e-9)
    model = project(
        jet.structure,
        base,
        groups,
        applied_shapes(jet),
        jet.recovery,
        basis,
        airframe_damping(jet),
    )
    peaks = find_peaks(model, landing_response(assemble(model, FACTORS), jet_loads))
    stressed = jet_peaks > 0.2 * jet_peaks.max()
    assert np.abs(peaks.stress / jet_peaks - 1)[stressed].max() > 0.2


def test_real_landings_balance_to_rounding_and_keep_the_mass_properties(tmp_path):
    mini = load_airframe(write_mini_aircraft(tmp_path / "mini"))
    model = reduced_model(mini, settings=BasisSettings(modes=10, residual_order=1))
    for factors in ([0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.9, 0.2, 0.4]):
        loading = assemble(model, np.array(factors))
        properties = mini.mass_properties(np.array(factors))
        assert loading.mass == pytest.approx(properties.mass, rel=1e-12)
        np.testing.assert_allclose(
            loading.centre_of_gravity, properties.centre_of_gravity, atol=1e-10
        )
        options = SimulationOptions(time_limit=0.3, stop_when_settled=False)
        aircraft = mini.landing_aircraft(np.array(factors))
        history = simulate_landing(aircraft, CONTACT, options)
        response = landing_response(loading, landing_loads(mini, history))
        assert response.equilibrium_residual < 1e-11


def test_reduced_model_is_built_once_for_each_airframe_and_setting(tmp_path):
    folder = write_mini_aircraft(tmp_path / "mini")
    settings = BasisSettings(modes=8, residual_order=1)
    steps: list[str] = []

    def progress(step: str, share: float) -> None:
        steps.append(step)

    first = reduced_model(load_airframe(folder), tmp_path / "cache", settings, progress=progress)
    assert {"elastic modes", "residual vectors", "projection"} <= set(steps)
    steps.clear()
    again = reduced_model(load_airframe(folder), tmp_path / "cache", settings, progress=progress)
    assert steps == []
    np.testing.assert_array_equal(again.mass, first.mass)
    definition = folder / "definition.toml"
    definition.write_text(definition.read_text() + "\n# another content\n")
    changed = reduced_model(load_airframe(folder), tmp_path / "cache", settings, progress=progress)
    assert steps
    assert changed.key != first.key
