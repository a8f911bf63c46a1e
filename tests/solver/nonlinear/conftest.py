"""The mini aircraft, written and loaded once."""

import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from tests.solver.aircraft.mini import write_mini_aircraft


@pytest.fixture(scope="session")
def mini(tmp_path_factory: pytest.TempPathFactory) -> Airframe:
    return load_airframe(write_mini_aircraft(tmp_path_factory.mktemp("mini")))
