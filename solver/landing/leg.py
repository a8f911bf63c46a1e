"""One gear in motion: kinematics of its leg, and the forces that act on it, before accelerations.

The leg hangs at its pivot p (fixed to the airframe), has the length L = L_0 - s and swings about
the lateral axis e by theta, aft positive.  With d the unit vector from pivot to axle and
f = e x d the forward normal, in body axes:

    r = p + L d,   d' = -theta' f,   f' = theta' d
    r' = -s' d - L theta' f
    r'' = -s'' d - L theta'' f + 2 s' theta' f - L theta'^2 d

The unsprung mass is a point at the axle; the wheels are a body of revolution that spins about e.
``spin`` is the wheel's rate against the airframe, positive when it rolls forward, so that the
wheel's angular velocity is omega - spin e.
"""

from typing import NamedTuple

import numba
import numpy as np

from solver.gear.oleo import (
    area_ratio,
    friction_force,
    gas_energy,
    gas_force,
    hydraulic_force,
    stop_force,
)
from solver.gear.spring_back import swing_damping, two_tube_stiffness
from solver.gear.tyre import fiala_forces, rolling_moment, slips, vertical_energy, vertical_force
from solver.landing.records import Record
from solver.landing.vectors import Vector, add, along, cross, dot, scaled, vector


class Leg(NamedTuple):
    """Where a leg is, how it moves, and what pushes it; body axes, moments about the axle."""

    length: float  #: L [m]
    down: Vector  #: d
    forward: Vector  #: f
    lateral: Vector  #: e
    arm: Vector  #: r, from the airframe's centre of gravity to the axle [m]
    velocity: Vector  #: of the axle [m/s]
    bias: Vector  #: of the axle's acceleration, what no second derivative multiplies [m/s2]
    strut_force: float  #: compression positive, stops and friction included [N]
    swing_stiffness: float  #: k [N m/rad]
    swing_slope: float  #: dk/ds [N/rad]
    swing_damping: float  #: [N m s/rad]
    deflection: float  #: of the tyre, negative off the ground [m]
    normal: float  #: ground force along the ground's normal [N]
    ground_force: Vector  #: on the tyre [N]
    ground_moment: Vector  #: on the wheel, about the axle [N m]
    hydraulic_power: float  #: dissipated [W]
    tyre_power: float  #: dissipated [W]
    other_power: float  #: dissipated by stops, friction and swing damping [W]


@numba.njit(cache=True)
def leg_state(
    gear: Record,
    stroke: float,
    stroke_rate: float,
    swing: float,
    swing_rate: float,
    spin: float,
    origin_velocity: Vector,
    rate: Vector,
    below: Vector,
    depth: float,
) -> Leg:
    """Evaluate one gear.

    Parameters
    ----------
    gear : GEAR_RECORD
    stroke, stroke_rate, swing, swing_rate, spin : float
        The gear's own motion [m, m/s, rad, rad/s, rad/s].
    origin_velocity, rate : Vector
        Of the airframe, body axes [m/s, rad/s].
    below : Vector
        Unit vector down to the ground, body axes.
    depth : float
        Earth z of the airframe's centre of gravity, negative above the ground [m].
    """
    lateral = vector(gear.lateral)
    ahead = vector(gear.forward)
    straight = vector(gear.down)
    sine, cosine = np.sin(swing), np.cos(swing)
    down = along(scaled(cosine, straight), -sine, ahead)
    forward = along(scaled(cosine, ahead), sine, straight)
    length = gear.extended_length - stroke
    arm = along(vector(gear.pivot), length, down)
    drift = along(scaled(-stroke_rate, down), -length * swing_rate, forward)
    velocity = add(add(origin_velocity, cross(rate, arm)), drift)
    bias = add(cross(rate, cross(rate, arm)), scaled(2.0, cross(rate, drift)))
    bias = along(bias, 2.0 * stroke_rate * swing_rate, forward)
    bias = along(bias, -length * swing_rate**2, down)

    strut_force, hydraulic_power, other_power = _strut(gear, stroke, stroke_rate)

    stiffness, slope = swing_spring(gear, length)
    damping = 0.0
    if gear.swings:
        damping = swing_damping(stiffness, gear.swing_damping_ratio, gear.unsprung_mass, length)
        other_power += damping * swing_rate**2

    wheel_rate = along(rate, -spin, lateral)
    height = -(depth + dot(below, arm))
    deflection, normal, force, moment, tyre_power = _ground(
        gear, lateral, velocity, wheel_rate, below, height
    )
    return Leg(
        length,
        down,
        forward,
        lateral,
        arm,
        velocity,
        bias,
        strut_force,
        stiffness,
        slope,
        damping,
        deflection,
        normal,
        force,
        moment,
        hydraulic_power,
        tyre_power,
        other_power,
    )


@numba.njit(cache=True)
def swing_spring(gear: Record, length: float) -> tuple[float, float]:
    """Stiffness k of the spring-back [N m/rad] and its slope with the stroke dk/ds [N/rad]."""
    if not gear.swings:
        return 0.0, 0.0
    if gear.two_tube:
        stiffness, slope = two_tube_stiffness(
            length,
            gear.cylinder_rigidity,
            gear.piston_rigidity,
            gear.cylinder_length,
            gear.attachment_stiffness,
        )
        return stiffness, -slope
    return gear.swing_stiffness, 0.0


@numba.njit(cache=True)
def _strut(gear: Record, stroke: float, rate: float) -> tuple[float, float, float]:
    """Axial force [N], power lost in the oil [W], power lost in stops and friction [W]."""
    coefficient = (
        gear.compression_coefficient
        / area_ratio(stroke, gear.metering_stroke, gear.metering_ratio, gear.metering_count) ** 2
    )
    oil = hydraulic_force(rate, coefficient, gear.rebound_coefficient)
    gas = gas_force(
        stroke,
        gear.pneumatic_area,
        gear.initial_gas_pressure,
        gear.initial_gas_volume,
        gear.polytropic_exponent,
    )
    stiffness = gear.stop_stiffness
    closed = stop_force(stroke - gear.full_stroke, rate, stiffness, gear.stop_damping)
    extended = stop_force(-stroke, -rate, stiffness, gear.stop_damping)
    friction = friction_force(rate, gear.seal_friction, gear.friction_speed)
    elastic = stiffness * (max(0.0, stroke - gear.full_stroke) - max(0.0, -stroke))
    lost = (closed - extended - elastic + friction) * rate
    return gas + oil + closed - extended + friction, oil * rate, lost


@numba.njit(cache=True)
def _ground(
    gear: Record,
    lateral: Vector,
    velocity: Vector,
    wheel_rate: Vector,
    below: Vector,
    height: float,
) -> tuple[float, float, Vector, Vector, float]:
    """Deflection, normal force, force and moment about the axle, power lost in the tyre.

    The tyre is a torus whose tread has the crown radius across it.  Its lowest point moves with
    the camber; the normal force acts there along the ground's normal, which makes it conservative.
    """
    tilt = dot(below, lateral)
    upright = np.sqrt(1.0 - tilt**2)
    radial = scaled(1.0 / upright, along(below, -tilt, lateral))
    ring = gear.free_radius - gear.crown_radius
    deflection = ring * upright + gear.crown_radius - height
    nothing = (0.0, 0.0, 0.0)
    if deflection <= 0.0:
        return deflection, 0.0, nothing, nothing, 0.0

    contact = along(scaled(ring, radial), gear.crown_radius - deflection, below)
    sliding = add(velocity, cross(wheel_rate, contact))
    closing = dot(sliding, below)
    elastic = vertical_force(
        deflection,
        gear.vertical_coefficient,
        gear.vertical_exponent,
        gear.bottoming_deflection,
        gear.rim_stiffness,
    )
    normal = max(0.0, elastic * (1.0 + gear.vertical_damping * closing))

    heading = scaled(1.0 / upright, cross(lateral, below))
    side = cross(below, heading)
    # The tread is hardly extensible, so that it rolls on more than the deflected radius.
    rolling = -dot(wheel_rate, lateral)
    surplus = rolling * (1.0 - gear.rolling_share) * deflection
    kappa, tangent = slips(
        dot(velocity, heading), dot(sliding, heading) - surplus, dot(sliding, side)
    )
    longitudinal, sideways, aligning = fiala_forces(
        normal,
        kappa,
        tangent,
        gear.longitudinal_stiffness,
        gear.cornering_stiffness,
        gear.maximum_friction,
        gear.minimum_friction,
        gear.width,
    )
    count = gear.tyre_count
    normal *= count
    force = along(
        along(scaled(count * longitudinal, heading), count * sideways, side), -normal, below
    )
    resistance = rolling_moment(normal, rolling * gear.free_radius, gear.rolling_resistance)
    turning = along(scaled(resistance, lateral), count * aligning, below)
    moment = add(cross(contact, force), turning)
    # Power the ground gives the wheel, plus what the tyre stores, is what is lost in it.
    given = dot(force, sliding) + dot(turning, wheel_rate)
    return deflection, normal, force, moment, -given - count * elastic * closing


@numba.njit(cache=True)
def stored_energy(
    gear: Record, stroke: float, swing: float, deflection: float
) -> tuple[float, float, float, float]:
    """Energy in gas, stops, swing spring and tyres [J]."""
    gas = gas_energy(
        stroke,
        gear.pneumatic_area,
        gear.initial_gas_pressure,
        gear.initial_gas_volume,
        gear.polytropic_exponent,
    )
    over = max(0.0, stroke - gear.full_stroke)
    under = max(0.0, -stroke)
    stops = 0.5 * gear.stop_stiffness * (over**2 + under**2)
    stiffness, _ = swing_spring(gear, gear.extended_length - stroke)
    tyre = gear.tyre_count * vertical_energy(
        deflection,
        gear.vertical_coefficient,
        gear.vertical_exponent,
        gear.bottoming_deflection,
        gear.rim_stiffness,
    )
    return gas, stops, 0.5 * stiffness * swing**2, tyre
