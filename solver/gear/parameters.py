"""What describes one landing gear: strut, tyres, spring-back, pins.  SI units, structural axes.

The values are checked when they are made, so that a force law never meets an impossible gear.
"""

import math
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError


def hydraulic_coefficient(
    fluid_density: float, hydraulic_area: float, discharge_coefficient: float, orifice_area: float
) -> float:
    """Force of the oil per square of the closure rate, rho A_h^3 / (2 (C_d A_n)^2) [N s2/m2].

    Parameters
    ----------
    fluid_density : float
        rho [kg/m3].
    hydraulic_area : float
        A_h [m2].
    discharge_coefficient : float
        C_d.
    orifice_area : float
        Net orifice area A_n, the metering pin's section taken off [m2].

    Notes
    -----
    Milwitzky & Cook, NACA Report 1154 (1953); Bernoulli's equation and continuity.
    """
    return fluid_density * hydraulic_area**3 / (2 * (discharge_coefficient * orifice_area) ** 2)


@dataclass(frozen=True, slots=True)
class Strut:
    """Oleo-pneumatic shock strut.

    The oil's force is ``compression_coefficient / ratio(s)^2 * rate^2`` while the strut closes and
    ``rebound_coefficient * rate^2`` while it extends.  ``ratio`` is the net orifice area over the
    area that belongs to ``compression_coefficient``; it is 1 without a metering pin.
    """

    pneumatic_area: float  #: A_a [m2]
    initial_gas_pressure: float  #: p_0 at full extension, above the atmosphere [Pa]
    initial_gas_volume: float  #: V_0 at full extension [m3]
    polytropic_exponent: float  #: n
    compression_coefficient: float  #: C_orf [N s2/m2], see `hydraulic_coefficient`
    rebound_coefficient: float  #: C_reb [N s2/m2]
    full_stroke: float  #: from full extension to the closed stop [m]
    extended_length: float  #: L_0, pivot to axle at full extension [m]
    metering: tuple[tuple[float, float], ...] = ()  #: (stroke [m], area ratio), linear between
    stop_stiffness: float = 2.0e7  #: of the stops at both ends [N/m]
    stop_damping: float = 0.5  #: of the stops, force k d (1 + c d') [s/m]
    seal_friction: float = 0.0  #: constant friction of seals and bearings; off by default [N]
    friction_speed: float = 0.01  #: closure rate below which friction fades to zero [m/s]

    def __post_init__(self) -> None:
        _positive(
            self,
            "pneumatic_area",
            "initial_gas_pressure",
            "initial_gas_volume",
            "polytropic_exponent",
            "full_stroke",
            "extended_length",
            "stop_stiffness",
            "friction_speed",
        )
        _not_negative(
            self,
            "compression_coefficient",
            "rebound_coefficient",
            "stop_damping",
            "seal_friction",
        )
        reach = self.initial_gas_volume / self.pneumatic_area
        if self.full_stroke >= reach:
            raise ModelError(
                f"full_stroke {self.full_stroke:g} m must be below the {reach:g} m "
                "at which the gas volume is used up"
            )
        if self.full_stroke >= self.extended_length:
            raise ModelError(
                f"full_stroke {self.full_stroke:g} m must be below "
                f"extended_length {self.extended_length:g} m"
            )
        strokes = [stroke for stroke, _ in self.metering]
        if strokes != sorted(set(strokes)):
            raise ModelError(f"metering strokes must ascend, got {strokes}")
        if any(not ratio > 0 for _, ratio in self.metering):
            raise ModelError("metering area ratios must be above 0")
        if len(self.metering) > METERING_POINTS:
            raise ModelError(f"metering has {len(self.metering)} points, {METERING_POINTS} at most")

    @property
    def preload(self) -> float:
        """Gas force at full extension, which the extension stop carries [N]."""
        return self.initial_gas_pressure * self.pneumatic_area


#: Longest metering-pin table.
METERING_POINTS = 32


@dataclass(frozen=True, slots=True)
class Tyre:
    """Tyres of one axle; forces and stiffnesses are PER TYRE, ``count`` of them act alike."""

    free_radius: float  #: R [m]
    vertical_coefficient: float  #: m of F = m d^r [N/m^r]
    vertical_exponent: float  #: r
    longitudinal_stiffness: float  #: C_slip, force per unit slip [N]
    cornering_stiffness: float  #: C_alpha, force per unit slip angle [N/rad]
    maximum_friction: float  #: mu at zero slip
    minimum_friction: float  #: mu at full slip
    width: float  #: [m]
    wheel_inertia: float  #: of one wheel and tyre about its axle [kg m2]
    count: int = 1
    bottoming_deflection: float = math.inf  #: d_b where the carcass meets the rim [m]
    bottoming_stiffness: float | None = None  #: beyond d_b, added; None: see below [N/m]
    rolling_resistance: float = 0.0  #: moment per vertical force [m]
    rolling_share: float = 1 / 3  #: of the deflection by which the rolling radius shrinks
    vertical_damping: float = 0.0  #: force times (1 + c d') [s/m]
    crown_radius: float | None = None  #: of the tread across the tyre; None: half the width [m]
    wheel_transverse_inertia: float | None = None  #: None: thin disc, half the spin one [kg m2]

    def __post_init__(self) -> None:
        _positive(
            self,
            "free_radius",
            "vertical_coefficient",
            "longitudinal_stiffness",
            "cornering_stiffness",
            "maximum_friction",
            "minimum_friction",
            "width",
            "wheel_inertia",
            "bottoming_deflection",
        )
        _not_negative(self, "rolling_resistance", "vertical_damping")
        if not 1.0 <= self.vertical_exponent <= 3.0:
            raise ModelError(f"vertical_exponent {self.vertical_exponent:g} must be in 1 to 3")
        if self.count < 1:
            raise ModelError(f"count {self.count} must be 1 or more")
        if self.minimum_friction > self.maximum_friction:
            raise ModelError(
                f"minimum_friction {self.minimum_friction:g} must not exceed "
                f"maximum_friction {self.maximum_friction:g}"
            )

    @property
    def rim_stiffness(self) -> float:
        """Stiffness added beyond the bottoming deflection [N/m].

        Unless given, ten times the tangent stiffness of the power law at that deflection: a
        bottomed tyre squeezes rubber between rim and ground, an order of magnitude stiffer than
        the inflated carcass.  The constant of NACA Report 1154 for its bottoming regime was not at
        hand; the choice is an assumption and should be replaced by the maker's curve.
        """
        if self.bottoming_stiffness is not None:
            return self.bottoming_stiffness
        if math.isinf(self.bottoming_deflection):
            return 0.0
        r = self.vertical_exponent
        slope: float = self.vertical_coefficient * r * self.bottoming_deflection ** (r - 1)
        return 10.0 * slope

    @property
    def tread_radius(self) -> float:
        """Crown radius of the tread with its default [m]."""
        return self.width / 2 if self.crown_radius is None else self.crown_radius

    @property
    def transverse_inertia(self) -> float:
        """Inertia of one wheel about a diameter, with its default [kg m2]."""
        if self.wheel_transverse_inertia is None:
            return self.wheel_inertia / 2
        return self.wheel_transverse_inertia


@dataclass(frozen=True, slots=True)
class SpringBack:
    """Fore-aft bending of the leg, a rotational spring at the pivot with damping.

    Either ``stiffness`` is constant, or the two-tube form varies with the stroke: a cylinder of
    bending stiffness ``cylinder_rigidity`` over ``cylinder_length`` from the pivot, then a piston
    of ``piston_rigidity`` down to the axle, both in series with ``attachment_stiffness``.
    """

    stiffness: float = math.inf  #: constant k_theta [N m/rad]; unused by the two-tube form
    damping_ratio: float = 0.04
    enabled: bool = True  #: False: rigid leg
    cylinder_rigidity: float = 0.0  #: E1 I1 [N m2]; above 0 chooses the two-tube form
    piston_rigidity: float = 0.0  #: E2 I2 [N m2]
    cylinder_length: float = 0.0  #: L_c [m]
    attachment_stiffness: float = math.inf  #: of pivot and drag brace [N m/rad]

    def __post_init__(self) -> None:
        _not_negative(self, "damping_ratio", "cylinder_length")
        if not self.enabled:
            return
        _positive(self, "attachment_stiffness")
        if self.is_two_tube:
            _positive(self, "piston_rigidity")
        elif not (self.stiffness > 0 and math.isfinite(self.stiffness)):
            raise ModelError(f"spring-back stiffness {self.stiffness} must be above 0 and finite")

    @property
    def is_two_tube(self) -> bool:
        """Whether the stiffness follows the stroke."""
        return self.cylinder_rigidity > 0

    @classmethod
    def rigid(cls) -> Self:
        """No spring-back."""
        return cls(enabled=False)

    @classmethod
    def from_bending(cls, rigidity: float, length: float, damping_ratio: float = 0.04) -> Self:
        """Constant k_theta = 3 E I / L: same axle displacement as a cantilever of length L."""
        return cls(stiffness=3 * rigidity / length, damping_ratio=damping_ratio)

    @classmethod
    def from_frequency(
        cls, frequency: float, unsprung_mass: float, length: float, damping_ratio: float = 0.04
    ) -> Self:
        """Constant k_theta from a fore-aft frequency [Hz] of the unsprung mass at ``length`` [m].

        The length should be that at the stroke of the spin-up (about 0.05 m to 0.10 m closed).
        """
        return cls(
            stiffness=(2 * math.pi * frequency * length) ** 2 * unsprung_mass,
            damping_ratio=damping_ratio,
        )


@dataclass(frozen=True, slots=True)
class Pin:
    """An elastic pin between the gear's fitting and the airframe."""

    name: str
    position: Array  #: (3,) structural axes [m]
    stiffness: Array  #: (6,) along and about the structural axes [N/m, N m/rad]; 0 lets go

    def __post_init__(self) -> None:
        if np.shape(self.position) != (3,) or np.shape(self.stiffness) != (6,):
            raise ModelError(f"pin {self.name}: position needs 3 and stiffness 6 values")
        if not (np.all(np.isfinite(self.position)) and np.all(np.isfinite(self.stiffness))):
            raise ModelError(f"pin {self.name}: position and stiffness must be finite")
        if np.any(np.asarray(self.stiffness) < 0):
            raise ModelError(f"pin {self.name}: stiffness must not be negative")


def _straight_down() -> Array:
    return np.array([0.0, 0.0, -1.0])


@dataclass(frozen=True, slots=True)
class Gear:
    """Everything one landing gear needs."""

    name: str
    strut: Strut
    tyre: Tyre
    spring_back: SpringBack
    unsprung_mass: float  #: lower strut, axle, wheels, tyres; moves with the axle [kg]
    pivot: Array  #: (3,) where the leg meets the airframe, structural axes [m]
    axis: Array = field(default_factory=_straight_down)  #: (3,) pivot to axle, structural axes
    pins: tuple[Pin, ...] = ()

    def __post_init__(self) -> None:
        _positive(self, "unsprung_mass")
        if np.shape(self.pivot) != (3,) or np.shape(self.axis) != (3,):
            raise ModelError(f"gear {self.name}: pivot and axis need 3 values")
        length = float(np.linalg.norm(self.axis))
        if not abs(length - 1) < 1e-6:
            raise ModelError(
                f"gear {self.name}: axis must be a unit vector, its length is {length:g}"
            )
        if self.axis[2] > -0.5:
            raise ModelError(f"gear {self.name}: axis must point down, within 60 deg")

    @property
    def extended_axle(self) -> Array:
        """Position of the axle with the strut fully extended, structural axes (3,) [m]."""
        return np.asarray(self.pivot + self.strut.extended_length * self.axis)


def _positive(value: object, *names: str) -> None:
    for name in names:
        number = getattr(value, name)
        if not number > 0:
            raise ModelError(f"{type(value).__name__}.{name} must be above 0, got {number:g}")


def _not_negative(value: object, *names: str) -> None:
    for name in names:
        number = getattr(value, name)
        if not (number >= 0 and math.isfinite(number)):
            raise ModelError(f"{type(value).__name__}.{name} must not be negative, got {number:g}")
