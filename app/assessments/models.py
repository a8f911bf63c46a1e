"""The job and its answer."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Float, ForeignKey, Index, Integer, SmallInteger, String, Text, text
from sqlalchemy.orm import Mapped, mapped_column

from app.assessments.states import State
from app.db import Base, DatabaseTime, UtcDateTime, new_id

#: As literal text, so that the planner can prove that a query lies within the partial index.
PENDING_CLAUSE = text("state IN ('queued', 'running')")
RUNNING_CLAUSE = text("state = 'running'")


class AssessmentJob(Base):
    """One assessment of one landing: the row is the job, messages are only nudges."""

    __tablename__ = "assessment"
    __table_args__ = (
        # The claim walks this index in order and passes over the few rows that are running.
        Index(
            "ix_assessment_pending",
            "lane",
            "created_at",
            "id",
            postgresql_where=PENDING_CLAUSE,
            sqlite_where=PENDING_CLAUSE,
        ),
        # The sweep looks for leases that are over; it must not read a whole back-fill for that.
        Index(
            "ix_assessment_running",
            "lease_until",
            postgresql_where=RUNNING_CLAUSE,
            sqlite_where=RUNNING_CLAUSE,
        ),
    )

    id: Mapped[str] = mapped_column(String(36), primary_key=True, default=new_id)
    operator_id: Mapped[str] = mapped_column(ForeignKey("operator.id"))
    landing_id: Mapped[str] = mapped_column(ForeignKey("landing.id"), unique=True)
    lane: Mapped[int] = mapped_column(SmallInteger)
    state: Mapped[str] = mapped_column(String(10), default=State.QUEUED)
    attempts: Mapped[int] = mapped_column(Integer, default=0)
    token: Mapped[str | None] = mapped_column(String(36))  #: fence of the claim
    lease_until: Mapped[datetime | None] = mapped_column(UtcDateTime)
    created_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())
    started_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    finished_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    worker: Mapped[str | None] = mapped_column(String(100))
    last_error: Mapped[str | None] = mapped_column(Text)
    version: Mapped[int] = mapped_column(Integer, default=1)  #: rises with every change
    #: Given with the record's acceptance; see `app.assessments.provisional`.
    provisional: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))


class VerdictRow(Base):
    """What was found; one per assessment, which its key enforces."""

    __tablename__ = "verdict"
    __table_args__ = (Index("ix_verdict_operator_id_verdict", "operator_id", "verdict"),)

    assessment_id: Mapped[str] = mapped_column(ForeignKey("assessment.id"), primary_key=True)
    operator_id: Mapped[str] = mapped_column(ForeignKey("operator.id"))
    landing_id: Mapped[str] = mapped_column(ForeignKey("landing.id"), index=True)
    verdict: Mapped[str] = mapped_column(String(12))
    action: Mapped[str] = mapped_column(String(12))  #: the stricter of verdict and maker's rule
    rule_difference: Mapped[str] = mapped_column(String(20))
    makers_rule: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    is_provisional: Mapped[bool] = mapped_column(default=False)
    provisional_differs: Mapped[bool | None] = mapped_column()  #: None: there was none
    probability_limit_exceeded: Mapped[float | None] = mapped_column(Float)
    #: with its sampling error and basis
    limit_probability: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    driving_contact: Mapped[int | None] = mapped_column(Integer)
    worst_utilisation: Mapped[float | None] = mapped_column(Float)
    worst_margin: Mapped[float | None] = mapped_column(Float)
    peak_normal_load_factor: Mapped[float | None] = mapped_column(Float)
    energy_error: Mapped[float | None] = mapped_column(Float)
    equilibrium_residual: Mapped[float | None] = mapped_column(Float)
    reasons: Mapped[list[dict[str, Any]]] = mapped_column(JSON)
    gear_loads: Mapped[list[dict[str, Any]]] = mapped_column(JSON)
    notes: Mapped[list[str]] = mapped_column(JSON)
    timing: Mapped[dict[str, float] | None] = mapped_column(JSON)
    advisory: Mapped[str] = mapped_column(Text)
    model_hash: Mapped[str] = mapped_column(String(64))
    program_version: Mapped[str] = mapped_column(String(60))
    inputs: Mapped[dict[str, Any]] = mapped_column(JSON)
    created_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())


class HotSpotRow(Base):
    """The worst element of one zone."""

    __tablename__ = "hot_spot"

    assessment_id: Mapped[str] = mapped_column(ForeignKey("assessment.id"), primary_key=True)
    rank: Mapped[int] = mapped_column(Integer, primary_key=True)
    component: Mapped[str] = mapped_column(String(200))
    zone: Mapped[str] = mapped_column(String(200))
    side: Mapped[str] = mapped_column(String(20))
    element: Mapped[int] = mapped_column(Integer)
    element_kind: Mapped[str] = mapped_column(String(20))
    x: Mapped[float] = mapped_column(Float)
    y: Mapped[float] = mapped_column(Float)
    z: Mapped[float] = mapped_column(Float)
    peak_stress: Mapped[float] = mapped_column(Float)
    allowable: Mapped[float] = mapped_column(Float)
    utilisation: Mapped[float] = mapped_column(Float)
    margin: Mapped[float | None] = mapped_column(Float)
    time: Mapped[float] = mapped_column(Float)
    contact: Mapped[int] = mapped_column(Integer)
    ata_chapter: Mapped[str] = mapped_column(String(20))
    inspection: Mapped[str] = mapped_column(Text)
    probability_limit_exceeded: Mapped[float | None] = mapped_column(Float)
    probability_standard_error: Mapped[float | None] = mapped_column(Float)
