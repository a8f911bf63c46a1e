"""Published landings as facts with their certainty, read from the file beside this one."""

from importlib.resources import files
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from solver.aircraft.toml_document import read_document
from solver.assessment import Verdict

Certainty = Literal["read", "memory", "assumed"]
Basis = Literal["sink_rate", "normal_load_factor", "energy", "share"]


class _Form(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class TypeLimit(_Form):
    """Normal load factor from which the maker of the type asks for an inspection."""

    value: Annotated[float, Field(gt=1.0, lt=4.0)]  #: [g]
    certainty: Certainty
    note: str


class PublishedContact(_Form):
    """One contact: the figure that was published, and the attitude."""

    basis: Basis
    value: Annotated[float, Field(gt=0.0)]  #: [ft/min], [g], or a ratio
    certainty: Certainty
    pitch_deg: Annotated[float, Field(ge=-10.0, le=15.0)]
    roll_deg: Annotated[float, Field(ge=-15.0, le=15.0)] = 0.0
    drift_deg: Annotated[float, Field(ge=-15.0, le=15.0)] = 0.0
    pitch_rate_deg_s: Annotated[float, Field(ge=-20.0, le=20.0)] = 0.0


class PublishedCase(_Form):
    """One landing and what became of it."""

    name: str
    title: str
    expected: Verdict
    damage: Literal["main", "nose", "none"]
    sequence: str
    found: str
    assumptions: str  #: what nobody published, and what was taken
    source: str
    contact: Annotated[tuple[PublishedContact, ...], Field(min_length=1)]
    type_limit: TypeLimit | None = None
    mass_share: Annotated[float, Field(gt=0.5, lt=1.2)] = 1.0  #: of the maximum landing mass
    scaled: bool = True  #: False: taken as it is
    ground_speed_m_s: Annotated[float, Field(gt=20.0, lt=90.0)] = 60.0


class _File(_Form):
    case: tuple[PublishedCase, ...]


def published_cases() -> tuple[PublishedCase, ...]:
    """All cases, the accidents first.

    Raises
    ------
    ModelError
        The file cannot be used; says which key.
    """
    return read_document(files(__package__) / "accident_cases.toml", _File).case
