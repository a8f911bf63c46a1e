"""One recording as an assessment reads it: contacts by the smoother, on the aircraft as defined."""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.loading import Loading
from solver.assess import AssessmentModel
from solver.assessment import TouchdownRecord
from solver.assimilation.assimilate import FOLLOWING, Assimilation, assimilate, contact_of
from solver.assimilation.parameters import ServiceScatter
from solver.flight_data.contacts import ContactKind
from solver.flight_data.geometry import Geometry, Installation, geometry_on_gears
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import Reconstruction, reconstruct
from solver.flight_data.window import Window
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.recorded import RecordedContact

#: Of a recorded gross mass, relative (the computed mass of an airliner is good to about 1 %).
MASS_DEVIATION = 0.01


@dataclass(frozen=True, slots=True)
class Reading:
    """What is believed of a landing before its response is looked at."""

    window: Window
    mass: float  #: recorded [kg]
    loading: Loading  #: by that mass
    aircraft: LandingAircraft  #: as defined, in that loading
    geometry: Geometry
    found: Reconstruction

    @property
    def is_silent(self) -> bool:
        """Whether the window shows no contact that could be assessed."""
        return not self.found.contacts

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """Contacts out of the air, in order."""
        landed = [each for each in self.found.contacts if each.kind not in FOLLOWING]
        return tuple(contact_of(each, landed[0].time) for each in landed)

    def record(self, model: AssessmentModel) -> TouchdownRecord:
        """Record of the landing, as it is assessed."""
        landed = [each for each in self.found.contacts if each.kind not in FOLLOWING]
        return TouchdownRecord(
            model.name,
            self.contacts,
            mass=self.mass,
            mass_deviation=MASS_DEVIATION * self.mass,
            centre_of_gravity_deviation=self.geometry.centre_of_gravity_sd,
            recorded=tuple(
                RecordedContact(nose_first=each.kind is ContactKind.NOSE_FIRST, simulated=place)
                for place, each in enumerate(landed)
            ),
        )

    def assimilated(
        self, model: AssessmentModel, friction: tuple[float, float] | None = None
    ) -> Assimilation:
        """Correct the contacts by their recorded responses.

        With ``friction`` the runway's is known: value and standard deviation.
        """
        aircraft = self.aircraft
        scatter = ServiceScatter.stated(model.airframe.definition.scatter)
        if friction is not None:
            aircraft = aircraft.on_runway(friction[0])
            scatter = scatter.on_runway(*friction)
        return assimilate(self.window, self.found, aircraft, self.geometry, scatter=scatter)


def read_window(model: AssessmentModel, window: Window, installation: Installation) -> Reading:
    """Find the contacts of a window; ``installation`` is where the sensors are believed to be."""
    airframe = model.airframe
    mass = recorded_mass(model, window)
    loading = airframe.loading_for(mass)
    aircraft = airframe.landing_aircraft(loading.factors)
    reference = airframe.definition.reference
    forward, aft = reference.forward_centre_of_gravity, reference.aft_centre_of_gravity
    geometry = geometry_on_gears(
        aircraft.gears,
        aircraft.total_centre_of_gravity,
        aircraft.total_mass,
        installation,
        # Anywhere in the allowed range: uniform, variance (aft - forward)^2 / 12.
        centre_of_gravity_sd=(aft - forward) / np.sqrt(12.0),
    )
    return Reading(window, mass, loading, aircraft, geometry, reconstruct(window, geometry))


def recorded_mass(model: AssessmentModel, window: Window) -> float:
    """Gross mass of the window, or the largest landing mass where it shows none [kg]."""
    channel = window.first(Parameter.GROSS_MASS)
    if channel is None:
        return model.airframe.definition.masses.maximum_landing
    return float(np.median(channel.value))
