"""What may be wrong about a simulated contact and its recording: parameters with their scatter.

The state of the contact is what is sought.  Everything else that shapes the recorded response is
a parameter as well, with the scatter of service, so that a strut serviced 5 % low is not taken for
a faster sink: it is estimated along with the state and its uncertainty stays in the posterior.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from solver.aircraft.scatter import Scatter
from solver.arrays import Array
from solver.gear.parameters import Gear
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.landing.initial import RANGES


@dataclass(frozen=True, slots=True)
class ServiceScatter:
    """Standard deviations of what differs from aircraft to aircraft and landing to landing.

    Assumptions of the usual size where no source is named; an operator's own records are better.
    Factors scatter by the standard deviation of their natural logarithm.
    """

    #: Gas pressure of each strut: servicing charts allow some 5 %, 10 K between the servicing and
    #: the landing are another 3 %.
    gas_pressure: float = 0.05
    #: Force of the oil, all struts alike: discharge coefficients of 0.8 to 0.9 give 12 % from end
    #: to end (Milwitzky & Cook, NACA Report 1154), bearing friction is not told apart from it.
    orifice: float = 0.08
    tyre_stiffness: float = 0.05  #: inflation within 5 %, wear
    tyre_friction: float = 0.15  #: dry to damp runways
    mass: float = 0.01
    decay_start: float = 0.25  #: when the spoilers come out
    decay_time: float = 0.25
    residual_lift: float = 0.08  #: lift over weight, a standard deviation of its own

    def on_runway(self, friction: float, deviation: float) -> "ServiceScatter":
        """Scatter where the coefficient of friction was measured with a standard deviation."""
        return replace(self, tyre_friction=deviation / friction)

    @classmethod
    def stated(cls, scatter: Scatter) -> "ServiceScatter":
        """Scatter that an aircraft's definition states, struts alike in their oil."""
        return cls(
            gas_pressure=scatter.gas_pressure,
            orifice=scatter.strut_damping,
            tyre_stiffness=scatter.tyre_stiffness,
            tyre_friction=scatter.tyre_friction,
            decay_start=scatter.lift_decay_start / Lift().decay_start,
            decay_time=scatter.lift_decay_time,
            residual_lift=scatter.residual_lift_fraction,
        )


#: Names of the parameters of the aircraft and its lift besides one gas pressure for each strut.
SERVICE_PARAMETERS = (
    "orifice",
    "tyre_stiffness",
    "tyre_friction",
    "mass",
    "decay_start",
    "decay_time",
    "residual_lift",
    "centre_of_gravity",
)

#: Name of a strut's gas pressure is this and the gear's name.
GAS_PRESSURE = "gas_pressure "


def service_parameters(
    aircraft: LandingAircraft, scatter: ServiceScatter, centre_of_gravity_sd: float
) -> dict[str, float]:
    """Name and standard deviation of each parameter; all are 0 where nothing is perturbed."""
    found = {GAS_PRESSURE + gear.name: scatter.gas_pressure for gear in aircraft.gears}
    for name in SERVICE_PARAMETERS[:-1]:
        found[name] = getattr(scatter, name)
    found["centre_of_gravity"] = centre_of_gravity_sd
    return found


def perturbed_aircraft(aircraft: LandingAircraft, changes: dict[str, float]) -> LandingAircraft:
    """Aircraft with its service parameters changed.

    Parameters
    ----------
    aircraft : LandingAircraft
    changes : dict
        Of `service_parameters`; the centre of gravity's in m aft, the others as logarithms of
        factors.
    """
    factor = float(np.exp(changes["mass"]))
    shift = np.array([changes["centre_of_gravity"], 0.0, 0.0])
    return replace(
        aircraft,
        mass=aircraft.mass * factor,
        inertia=aircraft.inertia * factor,
        centre_of_gravity=aircraft.centre_of_gravity + shift,
        gears=tuple(_perturbed_gear(gear, changes) for gear in aircraft.gears),
    )


def _perturbed_gear(gear: Gear, changes: dict[str, float]) -> Gear:
    gas, oil, stiffness, friction = (
        float(np.exp(changes[name]))
        for name in (GAS_PRESSURE + gear.name, "orifice", "tyre_stiffness", "tyre_friction")
    )
    strut, tyre = gear.strut, gear.tyre
    return replace(
        gear,
        strut=replace(
            strut,
            initial_gas_pressure=strut.initial_gas_pressure * gas,
            compression_coefficient=strut.compression_coefficient * oil,
            rebound_coefficient=strut.rebound_coefficient * oil,
        ),
        tyre=replace(
            tyre,
            vertical_coefficient=tyre.vertical_coefficient * stiffness,
            maximum_friction=tyre.maximum_friction * friction,
            minimum_friction=tyre.minimum_friction * friction,
        ),
    )


def perturbed_lift(lift: Lift, changes: dict[str, float]) -> Lift:
    """Lift with its decay changed."""
    return replace(
        lift,
        decay_start=lift.decay_start * float(np.exp(changes["decay_start"])),
        decay_time=lift.decay_time * float(np.exp(changes["decay_time"])),
        residual_fraction=float(np.clip(lift.residual_fraction + changes["residual_lift"], 0, 1.5)),
    )


#: Range of the lift over weight that a record may state.
LIFT_RANGE = (0.0, 1.5)


def contact_values(contact: Contact) -> Array:
    """State of a contact, (9,) in the order of `CONTACT_COMPONENTS`."""
    return np.array(
        [
            contact.lift.fraction if name == "lift_fraction" else getattr(contact, name)
            for name in CONTACT_COMPONENTS
        ]
    )


def contact_with(contact: Contact, values: Array) -> Contact:
    """Contact with another state, (9,) in the order of `CONTACT_COMPONENTS`, kept within range."""
    given = dict(zip(CONTACT_COMPONENTS, values.tolist(), strict=True))
    lift = replace(contact.lift, fraction=float(np.clip(given.pop("lift_fraction"), *LIFT_RANGE)))
    state: dict[str, Any] = {
        name: float(np.clip(value, *RANGES[name])) for name, value in given.items()
    }
    return replace(contact, **state, lift=lift)
