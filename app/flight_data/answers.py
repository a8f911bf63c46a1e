"""What was understood of a recorder window."""

from pydantic import BaseModel, Field

from app.landings.answers import LandingAccepted


class ContactFound(BaseModel):
    """One ground contact of the window."""

    kind: str
    gear: str
    time_s: float = Field(description="On the window's clock.")
    time_sd_s: float
    chance: float = Field(description="That there was such a contact.", ge=0, le=1)
    sink_rate_m_s: float = Field(description="Of the centre of gravity, downward.")
    sink_rate_sd_m_s: float
    gear_sink_rates_m_s: dict[str, float]


class CannotTell(BaseModel):
    """Why the window cannot carry a verdict."""

    code: str
    reason: str
    settled_by: str = Field(description="Which data would settle it.")


class WindowNote(BaseModel):
    """What was found or put right while reading."""

    code: str
    text: str


class WindowAccepted(LandingAccepted):
    """The window became a landing, which will be assessed."""

    contacts: list[ContactFound]
    cannot_tell: list[CannotTell] = Field(description="Not empty: the verdict is UNDETERMINED.")
    notes: list[WindowNote]
