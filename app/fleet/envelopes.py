"""Envelopes of the installed aircraft, each read once it is there."""

import threading
from pathlib import Path

from app.fleet.registry import AircraftRegistry
from solver.envelope.envelope import Envelope
from solver.envelope.store import envelope_path, load_envelope


class Envelopes:
    """Whatever lies beside the reduced models, for the aircraft as they are now."""

    def __init__(self, registry: AircraftRegistry, cache: Path) -> None:
        self._registry = registry
        self._cache = cache
        self._lock = threading.Lock()
        self._read: dict[Path, Envelope] = {}

    def get(self, aircraft: str) -> Envelope | None:
        """Envelope of an aircraft; None if it is not installed or its envelope not made yet."""
        registered = self._registry.get(aircraft)
        if registered is None:
            return None
        path = envelope_path(self._cache, registered.content_hash)
        with self._lock:
            found = self._read.get(path)
            if found is None:
                found = load_envelope(path, registered.definition)
                if found is not None:
                    self._read[path] = found
            return found
