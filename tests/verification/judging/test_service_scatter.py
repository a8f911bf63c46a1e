"""The aircraft that lands differs from its definition by what the definition states."""

import numpy as np
import pytest

from solver.assess import AssessmentModel
from solver.landing.contact import Contact, Lift
from verification.judging.service_scatter import scattered_aircraft, scattered_lift


def test_gears_scatter_as_the_definition_says(example_jet: AssessmentModel) -> None:
    """Logarithms of 600 struts' gas pressures and damping, within four standard errors."""
    airframe = example_jet.airframe
    scatter = airframe.definition.scatter
    nominal = airframe.landing_aircraft(airframe.loading_for().factors)
    rng = np.random.default_rng(4)
    contact = Contact(1.0, 60.0)
    logs = []
    for _ in range(200):
        drawn = scattered_aircraft(nominal, contact, scatter, rng)
        logs += [
            (
                np.log(a.strut.initial_gas_pressure / b.strut.initial_gas_pressure),
                np.log(a.strut.compression_coefficient / b.strut.compression_coefficient),
            )
            for a, b in zip(drawn.gears, nominal.gears, strict=True)
        ]
    deviations = np.std(logs, axis=0)
    expected = np.array([scatter.gas_pressure, scatter.strut_damping])
    assert deviations == pytest.approx(expected, rel=4.0 / np.sqrt(2 * 600))


def test_lift_scatters_within_what_lift_can_be(example_jet: AssessmentModel) -> None:
    scatter = example_jet.airframe.definition.scatter
    rng = np.random.default_rng(6)
    drawn = [scattered_lift(Lift(), scatter, rng) for _ in range(500)]
    starts = np.array([each.decay_start for each in drawn])
    assert starts.min() >= 0.0
    assert starts.std() == pytest.approx(scatter.lift_decay_start, rel=0.15)
    assert all(0.0 <= each.residual_fraction <= 1.0 for each in drawn)
