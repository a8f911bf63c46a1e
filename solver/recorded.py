"""What a recorder shows of a contact, as makers' rules take it: peaks with the rate behind them."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RecordedPeak:
    """Largest recorded sample; the true peak lies between samples and is at least as large."""

    value: float  #: [g]
    rate: float  #: samples per second [Hz]


@dataclass(frozen=True, slots=True)
class RecordedContact:
    """One contact as recorded; None where the record is silent, never an assumed zero."""

    normal_load_factor: RecordedPeak | None = None  #: along the body's normal, +1 at rest
    lateral_load_factor: RecordedPeak | None = None
    sink_rate: float | None = None  #: downward positive [m/s]
    roll: float | None = None  #: starboard wing down positive [rad]
    roll_rate: float | None = None  #: [rad/s]
    nose_first: bool | None = None  #: by the gear switches
    simulated: int | None = None  #: its place among the contacts whose state is known
