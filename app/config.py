"""Settings of the service, from the environment (``HL_...``) or a ``.env`` file."""

import os
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, field_validator, model_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

LANES: dict[str, int] = {"interactive": 0, "bulk": 1}
LANE_NAMES: dict[int, str] = {rank: name for name, rank in LANES.items()}


class Settings(BaseSettings):
    """All that differs between a laptop and a fleet; the defaults run everything on one machine."""

    model_config = SettingsConfigDict(
        env_prefix="HL_", env_file=".env", extra="ignore", frozen=True
    )

    var: Path = Path("var")  #: state of the embedded mode
    aircraft_dir: Path | None = None  #: folders with definition.toml and bulk data
    cache_dir: Path | None = None  #: reduced models by content hash
    database_url: str | None = None  #: sqlite:///file or postgresql://...
    broker_url: str | None = None  #: filesystem:// or redis://...
    host: str = "127.0.0.1"
    port: Annotated[int, Field(ge=0, le=65535)] = 8000
    log_format: Literal["json", "console"] = "json"
    auto_migrate: bool = True  #: `serve` brings the database to head before it starts

    #: Records are a few kilobytes, also with many contacts; what is larger is a mistake.
    max_body_bytes: Annotated[int, Field(ge=1024)] = 1024 * 1024
    #: A stream of records is never held, only stored; each of its lines is limited as a body is.
    max_bulk_bytes: Annotated[int, Field(ge=1024)] = 8 * 1024**3
    #: An oversized body is read and thrown away up to here, so that its sender sees the answer
    #: instead of a reset connection.
    discard_body_bytes: Annotated[int, Field(ge=0)] = 128 * 1024 * 1024

    #: A claim lasts this long by the database's clock; must exceed `hard_time_limit`, or a slow
    #: worker and its successor would both solve (only one could finish, the other is fenced).
    lease_seconds: Annotated[float, Field(gt=0)] = 45.0
    soft_time_limit: Annotated[float, Field(gt=0)] = 20.0
    hard_time_limit: Annotated[float, Field(gt=0)] = 30.0
    #: A worker keeps claiming for this long on one nudge, then passes the nudge on.
    drain_budget: Annotated[float, Field(ge=0)] = 1.0
    #: Where many wait, a worker claims as many at once as it can solve in this time, and puts back
    #: what it could not.  Whoever comes with priority waits this long, and for one landing more.
    batch_seconds: Annotated[float, Field(ge=0)] = 0.25
    batch_limit: Annotated[int, Field(ge=1)] = 32  #: most landings in one claim
    max_attempts: Annotated[int, Field(ge=1)] = 5
    sweep_interval: Annotated[float, Field(gt=0)] = 1.5
    nudge_window: Annotated[int, Field(ge=1)] = 4  #: most nudges that one sweep sends

    #: `run` and `serve` make the envelopes that installed aircraft lack, when nobody else works.
    makes_envelopes: bool = True

    worker_concurrency: Annotated[int, Field(ge=1)] = max(1, (os.cpu_count() or 2) - 1)
    worker_lanes: Annotated[tuple[str, ...], NoDecode] = ("interactive", "bulk")

    #: Whether a landing's uncertainty goes through the simulation, too.  Seconds of all cores for
    #: a firm landing; without it there is a verdict, but no probability.
    propagate_uncertainty: bool = True

    #: Histories and peak fields are kept when the worst utilisation reaches this, or the verdict
    #: asks for an inspection.  Unset: everything on SQLite, 0.8 on Postgres.
    keep_arrays_above: Annotated[float, Field(ge=0)] | None = None
    idempotency_days: Annotated[int, Field(ge=1)] = 30

    @field_validator("worker_lanes", mode="before")
    @classmethod
    def _lanes(cls, value: object) -> object:
        names = tuple(value.split(",")) if isinstance(value, str) else value
        if isinstance(names, tuple) and not set(names) <= set(LANES):
            raise ValueError(f"lanes are {', '.join(LANES)}")
        return names

    @model_validator(mode="after")
    def _limits_in_order(self) -> "Settings":
        if not self.soft_time_limit < self.hard_time_limit < self.lease_seconds:
            raise ValueError("soft_time_limit < hard_time_limit < lease_seconds must hold")
        return self

    @property
    def sqlalchemy_url(self) -> str:
        if self.database_url is None:
            return f"sqlite:///{(self.var / 'hardlanding.db').absolute()}"
        # The short form of a URL leaves the driver to the library; say which one is meant.
        return self.database_url.replace("postgresql://", "postgresql+psycopg://", 1)

    @property
    def celery_broker_url(self) -> str:
        # The host means nothing to a folder, but its absence would be logged as a mistake.
        return self.broker_url or "filesystem://localhost"

    @property
    def broker_folder(self) -> Path:
        """Where the filesystem transport keeps its messages."""
        return (self.var / "broker").absolute()

    @property
    def aircraft_folder(self) -> Path:
        return self.aircraft_dir or self.var / "aircraft"

    @property
    def cache_folder(self) -> Path:
        return self.cache_dir or self.var / "cache"

    @property
    def keeps_arrays_from(self) -> float:
        """Worst utilisation from which the arrays of a landing are kept."""
        if self.keep_arrays_above is not None:
            return self.keep_arrays_above
        return 0.0 if self.sqlalchemy_url.startswith("sqlite") else 0.8


@lru_cache(maxsize=1)
def get_settings() -> Settings:
    """Settings of this process, read once."""
    return Settings()
