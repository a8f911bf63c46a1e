"""What is said about a recorder window besides its content."""

from typing import Annotated, Literal

from pydantic import Field

from app.landings.schemas import Strict, Token
from solver.flight_data.frame_file import frame_names


class WindowQuery(Strict):
    """The aircraft, and what is known of its recorder."""

    aircraft: Token = Field(description="Name of the aircraft definition.")
    tail: Token | None = None
    frame: Token | None = Field(
        default=None,
        description="Recorder frame; without it every error is taken wide. "
        f"There are {', '.join(frame_names())}.",
    )
    record_id: Token | None = Field(
        default=None,
        description="The sender's own identifier; without it the file's content is its identity.",
    )
    lane: Annotated[
        Literal["interactive", "bulk"],
        Field(description="Somebody waits for it, or it is part of a back-fill."),
    ] = "interactive"
