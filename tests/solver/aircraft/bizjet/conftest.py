from pathlib import Path

import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet

COARSE = 0.25


@pytest.fixture(scope="package")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bizjet")
    build_bizjet(folder, COARSE)
    return folder


@pytest.fixture(scope="package")
def airframe(folder: Path) -> Airframe:
    return load_airframe(folder)
