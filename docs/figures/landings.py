"""Write the table of landings in docs/example-aircraft.md from runs made now, for `make docs`."""

import math
from dataclasses import dataclass
from pathlib import Path

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import TouchdownRecord
from solver.landing.contact import Contact, Lift, LiftModel
from solver.progress import Progress

FOOT = 0.3048
SPEED = 55.0
DOCUMENT = Path(__file__).parent.parent / "example-aircraft.md"
MARKS = ("<!-- landings: written by make docs -->", "<!-- end of landings -->")


@dataclass(frozen=True)
class Row:
    """One landing; masses as the definition names them, or a loading."""

    title: str
    sink: float  #: [m/s]
    pitch: float = 1.0  #: [degrees]
    roll: float = 0.0
    lift: LiftModel = LiftModel.DECAYING
    mass: str = "landing"
    fuel: float | None = None  #: of both tanks [kg]
    payload: float | None = None  #: share of every bay
    station: float | None = None  #: of the centre of gravity [m]


def _ladder() -> list[Row]:
    gentle = [Row(f"{sink:.2f} m/s", sink) for sink in (0.3, 0.5, 0.64)]
    steps = [Row(f"{k * FOOT:.2f} m/s ({k} ft/s)", k * FOOT) for k in (3, 4, 5, 6, 8, 10, 12)]
    return gentle + steps


TEN = 10 * FOOT
ROWS = [
    *_ladder(),
    Row("10 ft/s, lift held", TEN, lift=LiftModel.HELD),
    Row("10 ft/s, three wheels", TEN, pitch=0.0),
    Row("10 ft/s, 3 degrees nose up", TEN, pitch=3.0),
    Row("10 ft/s, 8 degrees nose up", TEN, pitch=8.0),
    Row("10 ft/s, no payload", TEN, mass="", fuel=4057.0, payload=0.0),
    Row("10 ft/s, light", TEN, mass="", fuel=600.0, payload=0.5),
    Row("10 ft/s, forward centre of gravity", TEN, station=9.75),
    Row("10 ft/s, aft centre of gravity", TEN, station=10.05),
    Row("take-off mass, 6 ft/s, two wheels", 6 * FOOT, mass="take-off"),
    Row("take-off mass, 6 ft/s, three wheels", 6 * FOOT, pitch=0.0, mass="take-off"),
    Row("0.5 m/s, pitch 3, roll 3 degrees", 0.5, pitch=3.0, roll=3.0),
    Row("1.22 m/s, nose first (-1 degree)", 4 * FOOT, pitch=-1.0),
    Row("5 ft/s, roll 6 degrees", 5 * FOOT, roll=6.0),
    Row("8 ft/s, roll 3 degrees", 8 * FOOT, roll=3.0),
    Row("10 ft/s, roll 3 degrees", TEN, roll=3.0),
]


def record(model: AssessmentModel, row: Row) -> TouchdownRecord:
    """Touchdown record of a row."""
    definition = model.airframe.definition
    masses = {
        "landing": definition.masses.maximum_landing,
        "take-off": definition.masses.maximum_takeoff,
    }
    tanks = {} if row.fuel is None else {t.name: row.fuel / 2 for t in definition.tanks}
    bays = (
        {} if row.payload is None else {b.name: row.payload * b.capacity for b in definition.bays}
    )
    contact = Contact(
        sink_rate=row.sink,
        ground_speed=SPEED,
        pitch=math.radians(row.pitch),
        roll=math.radians(row.roll),
        lift=Lift(row.lift),
    )
    return TouchdownRecord(
        model.name, (contact,), masses.get(row.mass), row.station, tanks, bays
    )  # fmt: skip


def table(model: AssessmentModel, progress: Progress) -> list[str]:
    """Assess every landing; the table as lines of Markdown."""
    lines = [
        "| landing | verdict | worst element | worst gear load | where |",
        "|---|---|---|---|---|",
    ]
    for number, row in enumerate(ROWS):
        progress("landings of the table", number / len(ROWS))
        found = assess_landing(model, record(model, row))
        spot = found.hot_spots[0]
        gear = max(load.utilisation for load in found.gear_loads)
        lines.append(
            f"| {row.title} | {found.verdict} | {found.worst_utilisation:.3f} | {gear:.2f} | "
            f"{spot.zone}, {1e3 * spot.time:.0f} ms |"
        )
    progress("landings of the table", 1.0)
    return lines


def write_table(model: AssessmentModel, progress: Progress) -> None:
    """Put the table between its marks."""
    text = DOCUMENT.read_text()
    before, rest = text.split(MARKS[0])
    _, after = rest.split(MARKS[1])
    lines = "\n".join([MARKS[0], "", *table(model, progress), "", MARKS[1]])
    DOCUMENT.write_text(before + lines + after)
