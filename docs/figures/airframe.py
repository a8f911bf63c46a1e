"""Draw an aircraft's airframe, optionally coloured by a value for each element.

    python docs/figures/airframe.py FOLDER [VALUES.npy] [-o PICTURE] [--label TEXT]

``VALUES.npy`` holds one value for each element in the solver's order (quadrilaterals, triangles,
beams), for instance the peak stress [MPa] of a landing.
"""

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from solver.aircraft.nastran import read_bulk_data
from solver.arrays import Array
from solver.fe.model import FiniteElementModel

PICTURE = Path(__file__).with_name("airframe.png")


def draw_airframe(
    model: FiniteElementModel,
    values: Array | None = None,
    label: str = "peak von Mises stress [MPa]",
    path: Path = PICTURE,
    elevation: float = -28.0,
    azimuth: float = -60.0,
) -> None:
    """Write a picture of the shells, and of the beams where no values colour the shells.

    Parameters
    ----------
    values : (n_elements,) array, optional
        In the order of ``model.element_identifiers``.
    """
    shells = [model.coordinates[shells.nodes] for shells in (model.quads, model.triangles)]
    polygons = [corners for part in shells for corners in part]
    figure = plt.figure(figsize=(12, 7.2))
    axes = figure.add_subplot(projection="3d", proj_type="ortho", computed_zorder=False)
    if values is None:
        colours = _shaded(polygons)
        skin = Poly3DCollection(polygons, facecolors=colours, edgecolors=(0, 0, 0, 0.35))
        skin.set_linewidth(0.15)
    else:
        shown = np.asarray(values[: len(polygons)])
        skin = Poly3DCollection(polygons, cmap="turbo", edgecolors=(0, 0, 0, 0.20))
        skin.set_array(shown)
        skin.set_clim(0.0, float(np.max(shown)))
        skin.set_linewidth(0.1)
        bar = figure.colorbar(skin, cax=figure.add_axes((0.06, 0.52, 0.014, 0.38)))
        bar.ax.set_title(label, loc="left", pad=10)
    axes.add_collection3d(skin)
    beams = model.coordinates[model.beams.nodes]
    if values is None:
        axes.add_collection3d(Line3DCollection(beams, colors=(0.1, 0.2, 0.5, 0.25), lw=0.3))
    low, high = model.coordinates.min(axis=0), model.coordinates.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=1.1)
    axes.view_init(elevation, azimuth)
    axes.set_axis_off()
    axes.set_position((-0.4, -0.4, 1.8, 1.8))
    figure.savefig(path, dpi=150)
    plt.close(figure)


def _shaded(polygons: list[Array]) -> Array:
    """Grey by the angle between a panel and the light."""
    light = np.array([-0.4, -0.3, 0.86])
    normals = np.array([np.cross(p[2] - p[0], p[-1] - p[1]) for p in polygons])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    grey = 0.55 + 0.4 * np.abs(normals @ light)
    return np.stack([grey * 0.95, grey * 0.98, grey, np.ones_like(grey)], axis=1).clip(0, 1)


def main() -> None:
    """Read the arguments and draw."""
    parser = argparse.ArgumentParser(description="Draw an aircraft's airframe.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("values", type=Path, nargs="?")
    parser.add_argument("-o", "--output", type=Path, default=PICTURE)
    parser.add_argument("--label", default="peak von Mises stress [MPa]")
    parser.add_argument("--view", type=float, nargs=2, default=(-28.0, -60.0))
    arguments = parser.parse_args()
    model = read_bulk_data(arguments.folder / "airframe.bdf").model
    values = None if arguments.values is None else np.load(arguments.values)
    draw_airframe(model, values, arguments.label, arguments.output, *arguments.view)


if __name__ == "__main__":
    main()
