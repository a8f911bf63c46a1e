"""The touchdown record as it is posted, and the landing as it is answered."""

import re
from datetime import UTC, datetime, timedelta
from enum import StrEnum
from typing import Annotated, Literal

from pydantic import (
    AfterValidator,
    AwareDatetime,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    model_validator,
)
from pydantic_core import PydanticCustomError

from app.landings.quantities import (
    AngularRate,
    CentreOfGravity,
    Drift,
    Duration,
    FuelOrPayload,
    GrossWeight,
    GroundSpeed,
    LiftFraction,
    LoadFactor,
    Number,
    Pitch,
    RecordedPeak,
    Roll,
    RunwayFriction,
    SinkRate,
)

#: Letters, digits and a little punctuation: safe in logs, paths and every database.
TOKEN = r"^[A-Za-z0-9][A-Za-z0-9._:/-]*$"  # noqa: S105 - a pattern, not a secret
Token = Annotated[str, Field(min_length=1, max_length=100, pattern=TOKEN)]
GroupName = Annotated[str, Field(max_length=64, pattern=r"^[\w .-]+$")]

_CREW = re.compile(r"^(crew|pilot|co_?pilot|captain|commander|first_?officer|cockpit)", re.I)


class Strict(BaseModel):
    """Part of a record: unknown fields are refused, and whatever is about the crew by name."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _no_crew(cls, data: object) -> object:
        if isinstance(data, dict):
            for key in data:
                if isinstance(key, str) and _CREW.match(key):
                    raise PydanticCustomError(
                        "crew_data",
                        "data about the crew is never accepted; leave the field out",
                        {"field": key, "value": "(not repeated)", "allowed": "no crew data"},
                    )
        return data


def _is_text(value: object) -> object:
    if not isinstance(value, str | datetime):
        raise PydanticCustomError(
            "not_a_time",
            "a time is a text as in 2026-03-01T04:22:51.40Z",
            {"allowed": "ISO 8601 with a zone"},
        )
    return value


def _plausible(value: datetime) -> datetime:
    latest = datetime.now(UTC) + timedelta(days=1)
    if not datetime(1970, 1, 1, tzinfo=UTC) <= value <= latest:
        raise PydanticCustomError(
            "out_of_range",
            "must lie in the allowed range",
            {"allowed": f"1970-01-01 to {latest:%Y-%m-%d}"},
        )
    return value.astimezone(UTC)


UtcTime = Annotated[AwareDatetime, BeforeValidator(_is_text), AfterValidator(_plausible)]


class FirstGear(StrEnum):
    """Which gear touched first, as far as the recorder's switches say."""

    NOSE = "N"
    MAIN_LEFT = "ML"
    MAIN_RIGHT = "MR"
    BOTH_MAINS = "M"


class LiftIn(Strict):
    """Lift from the contact on; an explicit input, because the answer depends on it."""

    model: Literal["held", "decaying", "trimmed"] = "decaying"
    fraction: LiftFraction | None = None
    decay_start: Duration | None = None
    decay_time: Duration | None = None
    residual_fraction: LiftFraction | None = None
    normal_acceleration: LoadFactor | None = Field(
        default=None, description="Just before the contact, +1 at rest; required by `trimmed`."
    )

    @model_validator(mode="after")
    def _trimmed_to_something(self) -> "LiftIn":
        if self.model == "trimmed" and self.normal_acceleration is None:
            raise PydanticCustomError(
                "missing",
                "lift trimmed to the recorded acceleration needs normal_acceleration",
                {"field": "normal_acceleration", "value": None, "allowed": "a number in g"},
            )
        return self


class ContactIn(Strict):
    """One ground contact: the state of the aircraft as it touches."""

    seq: Annotated[int, Field(ge=1, le=12)] | None = None
    t_utc: UtcTime | None = None
    t_sd_s: Annotated[Number, Field(ge=0, le=60)] | None = None
    time: Duration | None = Field(default=None, description="Since the first contact.")
    first_gear: FirstGear | None = None
    nose_wheel_down: bool = Field(
        default=False,
        description="The nose wheel stayed on the ground since the contact before: the main wheels "
        "touch, and what the nose wheel carries is part of the lift fraction.",
    )
    sink_rate: SinkRate | None = None
    ground_speed: GroundSpeed | None = None
    pitch: Pitch | None = None
    roll: Roll | None = None
    drift: Drift | None = None
    pitch_rate: AngularRate | None = None
    roll_rate: AngularRate | None = None
    yaw_rate: AngularRate | None = None
    nz_peak: RecordedPeak | None = None
    ny_peak: RecordedPeak | None = None
    nx_peak: RecordedPeak | None = None
    lift: LiftIn | None = None
    lift_fraction: LiftFraction | None = Field(
        default=None, description="Short form of lift.fraction."
    )
    spoilers: Literal["armed", "extended", "stowed"] | None = Field(
        default=None, description="Kept on record; lift itself is given by `lift`."
    )

    @model_validator(mode="after")
    def _one_gear_first(self) -> "ContactIn":
        if self.nose_wheel_down and self.first_gear is FirstGear.NOSE:
            raise PydanticCustomError(
                "contradiction",
                "a nose wheel that is down does not touch",
                {"field": "first_gear", "value": self.first_gear, "allowed": "a main gear"},
            )
        return self

    @model_validator(mode="after")
    def _one_lift(self) -> "ContactIn":
        if self.lift is not None and self.lift_fraction is not None:
            raise PydanticCustomError(
                "given_twice",
                "give either lift or lift_fraction",
                {"field": "lift_fraction", "value": self.lift_fraction.value, "allowed": "absent"},
            )
        return self


class AircraftIn(Strict):
    model_id: Token = Field(description="Name of the aircraft definition.")
    tail_token: Token | None = None
    config: Token | None = None


class MassIn(Strict):
    gross_weight: GrossWeight | None = None
    cg: CentreOfGravity | None = None
    mlw: GrossWeight | None = Field(
        default=None, description="Kept on record; the definition's own limit is used."
    )


class LegIn(Strict):
    landing_airport: Token | None = None
    runway: Token | None = None
    surface: Literal["dry", "wet", "contaminated"] | None = Field(
        default=None, description="Kept on record; `runway_friction` is what counts."
    )
    runway_friction: RunwayFriction | None = Field(
        default=None,
        description="As measured at the time of the landing, on the scale of the aircraft's tyres. "
        "Without it that of the aircraft's definition, with its scatter.",
    )
    leg_token: Token | None = None


class SourceIn(Strict):
    recorder: Token | None = None
    frame: Token | None = None
    extractor: Token | None = None
    raw_sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = None
    nz_filter_hz: Annotated[Number, Field(gt=0, le=20_000)] | None = None


class TouchdownRecordIn(Strict):
    """Touchdown record, version 1: every number with its unit, several contacts allowed.

    Signs: sink rate downward, pitch nose up, roll starboard wing down, drift nose right of the
    track; normal acceleration +1 at rest.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "schema": "touchdown-record/1",
                    "record_id": "2026-03-01-T0142-1",
                    "aircraft": {"model_id": "ebj-19", "tail_token": "T-0142"},
                    "mass": {
                        "gross_weight": {"value": 25500, "unit": "lb", "sd": 250},
                        "cg": {"value": 24.0, "unit": "%MAC", "sd": 2},
                    },
                    "contacts": [
                        {
                            "t_utc": "2026-03-01T04:22:51.40Z",
                            "sink_rate": {"value": 6.2, "unit": "ft/s", "sd": 1.0},
                            "ground_speed": {"value": 120, "unit": "kt"},
                            "pitch": {"value": 4.0, "unit": "deg"},
                            "roll": {"value": 1.5, "unit": "deg"},
                            "nz_peak": {"value": 1.72, "unit": "g", "rate_hz": 8},
                        }
                    ],
                }
            ]
        }
    )

    schema_: Literal["touchdown-record/1"] = Field(default="touchdown-record/1", alias="schema")
    record_id: Token | None = Field(
        default=None,
        description="The sender's own identifier; makes the posting idempotent. Without it the "
        "record's content is its identity.",
    )
    operator_token: Token | None = Field(
        default=None, description="If given, must name the operator that the key belongs to."
    )
    aircraft: AircraftIn
    leg: LegIn | None = None
    source: SourceIn | None = None
    mass: MassIn = MassIn()
    fuel: Annotated[dict[GroupName, FuelOrPayload], Field(max_length=50)] = {}
    payload: Annotated[dict[GroupName, FuelOrPayload], Field(max_length=50)] = {}
    contacts: Annotated[list[ContactIn], Field(min_length=1, max_length=12)]

    @model_validator(mode="after")
    def _comes_out_of_the_air(self) -> "TouchdownRecordIn":
        if self.contacts[0].nose_wheel_down:
            raise PydanticCustomError(
                "contradiction",
                "at the first contact no wheel is down already",
                {"field": "contacts[0].nose_wheel_down", "value": True, "allowed": "false"},
            )
        return self

    @model_validator(mode="after")
    def _contacts_in_order(self) -> "TouchdownRecordIn":
        for index, contact in enumerate(self.contacts):
            if contact.seq is not None and contact.seq != index + 1:
                raise PydanticCustomError(
                    "out_of_order",
                    "contacts are listed in the order in which they happened",
                    {
                        "field": f"contacts[{index}].seq",
                        "value": contact.seq,
                        "allowed": str(index + 1),
                    },
                )
        times = [contact.t_utc for contact in self.contacts if contact.t_utc is not None]
        if times != sorted(times):
            raise PydanticCustomError(
                "out_of_order",
                "contacts are listed in the order in which they happened",
                {"field": "contacts", "value": "t_utc falls", "allowed": "rising t_utc"},
            )
        return self
