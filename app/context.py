"""What a request works with, made once per process."""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends, Request
from sqlalchemy import Engine

from app.broker import Nudger
from app.config import Settings
from app.fleet.envelopes import Envelopes
from app.fleet.registry import AircraftRegistry
from app.observe import Metrics


@dataclass(frozen=True, slots=True)
class ServiceContext:
    settings: Settings
    engine: Engine
    registry: AircraftRegistry
    envelopes: Envelopes
    nudger: Nudger
    metrics: Metrics


def _context(request: Request) -> ServiceContext:
    context: ServiceContext = request.app.state.context
    return context


Context = Annotated[ServiceContext, Depends(_context)]
