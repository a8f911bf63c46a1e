"""Vector of everything that is estimated at one contact: names, prior, and what each stands for.

Order: state of the contact, its instant, service parameters, place of the accelerometer, errors of
the recorded channels.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.assimilation.parameters import (
    ServiceScatter,
    contact_values,
    contact_with,
    perturbed_aircraft,
    perturbed_lift,
    service_parameters,
)
from solver.assimilation.samples import ChannelSamples
from solver.assimilation.sensor import SensorErrors
from solver.flight_data.geometry import Geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.vertical import SLOPE_SD
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS

#: By how much the contact was later than found [s].
INSTANT = "instant"

_SENSOR = ("accelerometer x", "accelerometer y", "accelerometer z")
_STATE = len(CONTACT_COMPONENTS)

#: Unit of each component of a contact's state.
STATE_UNITS = {
    "sink_rate": "m/s",
    "pitch": "rad",
    "roll": "rad",
    "drift": "rad",
    "ground_speed": "m/s",
    "pitch_rate": "rad/s",
    "roll_rate": "rad/s",
    "yaw_rate": "rad/s",
    "lift_fraction": "1",
}


@dataclass(frozen=True, slots=True)
class Believed:
    """What is believed of a contact before its response is looked at."""

    aircraft: LandingAircraft
    geometry: Geometry
    contact: Contact
    covariance: Array  #: (9, 9) in the order of `CONTACT_COMPONENTS`
    instant_sd: float  #: [s]
    scatter: ServiceScatter
    wheel_speeds: Array | None = None  #: (n_gears,) before the contact, None: at rest [rad/s]


@dataclass(frozen=True, slots=True)
class Prior:
    """Expected parameters and a square root of their covariance."""

    believed: Believed
    names: tuple[str, ...]
    mean: Array  #: (n,)
    root: Array  #: (n, n) lower triangular, covariance ``root root'``
    simulated_count: int  #: so many come first that change the simulation

    def covariance(self, whitened: Array) -> Array:
        """(n, n) in the parameters' own units of that of independent ones of unit variance."""
        return np.asarray(self.root @ whitened @ self.root.T)

    def named(self, whitened: Array) -> dict[str, float]:
        """Values by name of independent ones of unit variance."""
        values = self.mean + self.root @ whitened
        return dict(zip(self.names, values.tolist(), strict=True))


def prior(believed: Believed, channels: Sequence[ChannelSamples]) -> Prior:
    """Prior of all parameters."""
    service = service_parameters(
        believed.aircraft, believed.scatter, believed.geometry.centre_of_gravity_sd
    )
    reference = channels[0].entry.delay_scatter.value
    # The instant is that which the first channel shows: its delay is in it, and others are late
    # against it.
    sd = service | {INSTANT: float(np.hypot(believed.instant_sd, reference))}
    sd |= dict.fromkeys(_SENSOR, believed.geometry.installation.position_sd)
    for channel in channels:
        sd[_name(channel, "bias")] = channel.bias_sd
        sd[_name(channel, "scale")] = channel.entry.scale.value
        late = float(np.hypot(channel.entry.delay_scatter.value, reference))
        sd[_name(channel, "delay")] = 0.0 if channel is channels[0] else late
    names = (*CONTACT_COMPONENTS, *sd)
    covariance = np.zeros((len(names), len(names)))
    covariance[:_STATE, :_STATE] = believed.covariance
    covariance[range(_STATE, len(names)), range(_STATE, len(names))] = np.square(list(sd.values()))
    for channel in channels:
        _share_bias(covariance, names, channel)
    mean = np.zeros(len(names))
    mean[:_STATE] = contact_values(believed.contact)
    return Prior(believed, names, mean, _root(covariance), _STATE + len(service))


def _name(channel: ChannelSamples, error: str) -> str:
    return f"{channel.parameter} {error}"


def _share_bias(covariance: Array, names: tuple[str, ...], channel: ChannelSamples) -> None:
    """Tie a level's bias to the angle at the contact, which was taken too high by as much."""
    if channel.parameter not in (Parameter.PITCH, Parameter.ROLL):
        return
    angle, bias = names.index(channel.parameter), names.index(_name(channel, "bias"))
    variance = channel.bias_sd**2
    if channel.parameter is Parameter.PITCH:
        variance += SLOPE_SD**2  # a runway's slope does the same
    covariance[bias, bias] = variance
    shared = min(variance, 0.98 * covariance[angle, angle])
    covariance[angle, bias] = covariance[bias, angle] = -shared


def _root(covariance: Array) -> Array:
    """Lower triangular square root; a parameter without variance gets a row of zeros."""
    scale = np.sqrt(np.diag(covariance))
    used = scale > 0.0
    safe = np.where(used, scale, 1.0)
    correlation = covariance / np.outer(safe, safe)
    correlation[~used, ~used] = 1.0
    # A correlation of one cannot be factored; rounding may even pass it.
    correlation = (1.0 - 1e-9) * correlation + 1e-9 * np.eye(len(scale))
    return np.asarray(scale[:, None] * np.linalg.cholesky(correlation))


def simulated(prior: Prior, values: dict[str, float]) -> tuple[LandingAircraft, Contact]:
    """Aircraft and contact to simulate for parameters by name."""
    state = np.array([values[name] for name in CONTACT_COMPONENTS])
    contact = contact_with(prior.believed.contact, state)
    return (
        perturbed_aircraft(prior.believed.aircraft, values),
        replace(contact, lift=perturbed_lift(contact.lift, values)),
    )


def accelerometer(prior: Prior, values: dict[str, float]) -> Array:
    """Place of the accelerometer for parameters by name, (3,) structural axes [m]."""
    believed = prior.believed.geometry.installation.accelerometer
    return np.asarray(believed + [values[name] for name in _SENSOR])


def channel_errors(channel: ChannelSamples, values: dict[str, float]) -> SensorErrors:
    """Constant errors of a channel for parameters by name."""
    return SensorErrors(
        bias=values[_name(channel, "bias")],
        scale=values[_name(channel, "scale")],
        delay=values[_name(channel, "delay")] + values[INSTANT],
    )


def unit_of(name: str) -> str:
    """Name the unit of a parameter: SI, g for accelerations, ``ln`` for logarithms of factors."""
    if name in STATE_UNITS:
        return STATE_UNITS[name]
    if name in (INSTANT, "centre_of_gravity", *_SENSOR):
        return "s" if name == INSTANT else "m"
    parameter, _, error = name.rpartition(" ")
    if error == "bias":
        return "rad" if parameter in (Parameter.PITCH, Parameter.ROLL) else "g"
    return {"scale": "1", "delay": "s", "residual_lift": "1"}.get(error, "ln")
