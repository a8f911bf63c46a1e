"""What is said about a recorder window besides its content."""

from typing import Annotated, Literal

from pydantic import Field

from app.landings.quantities import RunwayFriction
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
    runway_friction: Annotated[float, Field(ge=0.05, le=1.2)] | None = Field(
        default=None,
        description="Largest coefficient of friction on the runway, as measured at the time; "
        "without it that of the aircraft's definition, with its scatter.",
    )
    runway_friction_sd: Annotated[float, Field(ge=0, le=0.5)] = Field(
        default=RunwayFriction.default_sd, description="Its standard deviation."
    )
    record_id: Token | None = Field(
        default=None,
        description="The sender's own identifier; without it the file's content is its identity.",
    )
    lane: Annotated[
        Literal["interactive", "bulk"],
        Field(description="Somebody waits for it, or it is part of a back-fill."),
    ] = "interactive"
