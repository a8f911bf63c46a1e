"""The job protocol on both databases."""

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from sqlalchemy import Engine, event, select, text, update

from app.assessments import queue
from app.assessments.models import AssessmentJob
from app.assessments.queue import Claim
from app.audit.models import AuditEntry
from app.db import DatabaseTime, make_engine, new_id, reading, writing, writing_once
from app.fleet.models import Operator
from app.landings.models import Landing
from tests.conftest import Stack

ATTEMPTS = 3


@pytest.fixture
def operator(engine: Engine) -> Iterator[str]:
    with writing(engine) as session:
        owner = Operator(id=new_id(), name="alpha")
        session.add(owner)
    return owner.id


def add(engine: Engine, operator: str, lane: int = 0) -> str:
    """Queue an assessment."""
    with writing(engine) as session:
        landing = Landing(
            id=new_id(),
            operator_id=operator,
            record_id=new_id(),
            body_digest="",
            aircraft="mini",
            touchdown_at=session.execute(select(DatabaseTime())).scalar_one(),
            record={},
            inputs={},
            sd={},
            sd_defaulted=[],
            taken_as_zero=[],
        )
        session.add(landing)
        session.flush()
        job = AssessmentJob(id=new_id(), operator_id=operator, landing_id=landing.id, lane=lane)
        session.add(job)
    return job.id


def claim(engine: Engine, lanes: tuple[int, ...] = (0, 1), lease: float = 60.0) -> Claim | None:
    return next(iter(claim_batch(engine, 1, lanes, lease)), None)


def claim_batch(
    engine: Engine, most: int, lanes: tuple[int, ...] = (0, 1), lease: float = 60.0
) -> list[Claim]:
    with writing_once(engine) as session:
        return queue.claim(
            session, worker="w", lanes=lanes, lease=lease, max_attempts=ATTEMPTS, most=most
        )


def state(engine: Engine, job: str) -> AssessmentJob:
    with reading(engine) as session:
        return session.execute(select(AssessmentJob).where(AssessmentJob.id == job)).scalar_one()


def let_lease_run_out(engine: Engine, job: str) -> None:
    with writing(engine) as session:
        session.execute(
            update(AssessmentJob)
            .where(AssessmentJob.id == job)
            .values(lease_until=DatabaseTime(-1.0))
        )


def test_nothing_to_claim(engine: Engine, operator: str) -> None:
    assert claim(engine) is None


def test_interactive_goes_before_bulk_and_older_before_younger(
    engine: Engine, operator: str
) -> None:
    bulk = [add(engine, operator, lane=1) for _ in range(2)]
    interactive = [add(engine, operator, lane=0) for _ in range(2)]
    order = [claim(engine) for _ in range(4)]
    assert [c.assessment_id for c in order if c] == interactive + bulk


def test_a_worker_keeps_to_its_lanes(engine: Engine, operator: str) -> None:
    add(engine, operator, lane=1)
    assert claim(engine, lanes=(0,)) is None
    assert claim(engine, lanes=(1,)) is not None


def test_a_claim_is_marked_by_the_databases_clock(engine: Engine, operator: str) -> None:
    job = add(engine, operator)
    claimed = claim(engine, lease=60.0)
    assert claimed is not None
    row = state(engine, job)
    assert row.started_at is not None
    assert (claimed.lease_until - row.started_at).total_seconds() == pytest.approx(60.0, abs=1.0)
    assert (row.state, row.attempts, row.token) == ("running", 1, claimed.token)


def test_many_workers_share_without_meeting(engine: Engine, operator: str) -> None:
    jobs = {add(engine, operator) for _ in range(24)}

    def work(_: int) -> list[str]:
        found = []
        while (claimed := claim(engine)) is not None:
            found.append(claimed.assessment_id)
        return found

    with ThreadPoolExecutor(6) as pool:
        claimed = [job for found in pool.map(work, range(6)) for job in found]
    assert sorted(claimed) == sorted(jobs)


class TestBatch:
    """Several landings in one claim."""

    def test_takes_the_oldest_each_with_a_fence_and_a_lease_of_its_own(
        self, engine: Engine, operator: str
    ) -> None:
        jobs = [add(engine, operator) for _ in range(5)]
        batch = claim_batch(engine, 3)
        assert [claimed.assessment_id for claimed in batch] == jobs[:3]
        assert len({claimed.token for claimed in batch}) == 3
        rows = [state(engine, job) for job in jobs]
        assert [row.token for row in rows[:3]] == [claimed.token for claimed in batch]
        assert [row.state for row in rows] == ["running"] * 3 + ["queued"] * 2
        assert [row.lease_until for row in rows[:3]] == [claimed.lease_until for claimed in batch]

    def test_carries_what_the_solver_needs(self, engine: Engine, operator: str) -> None:
        add(engine, operator)
        add(engine, operator)
        assert [claimed.inputs for claimed in claim_batch(engine, 5)] == [{}, {}]

    def test_nobody_who_waits_shares_a_batch_with_a_back_fill(
        self, engine: Engine, operator: str
    ) -> None:
        bulk = [add(engine, operator, lane=1) for _ in range(2)]
        interactive = [add(engine, operator, lane=0) for _ in range(2)]
        assert [c.assessment_id for c in claim_batch(engine, 4)] == interactive
        assert [c.assessment_id for c in claim_batch(engine, 4)] == bulk

    def test_what_was_tried_before_comes_alone(self, engine: Engine, operator: str) -> None:
        jobs = [add(engine, operator) for _ in range(4)]
        for claimed in claim_batch(engine, 2):
            let_lease_run_out(engine, claimed.assessment_id)
        found = [[c.assessment_id for c in claim_batch(engine, 4)] for _ in range(3)]
        assert found == [jobs[:1], jobs[1:2], jobs[2:]]

    def test_one_lost_claim_leaves_its_neighbours_standing(
        self, engine: Engine, operator: str
    ) -> None:
        first, second, third = (add(engine, operator) for _ in range(3))
        batch = claim_batch(engine, 3)
        let_lease_run_out(engine, second)
        successor = claim(engine)
        assert successor is not None
        with writing(engine) as session:
            held = queue.finish(session, batch)
        assert [claimed.assessment_id for claimed in held] == [first, third]
        assert state(engine, second).token == successor.token

    def test_what_is_put_back_has_lost_no_attempt(self, engine: Engine, operator: str) -> None:
        jobs = [add(engine, operator) for _ in range(3)]
        batch = claim_batch(engine, 3)
        let_lease_run_out(engine, jobs[2])
        assert claim(engine) is not None
        with writing_once(engine) as session:
            queue.release(session, batch[1:])
        rows = [state(engine, job) for job in jobs]
        assert [(row.state, row.attempts) for row in rows] == [
            ("running", 1),
            ("queued", 0),
            ("running", 2),  # has another holder by now
        ]

    def test_many_workers_share_without_meeting(self, engine: Engine, operator: str) -> None:
        jobs = {add(engine, operator) for _ in range(40)}

        def work(_: int) -> list[str]:
            found = []
            while batch := claim_batch(engine, 3):
                found += [claimed.assessment_id for claimed in batch]
            return found

        with ThreadPoolExecutor(6) as pool:
            claimed = [job for found in pool.map(work, range(6)) for job in found]
        assert sorted(claimed) == sorted(jobs)


def test_a_lease_that_ran_out_is_claimed_again(engine: Engine, operator: str) -> None:
    job = add(engine, operator)
    first = claim(engine)
    assert claim(engine) is None
    let_lease_run_out(engine, job)
    second = claim(engine)
    assert first is not None
    assert second is not None
    assert second.attempts == 2
    assert second.token != first.token


def test_a_short_lease_runs_out_by_itself(engine: Engine, operator: str) -> None:
    add(engine, operator)
    claim(engine, lease=0.05)
    time.sleep(0.1)
    assert claim(engine) is not None


def test_who_lost_the_claim_may_not_write(engine: Engine, operator: str) -> None:
    job = add(engine, operator)
    late = claim(engine)
    let_lease_run_out(engine, job)
    successor = claim(engine)
    assert late is not None
    assert successor is not None
    with writing(engine) as session:
        assert queue.finish(session, [late]) == []
        assert not queue.give_up(session, late, "too late", ATTEMPTS)
        assert not queue.fail(session, late, "too late")
    assert state(engine, job).token == successor.token
    with writing(engine) as session:
        assert queue.finish(session, [successor]) == [successor]
    with writing(engine) as session:
        assert queue.finish(session, [successor]) == []
    assert state(engine, job).state == "assessed"


def test_an_error_sends_the_job_back_until_its_attempts_are_used_up(
    engine: Engine, operator: str
) -> None:
    job = add(engine, operator)
    for attempt in range(1, ATTEMPTS + 1):
        claimed = claim(engine)
        assert claimed is not None
        with writing(engine) as session:
            queue.give_up(session, claimed, f"error {attempt}", ATTEMPTS)
        assert state(engine, job).state == ("dead" if attempt == ATTEMPTS else "queued")
    row = state(engine, job)
    assert (row.last_error, row.attempts) == ("error 3", ATTEMPTS)
    assert claim(engine) is None


def test_a_job_that_kills_its_workers_is_buried_with_its_reason(
    engine: Engine, operator: str
) -> None:
    job = add(engine, operator)
    for _ in range(ATTEMPTS):
        assert claim(engine) is not None
        let_lease_run_out(engine, job)
    assert claim(engine) is None
    with reading(engine) as session:
        assert queue.is_anything_spent(session, ATTEMPTS)
        assert queue.due(session, max_attempts=ATTEMPTS, limit=10) == 0
    with writing(engine) as session:
        assert queue.bury(session, ATTEMPTS) == [job]
    row = state(engine, job)
    assert row.state == "dead"
    assert row.last_error == "the worker was lost in each of 3 attempts"
    with reading(engine) as session:
        entry = session.scalars(select(AuditEntry)).one()
        assert (entry.action, entry.actor) == ("dead", "sweeper")
        assert not queue.is_anything_spent(session, ATTEMPTS)


def test_every_change_raises_the_version(engine: Engine, operator: str) -> None:
    job = add(engine, operator)
    versions = [state(engine, job).version]
    claimed = claim(engine)
    assert claimed is not None
    versions.append(state(engine, job).version)
    with writing(engine) as session:
        queue.fail(session, claimed, "no")
    versions.append(state(engine, job).version)
    with writing(engine) as session:
        queue.retry(session, job)
    versions.append(state(engine, job).version)
    assert versions == [1, 2, 3, 4]


def test_due_counts_up_to_its_limit(engine: Engine, operator: str) -> None:
    for _ in range(5):
        add(engine, operator)
    with reading(engine) as session:
        assert queue.due(session, max_attempts=ATTEMPTS, limit=3) == 3
        assert queue.due(session, max_attempts=ATTEMPTS, limit=10) == 5


def queue_rows(engine: Engine, operator: str, number: int) -> None:
    rows = {"operator": operator, "number": number}
    with writing(engine) as session:
        session.execute(
            text(
                "INSERT INTO landing (id, operator_id, record_id, body_digest, aircraft, "
                "touchdown_at, received_at, record, inputs, sd, sd_defaulted, taken_as_zero) "
                "SELECT 'l' || n, :operator, 'r' || n, '', 'mini', now(), now(), "
                "'{}', '{}', '{}', '[]', '[]' FROM generate_series(1, :number) n"
            ),
            rows,
        )
        session.execute(
            text(
                "INSERT INTO assessment (id, operator_id, landing_id, lane, state, attempts, "
                "created_at, version) SELECT 'a' || n, :operator, 'l' || n, 1, 'queued', 0, "
                "clock_timestamp(), 1 FROM generate_series(1, :number) n"
            ),
            rows,
        )


@pytest.mark.parametrize("is_counted_empty", [False, True])
def test_a_claim_reads_a_few_rows_of_a_long_queue_whatever_the_planner_believes(
    stack: Stack, operator: str, is_counted_empty: bool
) -> None:
    if stack.settings.database_url is None:
        pytest.skip("SQLite plans by rule, not by statistics")
    engine = make_engine(stack.settings.sqlalchemy_url, is_for_claims=True)
    if is_counted_empty:
        with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
            connection.execute(text("VACUUM ANALYZE assessment"))
    queue_rows(engine, operator, 100_000)  # and nobody has counted them
    asked: list[tuple[str, Any]] = []
    event.listen(engine, "before_cursor_execute", lambda _c, _cursor, *said: asked.append(said[:2]))
    assert len(claim_batch(engine, 8)) == 8
    statement, values = asked[-1]
    with engine.connect() as connection:
        explained = connection.exec_driver_sql(
            f"EXPLAIN (ANALYZE, FORMAT JSON) {statement}", values
        )
        (plan,) = explained.scalar_one()
    engine.dispose()
    scans = [node for node in _nodes(plan["Plan"]) if node.get("Relation Name") == "assessment"]
    read = [node["Actual Rows"] + node.get("Rows Removed by Filter", 0) for node in scans]
    assert read
    assert max(read) <= 2 * 8


def _nodes(plan: dict[str, Any]) -> Iterator[dict[str, Any]]:
    yield plan
    for inner in plan.get("Plans", []):
        yield from _nodes(inner)
