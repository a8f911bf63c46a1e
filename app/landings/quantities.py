"""Numbers with units, as a touchdown record carries them: range, units and default uncertainty.

Ranges are what a fixed-wing landing can physically show, not what an aircraft may stand: a record
outside them is a mistake in the record.  Default standard deviations are what a recorder of the
common frames gives (resolution, rate and accuracy of 14 CFR 125 appendix D); they are flagged in
the answer wherever they were used.
"""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    Strict,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from solver.units import (
    AngleUnit,
    AngularRateUnit,
    Dimension,
    FractionUnit,
    LoadFactorUnit,
    MassUnit,
    SpeedUnit,
    StationUnit,
    TimeUnit,
    allowed_units,
    from_si,
    to_si,
)

Number = Annotated[float, Strict(), Field(allow_inf_nan=False)]
StandardDeviation = Annotated[float, Strict(), Field(ge=0, allow_inf_nan=False)]

_DEGREE = math.pi / 180.0

_SOLVER_UNITS = {
    Dimension.SPEED: "m/s",
    Dimension.ANGLE: "rad",
    Dimension.ANGULAR_RATE: "rad/s",
    Dimension.MASS: "kg",
    Dimension.LOAD_FACTOR: "g",
    Dimension.STATION: "m",
    Dimension.TIME: "s",
    Dimension.FRACTION: "of one",
}


class Measured(BaseModel):
    """A number with its unit and, if known, its standard deviation in the same unit."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    dimension: ClassVar[Dimension]
    minimum: ClassVar[float]  #: SI
    maximum: ClassVar[float]  #: SI
    default_sd: ClassVar[float]  #: SI
    default_sd_words: ClassVar[str] = ""  #: where it is no fixed number

    value: Number
    unit: str
    sd: StandardDeviation | None = None

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Say the range and the default deviation where the interface is described."""
        schema = handler(core_schema)
        described = handler.resolve_ref_schema(schema)
        unit = _SOLVER_UNITS[cls.dimension]
        default = f"{cls.default_sd:.4g} {unit}"
        described["description"] = (
            f"{(cls.__doc__ or '').strip()} Range {cls.minimum:.4g} to {cls.maximum:.4g} {unit}; "
            f"standard deviation if none is given: {cls.default_sd_words or default}."
        )
        return schema

    @model_validator(mode="before")
    @classmethod
    def _has_unit(cls, data: object) -> object:
        if isinstance(data, dict | Measured):
            return data
        units = allowed_units(cls.dimension)
        raise PydanticCustomError(
            "number_without_unit",
            "a number needs its unit: write {example}",
            {
                "example": f'{{"value": ..., "unit": "{units[0]}"}}',
                "allowed": f"an object with value and unit ({', '.join(units)})",
            },
        )

    @model_validator(mode="after")
    def _in_range(self) -> "Measured":
        if self.is_convertible and not self.minimum <= self.si <= self.maximum:
            low, high = (
                from_si(bound, self.unit, self.dimension) for bound in (self.minimum, self.maximum)
            )
            raise PydanticCustomError(
                "out_of_range",
                "must lie in the allowed range",
                {
                    "value": f"{self.value:g} {self.unit}",
                    "allowed": f"{low:.4g} to {high:.4g} {self.unit}",
                },
            )
        return self

    @property
    def is_convertible(self) -> bool:
        """Whether the unit stands on its own feet (a chord percentage does not)."""
        return True

    @property
    def si(self) -> float:
        return to_si(self.value, self.unit, self.dimension)

    @property
    def sd_si(self) -> float:
        """Standard deviation, the documented default where the record gives none."""
        return self.default_sd if self.sd is None else to_si(self.sd, self.unit, self.dimension)


class Speed(Measured):
    dimension = Dimension.SPEED
    unit: SpeedUnit


class SinkRate(Speed):
    """Of the centre of gravity, downward positive."""

    minimum, maximum = 0.0, 10.0
    default_sd = 0.3
    method: Annotated[str, Field(max_length=60, pattern=r"^[\w ./+-]*$")] | None = None
    at: Literal["CG"] = "CG"


class GroundSpeed(Speed):
    """Along the direction of flight over ground."""

    minimum, maximum = 5.0, 150.0
    default_sd = 2.0 * 1852.0 / 3600.0


class Angle(Measured):
    dimension = Dimension.ANGLE
    unit: AngleUnit


class Pitch(Angle):
    """Nose up positive."""

    minimum, maximum = -30.0 * _DEGREE, 30.0 * _DEGREE
    default_sd = 0.5 * _DEGREE


class Roll(Angle):
    """Starboard wing down positive."""

    minimum, maximum = -45.0 * _DEGREE, 45.0 * _DEGREE
    default_sd = 0.5 * _DEGREE


class Drift(Angle):
    """Heading minus track: nose right of the flight path positive."""

    minimum, maximum = -45.0 * _DEGREE, 45.0 * _DEGREE
    default_sd = 1.0 * _DEGREE


class AngularRate(Measured):
    """Body rate; pitch nose up, roll starboard wing down, yaw nose right positive."""

    dimension = Dimension.ANGULAR_RATE
    minimum, maximum = -60.0 * _DEGREE, 60.0 * _DEGREE
    default_sd = 0.8 * _DEGREE
    unit: AngularRateUnit


class Mass(Measured):
    dimension = Dimension.MASS
    minimum, maximum = 0.0, 1e6
    unit: MassUnit


class GrossWeight(Mass):
    """Gross mass at the landing."""

    default_sd = math.nan
    default_sd_words = "1 % of the value"

    @property
    def sd_si(self) -> float:
        return 0.01 * self.si if self.sd is None else super().sd_si


class FuelOrPayload(Mass):
    """Mass in one tank or bay."""

    default_sd = math.nan
    default_sd_words = "2 % of the value"

    @property
    def sd_si(self) -> float:
        return 0.02 * self.si if self.sd is None else super().sd_si


class CentreOfGravity(Measured):
    """Station along structural x, or percentage of the mean aerodynamic chord."""

    dimension = Dimension.STATION
    minimum, maximum = -200.0, 200.0
    default_sd = math.nan
    default_sd_words = "2 % of the mean aerodynamic chord"
    unit: StationUnit

    @property
    def is_convertible(self) -> bool:
        return self.unit != "%MAC"


class LoadFactor(Measured):
    """Acceleration along a body axis as recorded; normal is +1 at rest."""

    dimension = Dimension.LOAD_FACTOR
    minimum, maximum = -6.0, 12.0
    default_sd = 0.03
    unit: LoadFactorUnit


class RecordedPeak(LoadFactor):
    """A peak means little without the rate it was sampled at."""

    rate_hz: Annotated[float, Strict(), Field(gt=0, le=20_000, allow_inf_nan=False)]


class Duration(Measured):
    """Time."""

    dimension = Dimension.TIME
    minimum, maximum = 0.0, 600.0
    default_sd = 0.15
    unit: TimeUnit


class RunwayFriction(Measured):
    """Largest coefficient of friction between tyre and runway; its unit may be left out."""

    dimension = Dimension.FRACTION
    minimum, maximum = 0.05, 1.2
    default_sd = 0.05
    unit: FractionUnit = "1"


class LiftFraction(Measured):
    """Lift over weight; a pure number, so its unit may be left out."""

    dimension = Dimension.FRACTION
    minimum, maximum = 0.0, 1.5
    default_sd = 0.1
    unit: FractionUnit = "1"
