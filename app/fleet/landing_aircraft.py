"""An aircraft's mass and gears for the landing simulation, without its stress model."""

from functools import lru_cache
from pathlib import Path

from app.fleet.registry import RegisteredAircraft
from solver.aircraft.airframe import load_airframe
from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.stored_airframe import load_stored_airframe, store_airframe
from solver.landing.aircraft import LandingAircraft

#: Airframes kept; they are mapped files.
_KEPT = 4


def landing_aircraft(
    aircraft: RegisteredAircraft, mass: float | None, cache: Path
) -> LandingAircraft:
    """Aircraft at a gross mass [kg], or in the definition's default loading.

    Its airframe is mapped from ``cache`` as a worker left it there.  Where none has loaded it yet,
    the first call reads the mesh, which takes a second or two.

    Raises
    ------
    ModelError
        The aircraft's files cannot be used.
    RecordError
        No loading has that mass.
    """
    airframe = _airframe(aircraft.folder, aircraft.content_hash, cache)
    loading = airframe.loading_for(mass=mass, fuel={}, payload={})
    return airframe.landing_aircraft(loading.factors)


@lru_cache(maxsize=_KEPT)
def _airframe(folder: Path, content_hash: str, cache: Path) -> AssessedAirframe:  # noqa: ARG001 - part of the key
    return load_stored_airframe(folder, cache) or store_airframe(load_airframe(folder), cache)
