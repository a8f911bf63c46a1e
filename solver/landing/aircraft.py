"""The aircraft as the landing simulation sees it: a rigid airframe, its gears, its air loads."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.gear.parameters import Gear
from solver.gear.place import Place, place_of


@dataclass(frozen=True, slots=True)
class Aerodynamics:
    """Drag and angular damping; lift is an input of each landing (`solver.landing.contact.Lift`).

    With air density rho and speed V the drag is ``rho V^2 / 2 * drag_area`` against the velocity,
    and the damping moment about each body axis is ``-rho V * damping * rate``.  Zero by default.
    Sideslip beta, the air coming from starboard, turns the nose into the wind with
    ``rho V^2 / 2 * yaw_stiffness * beta``; without it a rolling aircraft with few loads on its
    wheels is directionally unstable.
    The lift of the landing's input is that at the contact's angle of attack; a change of the angle
    adds ``rho V^2 / 2 * lift_slope_area`` per rad, which takes lift away as the sink is stopped and
    the nose comes down, and damps a bounce.
    Lift and drag act at ``lift_point``; left open it is the whole aircraft's centre of gravity,
    which trims the aircraft at the contact.
    """

    drag_area: float = 0.0  #: C_D S, landing configuration [m2]
    roll_damping: float = 0.0  #: -C_lp S b^2 / 4 [m4]
    pitch_damping: float = 0.0  #: -C_mq S c^2 / 4 [m4]
    yaw_damping: float = 0.0  #: -C_nr S b^2 / 4 [m4]
    yaw_stiffness: float = 0.0  #: C_n_beta S b, weathercock stability [m3/rad]
    air_density: float = 1.225  #: [kg/m3]
    lift_slope_area: float = 0.0  #: C_L_alpha S; 0: lift does not answer to the motion [m2/rad]
    lift_point: Array | None = None  #: (3,) structural axes [m]; None: whole aircraft's c.g.

    def __post_init__(self) -> None:
        for name in self.__slots__[:-1]:
            if not 0 <= getattr(self, name) < np.inf:
                raise ModelError(f"{name} must not be negative, got {getattr(self, name):g}")
        if self.lift_point is not None and np.shape(self.lift_point) != (3,):
            raise ModelError("lift_point needs 3 values")

    @classmethod
    def from_coefficients(
        cls,
        *,
        area: float,
        span: float,
        chord: float,
        drag_coefficient: float = 0.0,
        roll_damping_derivative: float = 0.0,
        pitch_damping_derivative: float = 0.0,
        yaw_damping_derivative: float = 0.0,
        weathercock_derivative: float = 0.0,
        lift_slope: float = 0.0,
        air_density: float = 1.225,
    ) -> Self:
        """Make it from the usual derivatives per rad: C_lp, C_mq, C_nr, negative where they damp.

        The weathercock derivative C_n_beta is positive where it turns the nose into the wind.

        The rates are made dimensionless with b/2V and c/2V, so that each moment is
        ``rho V^2 / 2 * S * b * C_lp * (p b / 2V)`` and so on (ISO 1151-2).
        """
        return cls(
            drag_area=drag_coefficient * area,
            roll_damping=-roll_damping_derivative * area * span**2 / 4,
            pitch_damping=-pitch_damping_derivative * area * chord**2 / 4,
            yaw_damping=-yaw_damping_derivative * area * span**2 / 4,
            yaw_stiffness=weathercock_derivative * area * span,
            lift_slope_area=lift_slope * area,
            air_density=air_density,
        )


@dataclass(frozen=True, slots=True)
class LandingAircraft:
    """A rigid airframe WITHOUT the unsprung masses of its gears, and the gears."""

    mass: float  #: of the airframe, unsprung masses left out [kg]
    centre_of_gravity: Array  #: (3,) of the airframe, structural axes [m]
    inertia: (
        Array  #: (3, 3) tensor about that point, structural axes, +integral(r2 I - r r') [kg m2]
    )
    gears: tuple[Gear, ...]
    aerodynamics: Aerodynamics = Aerodynamics()

    def __post_init__(self) -> None:
        if not self.mass > 0:
            raise ModelError(f"mass must be above 0, got {self.mass:g} kg")
        if np.shape(self.centre_of_gravity) != (3,) or np.shape(self.inertia) != (3, 3):
            raise ModelError("centre_of_gravity needs 3 values and inertia 3 x 3")
        moments = np.linalg.eigvalsh((self.inertia + self.inertia.T) / 2)
        # No body violates the triangle inequality of the principal moments of inertia.
        if not (moments[0] > 0 and moments[2] <= (moments[0] + moments[1]) * (1 + 1e-9)):
            raise ModelError(f"no body has the principal moments of inertia {moments} kg m2")
        if not np.allclose(self.inertia, self.inertia.T, rtol=0, atol=1e-9 * moments[2]):
            raise ModelError("inertia must be symmetric")
        names = [gear.name for gear in self.gears]
        if not names or len(set(names)) != len(names):
            raise ModelError(f"gears need distinct names, got {names}")

    def on_runway(self, friction: float) -> Self:
        """Aircraft on a runway of which the largest coefficient of friction is known.

        What the tyres keep when they slide goes with it.
        """
        gears = tuple(
            replace(
                gear,
                tyre=replace(
                    gear.tyre,
                    maximum_friction=friction,
                    minimum_friction=gear.tyre.minimum_friction
                    * (friction / gear.tyre.maximum_friction),
                ),
            )
            for gear in self.gears
        )
        return replace(self, gears=gears)

    @property
    def nose_gears(self) -> tuple[int, ...]:
        """Which of the gears are the nose's."""
        places = [place_of(gear, self.gears) for gear in self.gears]
        return tuple(index for index, place in enumerate(places) if place is Place.NOSE)

    @property
    def total_mass(self) -> float:
        """Airframe and unsprung masses [kg]."""
        return self.mass + sum(gear.unsprung_mass for gear in self.gears)

    @property
    def total_centre_of_gravity(self) -> Array:
        """Of airframe and unsprung masses, struts extended; (3,) structural axes [m]."""
        moment = self.mass * self.centre_of_gravity
        for gear in self.gears:
            moment = moment + gear.unsprung_mass * gear.extended_axle
        return np.asarray(moment / self.total_mass)
