"""Loads that a landing puts on the airframe, and the proof that they balance its motion.

Equation (15) of Lee et al., "Hard-landing Simulation by a Hierarchical Aircraft Landing Model and
an Extended Inertia Relief Technique", is well posed only when every external load takes part: pin
loads, air loads as a distribution, gravity as a body force, each in equilibrium with the motion.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array
from solver.errors import EquilibriumError, ModelError
from solver.frames import BODY_STRUCTURAL, body_structural
from solver.inertia_relief.motion import RigidMotion

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe
    from solver.aircraft.assessed_airframe import AssessedAirframe
    from solver.landing.history import LandingHistory

#: Largest share of the applied loads that may be out of balance; rounding is near 1e-13.
EQUILIBRIUM_TOLERANCE = 1e-8

#: Farthest a gear's pin may be from the airframe's node that takes its load [m].
PIN_POSITION_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True)
class LandingLoads:
    """Applied loads and rigid-body motion on one uniform time grid, structural axes."""

    time: Array  #: (nt,) [s]
    pin_loads: Array  #: (nt, 6 n_pins) force and moment at each pin, gear order [N, N m]
    air_loads: Array  #: (nt, 6) resultant about the structural origin [N, N m]
    motion: RigidMotion

    def applied_amplitudes(self) -> Array:
        """Amplitudes (nt, 6 n_pins + 6) of the applied load shapes: pins, then air."""
        return np.hstack([self.pin_loads, self.air_loads])

    def until(self, end: float) -> "LandingLoads":
        """Return the part of the landing up to ``end`` [s]."""
        count = int(np.searchsorted(self.time, end + 1e-9 * max(abs(end), 1.0), side="right"))
        motion = self.motion
        return LandingLoads(
            self.time[:count],
            self.pin_loads[:count],
            self.air_loads[:count],
            RigidMotion(
                motion.origin,
                motion.acceleration[:count],
                motion.gravity[:count],
                motion.rate[:count],
                motion.rate_derivative[:count],
            ),
        )


def landing_loads(airframe: "AssessedAirframe", history: "LandingHistory") -> LandingLoads:
    """Turn a simulated landing into structural loads (body axes become structural axes).

    Raises
    ------
    ModelError
        The gears' pins are not the airframe's: another number, or away from their nodes.
    """
    count = len(history.time)
    pins = [gear.pin_loads for gear in history.gears]
    pin_loads = np.concatenate(pins, axis=1) if pins else np.zeros((count, 0, 6))
    _check_pins(airframe, history)
    force = body_structural(history.air_wrench[:, :3])
    moment = body_structural(history.air_wrench[:, 3:]) + np.cross(history.origin, force)
    return LandingLoads(
        time=history.time,
        pin_loads=(pin_loads * np.tile(BODY_STRUCTURAL, 2)).reshape(count, -1),
        air_loads=np.hstack([force, moment]),
        motion=RigidMotion(
            np.asarray(history.origin, dtype=np.float64),
            body_structural(history.acceleration),
            body_structural(history.gravity),
            body_structural(history.rate),
            body_structural(history.rate_derivative),
        ),
    )


def _check_pins(airframe: "AssessedAirframe", history: "LandingHistory") -> None:
    nodes = airframe.pin_positions
    pins = np.concatenate([gear.pin_positions for gear in history.gears] or [np.zeros((0, 3))])
    if pins.shape != nodes.shape:
        raise ModelError(f"the landing has {len(pins)} gear pins, the airframe {len(nodes)}")
    distance = np.linalg.norm(pins - nodes, axis=1)
    if np.any(distance > PIN_POSITION_TOLERANCE):
        worst = int(np.argmax(distance))
        raise ModelError(
            f"gear pin {worst} is {distance[worst]:.4f} m from its node "
            f"(limit {PIN_POSITION_TOLERANCE} m)"
        )


def applied_shapes(airframe: "Airframe") -> Array:
    """Nodal loads (n_free, 6 n_pins + 6) of unit pin components, then unit air resultants."""
    return np.hstack([airframe.pin_loads.toarray(), airframe.air_shapes])


def equilibrium_residual(
    applied_resultants: Array,
    applied_amplitudes: Array,
    inertia_resultants: Array,
    inertia_amplitudes: Array,
    weight: Array,
    length: float,
) -> float:
    """Largest imbalance of the right-hand side of eq (15), relative to the loads in it.

    The six components of ``Phi_R' rhs`` about the centre of gravity, moments divided by
    ``length``, have the Euclidean norm r(t).  |P|(t) is the sum of the same norms of every applied
    contribution taken by itself (each pin's wrench, the air loads' wrench) plus the weight, so
    that loads which cancel each other still count.  The figure is the largest r(t) / |P|(t).

    Parameters
    ----------
    applied_resultants : (6, k) array
        ``Phi_R'`` times the applied load shapes, k a multiple of six: one block for each pin,
        the last for the air loads.
    applied_amplitudes : (nt, k) array
        [N, N m]
    inertia_resultants : (6, 12) array
        ``Phi_R'`` times the rigid load shapes of this loading's inertia.
    inertia_amplitudes : (nt, 12) array
        See `RigidMotion.inertia_amplitudes`.
    weight : (nt,) array
        Mass times gravity [N].
    length : float
        Radius of gyration that makes moments comparable with forces [m].

    Raises
    ------
    EquilibriumError
        The figure exceeds `EQUILIBRIUM_TOLERANCE`.  Nothing larger is ever projected away.
    """
    scale = np.array([1.0, 1.0, 1.0, 1.0 / length, 1.0 / length, 1.0 / length])
    count, columns = applied_amplitudes.shape
    contributions = (scale[:, None] * applied_resultants).reshape(6, columns // 6, 6)
    wrenches = np.einsum(
        "cbk,tbk->tbc", contributions, applied_amplitudes.reshape(count, columns // 6, 6)
    )
    inertial = inertia_amplitudes @ (scale[:, None] * inertia_resultants).T
    residual = np.linalg.norm(wrenches.sum(axis=1) + inertial, axis=1)
    magnitude = np.linalg.norm(wrenches, axis=2).sum(axis=1) + weight
    ratio = residual / magnitude
    worst = int(np.argmax(ratio))
    figure = float(ratio[worst])
    if not figure <= EQUILIBRIUM_TOLERANCE:
        imbalance = wrenches[worst].sum(axis=0) + inertial[worst]
        raise EquilibriumError(
            f"loads do not balance the motion at sample {worst}: imbalance / loads = {figure:.3e} "
            f"(limit {EQUILIBRIUM_TOLERANCE:.0e}), force {np.round(imbalance[:3], 3).tolist()} N, "
            f"moment {np.round(imbalance[3:] * length, 3).tolist()} N m about the centre of gravity"
        )
    return figure
