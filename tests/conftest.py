"""Fixtures of the service: real servers, fresh databases, the mini aircraft, a client."""

import logging
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx2
import pytest
import redis
from fastapi.testclient import TestClient
from sqlalchemy import Engine

from app import migrate
from app.assessments.states import PENDING
from app.broker import Nudger
from app.cli.demo import EXAMPLE_AIRCRAFT
from app.cli.key import create_key
from app.config import Settings
from app.db import make_engine
from app.fleet.registry import AircraftRegistry
from app.main import create_app
from app.models import Base
from solver.aircraft.bizjet import build_bizjet
from solver.assess import AssessmentModel, load_assessment_model
from tests import servers
from tests.solver.aircraft.mini import write_mini_aircraft
from worker.warm import Models
from worker.work import work_off

# A line for each request of a test says nothing.
logging.getLogger("httpx2").setLevel(logging.WARNING)

STACKS = ("sqlite+filesystem", "postgres+redis")


def pytest_report_header() -> str:
    return servers.describe()


@pytest.fixture(scope="session", autouse=True)
def _environment_of_our_own() -> None:
    """No setting of the developer's shell may reach the tests."""
    for name in [name for name in os.environ if name.startswith("HL_")]:
        del os.environ[name]


@pytest.fixture(scope="session")
def postgres() -> Iterator[servers.Postgres | servers.GivenPostgres]:
    server = servers.start_postgres()
    yield server
    server.remove()


@pytest.fixture(scope="session")
def redis_server() -> Iterator[servers.Redis | servers.GivenRedis]:
    server = servers.start_redis()
    yield server
    server.remove()


@pytest.fixture(scope="session")
def aircraft_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("aircraft")
    write_mini_aircraft(folder / "mini")
    return folder


@pytest.fixture(scope="session")
def cache_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Reduced models, built once for all tests."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="session")
def models(aircraft_folder: Path, cache_folder: Path) -> Models:
    """The real solver on the mini aircraft."""
    return Models(AircraftRegistry(aircraft_folder), cache_folder)


#: The example aircraft's reduced model takes a minute; it is kept between runs by content hash.
KEPT_CACHE = Path(__file__).resolve().parents[1] / "var" / "cache"


@pytest.fixture(scope="session")
def example_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Aircraft folder that holds the example aircraft at full size."""
    folder = tmp_path_factory.mktemp("example")
    build_bizjet(folder / EXAMPLE_AIRCRAFT)
    return folder


@pytest.fixture(scope="session")
def example_jet(example_folder: Path) -> AssessmentModel:
    return load_assessment_model(example_folder / EXAMPLE_AIRCRAFT, KEPT_CACHE)


@pytest.fixture(scope="session")
def migrated_sqlite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sqlite") / "migrated.db"
    migrate.upgrade(f"sqlite:///{path}")
    return path


@pytest.fixture(scope="session")
def postgres_databases(postgres: servers.Postgres) -> Iterator[dict[str, str]]:
    """Addresses of migrated databases by the scope of the fixture that empties them."""
    urls = {scope: postgres.create_database(f"hl_{scope}") for scope in ("function", "module")}
    for url in urls.values():
        migrate.upgrade(url.replace("postgresql://", "postgresql+psycopg://", 1))
    yield urls
    for scope in urls:
        postgres.drop_database(f"hl_{scope}")


@dataclass(frozen=True)
class Stack:
    """A fresh database and broker of one kind."""

    name: str
    settings: Settings


_numbers = iter(range(10_000))


@contextmanager
def make_stack(kind: str, var: Path, request: pytest.FixtureRequest) -> Iterator[Stack]:
    """A migrated database and an empty broker of one kind."""
    number = next(_numbers)
    var.mkdir()
    if kind == "sqlite+filesystem":
        database, broker = None, None
        shutil.copy(request.getfixturevalue("migrated_sqlite"), var / "hardlanding.db")
    else:
        database = request.getfixturevalue("postgres_databases")[request.scope]
        servers.empty_database(database, list(Base.metadata.tables))
        # Databases 1 to 15, as every Redis has at least sixteen; each test clears its own.
        broker = request.getfixturevalue("redis_server").url(1 + number % 15)
        with redis.Redis.from_url(broker) as client:
            client.flushdb()
    settings = Settings(
        _env_file=None,
        var=var,
        aircraft_dir=request.getfixturevalue("aircraft_folder"),
        cache_dir=request.getfixturevalue("cache_folder"),
        database_url=database,
        broker_url=broker,
        log_format="console",
        keep_arrays_above=0.0,
        propagate_uncertainty=False,  # seconds for every firm landing; tests of it ask for it
    )
    yield Stack(kind, settings)


@pytest.fixture(params=STACKS)
def stack(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Stack]:
    """Both ways to run the service, one after the other."""
    with make_stack(request.param, tmp_path / "var", request) as made:
        yield made


@pytest.fixture
def engine(stack: Stack) -> Iterator[Engine]:
    engine = make_engine(stack.settings.sqlalchemy_url)
    yield engine
    engine.dispose()


@dataclass
class Service:
    """The application in this process, and the worker's code on call."""

    settings: Settings
    engine: Engine
    client: TestClient
    models: Models
    keys: dict[str, str]

    def key(self, operator: str, *scopes: str) -> dict[str, str]:
        """Header with a key of an operator."""
        name = f"{operator}:{','.join(scopes)}"
        if name not in self.keys:
            self.keys[name] = create_key(self.settings, operator=operator, scopes=scopes)
        return {"X-API-Key": self.keys[name]}

    def post(self, record: object, **options: object) -> httpx2.Response:
        options.setdefault("headers", self.key("alpha", "post"))
        return self.client.post("/v1/landings", json=record, **options)

    def get(self, path: str, **options: object) -> httpx2.Response:
        options.setdefault("headers", self.key("alpha", "read"))
        return self.client.get(path, **options)

    def work(self) -> int:
        """Do what a nudged worker does, here and now."""
        nudger = Nudger(self.settings)
        total = 0
        while count := work_off(self.engine, self.settings, self.models, nudger):
            total += count
        nudger.close()
        return total

    def assessed(self, record: object) -> dict[str, object]:
        """Post a record, have it assessed, return the assessment."""
        location = self.post(record).headers["Location"]
        self.work()
        answer: dict[str, object] = self.get(location).json()
        assert answer["state"] not in PENDING
        return answer


@contextmanager
def make_service(stack: Stack, models: Models) -> Iterator[Service]:
    app = create_app(stack.settings)
    engine = make_engine(stack.settings.sqlalchemy_url)
    with TestClient(app, raise_server_exceptions=False) as client:
        yield Service(stack.settings, engine, client, models, {})
    engine.dispose()


@pytest.fixture
def service(stack: Stack, models: Models) -> Iterator[Service]:
    """A service with nothing in it."""
    with make_service(stack, models) as made:
        yield made


@pytest.fixture(scope="module", params=STACKS)
def shared_service(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, models: Models
) -> Iterator[Service]:
    """A service for tests that leave nothing behind."""
    var = tmp_path_factory.mktemp("shared") / "var"
    with make_stack(request.param, var, request) as stack, make_service(stack, models) as made:
        yield made
