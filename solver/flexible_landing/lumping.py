"""Masses and loads of the full airframe put onto the stations of a stick, totals kept exactly.

Every mass point belongs to the nearest station.  The consistent mass that couples points of two
stations goes half to each, so that mass, centre of gravity and inertia tensor of the whole are
those of the full model to rounding.
"""

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.model import PointMasses
from solver.flexible_landing.stations import Station

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia
    from solver.fe.structure import Structure

#: A mass nearer than this to a gear's pin hangs on the fitting [m].
_AT_PIN = 1e-6


def nearest_station(
    points: Array, stations: tuple[Station, ...], pins: tuple[Array, ...]
) -> IntArray:
    """Index of the station of every point (p, 3); ``pins`` holds each fitting's (n, 3) places."""
    sections = np.array([k for k, station in enumerate(stations) if not station.is_fitting])
    tree = cKDTree(np.array([stations[k].point for k in sections]))
    owner = sections[tree.query(points)[1]]
    fittings = [k for k, station in enumerate(stations) if station.is_fitting]
    for station, places in zip(fittings, pins, strict=True):
        owner[cKDTree(places).query(points)[0] < _AT_PIN] = station
    return np.asarray(owner, dtype=np.int64)


def lumped_masses(
    structure: "Structure",
    inertia: "Inertia",
    stations: tuple[Station, ...],
    pins: tuple[Array, ...],
) -> PointMasses:
    """One mass with offset and inertia for each station.

    Raises
    ------
    ModelError
        A station has no mass.
    """
    owner = nearest_station(inertia.points, stations, pins)
    count = len(stations)
    reach = inertia.scalar_mass @ np.column_stack([np.ones(len(inertia.points)), inertia.points])
    masses, first = np.zeros(count), np.zeros((count, 3))
    second = np.zeros((count, 3, 3))
    np.add.at(masses, owner, reach[:, 0])
    np.add.at(first, owner, reach[:, 1:])
    np.add.at(second, owner, inertia.points[:, :, None] * reach[:, None, 1:])
    if np.any(masses <= 0.0):
        raise ModelError(f"station {stations[int(np.argmin(masses))].name} has no mass")
    centres = first / masses[:, None]
    second = (second + second.transpose(0, 2, 1)) / 2
    second = second - masses[:, None, None] * centres[:, :, None] * centres[:, None, :]
    traces = np.trace(second, axis1=1, axis2=2)
    tensors = traces[:, None, None] * np.eye(3) - second

    # Rotary inertia: that of lumped masses at their nodes, the little that sections have by mass.
    lumped = structure.model.point_masses
    places = structure.model.coordinates[lumped.nodes] + lumped.offsets
    np.add.at(tensors, nearest_station(places, stations, pins), lumped.inertias)
    rest = inertia.rotary.sum(axis=0) - lumped.inertias.sum(axis=0)
    tensors += masses[:, None, None] / masses.sum() * rest
    return PointMasses(
        identifiers=np.arange(1, count + 1),
        nodes=np.arange(count),
        masses=masses,
        offsets=centres - np.array([station.point for station in stations]),
        inertias=tensors,
    )


def lumped_loads(
    structure: "Structure", loads: Array, stations: tuple[Station, ...], pins: tuple[Array, ...]
) -> Array:
    """Wrenches (n_stations, 6, k) about the stations of loads (n_free, k) on the full airframe."""
    nodes, components = structure.free // 6, structure.free % 6
    everywhere = np.zeros((structure.model.node_count, 6, loads.shape[1]))
    everywhere[nodes, components] = loads
    owner = nearest_station(structure.model.coordinates, stations, pins)
    points = np.array([station.point for station in stations])
    arms = structure.model.coordinates - points[owner]
    everywhere[:, 3:] += np.cross(arms[:, :, None], everywhere[:, :3], axis=1)
    wrenches = np.zeros((len(stations), 6, loads.shape[1]))
    np.add.at(wrenches, owner, everywhere)
    return wrenches
