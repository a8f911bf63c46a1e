"""How often Postgres is asked: what a database at the other end of a network is slow by."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from app import db
from app.broker import Nudger
from app.landings import bulk
from tests.conftest import Service, Stack, make_service, make_stack
from tests.records import record
from tests.round_trips import RoundTrips, counted
from worker.pace import Pace
from worker.warm import Models
from worker.work import work_off

#: From the fifth time on the driver prepares a statement, which costs a round trip once.
WARM = 8


@pytest.fixture
def trips(
    request: pytest.FixtureRequest,
    tmp_path: Path,
    models: Models,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[tuple[RoundTrips, Service]]:
    """A service whose way to Postgres is watched; every statement was used before."""
    # On a slow machine connections would be asked, after a pause, whether they still live.
    monkeypatch.setattr(db, "TRUSTED_IDLE", 3600.0)
    with make_stack("postgres+redis", tmp_path / "var", request) as stack:
        url = stack.settings.database_url
        assert url is not None
        with counted(url) as counter:
            settings = stack.settings.model_copy(
                update={"database_url": counter.url, "sweep_interval": 3600.0}
            )
            with make_service(Stack(stack.name, settings), models) as service:
                for number in range(WARM):
                    service.post(record(1.0 + 0.1 * number))
                    drain(service)
                yield counter, service


def drain(service: Service, most: int = 1) -> int:
    without_clock = {"batch_limit": most, "batch_seconds": 3600.0, "drain_budget": 3600.0}
    settings = service.settings.model_copy(update=without_clock)
    nudger = Nudger(settings)
    count = work_off(service.engine, settings, service.models, nudger, Pace(1e-3))
    nudger.close()
    return count


def test_taking_a_landing_in(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    with counter.of() as asked:
        assert service.post(record(5.0)).status_code == 202
    # The key; begin, look it up, landing, assessment, audit entry, commit.
    assert asked == [7]


def test_a_landing_taken_in_before(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    with counter.of() as asked:
        assert service.post(record(1.0)).json()["is_repeated"]
    assert asked == [5]


def test_asking_where_an_assessment_stands(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    location = service.post(record(5.0)).headers["location"]
    service.get(location)
    with counter.of() as asked:
        service.get(location)
    assert asked == [2]


def test_nothing_to_do(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    with counter.of() as asked:
        assert drain(service) == 0
    assert asked == [1]


def test_one_landing_from_claim_to_answer(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    service.post(record(5.0))
    with counter.of() as asked:
        assert drain(service) == 1
    # Claim; begin, finish, verdict, hot spots, arrays, audit entry, commit; nothing more to claim.
    assert asked == [9]


def test_a_batch_costs_no_more_than_one_landing(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    # The statements for several rows are others than those for one.
    for start in (20.0, 21.0):
        for number in range(6):
            service.post(record(start + 0.1 * number))
        with counter.of() as asked:
            assert drain(service, most=6) == 6
    assert asked == [9]


def test_a_chunk_of_a_back_fill(trips: tuple[RoundTrips, Service]) -> None:
    counter, service = trips
    for start in (0, 1000, 2000):  # the first ones prepare statements
        rows = [json.dumps(record(record_id=f"r-{start + n}")) for n in range(bulk.CHUNK_ROWS)]
        with counter.of() as asked:
            service.client.post(
                "/v1/landings/bulk",
                content="\n".join(rows),
                headers={**service.key("alpha", "post"), "content-type": "application/x-ndjson"},
            )
    # The key; begin, look them up; for each of three tables its clock, leave to copy, and the
    # copy; commit.
    assert asked == [13]
