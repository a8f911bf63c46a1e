"""Aircraft and their models as the service answers them."""

from datetime import datetime

from pydantic import BaseModel, Field


class MassGroupOut(BaseModel):
    """A tank or payload bay."""

    name: str
    capacity_kg: float
    default_fill: float = Field(description="Share assumed when a record says nothing.")


class AircraftOut(BaseModel):
    """An aircraft definition that records may name, and the operator's tails seen so far."""

    name: str
    title: str
    disclaimer: str
    model_hash: str
    operating_empty_kg: float
    maximum_landing_kg: float
    maximum_takeoff_kg: float
    tanks: list[MassGroupOut]
    bays: list[MassGroupOut]
    gears: list[str]
    tails: list[str]
    links: dict[str, str]


class AircraftList(BaseModel):
    items: list[AircraftOut]


class ZoneOut(BaseModel):
    """A piece of the airframe an inspector can be sent to."""

    name: str
    component: str
    side: str
    ata_chapter: str
    look_for: str
    access: str


class ModelOut(BaseModel):
    """An airframe model; one that is no longer installed still says what it was."""

    hash: str
    aircraft: str
    title: str
    first_seen_at: datetime
    is_installed: bool
    definition: str = Field(description="The definition file as it was, TOML.")
    zones: list[ZoneOut]
    links: dict[str, str]


class MeshOut(BaseModel):
    """Nodes and elements for pictures, in the order of every peak field."""

    model_hash: str
    node: list[int] = Field(description="Identifiers in the bulk data.")
    coordinates: list[tuple[float, float, float]] = Field(description="Structural axes [m].")
    quads: list[tuple[int, int, int, int]] = Field(description="Rows of `node`.")
    triangles: list[tuple[int, int, int]]
    beams: list[tuple[int, int]]
    element: list[int] = Field(description="Identifiers: quads, then triangles, then beams.")
    zone: list[int] = Field(description="Row of `zones` for each element, -1 for none.")
    zones: list[str]
