"""Back-fills: records in as a stream of lines, one outcome out for each, good rows never held up.

Rows are stored in chunks, each in one transaction that is committed before its outcomes are sent.
Whoever loses the connection sends the file again: what was stored is found by its identity.
"""

from collections import Counter
from collections.abc import AsyncIterator, Iterable, Iterator, Sequence
from dataclasses import dataclass

import structlog
from fastapi.concurrency import run_in_threadpool
from fastapi_problem.error import Problem
from sqlalchemy.exc import DBAPIError, IntegrityError, OperationalError
from starlette.types import Receive

from app.body_limit import body_too_large
from app.context import ServiceContext
from app.db import writing, writing_once
from app.errors import ProblemDocument, invalid_record, problem
from app.landings import arrivals, repository, service
from app.landings.answers import BulkEnd, BulkOutcome, Outcome
from app.landings.arrivals import Arrival
from app.landings.field_errors import InvalidRecordError
from app.landings.intake import parse_record
from app.landings.repository import Kept
from app.ndjson import Line, LineCutter, PartReader, pieces
from app.security import Principal

log = structlog.get_logger(__name__)

LANE = "bulk"

#: A transaction of this many rows costs little more for each than a larger one, and a sender sees
#: outcomes several times a second.
CHUNK_ROWS = 500
CHUNK_BYTES = 4 * 1024 * 1024

#: Whenever a stream has grown by this factor, what the database believes about its tables is old:
#: it would look new records up by reading all that their operator has.
STATISTICS_FROM = 2_000
STATISTICS_FACTOR = 4

#: A row with more mistakes is no touchdown record, and its problem need not name them all.
MOST_ERRORS = 50


@dataclass(slots=True)
class _Row:
    """A line on its way: what it was found to be, and in the end its outcome."""

    line: int
    arrival: Arrival | None = None
    outcome: BulkOutcome | None = None


class BulkIntake:
    """One stream of records from one sender."""

    def __init__(
        self, context: ServiceContext, principal: Principal, boundary: str | None = None
    ) -> None:
        self._context = context
        self._principal = principal
        self._cutter = LineCutter(context.settings.max_body_bytes)
        self._parts = None if boundary is None else PartReader(boundary)
        self._counts: Counter[Outcome] = Counter()
        self._count_anew_at = STATISTICS_FROM

    async def outcomes(self, receive: Receive) -> AsyncIterator[bytes]:
        """A line for each record, in their order, and one that says that all were read."""
        limit = self._context.settings.max_bulk_bytes
        discard = limit + self._context.settings.discard_body_bytes
        chunk: list[Line] = []
        held = taken = 0
        async for piece in pieces(receive):
            taken += len(piece)
            if taken > limit:
                # The sender would not see the answer if its connection were cut while it sends.
                if taken > discard:
                    break
                continue
            for line in self._records(self._cutter.feed(piece)):
                chunk.append(line)
                held += line.size
                if len(chunk) >= CHUNK_ROWS or held >= CHUNK_BYTES:
                    yield await run_in_threadpool(self._take, chunk)
                    chunk, held = [], 0
        if taken <= limit:
            chunk += self._records(self._cutter.end())
        if chunk:
            yield await run_in_threadpool(self._take, chunk)
        await run_in_threadpool(self._context.nudger.nudge)
        yield self._end(body_too_large(limit, taken) if taken > limit else None)

    def _records(self, lines: Iterable[Line]) -> Iterator[Line]:
        for line in lines:
            for found in (line,) if self._parts is None else self._parts.content(line):
                if found.text is None or found.text.strip():
                    yield found

    def _take(self, lines: Sequence[Line]) -> bytes:
        """Store a chunk; returns its outcomes once they are committed."""
        fleet = arrivals.fleet(self._context.registry)
        rows = [self._checked(line, fleet) for line in lines]
        self._store([row for row in rows if row.arrival is not None])
        self._count_anew()
        received = self._context.metrics.landings_received
        outcomes = [row.outcome for row in rows if row.outcome is not None]
        for outcome in outcomes:
            self._counts[outcome.outcome] += 1
        received.labels("new").inc(sum(o.outcome is Outcome.ACCEPTED for o in outcomes))
        received.labels("repeated").inc(sum(o.outcome is Outcome.REPEATED for o in outcomes))
        return b"".join(_json(outcome) for outcome in outcomes)

    def _count_anew(self) -> None:
        if self._counts[Outcome.ACCEPTED] < self._count_anew_at:
            return
        self._count_anew_at *= STATISTICS_FACTOR
        try:
            with writing_once(self._context.engine) as session:
                repository.count_anew(session)
        except DBAPIError as error:
            log.warning("bulk.not_counted", error=str(error.orig))

    def _checked(self, line: Line, fleet: arrivals.Fleet) -> _Row:
        if line.text is None:
            longest = self._context.settings.max_body_bytes
            return _refused(line.number, body_too_large(longest, line.size))
        text = line.text.removeprefix(b"\xef\xbb\xbf") if line.number == 1 else line.text
        try:
            return _Row(line.number, arrivals.check(parse_record(text), self._principal, fleet))
        except InvalidRecordError as error:
            return _refused(line.number, invalid_record(error.errors[:MOST_ERRORS]))

    def _store(self, rows: Sequence[_Row], is_again: bool = False) -> None:
        """Store rows in one transaction; where one cannot be stored, the others without it."""
        if not rows:
            return
        arrived = [row.arrival for row in rows if row.arrival is not None]
        try:
            with writing(self._context.engine) as session:
                found = service.find_or_store(session, self._principal, arrived, LANE)
        except OperationalError as error:
            # The database is away; the next chunk may find it again.
            log.warning("bulk.not_stored", rows=len(rows), error=str(error.orig))
            for row in rows:
                row.outcome = _failed(row.line)
        except DBAPIError as error:
            if isinstance(error, IntegrityError) and not is_again:
                # One of them came in by another way at the same moment, and is found now.
                self._store(rows, is_again=True)
            elif len(rows) > 1:
                half = len(rows) // 2
                self._store(rows[:half], is_again)
                self._store(rows[half:], is_again)
            else:
                log.error("bulk.not_storable", line=rows[0].line, error=str(error.orig))
                rows[0].outcome = _failed(rows[0].line)
        else:
            for row, arrival, kept in zip(rows, arrived, found, strict=True):
                row.outcome = _outcome(row.line, arrival, kept)

    def _end(self, reason: Problem | None) -> bytes:
        return _json(
            BulkEnd(
                outcome="end",
                lines=self._counts.total(),
                accepted=self._counts[Outcome.ACCEPTED],
                repeated=self._counts[Outcome.REPEATED],
                refused=self._counts[Outcome.REFUSED],
                failed=self._counts[Outcome.FAILED],
                problem=None if reason is None else _document(reason),
            )
        )


def _outcome(line: int, arrival: Arrival, kept: Kept) -> BulkOutcome:
    if kept.body_digest != arrival.body_digest:
        refusal = service.conflict("record_id", arrival.record_id)
        return BulkOutcome(
            line=line,
            outcome=Outcome.REFUSED,
            record_id=arrival.record_id,
            problem=_document(refusal),
        )
    return BulkOutcome(
        line=line,
        outcome=Outcome.REPEATED if kept.is_repeated else Outcome.ACCEPTED,
        record_id=arrival.record_id,
        landing_id=kept.landing_id,
        assessment_id=kept.assessment_id,
    )


def _refused(line: int, reason: Problem) -> _Row:
    outcome = BulkOutcome(line=line, outcome=Outcome.REFUSED, problem=_document(reason))
    return _Row(line, outcome=outcome)


def _failed(line: int) -> BulkOutcome:
    reason = problem(
        503, "not-stored", "The record could not be stored now", "send it again, unchanged"
    )
    return BulkOutcome(line=line, outcome=Outcome.FAILED, problem=_document(reason))


def _document(reason: Problem) -> ProblemDocument:
    return ProblemDocument.model_validate(reason.marshal())


def _json(answer: BulkOutcome | BulkEnd) -> bytes:
    return answer.model_dump_json(exclude_unset=True).encode() + b"\n"
