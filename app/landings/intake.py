"""From a posted record to what the solver takes: SI, signs, defaults and what is missing."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import from_json

from app.landings.field_errors import FieldError, InvalidRecordError, field_errors
from app.landings.quantities import (
    AngularRate,
    CentreOfGravity,
    Drift,
    FuelOrPayload,
    GroundSpeed,
    LiftFraction,
    Measured,
    Pitch,
    Roll,
    SinkRate,
)
from app.landings.recorded import recorded_contact
from app.landings.schemas import ContactIn, LiftIn, TouchdownRecordIn
from solver.aircraft.definition import AircraftDefinition, MassGroup
from solver.aircraft.definition_reader import load_definition
from solver.assessment import TouchdownRecord
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.contact_uncertainty import ContactUncertainty
from solver.recorded import RecordedContact

#: Below this rate a landing peak can be missed altogether, so a recorded peak proves nothing.
LOWEST_RECORDER_RATE = 4.0  #: [Hz]

#: Without these the state at a contact is unknown, and no assumption is a safe one.
NEEDED_FOR_A_VERDICT = ("sink_rate", "ground_speed", "pitch", "roll")

#: Taken as zero when the record is silent, and flagged.
TAKEN_AS_ZERO = ("drift", "pitch_rate", "roll_rate", "yaw_rate")

#: Share by which a gross mass may leave the range from operating empty to maximum take-off.
MASS_TOLERANCE = 0.05

PERCENT_CHORD_RANGE = (-20.0, 80.0)


@dataclass(slots=True)
class Intake:
    """A record ready for the solver, and what was assumed on the way."""

    record: TouchdownRecord
    sd: dict[str, float] = field(default_factory=dict)  #: field to standard deviation, SI
    sd_defaulted: list[str] = field(default_factory=list)
    taken_as_zero: list[str] = field(default_factory=list)


def parse_record(document: bytes | str | Mapping[str, Any]) -> TouchdownRecordIn:
    """Check a record's form; raises `InvalidRecordError` naming field, value and range."""
    try:
        if isinstance(document, bytes | str):
            document = _json(document)
        # As the web framework does, so that both ways in refuse in the same words.
        return TouchdownRecordIn.model_validate(document, from_attributes=True)
    except ValidationError as error:
        raise InvalidRecordError(field_errors(error.errors(), TouchdownRecordIn)) from error
    except ValueError as error:
        raise InvalidRecordError(
            [FieldError("body", None, "a JSON object", f"not valid JSON: {error}")]
        ) from error


def _json(text: bytes | str) -> Any:
    try:
        return from_json(text)
    except ValueError as error:
        # The slower reader lets half characters pass, so that the field they are in is named.
        try:
            return json.loads(text)
        except RecursionError:
            raise error from None


def read_record_file(path: Path, aircraft_folder: Path) -> Intake:
    """Take in a record from a file, for an aircraft whose folder lies in ``aircraft_folder``."""
    record = parse_record(path.read_bytes())
    folder = aircraft_folder / record.aircraft.model_id
    if not (folder / "definition.toml").is_file():
        known = sorted(p.parent.name for p in aircraft_folder.glob("*/definition.toml"))
        raise InvalidRecordError([unknown_aircraft(record, known)])
    return take_in(record, load_definition(folder))


def unknown_aircraft(record: TouchdownRecordIn, known: list[str]) -> FieldError:
    return FieldError(
        "aircraft.model_id",
        record.aircraft.model_id,
        ", ".join(known) or "none yet",
        "no such aircraft definition",
    )


def take_in(record: TouchdownRecordIn, definition: AircraftDefinition) -> Intake:
    """Convert a record for its aircraft; raises `InvalidRecordError` for what it cannot carry."""
    return _Conversion(record, definition).result()


class _Conversion:
    """One pass over a record that collects every fault before it refuses."""

    def __init__(self, record: TouchdownRecordIn, definition: AircraftDefinition) -> None:
        self.record = record
        self.definition = definition
        self.errors: list[FieldError] = []
        self.missing: list[str] = []
        self.recorded: list[RecordedContact] = []
        self.uncertainties: list[ContactUncertainty] = []
        self.sd: dict[str, float] = {}
        self.sd_defaulted: list[str] = []
        self.taken_as_zero: list[str] = []

    def result(self) -> Intake:
        record = TouchdownRecord(
            aircraft=self.definition.name,
            contacts=tuple(self._contacts()),
            mass=self._mass(),
            centre_of_gravity=self._centre_of_gravity(),
            fuel=self._group_masses("fuel", self.record.fuel, self.definition.tanks),
            payload=self._group_masses("payload", self.record.payload, self.definition.bays),
            missing=tuple(self.missing),
            mass_deviation=self.sd.get("mass.gross_weight"),
            centre_of_gravity_deviation=self.sd.get("mass.cg"),
            recorded=tuple(self.recorded),
            runway_friction=self._runway_friction(),
            runway_friction_deviation=self.sd.get("leg.runway_friction", 0.0),
            uncertainties=tuple(self.uncertainties),
        )
        if self.errors:
            raise InvalidRecordError(self.errors)
        return Intake(record, self.sd, self.sd_defaulted, self.taken_as_zero)

    def _number(self, name: str, measured: Measured | None) -> float | None:
        if measured is None:
            return None
        self._note_sd(name, measured.sd_si, measured)
        return measured.si

    def _note_sd(self, name: str, sd: float, measured: Measured) -> None:
        self.sd[name] = sd
        if measured.sd is None:
            self.sd_defaulted.append(name)

    def _runway_friction(self) -> float | None:
        leg = self.record.leg
        return None if leg is None else self._number("leg.runway_friction", leg.runway_friction)

    def _mass(self) -> float | None:
        weight = self.record.mass.gross_weight
        mass = self._number("mass.gross_weight", weight)
        if weight is None or mass is None:
            return None
        low = self.definition.masses.operating_empty * (1 - MASS_TOLERANCE)
        high = self.definition.masses.maximum_takeoff * (1 + MASS_TOLERANCE)
        if not low <= mass <= high:
            self.errors.append(_out_of_range("mass.gross_weight", weight, low, high, "kg"))
        return mass

    def _centre_of_gravity(self) -> float | None:
        given: CentreOfGravity | None = self.record.mass.cg
        if given is None:
            return None
        reference = self.definition.reference
        chord, leading_edge = reference.mean_chord, reference.mean_chord_leading_edge
        percent = chord / 100.0
        if given.is_convertible:
            station = given.si
            sd = 2.0 * percent if given.sd is None else given.sd_si
        else:
            station = leading_edge + given.value * percent
            sd = (2.0 if given.sd is None else given.sd) * percent
        self._note_sd("mass.cg", sd, given)
        low, high = (leading_edge + bound * percent for bound in PERCENT_CHORD_RANGE)
        if not low <= station <= high:
            least, most = PERCENT_CHORD_RANGE
            allowed = f"{least:g} to {most:g} %MAC ({low:.3f} to {high:.3f} m)"
            value = f"{given.value:g} {given.unit}"
            self.errors.append(
                FieldError("mass.cg", value, allowed, "must lie in the allowed range")
            )
        return station

    def _group_masses(
        self, name: str, given: Mapping[str, FuelOrPayload], groups: tuple[MassGroup, ...]
    ) -> dict[str, float]:
        capacities = {group.name: group.capacity for group in groups}
        masses: dict[str, float] = {}
        for group, measured in given.items():
            path = f"{name}.{group}"
            if group not in capacities:
                self.errors.append(
                    FieldError(path, group, ", ".join(capacities) or "none", "no such tank or bay")
                )
                continue
            mass = self._number(path, measured)
            assert mass is not None  # noqa: S101 - for the type checker; `measured` is never None
            if mass > capacities[group]:
                self.errors.append(_out_of_range(path, measured, 0.0, capacities[group], "kg"))
            masses[group] = mass
        return masses

    def _contacts(self) -> list[Contact]:
        first = self.record.contacts[0].t_utc
        contacts: list[Contact] = []
        for index, given in enumerate(self.record.contacts):
            path = f"contacts[{index}]"
            absent = [name for name in NEEDED_FOR_A_VERDICT if getattr(given, name) is None]
            self.missing += [f"{path}.{name}" for name in absent]
            self._check_recorder(path, given)
            time = self._number(f"{path}.time", given.time)
            if time is None and first is not None and given.t_utc is not None:
                time = (given.t_utc - first).total_seconds()
            contact = self._contact(path, given, time or 0.0)
            simulated = None if absent else len(contacts)
            self.recorded.append(recorded_contact(given, simulated))
            if not absent:  # a zero in place of an unknown speed would be simulated as a greaser
                contacts.append(contact)
                self.uncertainties.append(contact_uncertainty(given))
        return contacts

    def _check_recorder(self, path: str, given: ContactIn) -> None:
        for name in ("nz_peak", "ny_peak", "nx_peak"):
            peak = getattr(given, name)
            self._number(f"{path}.{name}", peak)
            if name == "nz_peak" and peak is not None and peak.rate_hz < LOWEST_RECORDER_RATE:
                self.missing.append(
                    f"{path}.nz_peak recorded at {LOWEST_RECORDER_RATE:g} Hz or more "
                    f"(it was {peak.rate_hz:g} Hz)"
                )

    def _contact(self, path: str, given: ContactIn, time: float) -> Contact:
        def number(name: str) -> float:
            value = self._number(f"{path}.{name}", getattr(given, name))
            if value is None and name in TAKEN_AS_ZERO:
                self.taken_as_zero.append(f"{path}.{name}")
            return value or 0.0

        return Contact(
            sink_rate=number("sink_rate"),
            ground_speed=number("ground_speed"),
            pitch=number("pitch"),
            roll=number("roll"),
            drift=number("drift"),
            pitch_rate=number("pitch_rate"),
            roll_rate=number("roll_rate"),
            yaw_rate=number("yaw_rate"),
            lift=self._lift(path, given, time),
            time=time,
            nose_wheel_down=given.nose_wheel_down,
        )

    def _lift(self, path: str, given: ContactIn, time: float) -> Lift:
        lift = given.lift or LiftIn(fraction=given.lift_fraction)
        standard = Lift().seen_from(time)

        def number(name: str, default: float) -> float:
            value = self._number(f"{path}.lift.{name}", getattr(lift, name))
            return default if value is None else value

        return Lift(
            model=LiftModel(lift.model),
            fraction=number("fraction", standard.fraction),
            decay_start=number("decay_start", standard.decay_start),
            decay_time=number("decay_time", standard.decay_time),
            residual_fraction=number("residual_fraction", standard.residual_fraction),
            recorded_normal_acceleration=self._number(
                f"{path}.lift.normal_acceleration", lift.normal_acceleration
            ),
        )


def contact_uncertainty(given: ContactIn) -> ContactUncertainty:
    """How well a contact's state is known: its deviations, or the defaults of `quantities`.

    What the record leaves to its default is as uncertain as if it had been recorded so.
    """

    def deviation(measured: Measured | None, kind: type[Measured]) -> float:
        return kind.default_sd if measured is None else measured.sd_si

    lift = given.lift or LiftIn(fraction=given.lift_fraction)
    trimmed = lift.normal_acceleration if lift.model == "trimmed" else None
    state = ContactUncertainty.independent(
        sink_rate=deviation(given.sink_rate, SinkRate),
        pitch=deviation(given.pitch, Pitch),
        roll=deviation(given.roll, Roll),
        drift=deviation(given.drift, Drift),
        ground_speed=deviation(given.ground_speed, GroundSpeed),
        pitch_rate=deviation(given.pitch_rate, AngularRate),
        roll_rate=deviation(given.roll_rate, AngularRate),
        yaw_rate=deviation(given.yaw_rate, AngularRate),
        # In g and of the weight alike.
        lift_fraction=deviation(trimmed or lift.fraction, LiftFraction),
    )
    return replace(state, lift_course=_lift_course(lift))


def _lift_course(lift: LiftIn) -> tuple[float | None, float | None, float | None]:
    """Deviations of the lift's course where the record states them."""

    def stated(measured: Measured | None) -> float | None:
        return None if measured is None or measured.sd is None else measured.sd_si

    time, relative = lift.decay_time, stated(lift.decay_time)
    if relative is not None and time is not None and time.si > 0.0:
        relative /= time.si
    return stated(lift.decay_start), relative, stated(lift.residual_fraction)


def _out_of_range(path: str, measured: Measured, low: float, high: float, unit: str) -> FieldError:
    return FieldError(
        path,
        f"{measured.value:g} {measured.unit}",
        f"{low:.6g} to {high:.6g} {unit}",
        "must lie in the allowed range",
    )
