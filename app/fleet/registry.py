"""Aircraft definitions on disk; nothing here assembles a structure."""

import threading
from dataclasses import dataclass
from pathlib import Path

import structlog

from solver.aircraft.definition import DEFINITION_FILE, AircraftDefinition
from solver.aircraft.definition_reader import content_hash, load_definition
from solver.errors import ModelError

log = structlog.get_logger(__name__)


@dataclass(frozen=True, slots=True)
class RegisteredAircraft:
    """An aircraft folder whose definition can be read."""

    folder: Path
    definition: AircraftDefinition
    content_hash: str

    @property
    def bulk_data(self) -> Path:
        return self.folder / self.definition.bulk_data


class AircraftRegistry:
    """Reads each folder once and again only when its files change."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self._read: dict[Path, tuple[object, RegisteredAircraft | None]] = {}

    def all(self) -> list[RegisteredAircraft]:
        with self._lock:
            folders = sorted(path.parent for path in self.folder.glob(f"*/{DEFINITION_FILE}"))
            found = [self._registered(folder) for folder in folders]
        return [aircraft for aircraft in found if aircraft is not None]

    def get(self, name: str) -> RegisteredAircraft | None:
        return next((a for a in self.all() if a.definition.name == name), None)

    def by_hash(self, model_hash: str) -> RegisteredAircraft | None:
        return next((a for a in self.all() if a.content_hash == model_hash), None)

    def _registered(self, folder: Path) -> RegisteredAircraft | None:
        stamp = tuple(
            (path.name, path.stat().st_mtime_ns, path.stat().st_size)
            for path in sorted(folder.iterdir())
            if path.is_file()
        )
        known = self._read.get(folder)
        if known is None or known[0] != stamp:
            self._read[folder] = known = (stamp, _read(folder))
        return known[1]


def _read(folder: Path) -> RegisteredAircraft | None:
    try:
        definition = load_definition(folder)
        return RegisteredAircraft(folder, definition, content_hash(folder, *definition.files))
    except (ModelError, OSError) as error:
        # One broken folder must not take the other aircraft out of service.
        log.error("aircraft.unreadable", folder=str(folder), error=str(error))
        return None
