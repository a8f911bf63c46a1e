"""Landings survive whatever happens to workers and broker: none lost, none doubled."""

import json
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx2
import pytest
import redis
from sqlalchemy import Engine, func, select

from app.assessments.models import AssessmentJob, HotSpotRow, VerdictRow
from app.assessments.states import PENDING
from app.audit.models import AuditEntry
from app.cli.key import create_key
from app.db import reading
from tests.chaos.saboteur import KILLER, SLEEPER
from tests.conftest import Stack
from tests.records import contact, record
from tests.servers import free_port, wait_until
from tests.worker.programs import Programs, children, descendants, kill_at_once, programs

pytestmark = pytest.mark.chaos

LANDINGS = 200
PATIENCE = 240.0


@pytest.fixture
def running(stack: Stack, tmp_path: Path) -> Iterator[Programs]:
    """A real API on a port, with leases as short as slow machines allow; no worker yet."""
    settings = stack.settings.model_copy(
        update={
            "port": free_port(),
            "lease_seconds": 8.0,
            "hard_time_limit": 7.0,
            "soft_time_limit": 5.0,
            "drain_budget": 0.5,
            "batch_seconds": 2.0,
            "sweep_interval": 0.3,
            "max_attempts": 5,
            "auto_migrate": False,
        }
    )
    with programs(settings, tmp_path) as started:
        started.start_api()
        yield started


@pytest.fixture
def key(stack: Stack) -> dict[str, str]:
    return {"X-API-Key": create_key(stack.settings, operator="alpha", scopes=("post", "read"))}


def post_all(url: str, key: dict[str, str], records: list[dict[str, Any]]) -> list[str]:
    """Post many records at once; returns where their assessments will be."""
    with httpx2.Client(base_url=url, headers=key, timeout=60.0) as client:

        def post(body: dict[str, Any]) -> str:
            response = client.post("/v1/landings", json=body)
            assert response.status_code == 202, response.text
            place: str = response.headers["location"]
            return place

        with ThreadPoolExecutor(16) as pool:
            return list(pool.map(post, records))


def count(engine: Engine, *states: str) -> int:
    with reading(engine) as session:
        statement = select(func.count()).where(AssessmentJob.state.in_(states))
        return session.scalar(statement) or 0


def wipe_broker(stack: Stack) -> None:
    """FLUSHALL, or its likeness in a folder."""
    if stack.settings.broker_url is None:
        for message in stack.settings.broker_folder.glob("messages/*"):
            message.unlink(missing_ok=True)
        return
    with redis.Redis.from_url(stack.settings.broker_url) as client:
        client.flushall()


def test_killed_workers_and_a_wiped_broker_lose_and_double_nothing(
    running: Programs, stack: Stack, engine: Engine, key: dict[str, str]
) -> None:
    supervisor = running.start_worker(concurrency=2)
    # Ten different landings twenty times over: the answers must not depend on the chaos.
    records = [record(2.0 + n % 10, record_id=f"chaos-{n}") for n in range(LANDINGS)]
    places = post_all(running.url, key, records)
    assert len(set(places)) == LANDINGS

    wait_until(lambda: count(engine, "assessed") >= 20, "the first landings", PATIENCE)
    # More than there are processes: both are in the middle of a batch.
    wait_until(lambda: count(engine, "running") >= 4, "batches in mid-solve", PATIENCE)
    for member in descendants(supervisor.pid):
        kill_at_once(member)
    wipe_broker(stack)
    in_mid_solve = count(engine, "running")
    assert in_mid_solve >= 1

    before = count(engine, "assessed")
    wait_until(lambda: count(engine, "assessed") >= before + 20, "a second start", PATIENCE)
    (worker,) = children(supervisor.pid)
    kill_at_once(children(worker)[0])
    wipe_broker(stack)

    wait_until(lambda: count(engine, *PENDING) == 0, "the end of the queue", PATIENCE)
    with reading(engine) as session:
        jobs = session.scalars(select(AssessmentJob)).all()
        verdicts = session.scalars(select(VerdictRow)).all()
        assessed = session.scalars(
            select(AuditEntry.subject_id).where(AuditEntry.action == "assessed")
        ).all()
        spots = session.execute(
            select(HotSpotRow.assessment_id, func.count()).group_by(HotSpotRow.assessment_id)
        ).all()
    assert Counter(job.state for job in jobs) == {"assessed": LANDINGS}
    assert Counter(verdict.landing_id for verdict in verdicts) == Counter(
        {job.landing_id: 1 for job in jobs}
    )
    assert Counter(assessed) == Counter({job.landing_id: 1 for job in jobs})
    assert len({number for _, number in spots}) == 1
    assert sum(job.attempts > 1 for job in jobs) >= in_mid_solve
    worst: dict[float, set[float | None]] = {}
    for verdict in verdicts:
        sink_rate = verdict.inputs["contacts"][0]["sink_rate"]
        worst.setdefault(sink_rate, set()).add(verdict.worst_utilisation)
    assert len(worst) == 10
    assert all(len(answers) == 1 for answers in worst.values())


def test_a_landing_that_kills_its_workers_is_buried_and_the_others_go_on(
    stack: Stack, engine: Engine, key: dict[str, str], tmp_path: Path
) -> None:
    settings = stack.settings.model_copy(
        update={
            "port": free_port(),
            "lease_seconds": 3.0,
            "hard_time_limit": 2.9,
            "soft_time_limit": 1.5,
            "drain_budget": 0.2,
            "sweep_interval": 0.3,
            "max_attempts": 2,
            "auto_migrate": False,
        }
    )

    def drifting(degrees: float) -> dict[str, Any]:
        drift = {"value": degrees, "unit": "deg"}
        return record(contacts=[contact(drift=drift)], record_id=f"drift-{degrees:g}")

    with programs(settings, tmp_path) as running:
        running.start_api()
        running.start([sys.executable, "-m", "tests.chaos.saboteur"])
        records = [drifting(KILLER), drifting(SLEEPER)]
        records += [record(2.0 + n, record_id=f"good-{n}") for n in range(4)]
        killer, sleeper, *good = post_all(running.url, key, records)
        wait_until(lambda: count(engine, *PENDING) == 0, "the end of the queue", PATIENCE)
        with httpx2.Client(base_url=running.url, headers=key) as client:
            answers = {place: client.get(place).json() for place in (killer, sleeper, *good)}
    assert answers[killer]["state"] == "dead"
    assert answers[killer]["attempts"] == 2
    assert "worker was lost" in answers[killer]["last_error"]
    assert answers[sleeper]["state"] == "dead"
    assert "not done within 1.5 s" in answers[sleeper]["last_error"]
    # A neighbour may have been hit by the same kill, which is why it has attempts to spare.
    assert [answers[place]["state"] for place in good] == ["assessed"] * 4


def test_landings_whose_nudges_were_lost_are_found_by_the_sweeper(
    running: Programs, stack: Stack, engine: Engine, key: dict[str, str]
) -> None:
    places = post_all(running.url, key, [record(3.0 + n) for n in range(3)])
    wipe_broker(stack)
    running.start_worker(concurrency=1)
    wait_until(lambda: count(engine, "assessed") == len(places), "the sweeper's nudge", PATIENCE)


def test_a_back_fill_whose_server_died_is_sent_again(
    running: Programs, stack: Stack, engine: Engine, key: dict[str, str]
) -> None:
    number, cut = 3000, 2000
    rows = [json.dumps(record(2.0 + n % 10, record_id=f"bulk-{n}")) + "\n" for n in range(number)]
    headers = {**key, "content-type": "application/x-ndjson"}
    (api,) = running.running

    def dying() -> Iterator[bytes]:
        yield "".join(rows[:cut]).encode()
        wait_until(lambda: count(engine, "queued") >= 500, "the first rows", PATIENCE)
        running.kill(api)
        for row in rows[cut:]:
            yield row.encode()

    place = f"{running.url}/v1/landings/bulk"
    with pytest.raises(httpx2.TransportError):
        httpx2.post(place, content=dying(), headers=headers, timeout=60.0)
    stored = count(engine, "queued")
    assert 500 <= stored <= cut
    running.start_api()
    answer = httpx2.post(place, content="".join(rows).encode(), headers=headers, timeout=60.0)
    end = json.loads(answer.text.splitlines()[-1])
    assert (end["repeated"], end["accepted"]) == (stored, number - stored)
    with reading(engine) as session:
        received = session.scalars(
            select(AuditEntry.subject_id).where(AuditEntry.action == "received")
        ).all()
        landings = session.scalars(select(AssessmentJob.landing_id)).all()
    assert len(landings) == number
    assert sorted(received) == sorted(landings)
