"""Drawing of an airframe's shells in space, for the report and for the pictures of the docs."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from solver.arrays import Array
from solver.fe.model import FiniteElementModel

#: Direction of view: elevation and azimuth [deg].
VIEW = (-28.0, -60.0)


def add_airframe(
    figure: Figure,
    place: tuple[float, float, float, float],
    model: FiniteElementModel,
    values: Array | None = None,
    limit: float | None = None,
    view: tuple[float, float] = VIEW,
    colours: str = "turbo",
) -> Poly3DCollection:
    """Draw the shells, and the beams where no values colour the shells.

    Parameters
    ----------
    place : tuple of float
        Left, bottom, width and height of the picture in shares of the figure.
    values : (n_elements,) array, optional
        In the order of ``model.element_identifiers``.
    limit : float, optional
        Value of the last colour; the largest one of a shell if left out.
    colours : str
        A colour map of Matplotlib.

    Returns
    -------
    Poly3DCollection
        The shells, from which a scale of colours can be made.
    """
    shells = [model.coordinates[shells.nodes] for shells in (model.quads, model.triangles)]
    polygons = [corners for part in shells for corners in part]
    axes: Any = figure.add_subplot(projection="3d", proj_type="ortho", computed_zorder=False)
    if values is None:
        skin = Poly3DCollection(polygons, facecolors=_shaded(polygons), edgecolors=(0, 0, 0, 0.35))
        skin.set_linewidth(0.15)
    else:
        shown = np.asarray(values[: len(polygons)])
        skin = Poly3DCollection(polygons, cmap=colours, edgecolors=(0, 0, 0, 0.20))
        skin.set_array(shown)
        skin.set_clim(0.0, float(np.max(shown)) if limit is None else limit)
        skin.set_linewidth(0.1)
    axes.add_collection3d(skin)
    if values is None:
        beams = model.coordinates[model.beams.nodes]
        axes.add_collection3d(Line3DCollection(beams, colors=(0.1, 0.2, 0.5, 0.25), lw=0.3))
    low, high = model.coordinates.min(axis=0), model.coordinates.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=1.1)
    axes.view_init(*view)
    axes.set_axis_off()
    # Matplotlib leaves wide margins around a box in space; the picture may use them.
    left, bottom, width, height = place
    axes.set_position((left - 0.4 * width, bottom - 0.4 * height, 1.8 * width, 1.8 * height))
    return skin


def _shaded(polygons: list[Array]) -> Array:
    """Grey by the angle between a panel and the light."""
    light = np.array([-0.4, -0.3, 0.86])
    normals = np.array([np.cross(p[2] - p[0], p[-1] - p[1]) for p in polygons])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    grey = 0.55 + 0.4 * np.abs(normals @ light)
    return np.stack([grey * 0.95, grey * 0.98, grey, np.ones_like(grey)], axis=1).clip(0, 1)
