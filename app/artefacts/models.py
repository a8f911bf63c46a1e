"""Arrays that belong to an assessment."""

from datetime import datetime

from sqlalchemy import ForeignKey, LargeBinary, String
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, DatabaseTime, UtcDateTime


class Artefact(Base):
    """A packed and compressed set of arrays; see `app.artefacts.container`."""

    __tablename__ = "artefact"

    assessment_id: Mapped[str] = mapped_column(ForeignKey("assessment.id"), primary_key=True)
    kind: Mapped[str] = mapped_column(String(40), primary_key=True)
    body: Mapped[bytes] = mapped_column(LargeBinary)
    created_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())
