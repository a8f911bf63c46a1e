"""What a posted contact says of its recorded peaks, for the maker's rule."""

from app.landings.quantities import Measured, RecordedPeak
from app.landings.schemas import ContactIn, FirstGear
from solver import recorded


def recorded_contact(given: ContactIn, simulated: int | None) -> recorded.RecordedContact:
    """Nothing is filled in here: a rule takes no default for what was recorded."""

    def si(measured: Measured | None) -> float | None:
        return None if measured is None else measured.si

    def peak(measured: RecordedPeak | None) -> recorded.RecordedPeak | None:
        return None if measured is None else recorded.RecordedPeak(measured.si, measured.rate_hz)

    return recorded.RecordedContact(
        normal_load_factor=peak(given.nz_peak),
        lateral_load_factor=peak(given.ny_peak),
        sink_rate=si(given.sink_rate),
        roll=si(given.roll),
        roll_rate=si(given.roll_rate),
        nose_first=_nose_first(given),
        simulated=simulated,
    )


def _nose_first(given: ContactIn) -> bool | None:
    if given.nose_wheel_down:
        return False
    return None if given.first_gear is None else given.first_gear is FirstGear.NOSE
