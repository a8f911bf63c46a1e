"""Draw an aircraft's airframe, optionally coloured by a value for each element.

    python docs/figures/airframe.py FOLDER [VALUES.npy] [-o PICTURE] [--label TEXT]

``VALUES.npy`` holds one value for each element in the solver's order (quadrilaterals, triangles,
beams), for instance the peak stress [MPa] of a landing.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from solver.aircraft.nastran import read_bulk_data
from solver.arrays import Array
from solver.fe.model import FiniteElementModel
from verification.airframe_drawing import VIEW, add_airframe

PICTURE = Path(__file__).with_name("airframe.png")


def draw_airframe(
    model: FiniteElementModel,
    values: Array | None = None,
    label: str = "peak von Mises stress [MPa]",
    path: Path = PICTURE,
    view: tuple[float, float] = VIEW,
) -> None:
    """Write a picture of the shells, and of the beams where no values colour the shells."""
    figure = Figure(figsize=(12, 7.2))
    skin = add_airframe(figure, (0.0, 0.0, 1.0, 1.0), model, values, view=view)
    if values is not None:
        bar = figure.colorbar(skin, cax=figure.add_axes((0.06, 0.52, 0.014, 0.38)))
        bar.ax.set_title(label, loc="left", pad=10)
    figure.savefig(path, dpi=150)


def main() -> None:
    """Read the arguments and draw."""
    parser = argparse.ArgumentParser(description="Draw an aircraft's airframe.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("values", type=Path, nargs="?")
    parser.add_argument("-o", "--output", type=Path, default=PICTURE)
    parser.add_argument("--label", default="peak von Mises stress [MPa]")
    parser.add_argument("--view", type=float, nargs=2, default=VIEW)
    arguments = parser.parse_args()
    model = read_bulk_data(arguments.folder / "airframe.bdf").model
    values = None if arguments.values is None else np.load(arguments.values)
    draw_airframe(model, values, arguments.label, arguments.output, tuple(arguments.view))


if __name__ == "__main__":
    main()
