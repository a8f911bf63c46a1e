"""What a window cannot tell, why, and what would settle it."""

from dataclasses import dataclass

import numpy as np

from solver.errors import SolverError
from solver.flight_data.parameter import Parameter
from solver.flight_data.window import Channel, Window

#: Rates below which a landing cannot be told [Hz].  A shock of a quarter of a second falls between
#: samples of normal acceleration at less than 4 Hz; attitude below 1 Hz says nothing of its rate.
LEAST_RATES = {
    Parameter.NORMAL_ACCELERATION: 4.0,
    Parameter.PITCH: 1.0,
    Parameter.ROLL: 1.0,
    Parameter.GROUND_SPEED: 0.2,
}

#: Least radio-altitude samples per second, all sources together, without inertial vertical speed.
LEAST_RADIO_RATE = 0.4

_TOLERANCE = 0.95  #: of a rate, for clocks that are not exact


@dataclass(frozen=True, slots=True)
class Shortcoming:
    """One reason why a window cannot carry a verdict."""

    code: str
    reason: str
    settled_by: str  #: which data would settle it


class UndeterminedError(SolverError):
    """A window turns out not to tell; carries why and what would settle it."""

    def __init__(self, shortcoming: Shortcoming) -> None:
        super().__init__(f"{shortcoming.reason}; settled by {shortcoming.settled_by}")
        self.shortcoming = shortcoming


def shortcomings(window: Window) -> tuple[Shortcoming, ...]:
    """Everything that a window lacks before any landing is looked for in it."""
    found = []
    for parameter, least in LEAST_RATES.items():
        channel = window.first(parameter)
        name = parameter.replace("_", " ")
        if channel is None:
            found.append(
                Shortcoming(
                    f"no_{parameter}",
                    f"{name} is not recorded",
                    f"{name} at {least:g} Hz or more from the flight recorder",
                )
            )
        elif channel.rate < least * _TOLERANCE:
            found.append(
                Shortcoming(
                    f"slow_{parameter}",
                    f"{name} at {channel.rate:.2g} Hz; a landing shock falls between its samples"
                    if parameter is Parameter.NORMAL_ACCELERATION
                    else f"{name} at {channel.rate:.2g} Hz is too slow",
                    f"{name} at {least:g} Hz or more, as the flight recorder has it",
                )
            )
    found += _vertical(window)
    return tuple(found)


def _vertical(window: Window) -> list[Shortcoming]:
    radios = [c for c in window.of(Parameter.RADIO_ALTITUDE) if c.rate > 0]
    inertial = window.first(Parameter.VERTICAL_SPEED)
    total = sum(channel.rate for channel in radios)
    if inertial is not None and inertial.rate >= 0.95 and not _is_broadcast(inertial):
        return []
    if total >= LEAST_RADIO_RATE:
        return []
    reason = "neither radio altitude nor inertial vertical speed is recorded"
    if radios:
        reason = f"radio altitude at {total:.2g} Hz in all and no inertial vertical speed"
    elif window.of(Parameter.BAROMETRIC_SPEED) or inertial is not None:
        reason = "the vertical speed is barometric or broadcast: late, and in steps of 64 ft/min"
    return [
        Shortcoming(
            "no_vertical_motion",
            reason,
            "radio altitude, or inertial vertical speed at 1 Hz or more",
        )
    ]


def _is_broadcast(channel: Channel) -> bool:
    """Whether a vertical speed comes in the 64 ft/min steps of ADS-B (DO-260B, 2.2.3.2.6.1)."""
    step = 64.0 * 0.3048 / 60.0
    turns = channel.value / step
    return len(channel.value) > 4 and bool((abs(turns - turns.round()) < 1e-3).all())


def check_gaps(window: Window, contact: float) -> None:
    """Raise `UndeterminedError` if a needed channel has a gap around a contact [s]."""
    for parameter, reach in (
        (Parameter.NORMAL_ACCELERATION, 1.0),
        (Parameter.PITCH, 1.5),
        (Parameter.ROLL, 1.5),
    ):
        channel = window.first(parameter)
        if channel is None:
            continue
        first, last = contact - 2 * reach, contact + reach
        near = channel.time[(channel.time > first) & (channel.time < last)]
        if np.diff([first, *near, last]).max() > 3.5 / channel.rate:
            name = parameter.replace("_", " ")
            raise UndeterminedError(
                Shortcoming(
                    f"gap_{parameter}",
                    f"{name} has a gap at the contact",
                    f"{name} without a gap from 3 s before to 2 s after the contact",
                )
            )
