from pathlib import Path

import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet


@pytest.fixture(scope="package")
def airframe(tmp_path_factory: pytest.TempPathFactory) -> Airframe:
    folder: Path = tmp_path_factory.mktemp("coarse")
    build_bizjet(folder, refinement=0.25)
    return load_airframe(folder)
