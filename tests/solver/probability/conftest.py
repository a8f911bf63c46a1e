"""The coarse test aircraft and landings of it."""

import math

import numpy as np
import pytest

from solver.assess import AssessmentModel
from solver.assessment import TouchdownRecord
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import ContactUncertainty
from solver.landing.simulate import simulate_landing
from solver.probability.exceedance import Nominal
from worker.warm import Models

DEGREE = math.pi / 180.0

#: Deviations of a good recorder; the record's other components are exact.
RECORDER = {"sink_rate": 0.2, "pitch": 0.3 * DEGREE, "roll": 0.5 * DEGREE, "lift_fraction": 0.05}


@pytest.fixture(scope="session")
def mini(models: Models) -> AssessmentModel:
    return models.get("mini")


def landing(
    model: AssessmentModel,
    sink_rate: float,
    *,
    roll: float = 0.0,
    deviations: dict[str, float] | None = None,
) -> TouchdownRecord:
    contact = Contact(sink_rate=sink_rate, ground_speed=55.0, pitch=3.0 * DEGREE, roll=roll)
    given = RECORDER if deviations is None else deviations
    return TouchdownRecord(
        model.name, (contact,), uncertainties=(ContactUncertainty.independent(**given),)
    )


def assessed(model: AssessmentModel, record: TouchdownRecord) -> Nominal:
    """The landing as recorded, in full."""
    airframe = model.airframe
    loading = airframe.loading_for(record.mass)
    aircraft = airframe.landing_aircraft(loading.factors)
    reduced = assemble(model.reduced, loading.factors)
    histories = [simulate_landing(aircraft, contact) for contact in record.contacts]
    stress = [
        find_peaks(
            model.reduced, landing_response(reduced, landing_loads(airframe, history))
        ).stress
        for history in histories
    ]
    return Nominal(record, loading, reduced, histories, np.stack(stress))
