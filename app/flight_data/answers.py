"""What was understood of a recorder window."""

from pydantic import BaseModel, Field

from app.flight_data.contact_answers import ContactFound
from app.landings.answers import LandingAccepted


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
