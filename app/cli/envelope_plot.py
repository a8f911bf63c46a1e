"""An envelope as pictures: limits over attitude, over loading and lift, and how sure they are."""

import math
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from solver.arrays import Array
from solver.envelope.domain import FUEL, LIFT, PITCH, ROLL
from solver.envelope.envelope import Envelope, LimitSinkRate
from solver.envelope.sections import as_rows, limit_at, loading_at
from solver.envelope.surface import GRADED
from solver.errors import RecordError

_POINTS = 25


def draw(folder: Path, envelope: Envelope) -> list[Path]:
    """Write the pictures; returns their files."""
    written = []
    with mpl.rc_context({"font.size": 8}):
        for name, picture in (
            ("attitude", _attitude),
            ("loading", _loading),
            ("error", _error),
        ):
            path = folder / f"envelope-{name}.png"
            picture(envelope).savefig(path, dpi=110)
            written.append(path)
    return written


def _attitude(envelope: Envelope) -> Figure:
    """Contours of the limit sink rate over roll and pitch in the maximum landing mass."""
    domain = envelope.domain
    loading = loading_at(envelope, envelope.mass_states.definition.masses.maximum_landing)
    rolls = np.linspace(domain.low[ROLL], domain.high[ROLL], _POINTS)
    pitches = np.linspace(domain.low[PITCH], domain.high[PITCH], _POINTS)
    limits = np.array(
        [
            [limit_at(envelope, loading, roll=roll, pitch=pitch).value for roll in rolls]
            for pitch in pitches
        ]
    )
    # The other half is the mirror image.
    both = np.hstack([limits[:, :0:-1], limits])
    across = np.degrees(np.concatenate([-rolls[:0:-1], rolls]))
    figure = Figure(figsize=(6.0, 4.2), layout="constrained")
    ax = figure.subplots()
    levels = np.arange(0.0, math.ceil(domain.high[0] * 4.0) / 4.0 + 0.25, 0.25)
    filled = ax.contourf(across, np.degrees(pitches), both, levels=levels, cmap="viridis")
    lines = ax.contour(across, np.degrees(pitches), both, levels=levels, colors="white",
                       linewidths=0.5)  # fmt: skip
    ax.clabel(lines, fontsize=7)
    figure.colorbar(filled, label="limit sink rate m/s")
    ax.set_xlabel("roll deg")
    ax.set_ylabel("pitch deg")
    ax.set_title(
        f"{_name(envelope)}: sink rate at which a limit is reached, maximum landing mass\n"
        f"(error of the utilisation +{envelope.error.above:.0%} -{envelope.error.below:.0%})"
    )
    return figure


def _loading(envelope: Envelope) -> Figure:
    """Limit sink rate over mass, fuel and lift, with the band of its error."""
    domain, masses = envelope.domain, envelope.mass_states.definition.masses
    landing = loading_at(envelope, masses.maximum_landing)
    half_payload = 0.5 * sum(bay.capacity for bay in envelope.mass_states.definition.bays)

    def over_mass(mass: float, roll: float) -> LimitSinkRate:
        return limit_at(envelope, loading_at(envelope, mass), roll=roll)

    def over_fuel(fuel: float, roll: float) -> LimitSinkRate:
        mass = masses.operating_empty + half_payload + fuel
        return limit_at(envelope, loading_at(envelope, mass, fuel), roll=roll)

    def over_lift(fraction: float, roll: float) -> LimitSinkRate:
        return limit_at(envelope, landing, roll=roll, lift_fraction=fraction)

    figure = Figure(figsize=(9.0, 3.4), layout="constrained")
    panels = figure.subplots(1, 3, sharey=True)
    most_fuel = min(
        float(domain.high[FUEL]), masses.maximum_takeoff - masses.operating_empty - half_payload
    )
    for ax, label, course, low, high in (
        (panels[0], "mass kg", over_mass, masses.operating_empty, masses.maximum_takeoff),
        (panels[1], "fuel kg, half payload", over_fuel, 0.0, most_fuel),
        (panels[2], "lift over weight", over_lift, domain.low[LIFT], domain.high[LIFT]),
    ):
        for roll, colour in ((0.0, "tab:blue"), (3.0, "tab:orange")):
            _band(ax, course, np.linspace(low, high, _POINTS), roll, colour)
        ax.set_xlabel(label)
        ax.grid(alpha=0.3)
    panels[0].axvline(masses.maximum_landing, color="black", linewidth=0.8, linestyle=":")
    panels[0].set_ylabel("limit sink rate m/s")
    panels[0].set_ylim(bottom=0.0)
    panels[0].legend()
    figure.suptitle(f"{_name(envelope)}: limit sink rate with the error of the envelope")
    return figure


def _band(
    ax: Axes,
    course: Callable[[float, float], LimitSinkRate],
    along: Array,
    roll: float,
    colour: str,
) -> None:
    places, limits = [], []
    for place in along:
        try:
            limits.append(course(float(place), math.radians(roll)))
        except RecordError:
            continue  # no loading weighs that much with this fuel
        places.append(place)
    value, low, high = np.where(np.isfinite(rows := as_rows(limits)), rows, np.nan).T
    ax.plot(places, value, color=colour, label=f"roll {roll:.0f} deg")
    ax.fill_between(places, low, high, color=colour, alpha=0.2, linewidth=0)


def _error(envelope: Envelope) -> Figure:
    """Expected against found, for the landings that were held out."""
    expected, found = envelope.held_out.T
    thresholds = envelope.mass_states.definition.verdict
    error = envelope.error
    figure = Figure(figsize=(4.6, 4.4), layout="constrained")
    ax = figure.subplots()
    line = np.array([0.2, 1.7])
    ax.fill_between(line, line * (1 - error.below), line * (1 + error.above), alpha=0.2,
                    label="stated error")  # fmt: skip
    ax.plot(line, line, color="black", linewidth=0.8)
    ax.plot(expected, found, ".", markersize=4, label="landings held out")
    for level in (thresholds.firm_utilisation, thresholds.inspect_utilisation, 1.0):
        ax.axhline(level, color="tab:red", linewidth=0.5)
        ax.axvline(level, color="tab:red", linewidth=0.5)
    ax.set_xlim(0.3, GRADED[1])
    ax.set_ylim(0.2, 1.7)
    ax.set_xlabel("utilisation that the envelope expects")
    ax.set_ylabel("utilisation found")
    ax.set_title(f"{_name(envelope)}: {error.landings} landings held out")
    ax.legend(loc="upper left")
    return figure


def _name(envelope: Envelope) -> str:
    return envelope.mass_states.definition.name
