"""An aircraft's mass and gears for the landing simulation, without its stress model."""

from functools import lru_cache
from pathlib import Path

from app.fleet.registry import RegisteredAircraft
from solver.aircraft.airframe import Airframe, load_airframe
from solver.landing.aircraft import LandingAircraft

#: Airframes kept; some tens of megabytes each.
_KEPT = 4


def landing_aircraft(aircraft: RegisteredAircraft, mass: float | None) -> LandingAircraft:
    """Aircraft at a gross mass [kg], or in the definition's default loading.

    The first call for an aircraft reads its mesh, which takes a second or two.

    Raises
    ------
    ModelError
        The aircraft's files cannot be used.
    RecordError
        No loading has that mass.
    """
    airframe = _airframe(aircraft.folder, aircraft.content_hash)
    loading = airframe.loading_for(mass=mass, fuel={}, payload={})
    return airframe.landing_aircraft(loading.factors)


@lru_cache(maxsize=_KEPT)
def _airframe(folder: Path, content_hash: str) -> Airframe:  # noqa: ARG001 - part of the key
    return load_airframe(folder)
