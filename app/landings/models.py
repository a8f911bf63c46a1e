"""Landings as they were taken in."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, ForeignKey, Index, String, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, DatabaseTime, UtcDateTime, new_id


class Landing(Base):
    """One landing of one aircraft: the record as posted and as the solver takes it."""

    __tablename__ = "landing"
    __table_args__ = (
        UniqueConstraint("operator_id", "record_id"),
        Index("ix_landing_operator_id_touchdown_at_id", "operator_id", "touchdown_at", "id"),
        Index("ix_landing_operator_id_tail", "operator_id", "tail", "touchdown_at"),
    )

    id: Mapped[str] = mapped_column(String(36), primary_key=True, default=new_id)
    operator_id: Mapped[str] = mapped_column(ForeignKey("operator.id"))
    record_id: Mapped[str] = mapped_column(String(110))
    body_digest: Mapped[str] = mapped_column(String(64))
    aircraft: Mapped[str] = mapped_column(String(100))
    tail: Mapped[str | None] = mapped_column(String(100))
    #: Of the first contact; when the record does not say, the time of intake.
    touchdown_at: Mapped[datetime] = mapped_column(UtcDateTime)
    received_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())
    record: Mapped[dict[str, Any]] = mapped_column(JSON)
    inputs: Mapped[dict[str, Any]] = mapped_column(JSON)
    sd: Mapped[dict[str, float]] = mapped_column(JSON)
    sd_defaulted: Mapped[list[str]] = mapped_column(JSON)
    taken_as_zero: Mapped[list[str]] = mapped_column(JSON)


class IdempotencyKey(Base):
    """What a sender's Idempotency-Key was used for."""

    __tablename__ = "idempotency_key"

    operator_id: Mapped[str] = mapped_column(ForeignKey("operator.id"), primary_key=True)
    key: Mapped[str] = mapped_column(String(255), primary_key=True)
    body_digest: Mapped[str] = mapped_column(String(64))
    landing_id: Mapped[str] = mapped_column(ForeignKey("landing.id"))
    expires_at: Mapped[datetime] = mapped_column(UtcDateTime, index=True)
