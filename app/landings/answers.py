"""Landings as the service answers them, and how lists of them are filtered."""

from datetime import datetime
from enum import StrEnum
from typing import Any, Literal

from pydantic import BaseModel, Field

from app.assessments.answers import ProvisionalOut
from app.assessments.states import State
from app.errors import ProblemDocument
from app.landings.schemas import Strict, Token, UtcTime
from app.paging import Cursor, Limit
from solver.assessment import ADVISORY, Verdict


class LandingFilter(Strict):
    """Every condition given must hold."""

    aircraft: Token | None = None
    tail: Token | None = None
    verdict: Verdict | None = None
    action: Verdict | None = Field(
        default=None, description="The stricter of the verdict and the maker's rule."
    )
    state: State | None = None
    from_: UtcTime | None = Field(default=None, alias="from", description="Touchdown, inclusive.")
    to: UtcTime | None = Field(default=None, description="Touchdown, exclusive.")
    cursor: Cursor = None
    limit: Limit = 50


class LandingSummary(BaseModel):
    """A landing in a list."""

    id: str
    record_id: str
    aircraft: str
    tail: str | None
    touchdown_at: datetime
    received_at: datetime
    contacts: int
    assessment_id: str
    state: State
    verdict: Verdict | None = None
    action: Verdict | None = Field(
        default=None, description="The stricter of the verdict and the maker's rule."
    )
    is_provisional: bool | None = None
    worst_utilisation: float | None = None
    links: dict[str, str]
    advisory: str = ADVISORY


class LandingDetail(LandingSummary):
    """A landing with its record and what was made of it."""

    record: dict[str, Any] = Field(description="As posted.")
    inputs: dict[str, Any] = Field(description="As the solver takes it: SI, rad.")
    sd: dict[str, float] = Field(description="Standard deviation of each number, SI, rad.")
    sd_defaulted: list[str] = Field(description="Numbers whose sd is the documented default.")
    taken_as_zero: list[str] = Field(description="Left out of the record and taken as zero.")


class LandingAccepted(BaseModel):
    """The landing is stored and will be assessed."""

    landing_id: str
    assessment_id: str
    state: State
    is_repeated: bool = Field(description="Whether this record had been accepted before.")
    sd_defaulted: list[str]
    taken_as_zero: list[str]
    missing: list[str] = Field(description="What the record lacks for a verdict.")
    provisional: ProvisionalOut | None = Field(
        description="First answer; null for a landing that was taken in with a back-fill before."
    )
    links: dict[str, str]


class Outcome(StrEnum):
    """What became of one record of a stream."""

    ACCEPTED = "accepted"  #: stored now
    REPEATED = "repeated"  #: was stored before
    REFUSED = "refused"  #: the problem says why; sending it again would not help
    FAILED = "failed"  #: could not be stored now; send it again


class BulkOutcome(BaseModel):
    """What became of the record in one line."""

    line: int = Field(description="Of the file or stream, from 1; blank lines count and are left.")
    outcome: Outcome
    record_id: str | None = Field(
        default=None, description="The record's own, or the one made from its content."
    )
    landing_id: str | None = None
    assessment_id: str | None = None
    problem: ProblemDocument | None = None


class BulkEnd(BaseModel):
    """The last line: without it the answer was cut off, and the rest is to be sent again."""

    outcome: Literal["end"] = "end"
    lines: int = Field(description="Records read.")
    accepted: int
    repeated: int
    refused: int
    failed: int
    problem: ProblemDocument | None = Field(
        default=None, description="Why the stream was not read to its end."
    )
