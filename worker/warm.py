"""Models ready before the first landing: loaded in the parent, shared with every child."""

import gc
import threading
from dataclasses import dataclass, field
from pathlib import Path

import structlog

from app.config import Settings
from app.fleet.registry import AircraftRegistry, RegisteredAircraft
from solver.assess import AssessmentModel, load_assessment_model
from solver.assessment import TouchdownRecord
from solver.errors import ModelError, SolverError
from solver.landing.contact import Contact
from worker.solve import solve

log = structlog.get_logger(__name__)

#: A gentle landing that makes every compiled routine ready.
_WARM_UP = Contact(sink_rate=0.5, ground_speed=60.0, pitch=0.05)


class NewAircraftError(Exception):
    """An aircraft was installed while the worker ran."""


@dataclass(slots=True)
class Models:
    """Assessment models by aircraft, each loaded once and again when its files change."""

    registry: AircraftRegistry
    cache: Path
    is_sealed: bool = False  #: in a child: loading would take longer than a task may
    _loaded: dict[str, AssessmentModel] = field(default_factory=dict)
    _unusable: dict[str, str] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def get(self, name: str) -> AssessmentModel:
        """Model of an aircraft.

        Raises `ModelError` if it is not installed or cannot be used, and `NewAircraftError` if it
        was installed after the models were loaded.
        """
        aircraft = self.registry.get(name)
        if aircraft is None:
            known = ", ".join(a.definition.name for a in self.registry.all()) or "none"
            raise ModelError(f"aircraft {name!r} is not installed here; installed: {known}")
        with self._lock:
            model = self._loaded.get(aircraft.content_hash)
            if aircraft.content_hash in self._unusable:
                raise ModelError(self._unusable[aircraft.content_hash])
            if model is None and self.is_sealed:
                raise NewAircraftError(f"{name} is new here; the worker starts again to load it")
            if model is None:
                model = self._load(aircraft)
                self._loaded[aircraft.content_hash] = model
            return model

    def warm_up(self) -> None:
        """Load every model, solve once with each, and set the memory apart for sharing."""
        for aircraft in self.registry.all():
            name = aircraft.definition.name
            try:
                solve(self.get(name), TouchdownRecord(name, (_WARM_UP,)))
            except SolverError as error:
                # A landing of this aircraft will say the same; the others must not suffer from it.
                self._unusable[aircraft.content_hash] = str(error)
                log.error("model.unusable", aircraft=name, error=str(error))
        self.is_sealed = True
        gc.collect()
        gc.freeze()

    def _load(self, aircraft: RegisteredAircraft) -> AssessmentModel:
        reported: set[tuple[str, int]] = set()

        def progress(step: str, share: float) -> None:
            tenth = (step, int(10 * share))
            if tenth not in reported:
                reported.add(tenth)
                log.info("model.loading", aircraft=aircraft.definition.name, step=step,
                         share=round(share, 2))  # fmt: skip

        self.cache.mkdir(parents=True, exist_ok=True)
        return load_assessment_model(aircraft.folder, self.cache, progress)


_models: Models | None = None


def models(settings: Settings) -> Models:
    """The models of this process, and by inheritance of its children."""
    global _models
    if _models is None:
        registry = AircraftRegistry(settings.aircraft_folder)
        _models = Models(registry, settings.cache_folder)
    return _models
