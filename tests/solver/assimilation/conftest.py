"""Aircraft, geometry and one firm landing that the tests of this room share."""

from dataclasses import dataclass

import pytest

from solver.assimilation.scattered_landing import ScatteredLanding, scattered_landing
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Geometry, aircraft_geometry
from solver.flight_data.reconstruction import Reconstruction, reconstruct
from solver.landing.aircraft import LandingAircraft
from tests.solver.landing.business_jet import business_jet


@dataclass(frozen=True, slots=True)
class Recovered:
    """A scattered landing and what is known of it from before its contacts."""

    true: ScatteredLanding
    reconstruction: Reconstruction


@pytest.fixture(scope="session")
def aircraft() -> LandingAircraft:
    return business_jet()


@pytest.fixture(scope="session")
def geometry(aircraft: LandingAircraft) -> Geometry:
    return aircraft_geometry(aircraft)


@pytest.fixture(scope="session")
def landings(aircraft: LandingAircraft, geometry: Geometry) -> list[Recovered]:
    """Four landings, one for each of the frames with the most and the fewest samples twice."""
    found = []
    for number, frame in enumerate(("737-3c", "business-jet-16") * 2):
        true = scattered_landing(aircraft, geometry, packaged_frame(frame), 810 + number)
        found.append(Recovered(true, reconstruct(true.landing.window, geometry)))
    return found
