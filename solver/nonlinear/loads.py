"""Loads of a landing on an airframe that turns by itself: inertial in direction, fixed in place.

The landing simulation gives pin and air loads in body axes.  Here they are turned into inertial
axes by the attitude of that same rigid simulation, sample by sample, and stay where they attach:
at pins and skin nodes, wherever these go.  No motion is prescribed.  Inertial axes are the
structural axes at the first sample; gravity is constant in them.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array, eye_array, hstack

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.structure import Structure
from solver.frames import BODY_STRUCTURAL, rotation_matrix
from solver.inertia_relief.loads import LandingLoads, landing_loads

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe
    from solver.landing.history import LandingHistory


@dataclass(frozen=True, slots=True)
class DirectedLoads:
    """Nodal loads, linear in time between samples, and the turn of the axes they are given in."""

    time: Array  #: (nt,) ascending [s]
    shapes: csr_array  #: (6 n, k) nodal loads of unit amplitude, dependent nodes included
    amplitudes: Array  #: (nt, k)
    attitude: Array  #: (nt, 4) quaternions that turn the loads' axes into inertial ones
    gravity: Array  #: (3,) inertial axes [m/s2]

    def at(self, time: float) -> Array:
        """Give forces and moments (n, 6) on all nodes at a time, inertial axes [N, N m]."""
        after = int(np.clip(np.searchsorted(self.time, time), 1, len(self.time) - 1))
        share = (time - self.time[after - 1]) / (self.time[after] - self.time[after - 1])
        share = min(max(float(share), 0.0), 1.0)
        amplitudes = (1 - share) * self.amplitudes[after - 1] + share * self.amplitudes[after]
        one, other = self.attitude[after - 1], self.attitude[after]
        other = other if one @ other >= 0 else -other
        # samples are so close that the chord halves the arc
        quaternion = (1 - share) * one + share * other
        matrix = rotation_matrix(quaternion / np.linalg.norm(quaternion))
        loads = (self.shapes @ amplitudes).reshape(-1, 2, 3)
        turned: Array = (loads @ matrix.T).reshape(-1, 6)
        return turned


def dead_loads(time: Array, shapes: Array, amplitudes: Array, gravity: Array) -> DirectedLoads:
    """Make loads whose axes are inertial: ``shapes`` (6 n, k), ``amplitudes`` (nt, k)."""
    attitude = np.tile([1.0, 0.0, 0.0, 0.0], (len(time), 1))
    return DirectedLoads(time, csr_array(shapes), amplitudes, attitude, gravity)


def no_loads(node_count: int, gravity: Array | None = None) -> DirectedLoads:
    """No loads but gravity."""
    none = np.zeros((6 * node_count, 1))
    vector = np.zeros(3) if gravity is None else gravity
    return dead_loads(np.array([0.0, 1.0]), none, np.zeros((2, 1)), vector)


def directed_landing_loads(
    airframe: "Airframe", history: "LandingHistory", loads: LandingLoads | None = None
) -> DirectedLoads:
    """Pin loads, air loads and gravity of a simulated landing.

    Parameters
    ----------
    loads : LandingLoads, optional
        The landing's loads if they exist already; they may end before the history does.

    Raises
    ------
    ModelError
        The loads are not of this history: another time grid.
    """
    loads = landing_loads(airframe, history) if loads is None else loads
    count = len(loads.time)
    if count > len(history.time) or not np.array_equal(loads.time, history.time[:count]):
        raise ModelError("the loads do not stand on the time grid of the landing's history")
    size = 6 * airframe.structure.model.node_count
    pins = (6 * airframe.pin_rows[:, None] + np.arange(6)).ravel()
    air = free_shapes(airframe.structure, airframe.air_shapes)
    shapes = hstack([_unit_columns(size, pins), air])
    return DirectedLoads(
        time=loads.time,
        shapes=csr_array(shapes),
        amplitudes=loads.applied_amplitudes(),
        attitude=structural_attitude(history.attitude[:count]),
        gravity=loads.motion.gravity[0],
    )


def structural_attitude(attitude: Array) -> Array:
    """Quaternions (nt, 4) from structural axes to those of the first sample.

    From ``attitude`` (nt, 4), body to earth: ``D R_0' R D`` with D the half turn about y between
    body and structural axes.
    """
    w, vector = attitude[:, :1], attitude[:, 1:]
    first, axis = attitude[0, 0], -attitude[0, 1:]
    scalar = first * w - (vector @ axis)[:, None]
    turned = first * vector + w * axis + np.cross(axis, vector)
    return np.hstack([scalar, turned * BODY_STRUCTURAL])


def free_shapes(structure: Structure, shapes: Array) -> csr_array:
    """Give on all nodes, (6 n, k), the loads ``shapes`` (n_free, k) on the free freedoms."""
    columns = _unit_columns(6 * structure.model.node_count, structure.free)
    return csr_array(columns @ csr_array(shapes))


def _unit_columns(size: int, rows: IntArray) -> csr_array:
    return csr_array(eye_array(size, format="csc")[:, rows])
