"""Who uses the service, with which keys, and the airframe models it has known."""

from datetime import datetime

from sqlalchemy import ForeignKey, String, Text
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, DatabaseTime, UtcDateTime, new_id


class Operator(Base):
    """An airline; nobody sees another one's landings."""

    __tablename__ = "operator"

    id: Mapped[str] = mapped_column(String(36), primary_key=True, default=new_id)
    name: Mapped[str] = mapped_column(String(100), unique=True)
    created_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())


class ApiKey(Base):
    """A key; the secret itself is never stored."""

    __tablename__ = "api_key"

    id: Mapped[str] = mapped_column(String(36), primary_key=True, default=new_id)
    operator_id: Mapped[str] = mapped_column(ForeignKey("operator.id"), index=True)
    prefix: Mapped[str] = mapped_column(String(12))
    digest: Mapped[str] = mapped_column(String(64), unique=True)
    scopes: Mapped[str] = mapped_column(String(100))
    label: Mapped[str] = mapped_column(String(100), default="")
    created_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())
    revoked_at: Mapped[datetime | None] = mapped_column(UtcDateTime)


class AirframeModel(Base):
    """An airframe model by its content hash, kept so that an old verdict can name its basis."""

    __tablename__ = "airframe_model"

    hash: Mapped[str] = mapped_column(String(64), primary_key=True)
    aircraft: Mapped[str] = mapped_column(String(100), index=True)
    title: Mapped[str] = mapped_column(Text)
    definition: Mapped[str] = mapped_column(Text)
    first_seen_at: Mapped[datetime] = mapped_column(UtcDateTime, default=DatabaseTime())
