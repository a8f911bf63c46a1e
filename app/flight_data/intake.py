"""From a recorder window to the touchdown record that it amounts to."""

import hashlib
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.flight_data.schemas import WindowQuery
from app.landings.field_errors import FieldError, InvalidRecordError
from solver.aircraft.definition import AircraftDefinition
from solver.errors import FlightDataError, ModelError
from solver.flight_data.contacts import ContactKind
from solver.flight_data.frame_file import frame_names, packaged_frame
from solver.flight_data.geometry import Geometry, Place, geometry_on_gears
from solver.flight_data.parameter import Parameter
from solver.flight_data.reading import read_window
from solver.flight_data.reconstruction import FoundContact, Reconstruction, reconstruct
from solver.flight_data.table import Limits
from solver.flight_data.touchdown import Estimate
from solver.flight_data.window import Window

#: Height of the centre of gravity above the main gears' pivots where nobody says [m].  It matters
#: little: the accelerometer is taken at the same height.
_ABOVE_PIVOTS = 0.5

#: How long after the last wheel came down peaks of the accelerations may still fall [s].
_PEAK_SPAN = 0.6

#: A record lists no more contacts.
_MOST_CONTACTS = 12

_FIRST_GEAR = {Place.LEFT: "ML", Place.RIGHT: "MR", Place.NOSE: "N"}

#: The landing simulation brings the other wheels down by itself.
_FOLLOWING = (ContactKind.DEROTATION, ContactKind.MAINS, ContactKind.ONE_GEAR)


@dataclass(frozen=True, slots=True)
class WindowIntake:
    """A window, what it tells, and the record made of it."""

    window: Window
    found: Reconstruction
    record: dict[str, Any]  #: as it would be posted
    digest: str  #: of file and query


def take_in_window(
    content: bytes, query: WindowQuery, definition: AircraftDefinition
) -> WindowIntake:
    """Read a window and reconstruct its contacts; raises `InvalidRecordError` saying where."""
    try:
        frame = packaged_frame(query.frame) if query.frame else None
    except ModelError as error:
        fault = FieldError("frame", query.frame, ", ".join(frame_names()), "no such frame")
        raise InvalidRecordError([fault]) from error
    try:
        window = read_window(content, frame, Limits())
    except FlightDataError as error:
        fault = FieldError(f"body, {error.where}", error.found, error.allowed, "cannot be read")
        raise InvalidRecordError([fault]) from error
    geometry = definition_geometry(definition, window)
    found = reconstruct(window, geometry)
    content_digest = hashlib.sha256(content).hexdigest()
    identity = f"{content_digest} {query.aircraft} {query.tail} {query.frame}"
    return WindowIntake(
        window=window,
        found=found,
        record=_record(query, window, found, geometry, content_digest),
        digest=hashlib.sha256(identity.encode()).hexdigest(),
    )


def definition_geometry(definition: AircraftDefinition, window: Window) -> Geometry:
    """Geometry in a loading of which only the gross mass may be recorded."""
    reference = definition.reference
    forward, aft = reference.forward_centre_of_gravity, reference.aft_centre_of_gravity
    gears = tuple(gear.gear(np.zeros((len(gear.pins), 3))) for gear in definition.gears)
    pivots = [float(gear.pivot[2]) for gear in gears]
    centre = np.array([(forward + aft) / 2, 0.0, max(pivots) + _ABOVE_PIVOTS])
    mass = window.first(Parameter.GROSS_MASS)
    return geometry_on_gears(
        gears,
        centre,
        definition.masses.maximum_landing if mass is None else float(np.median(mass.value)),
        # Anywhere in the allowed range: uniform, variance (aft - forward)^2 / 12.
        centre_of_gravity_sd=(aft - forward) / np.sqrt(12.0),
    )


def _record(
    query: WindowQuery,
    window: Window,
    found: Reconstruction,
    geometry: Geometry,
    content_digest: str,
) -> dict[str, Any]:
    aircraft = {"model_id": query.aircraft}
    if query.tail is not None:
        aircraft["tail_token"] = query.tail
    source = {"raw_sha256": content_digest, "extractor": "flight-data"}
    if query.frame is not None:
        source["frame"] = query.frame
    record: dict[str, Any] = {
        "record_id": query.record_id or f"flight-data:{content_digest}",
        "aircraft": aircraft,
        "source": source,
    }
    mass = window.first(Parameter.GROSS_MASS)
    if mass is not None:
        value = float(np.median(mass.value))
        record["mass"] = {"gross_weight": {"value": value, "unit": "kg", "sd": 0.01 * value}}
    landed = [c for c in found.contacts if c.kind not in _FOLLOWING][:_MOST_CONTACTS]
    places = {wheel.gear: wheel.place for wheel in geometry.wheels}
    # A window that cannot tell is a landing all the same: one contact of which nothing is known.
    record["contacts"] = [
        _contact(contact, landed[0], _peaks_until(contact, landed, found.contacts), window, places)
        for contact in landed
    ] or [{}]
    return record


def _peaks_until(
    contact: FoundContact, landed: list[FoundContact], every: tuple[FoundContact, ...]
) -> float:
    """Time up to which peaks are those of a contact: the next one, or the last wheel down [s]."""
    later = [other.time for other in landed if other.time > contact.time]
    if later:
        return min(later)
    return max(other.time for other in every) + _PEAK_SPAN


def _contact(
    contact: FoundContact,
    first: FoundContact,
    peaks_until: float,
    window: Window,
    places: dict[str, Place],
) -> dict[str, Any]:
    state = contact.state
    sink = state.sink_rate
    given: dict[str, Any] = {
        "time": _number(Estimate(contact.time - first.time, contact.time_sd), "s"),
        "t_sd_s": contact.time_sd,
        "first_gear": _FIRST_GEAR[places[contact.gear]],
        # The softest contact still comes down.
        "sink_rate": _number(Estimate(max(sink.value, 0.01), sink.sd), "m/s")
        | {"method": "smoother"},
        "pitch": _number(state.pitch, "rad"),
        "roll": _number(state.roll, "rad"),
        "pitch_rate": _number(state.pitch_rate, "rad/s"),
        "roll_rate": _number(state.roll_rate, "rad/s"),
        "lift_fraction": _number(
            Estimate(float(np.clip(state.lift_fraction.value, 0.0, 1.5)), state.lift_fraction.sd),
            "1",
        ),
    }
    for name, unit in (("drift", "rad"), ("ground_speed", "m/s"), ("yaw_rate", "rad/s")):
        if name not in state.assumed:
            given[name] = _number(getattr(state, name), unit)
    for name, parameter, size in (
        ("nz_peak", Parameter.NORMAL_ACCELERATION, np.positive),
        ("ny_peak", Parameter.LATERAL_ACCELERATION, np.abs),
    ):
        channel = window.first(parameter)
        if channel is None:
            continue
        inside = (channel.time > contact.time) & (channel.time < peaks_until)
        if np.any(inside):
            values = channel.value[inside]
            peak = float(values[np.argmax(size(values))])
            given[name] = {"value": peak, "unit": "g", "rate_hz": channel.rate}
    return given


def _number(estimate: Estimate, unit: str) -> dict[str, Any]:
    return {"value": float(estimate.value), "unit": unit, "sd": float(estimate.sd)}
