"""Force laws of strut and tyre, written anew from their stated formulae for the multibody peer.

Strut (method, section 2): gas p0 A (V0 / (V0 - A s))^n, oil C v |v| with a coefficient of its own
for rebound, stops k d (1 + c d') that never pull.  Tyre: a torus on a plane; the normal force is
m z^r for each tyre and stiffer beyond bottoming; tangential forces after Fiala with comprehensive
slip, rolling radius R - z / 3, lateral force within what the friction circle leaves.

Nothing is shared with `solver.gear` but the values that describe a gear.  Axes are those of the
peer: z up.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from solver.arrays import Array
from solver.gear.parameters import Strut, Tyre

UP = np.array([0.0, 0.0, 1.0])
#: Speed below which the slips are formed with this speed [m/s].
SLOW = 1.0


def gas_and_oil(stroke: float, closing: float, strut: Strut) -> float:
    """Gas spring and oil damper of an oleo strut, compression positive [N]."""
    volume = strut.initial_gas_volume - strut.pneumatic_area * stroke
    pressure: float = strut.initial_gas_pressure * (strut.initial_gas_volume / volume) ** (
        strut.polytropic_exponent
    )
    throttle = strut.compression_coefficient if closing > 0 else strut.rebound_coefficient
    return pressure * strut.pneumatic_area + throttle * closing * abs(closing)


def bumper(depth: float, speed: float, stiffness: float, damping: float) -> float:
    """Stop with damping in proportion to its depth (Hunt and Crossley), never pulling [N]."""
    return max(0.0, stiffness * depth * (1.0 + damping * speed)) if depth > 0 else 0.0


def strut_force(stroke: float, closing: float, strut: Strut) -> float:
    """Axial force of a strut with its stops, compression positive [N]."""
    at_closed_end = bumper(
        stroke - strut.full_stroke, closing, strut.stop_stiffness, strut.stop_damping
    )
    at_open_end = bumper(-stroke, -closing, strut.stop_stiffness, strut.stop_damping)
    return gas_and_oil(stroke, closing, strut) + at_closed_end - at_open_end


def normal_force(deflection: float, tyre: Tyre) -> float:
    """Elastic force of one tyre [N]."""
    if deflection <= 0.0:
        return 0.0
    force = tyre.vertical_coefficient * deflection**tyre.vertical_exponent
    beyond = max(0.0, deflection - tyre.bottoming_deflection)
    return float(force + tyre.rim_stiffness * beyond)


def fiala(normal: float, kappa: float, tangent: float, tyre: Tyre) -> tuple[float, float, float]:
    """Forward force, force towards the right and aligning moment, of one tyre [N, N, N m].

    ``kappa`` is -1 for a locked wheel that moves forward, ``tangent`` positive where the wheel
    moves to its right.
    """
    if normal <= 0.0:
        return 0.0, 0.0, 0.0
    comprehensive = min(1.0, float(np.hypot(kappa, tangent)))
    spread = tyre.maximum_friction - tyre.minimum_friction
    limit = (tyre.maximum_friction - spread * comprehensive) * normal
    critical = limit / (2.0 * tyre.longitudinal_stiffness)
    if abs(kappa) <= critical:
        forward = tyre.longitudinal_stiffness * kappa
    else:
        lost = limit * limit / (4.0 * abs(kappa) * tyre.longitudinal_stiffness)
        forward = float(np.sign(kappa)) * (limit - lost)
    if abs(np.arctan(tangent)) <= np.arctan(3.0 * limit / tyre.cornering_stiffness):
        adhering = 1.0 - tyre.cornering_stiffness * abs(tangent) / (3.0 * limit)
    else:
        adhering = 0.0
    circle = float(np.sqrt(max(0.0, 1.0 - (forward / limit) ** 2)))
    direction = float(np.sign(tangent))
    right = -direction * limit * (1.0 - adhering**3) * circle
    aligning = direction * limit * tyre.width * (1.0 - adhering) * adhering**3 * circle
    return forward, right, aligning


@dataclass(frozen=True, slots=True)
class GroundReaction:
    """What the ground does to the tyres of one axle, world axes with z up."""

    force: Array  #: (3,) [N]
    moment: Array  #: (3,) about the middle of the axle [N m]
    deflection: float  #: negative off the ground [m]


def ground_reaction(
    centre: Array, velocity: Array, spin: Array, axle: Array, tyre: Tyre
) -> GroundReaction:
    """Ground force on tyres whose axle is at ``centre``; the ground is the plane z = 0.

    Parameters
    ----------
    centre, velocity : (3,) arrays
        Of the middle of the axle [m], [m/s].
    spin : (3,) array
        Angular velocity of the wheel [rad/s].
    axle : (3,) array
        Unit vector along the axle, to the left.

    Notes
    -----
    The tread is a torus about the axle.  Its lowest point lies under the lowest point of the
    circle in its middle.
    """
    ring = tyre.free_radius - tyre.tread_radius
    in_wheel_plane = -UP + (UP @ axle) * axle
    towards_ground = in_wheel_plane / np.linalg.norm(in_wheel_plane)
    middle = centre + ring * towards_ground
    deflection = float(tyre.tread_radius - middle[2])
    if deflection <= 0.0:
        return GroundReaction(np.zeros(3), np.zeros(3), deflection)
    patch = np.array([middle[0], middle[1], 0.0])
    arm = patch - centre
    ahead: Any = np.cross(axle, UP)
    ahead = ahead / np.linalg.norm(ahead)
    right = np.cross(ahead, UP)
    tread = velocity + np.cross(spin, arm)
    # The wheel rolls on R - z/3, further than its axle stands above the ground.
    turning = float(spin @ axle)
    rolled = turning * (1.0 - tyre.rolling_share) * deflection
    speed = max(abs(float(velocity @ ahead)), SLOW)
    kappa = -(float(tread @ ahead) - rolled) / speed
    tangent = float(tread @ right) / speed
    normal = normal_force(deflection, tyre)
    closing = -float(tread[2])
    normal = max(0.0, normal * (1.0 + tyre.vertical_damping * closing))
    forward, sideways, aligning = fiala(normal, kappa, tangent, tyre)
    force = tyre.count * (forward * ahead + sideways * right + normal * UP)
    moment = np.cross(arm, force) - tyre.count * aligning * UP
    return GroundReaction(force, moment, deflection)
