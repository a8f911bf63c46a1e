"""Draw the figures of README and docs from runs made now: `make docs`."""

import math
import sys
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt

from app.cli.demo import EXAMPLE_AIRCRAFT
from app.cli.progress import progress_bars
from app.config import get_settings
from solver.aircraft.airframe import load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.assess import assess_landing, load_assessment_model
from solver.assessment import Assessment, TouchdownRecord
from solver.landing.contact import Contact

FIGURES = Path(__file__).parent
sys.path.insert(0, str(FIGURES))

from airframe import draw_airframe  # noqa: E402
from landings import write_table  # noqa: E402
from probability import draw_probability  # noqa: E402

#: Design landing of 14 CFR 25.473: 10 ft/s at the maximum landing mass.
DESIGN_CONTACT = Contact(sink_rate=3.048, ground_speed=55.0, pitch=math.radians(3.0))


def draw_gear_histories(assessment: Assessment, path: Path) -> None:
    """Ground forces, stroke and wheel speed of one main gear and the nose gear."""
    history = assessment.histories[0]
    figure, rows = plt.subplots(3, 1, figsize=(8, 8), sharex=True, layout="constrained")
    for gear in history.gears:
        if gear.name == "main_right":
            continue  # the mirror image of main_left in a landing without roll
        rows[0].plot(history.time, -gear.ground_force[:, 2] / 1e3, label=f"{gear.name} vertical")
        rows[0].plot(history.time, gear.wrench[:, 0] / 1e3, lw=0.8, label=f"{gear.name} fore-aft")
        rows[1].plot(history.time, gear.stroke * 1e3, label=gear.name)
        rows[2].plot(history.time, gear.wheel_speed, label=gear.name)
    for row, label in zip(rows, ("force [kN]", "stroke [mm]", "wheel [rad/s]"), strict=True):
        row.set_ylabel(label)
        row.grid(alpha=0.3)
        row.legend(fontsize="small")
    rows[0].set_title("Landing at 10 ft/s, maximum landing mass: vertical force at the ground,\n"
                      "fore-aft force on the airframe (aft negative)")  # fmt: skip
    rows[2].set_xlabel("time after contact [s]")
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main() -> None:
    """Build what is missing, land at 10 ft/s, draw."""
    settings = get_settings()
    folder = settings.aircraft_folder / EXAMPLE_AIRCRAFT
    with progress_bars() as progress:
        build_bizjet(folder, progress=progress)
        model = load_assessment_model(folder, settings.cache_folder, progress)
        write_table(model, progress)
        draw_probability(model, FIGURES / "probability.png", progress)
    limit = model.airframe.definition.masses.maximum_landing
    record = TouchdownRecord(EXAMPLE_AIRCRAFT, (DESIGN_CONTACT,), mass=limit)
    assessment = assess_landing(model, record)
    assert assessment.peak_field is not None
    draw_airframe(
        load_airframe(folder).structure.model,
        assessment.peak_field.stress / 1e6,
        path=FIGURES / "landing-10fps.png",
    )
    draw_gear_histories(assessment, FIGURES / "gear-10fps.png")


if __name__ == "__main__":
    main()
