"""The aircraft that the tests of this room land."""

import pytest

from solver.landing.aircraft import LandingAircraft
from tests.solver.landing.business_jet import business_jet


@pytest.fixture(scope="session")
def aircraft() -> LandingAircraft:
    return business_jet()
