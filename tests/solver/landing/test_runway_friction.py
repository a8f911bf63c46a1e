"""Friction of the runway: drag of a sliding tyre is in proportion to it (Coulomb)."""

import numpy as np
import pytest

from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing


def test_every_tyre_slides_with_what_was_measured(aircraft: LandingAircraft) -> None:
    wet = aircraft.on_runway(0.4)
    for gear, dry in zip(wet.gears, aircraft.gears, strict=True):
        assert gear.tyre.maximum_friction == 0.4
        kept = dry.tyre.minimum_friction / dry.tyre.maximum_friction
        assert gear.tyre.minimum_friction == pytest.approx(0.4 * kept)
        assert gear.strut == dry.strut


def test_drag_of_a_wheel_at_rest_goes_with_the_friction(aircraft: LandingAircraft) -> None:
    """Before the wheels turn all of the tread slides: drag over load is the sliding friction."""
    options = SimulationOptions(time_limit=0.02, stop_when_settled=False)
    contact = Contact(2.0, 60.0, pitch=0.09)
    ratios = []
    for friction in (0.3, 0.6):
        history = simulate_landing(aircraft.on_runway(friction), contact, options)
        force = history.gears[0].ground_force[5]
        ratios.append(-np.hypot(force[0], force[1]) / force[2])
    assert ratios[1] / ratios[0] == pytest.approx(2.0, rel=0.02)
