"""A recorder window as a picture: channels, contacts, and the smoothed motion."""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from solver.arrays import Array
from solver.flight_data.parameter import SWITCHES, Parameter
from solver.flight_data.reconstruction import Reconstruction
from solver.flight_data.window import Window

#: Panels from top to bottom: title, parameters, factor to the unit shown.
_PANELS: tuple[tuple[str, tuple[Parameter, ...], float], ...] = (
    (
        "load factor g",
        (
            Parameter.NORMAL_ACCELERATION,
            Parameter.LONGITUDINAL_ACCELERATION,
            Parameter.LATERAL_ACCELERATION,
        ),
        1.0,
    ),
    ("height m", (Parameter.RADIO_ALTITUDE,), 1.0),
    ("vertical speed m/s", (Parameter.VERTICAL_SPEED, Parameter.BAROMETRIC_SPEED), 1.0),
    ("angle deg", (Parameter.PITCH, Parameter.ROLL, Parameter.DRIFT), float(np.rad2deg(1.0))),
    ("on ground", SWITCHES, 1.0),
)

#: Shown before the first and after the last contact [s].
_BEFORE, _AFTER = 10.0, 6.0


def draw(path: Path, window: Window, found: Reconstruction) -> None:
    """Write the picture; the format follows from the file's ending."""
    with mpl.rc_context({"svg.hashsalt": "hardlanding", "font.size": 8}):
        figure = Figure(figsize=(9.0, 11.0), layout="constrained")
        axes = figure.subplots(len(_PANELS), 1, sharex=True)
        for ax, (title, parameters, factor) in zip(axes, _PANELS, strict=True):
            _panel(ax, window, parameters, factor)
            ax.set_ylabel(title)
            ax.grid(alpha=0.3)
        if found.courses is not None:
            _smoothed(axes, found)
        for ax in axes:
            for contact in found.contacts:
                ax.axvspan(
                    contact.time - contact.time_sd,
                    contact.time + contact.time_sd,
                    color="tab:red",
                    alpha=0.25,
                    linewidth=0,
                )
            if ax.get_legend_handles_labels()[1]:
                ax.legend(loc="upper left", fontsize=7)
        for contact in found.contacts:
            axes[0].annotate(
                contact.kind.replace("_", " "),
                (contact.time, 1.0),
                xycoords=("data", "axes fraction"),
                rotation=60,
                fontsize=7,
            )
        if found.contacts:
            first, last = found.contacts[0].time, found.contacts[-1].time
            axes[-1].set_xlim(first - _BEFORE, last + _AFTER)
        elif found.cannot_tell:
            reasons = "; ".join(each.reason for each in found.cannot_tell)
            figure.suptitle(f"cannot tell: {reasons}", fontsize=8, wrap=True)
        axes[-1].set_xlabel("time s")
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def _panel(ax: Axes, window: Window, parameters: tuple[Parameter, ...], factor: float) -> None:
    for parameter in parameters:
        for channel in window.of(parameter):
            style = "steps-post" if parameter in SWITCHES else "default"
            ax.plot(
                channel.time,
                channel.value * factor,
                marker=".",
                markersize=3,
                linewidth=0.6,
                drawstyle=style,
                label=channel.label.replace("_", " "),
            )


def _smoothed(axes: Array, found: Reconstruction) -> None:
    courses = found.courses
    if courses is None:
        return
    vertical = courses.vertical
    for ax, value, index in ((axes[1], vertical.height, 0), (axes[2], vertical.speed, 1)):
        sd = np.sqrt(vertical.covariance[:, index, index])
        ax.plot(vertical.time, value, color="black", linewidth=1.0, label="smoothed")
        ax.fill_between(
            vertical.time, value - 2 * sd, value + 2 * sd, color="black", alpha=0.15, linewidth=0
        )
