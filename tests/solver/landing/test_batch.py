"""Many landings at once give what each gives alone."""

from dataclasses import fields

import numpy as np
import pytest

from solver.errors import RecordError, SimulationDivergedError
from solver.landing import sequence
from solver.landing.batch import simulate_landings
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.landing.business_jet import business_jet

SHORT = SimulationOptions(time_limit=0.2)
CONTACTS = [Contact(sink_rate=0.5 * n, ground_speed=55.0, roll=0.01 * n) for n in range(1, 6)]


def arrays_of(history: LandingHistory) -> dict[str, np.ndarray]:
    found = {}
    for field in fields(history):
        value = getattr(history, field.name)
        if isinstance(value, np.ndarray):
            found[field.name] = value
    for gear in history.gears:
        found[f"{gear.name} ground"] = gear.ground_force
        found[f"{gear.name} pins"] = gear.pin_loads
    return found


@pytest.mark.parametrize("threads", [1, 3])
def test_every_landing_is_that_of_the_single_form_to_the_last_bit(threads: int) -> None:
    aircraft = business_jet()
    found = simulate_landings(
        [(aircraft, contact) for contact in CONTACTS],
        lambda place, history: (place, history),
        SHORT,
        threads,
    )
    for place, contact in enumerate(CONTACTS):
        number, together = found[place]
        alone = simulate_landing(aircraft, contact, SHORT)
        assert number == place
        for name, values in arrays_of(alone).items():
            np.testing.assert_array_equal(arrays_of(together)[name], values, err_msg=name)


def test_a_landing_that_diverges_does_not_take_the_others_with_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def simulate(aircraft: object, contact: Contact, *rest: object) -> LandingHistory:
        if contact.sink_rate == CONTACTS[1].sink_rate:
            raise SimulationDivergedError("as it happens")
        return simulate_landing(aircraft, contact, *rest)

    monkeypatch.setattr(sequence, "simulate_landing", simulate)
    aircraft = business_jet()
    found = simulate_landings(
        [(aircraft, contact) for contact in CONTACTS[:3]], lambda place, _: place, SHORT
    )
    assert found[0] == 0
    assert isinstance(found[1], SimulationDivergedError)
    assert found[2] == 2


def test_a_contact_that_no_landing_can_have_is_refused() -> None:
    with pytest.raises(RecordError, match="sink_rate"):
        simulate_landings(
            [(business_jet(), Contact(sink_rate=-1.0, ground_speed=55.0))], lambda *_: None
        )
