"""The mini aircraft, written and loaded once."""

from pathlib import Path

import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from tests.solver.aircraft.mini import write_mini_aircraft


@pytest.fixture(scope="session")
def mini_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Read only; tests that change a file write their own copy."""
    return write_mini_aircraft(tmp_path_factory.mktemp("mini"))


@pytest.fixture(scope="session")
def mini(mini_folder: Path) -> Airframe:
    return load_airframe(mini_folder)
