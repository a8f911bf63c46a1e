"""A maker's rule as an engineer writes it: every key of a rule file and its range.

Numbers stand in the unit of the publication, which the file names, so that they can be held
against it digit by digit.  Unknown keys are refused.
"""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from solver.aircraft.definition_file import Section, Text

Number = Annotated[float, Field(ge=0, le=1e7)]
Point = Annotated[list[Number], Field(min_length=2, max_length=2)]
Points = Annotated[list[Point], Field(min_length=2, max_length=50)]
Rate = Annotated[float, Field(ge=1, le=20_000)]
Label = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]{0,63}$")]
Unit = Annotated[str, Field(min_length=1, max_length=10)]


class SourceSection(Section):
    """[sources.X]: a publication, and how well what it says is known."""

    text: Text
    certainty: Literal["read", "computed", "memory", "assumed"]


class MarginSection(Section):
    """overweight_margin: above the maximum landing mass, still taken as on it."""

    value: Number
    unit: Unit


class ArgumentSection(Section):
    """Over: what the points run over; of roll the magnitude counts."""

    quantity: Literal["roll", "mass"]
    unit: Unit


class CurveSection(Section):
    """A number, or points [argument, value] with straight lines between them."""

    value: Number | None = None
    over: ArgumentSection | None = None
    points: Points | None = None
    outside: Literal["hold", "inspect", "cannot tell"] = "hold"  #: where the points end

    @model_validator(mode="after")
    def _one_form(self) -> "CurveSection":
        if (self.value is None) == (self.points is None):
            raise ValueError("needs either value or points")
        if (self.over is None) != (self.points is None):
            raise ValueError("points and over come together")
        if self.points is None and self.outside != "hold":
            raise ValueError("outside belongs to points")
        return self


class LimitSection(CurveSection):
    """[[criterion.limit]]."""

    rate_hz: Rate | None = None  #: least sample rate for which it holds; load factors only
    weight: Literal["up to landing mass", "above landing mass"] | None = None  #: both without it
    greatest: Number | None = None  #: the limit is published only as between the curve and this
    source: Label


class OnsetSection(CurveSection):
    """[criterion.onset]: the criterion counts only from this normal load factor [g]."""

    rate_hz: Rate


class CriterionSection(Section):
    """[[criterion]]: one quantity against its limits."""

    name: Text
    quantity: Literal["normal load factor", "lateral load factor", "sink rate", "roll rate"]
    unit: Unit
    action: Literal["INSPECT", "HARD"]
    main_gear_first: bool = False  #: does not hold where the nose gear touched first
    limit: Annotated[list[LimitSection], Field(min_length=1, max_length=20)]
    onset: OnsetSection | None = None


class RuleFile(Section):
    """The whole file."""

    title: Text
    note: Text
    overweight_margin: MarginSection | None = None
    sources: Annotated[dict[Label, SourceSection], Field(min_length=1)]
    criterion: Annotated[list[CriterionSection], Field(min_length=1, max_length=20)]
