"""Recorded samples around a contact, and how far the simulation may be from each."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from solver.arrays import Array
from solver.assimilation.model_error import ModelError, acceleration_error, turned
from solver.flight_data.alignment import Series, best
from solver.flight_data.datum import Datum
from solver.flight_data.frame import RecordedParameter
from solver.flight_data.parameter import ACCELERATIONS, Parameter
from solver.flight_data.window import Window

#: What is compared, in this order.
COMPARED = (
    Parameter.NORMAL_ACCELERATION,
    Parameter.LATERAL_ACCELERATION,
    Parameter.LONGITUDINAL_ACCELERATION,
    Parameter.PITCH,
    Parameter.ROLL,
)

#: Samples a channel must have after the contact; a single one says next to nothing.
_LEAST = 2


@dataclass(frozen=True, slots=True)
class ChannelSamples:
    """Samples of one channel that are compared."""

    parameter: Parameter
    entry: RecordedParameter
    rate: float  #: samples per second [Hz]
    time: Array  #: (n,) as filed, after the instant at which the contact was found [s]
    value: Array  #: (n,) datum taken out
    covariance: Array  #: (n, n) of noise, step and the simulation's own error
    bias_sd: float  #: of the channel's constant error

    @property
    def whiten(self) -> Array:
        """(n, n) W with ``W'W`` the inverse of the covariance."""
        return np.asarray(np.linalg.inv(np.linalg.cholesky(self.covariance)))


@dataclass(frozen=True, slots=True)
class Response:
    """What was recorded after a contact."""

    channels: tuple[ChannelSamples, ...]

    @property
    def measured(self) -> Array:
        """(m,) samples of all channels."""
        return np.concatenate([channel.value for channel in self.channels])

    @property
    def whiten(self) -> Array:
        """(m, m) as that of the channels, which err independently."""
        return np.asarray(block_diag(*[channel.whiten for channel in self.channels]))


def response_after(
    window: Window,
    contact_time: float,
    before: float,
    span: float,
    datum: Datum | None,
    model: ModelError,
) -> Response | None:
    """Take the samples around a contact; None without normal acceleration, which shows the shock.

    Parameters
    ----------
    window : Window
    contact_time : float
        On the clock of the aircraft [s].
    before : float
        How long before it normal acceleration is taken in: its last low sample bounds the instant.
        What else came before the contact is in the state already [s].
    span : float
        How long after it samples are taken in [s].
    datum : Datum, optional
        Of the normal acceleration.
    model : ModelError
    """
    found = []
    for parameter in COMPARED:
        series = best(window, parameter)
        if series is None:
            continue
        # A series has the filter's delay taken out; the prediction holds the filter itself.
        after = series.time + series.lag - contact_time
        first = -before if parameter is Parameter.NORMAL_ACCELERATION else 0.0
        inside = (after >= first) & (after <= span)
        if np.sum(after[inside] > 0.0) >= _LEAST:
            found.append(_channel(series, after[inside], series.value[inside], datum, model))
    if not found or found[0].parameter is not Parameter.NORMAL_ACCELERATION:
        return None
    return Response(tuple(found))


def _channel(
    series: Series, after: Array, value: Array, datum: Datum | None, model: ModelError
) -> ChannelSamples:
    parameter, entry = series.channel.parameter, series.entry
    bias_sd = entry.bias.value
    if parameter is Parameter.NORMAL_ACCELERATION and datum is not None:
        value = value - datum.offset
        bias_sd = datum.sd
    covariance = series.sd**2 * np.eye(len(after))
    if parameter in ACCELERATIONS:
        covariance += acceleration_error(parameter, after, value, model)
    else:
        covariance += turned(after, model.control)
    time = after + entry.delay.value
    return ChannelSamples(parameter, entry, series.channel.rate, time, value, covariance, bias_sd)
