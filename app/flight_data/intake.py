"""From a recorder window to the touchdown record that it amounts to."""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from app.fleet.landing_aircraft import landing_aircraft
from app.fleet.registry import RegisteredAircraft
from app.flight_data.schemas import WindowQuery
from app.landings.field_errors import FieldError, InvalidRecordError
from solver.aircraft.definition import AircraftDefinition
from solver.assimilation.assimilate import (
    Assimilation,
    ContactUpdate,
    assimilate,
    uncorrected,
)
from solver.assimilation.parameters import ServiceScatter
from solver.assimilation.state import STATE_UNITS
from solver.errors import FlightDataError, ModelError, SolverError
from solver.flight_data.frame_file import frame_names, packaged_frame
from solver.flight_data.geometry import Geometry, geometry_on_gears
from solver.flight_data.parameter import Parameter
from solver.flight_data.reading import read_window
from solver.flight_data.reconstruction import FoundContact, Reconstruction, reconstruct
from solver.flight_data.table import Limits
from solver.flight_data.window import Note, Window
from solver.gear.place import Place
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS

#: Height of the centre of gravity above the main gears' pivots where nobody says [m].  It matters
#: little: the accelerometer is taken at the same height.
_ABOVE_PIVOTS = 0.5

#: How long after the last wheel came down peaks of the accelerations may still fall [s].
_PEAK_SPAN = 0.6

#: A record lists no more contacts.
_MOST_CONTACTS = 12

_FIRST_GEAR = {Place.LEFT: "ML", Place.RIGHT: "MR", Place.NOSE: "N"}


@dataclass(frozen=True, slots=True)
class WindowIntake:
    """A window, what it tells, and the record made of it."""

    window: Window
    found: Reconstruction
    responses: Assimilation  #: its contacts as the record states them
    notes: tuple[Note, ...]
    record: dict[str, Any]  #: as it would be posted
    digest: str  #: of file and query


def take_in_window(
    content: bytes, query: WindowQuery, aircraft: RegisteredAircraft, cache: Path
) -> WindowIntake:
    """Read a window and reconstruct its contacts; raises `InvalidRecordError` saying where.

    Below `cache` the workers keep what an assessment needs of each airframe.
    """
    definition = aircraft.definition
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
    responses, notes = _responses(query, window, found, geometry, aircraft, cache)
    content_digest = hashlib.sha256(content).hexdigest()
    identity = f"{content_digest} {query.aircraft} {query.tail} {query.frame}"
    if query.runway_friction is not None:
        identity += f" {query.runway_friction:g} {query.runway_friction_sd:g}"
    return WindowIntake(
        window=window,
        found=found,
        responses=responses,
        notes=(*window.notes, *notes),
        record=_record(query, window, found, responses, geometry, content_digest),
        digest=hashlib.sha256(identity.encode()).hexdigest(),
    )


def _responses(
    query: WindowQuery,
    window: Window,
    found: Reconstruction,
    geometry: Geometry,
    aircraft: RegisteredAircraft,
    cache: Path,
) -> tuple[Assimilation, tuple[Note, ...]]:
    """Contacts corrected by the responses to them, if the aircraft can be simulated."""
    if not found.contacts:
        return Assimilation(()), ()
    try:
        simulated = landing_aircraft(aircraft, recorded_mass(window), cache)
    except SolverError as error:
        # A mass that no loading has is refused with the record, a broken mesh shows in its job.
        note = Note("response_not_compared", f"recorded responses are not compared: {error}")
        return uncorrected(found, str(error)), (note,)
    scatter = ServiceScatter.stated(aircraft.definition.scatter)
    if query.runway_friction is not None:
        simulated = simulated.on_runway(query.runway_friction)
        scatter = scatter.on_runway(query.runway_friction, query.runway_friction_sd)
    return assimilate(window, found, simulated, geometry, scatter=scatter), ()


def recorded_mass(window: Window) -> float | None:
    """Gross mass that a window states [kg]."""
    mass = window.first(Parameter.GROSS_MASS)
    return None if mass is None else float(np.median(mass.value))


def definition_geometry(definition: AircraftDefinition, window: Window) -> Geometry:
    """Geometry in a loading of which only the gross mass may be recorded."""
    reference = definition.reference
    forward, aft = reference.forward_centre_of_gravity, reference.aft_centre_of_gravity
    gears = tuple(gear.gear(np.zeros((len(gear.pins), 3))) for gear in definition.gears)
    pivots = [float(gear.pivot[2]) for gear in gears]
    centre = np.array([(forward + aft) / 2, 0.0, max(pivots) + _ABOVE_PIVOTS])
    mass = recorded_mass(window)
    return geometry_on_gears(
        gears,
        centre,
        definition.masses.maximum_landing if mass is None else mass,
        # Anywhere in the allowed range: uniform, variance (aft - forward)^2 / 12.
        centre_of_gravity_sd=(aft - forward) / np.sqrt(12.0),
    )


def _record(
    query: WindowQuery,
    window: Window,
    found: Reconstruction,
    responses: Assimilation,
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
    if query.runway_friction is not None:
        friction = _number(query.runway_friction, query.runway_friction_sd, "1")
        record["leg"] = {"runway_friction": friction}
    mass = recorded_mass(window)
    if mass is not None:
        record["mass"] = {"gross_weight": {"value": mass, "unit": "kg", "sd": 0.01 * mass}}
    places = {wheel.gear: wheel.place for wheel in geometry.wheels}
    landed = [update.found for update in responses.updates]
    # A window that cannot tell is a landing all the same: one contact of which nothing is known.
    record["contacts"] = [
        _contact(update, _peaks_until(update.found, landed, found.contacts), window, places)
        for update in responses.updates[:_MOST_CONTACTS]
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
    update: ContactUpdate,
    peaks_until: float,
    window: Window,
    places: dict[str, Place],
) -> dict[str, Any]:
    found, contact = update.found, update.contact
    sds = np.sqrt(np.diag(update.uncertainty.matrix))
    sd = dict(zip(CONTACT_COMPONENTS, sds.tolist(), strict=True))
    silent = () if update.is_corrected else found.state.assumed
    given: dict[str, Any] = {
        "time": _number(contact.time, found.time_sd, "s"),
        "t_sd_s": found.time_sd,
        "first_gear": _FIRST_GEAR[places[found.gear]],
        "nose_wheel_down": contact.nose_wheel_down,
    }
    for name, unit in STATE_UNITS.items():
        is_known = name not in silent and np.isfinite(sd[name])
        if is_known and name != "lift_fraction":
            given[name] = _number(getattr(contact, name), sd[name], unit)
    given["sink_rate"]["method"] = "smoother + response" if update.is_corrected else "smoother"
    given["lift"] = {
        "model": contact.lift.model.value,
        "fraction": _number(contact.lift.fraction, sd["lift_fraction"], "1"),
    }
    lift = contact.lift
    start_sd, time_deviation, residual_sd = update.uncertainty.lift_course
    for name, value, deviation, unit in (
        ("decay_start", lift.decay_start, start_sd, "s"),
        ("decay_time", lift.decay_time, time_deviation and lift.decay_time * time_deviation, "s"),
        ("residual_fraction", lift.residual_fraction, residual_sd, "1"),
    ):
        if deviation is not None:
            given["lift"][name] = _number(value, deviation, unit)
    for name, parameter, size in (
        ("nz_peak", Parameter.NORMAL_ACCELERATION, np.positive),
        ("ny_peak", Parameter.LATERAL_ACCELERATION, np.abs),
    ):
        channel = window.first(parameter)
        if channel is None:
            continue
        inside = (channel.time > found.time) & (channel.time < peaks_until)
        if np.any(inside):
            values = channel.value[inside]
            peak = float(values[np.argmax(size(values))])
            given[name] = {"value": peak, "unit": "g", "rate_hz": channel.rate}
    return given


def _number(value: float, sd: float, unit: str) -> dict[str, Any]:
    return {"value": float(value), "unit": unit, "sd": float(sd)}
