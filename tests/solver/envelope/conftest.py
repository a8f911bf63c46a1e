"""An envelope of the mini aircraft from real landings, made once."""

from pathlib import Path

import pytest

from solver.assess import AssessmentModel, load_assessment_model
from solver.envelope.build import build_envelope
from solver.envelope.envelope import Envelope
from tests.solver.aircraft.mini import write_mini_aircraft

#: Few enough to be quick; the stated error is large accordingly.
LANDINGS = 300


@pytest.fixture(scope="session")
def mini_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_mini_aircraft(tmp_path_factory.mktemp("aircraft") / "mini")


@pytest.fixture(scope="session")
def mini_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="session")
def mini_model(mini_folder: Path, mini_cache: Path) -> AssessmentModel:
    return load_assessment_model(mini_folder, mini_cache)


@pytest.fixture(scope="session")
def mini_envelope(mini_folder: Path, mini_cache: Path) -> Envelope:
    return build_envelope(mini_folder, mini_cache, LANDINGS, processes=1)
