"""What a landing simulation returns: histories, contacts, peaks and the energy account."""

from dataclasses import dataclass
from enum import StrEnum

from solver.arrays import Array


class Outcome(StrEnum):
    """Why the simulation stopped."""

    SETTLED = "settled"  #: every gear has passed its peak and the aircraft rolls
    TIME_LIMIT = "time_limit"  #: the stated limit came first


@dataclass(frozen=True, slots=True)
class GroundContact:
    """One stay of one gear on the ground."""

    gear: str
    start: float  #: [s]
    end: float | None  #: lift-off, None while still on the ground [s]
    peak_ground_force: float  #: normal to the ground [N]
    peak_time: float  #: [s]
    peak_strut_force: float  #: along the strut [N]
    peak_stroke: float  #: [m]
    closure_speed: float  #: vertical speed of the gear's wheel at `start`, downward positive [m/s]


@dataclass(frozen=True, slots=True)
class GearHistory:
    """Histories of one gear on the common time grid.

    Forces and moments are those of the gear ON THE AIRFRAME, body axes; ``wrench`` is taken about
    ``reference_point``.  Ground forces act on the tyre, earth axes (x along the track, z down, so
    a supporting force has negative z).
    """

    name: str
    reference_point: Array  #: (3,) structural axes [m]
    strut_force: Array  #: (nt,) axial, compression positive [N]
    ground_force: Array  #: (nt, 3) [N]
    stroke: Array  #: (nt,) [m]
    stroke_rate: Array  #: (nt,) [m/s]
    tyre_deflection: Array  #: (nt,) [m]
    wheel_speed: Array  #: (nt,) [rad/s]
    bending_angle: Array  #: (nt,) fore-aft swing of the lower strut, aft positive [rad]
    wrench: Array  #: (nt, 6) force and moment on the airframe [N, N m]
    pin_positions: Array  #: (n_pins, 3) structural axes [m]
    pin_loads: Array  #: (nt, n_pins, 6) on the airframe, body axes [N, N m]


@dataclass(frozen=True, slots=True)
class EnergyAccount:
    """Histories of every store and sink of energy [J], each (nt,)."""

    kinetic: Array
    potential: Array
    gas: Array
    tyre: Array
    strut_bending: Array
    stops: Array
    dissipated_hydraulic: Array
    dissipated_tyre: Array
    dissipated_other: Array
    lift_work: Array
    impact_energy: float  #: kinetic energy of the sink at the contact [J]
    closure_error: float  #: largest imbalance over the run divided by the impact energy


@dataclass(frozen=True, slots=True)
class LandingHistory:
    """One simulated landing on a uniform time grid.

    Accelerations are those of the airframe (without the unsprung masses) at its own centre of
    gravity ``origin``; they satisfy the airframe's equations of motion at every sample to rounding,
    so that the loads given to the structure balance.  Body axes unless said otherwise.
    """

    time: Array  #: (nt,) from the first ground contact [s]
    origin: Array  #: (3,) structural axes, the airframe's centre of gravity [m]
    position: Array  #: (nt, 3) of the origin, earth axes [m]
    attitude: Array  #: (nt, 4) quaternion, body to earth
    velocity: Array  #: (nt, 3) of the origin, body components [m/s]
    acceleration: Array  #: (nt, 3) of the origin, inertial, body components [m/s2]
    gravity: Array  #: (nt, 3) body components [m/s2]
    rate: Array  #: (nt, 3) body rate [rad/s]
    rate_derivative: Array  #: (nt, 3) [rad/s2]
    normal_load_factor: Array  #: (nt,) at the whole aircraft's centre of gravity, +1 at rest [g]
    air_wrench: Array  #: (nt, 6) air loads about the origin [N, N m]
    gears: tuple[GearHistory, ...]
    contacts: tuple[GroundContact, ...]
    energy: EnergyAccount
    outcome: Outcome
