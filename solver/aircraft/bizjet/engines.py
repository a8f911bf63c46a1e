"""Engines on the rear fuselage: a pylon box on two frames, and a rigid engine on its tip."""

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.divisions import Divisions
from solver.aircraft.bizjet.fuselage import Fuselage
from solver.aircraft.bizjet.mesh import Mesh


def build_engine(mesh: Mesh, divisions: Divisions, fuselage: Fuselage, side: int) -> int:
    """Add one side's pylon and the engine's node; returns that node's row."""
    front = fuselage.stations.index(dim.PYLON_FRONT)
    rear = fuselage.stations.index(dim.PYLON_REAR)
    cells = divisions.elements(2)
    share = np.linspace(0, 1, cells + 1)[:, None, None]
    first, last = (fuselage.column(angle, side) for angle in (dim.PYLON_LOWER, dim.PYLON_UPPER))
    columns = np.arange(first, last + side, side)
    root = mesh.points(fuselage.nodes[front : rear + 1][:, columns])
    tip = root.copy()
    tip[..., 1] = dim.PYLON_TIP * side
    # Spans (cells + 1), chord, height from lower to upper skin.
    points = (1 - share[..., None]) * root + share[..., None] * tip
    pylon = np.full(points.shape[:-1], -1, dtype=np.int64)
    for k in range(cells + 1):
        if k in (0, cells):
            pylon[k] = mesh.grid(points[k])
        else:
            pylon[k][:, [0, -1]] = mesh.grid(points[k][:, [0, -1]])
            pylon[k][[0, -1]] = mesh.grid(points[k][[0, -1]])
    for surface in (0, -1):
        mesh.shells(pylon[:, :, surface], "engine pylon skin", "upper" if surface else "lower")
    for chord, name in ((0, "front"), (-1, "rear")):
        mesh.shells(pylon[:, chord], "engine pylon spars", name)
        for surface, inside in ((0, 1.0), (-1, -1.0)):
            mesh.stiffener(
                pylon[:, chord, surface],
                "engine pylon caps",
                f"{name} {'upper' if surface else 'lower'}",
                [0.0, 0.0, inside],
                0.015,
            )
    mesh.shells(pylon[-1], "engine pylon spars", "tip")
    x, y, z = dim.ENGINE_CENTRE
    row = mesh.free_node(x, y * side, z)
    mesh.rigid.append((row, sorted({int(node) for node in pylon[-1].ravel()})))
    return row
