"""Aircraft, geometry and one plain landing that the tests of this room share."""

import numpy as np
import pytest

from solver.flight_data.approach import Approach, fly_in
from solver.flight_data.fleet import SyntheticLanding, synthetic_landing
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Geometry, aircraft_geometry
from solver.flight_data.motion import Motion
from solver.flight_data.recorder import Surroundings, record
from solver.flight_data.window import Window
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.landing.business_jet import business_jet

FRAMES = ("737-3c", "737-7", "a330", "business-jet-8", "business-jet-16")


@pytest.fixture(scope="session")
def aircraft() -> LandingAircraft:
    return business_jet()


@pytest.fixture(scope="session")
def geometry(aircraft: LandingAircraft) -> Geometry:
    return aircraft_geometry(aircraft)


@pytest.fixture(scope="session")
def history(aircraft: LandingAircraft) -> LandingHistory:
    """A firm landing, right wheel first, then a bounce."""
    contact = Contact(2.0, 62.0, pitch=0.085, roll=0.03, pitch_rate=0.01, roll_rate=-0.02)
    options = SimulationOptions(time_limit=6.0, stop_when_settled=False, output_interval=2e-3)
    return simulate_landing(aircraft, contact, options)


@pytest.fixture(scope="session")
def motion(history: LandingHistory) -> Motion:
    return fly_in(history, Approach(), np.random.default_rng(4))


@pytest.fixture(scope="session")
def window(motion: Motion, geometry: Geometry) -> Window:
    return record(motion, packaged_frame("business-jet-8"), geometry, Surroundings(mass=12e3), 7)


@pytest.fixture(scope="session")
def fleet(aircraft: LandingAircraft, geometry: Geometry) -> list[tuple[str, SyntheticLanding]]:
    """Eighty landings, sixteen for each frame."""
    return [
        (name, synthetic_landing(aircraft, geometry, packaged_frame(name), 1000 + seed))
        for seed in range(80)
        for name in (FRAMES[seed % len(FRAMES)],)
    ]
