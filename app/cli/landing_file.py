"""Input of `hardlanding simulate`: a contact, its lift, and optionally the aircraft in full.

SI units, named in the keys; angles in rad.  Positions are structural axes: x aft, y starboard,
z up.  Signs of the contact: sink rate down, pitch nose up, roll starboard wing down, drift nose
right of the track.
"""

from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.cli.demo import EXAMPLE_AIRCRAFT
from solver.gear.parameters import Gear, Pin, SpringBack, Strut, Tyre
from solver.landing.aircraft import Aerodynamics, LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.simulate import SimulationOptions

Vector = Annotated[list[float], Field(min_length=3, max_length=3)]


class _Part(BaseModel):
    """Fields carry the solver's names and, as alias, the file's keys with their units."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)

    def given(self) -> dict[str, Any]:
        """What the file says, under the solver's names."""
        return {name: getattr(self, name) for name in self.model_fields_set}


class LiftPart(_Part):
    """See `solver.landing.contact.Lift`."""

    model: Literal["held", "decaying", "trimmed"] = "decaying"
    fraction: Annotated[float, Field(ge=0, le=2.5)] = 1.0
    decay_start: Annotated[float, Field(ge=0, le=60, alias="decay_start_s")] = 0.5
    decay_time: Annotated[float, Field(gt=0, le=60, alias="decay_time_s")] = 1.0
    residual_fraction: Annotated[float, Field(ge=0, le=2.5)] = 0.3
    recorded_normal_acceleration: Annotated[
        float | None, Field(ge=0, le=2.5, alias="recorded_normal_acceleration_g")
    ] = None

    def lift(self) -> Lift:
        """As the solver takes it."""
        return Lift(**(self.given() | {"model": LiftModel(self.model)}))


class ContactPart(_Part):
    """See `solver.landing.contact.Contact`."""

    sink_rate: Annotated[float, Field(ge=0.01, le=15, alias="sink_rate_m_s")]
    ground_speed: Annotated[float, Field(ge=5, le=150, alias="ground_speed_m_s")]
    pitch: Annotated[float, Field(ge=-0.6, le=0.6, alias="pitch_rad")] = 0.0
    roll: Annotated[float, Field(ge=-0.6, le=0.6, alias="roll_rad")] = 0.0
    drift: Annotated[float, Field(ge=-0.6, le=0.6, alias="drift_rad")] = 0.0
    pitch_rate: Annotated[float, Field(ge=-2, le=2, alias="pitch_rate_rad_s")] = 0.0
    roll_rate: Annotated[float, Field(ge=-2, le=2, alias="roll_rate_rad_s")] = 0.0
    yaw_rate: Annotated[float, Field(ge=-2, le=2, alias="yaw_rate_rad_s")] = 0.0


class StrutPart(_Part):
    """See `solver.gear.parameters.Strut`, which checks the values."""

    pneumatic_area: Annotated[float, Field(alias="pneumatic_area_m2")]
    initial_gas_pressure: Annotated[float, Field(alias="initial_gas_pressure_pa")]
    initial_gas_volume: Annotated[float, Field(alias="initial_gas_volume_m3")]
    polytropic_exponent: float
    compression_coefficient: Annotated[float, Field(alias="compression_coefficient_n_s2_m2")]
    rebound_coefficient: Annotated[float, Field(alias="rebound_coefficient_n_s2_m2")]
    full_stroke: Annotated[float, Field(alias="full_stroke_m")]
    extended_length: Annotated[float, Field(alias="extended_length_m")]
    metering: Annotated[
        list[Annotated[list[float], Field(min_length=2, max_length=2)]],
        Field(alias="metering_stroke_m_and_area_ratio"),
    ] = []
    stop_stiffness: Annotated[float, Field(alias="stop_stiffness_n_m")] = 2e7
    stop_damping: Annotated[float, Field(alias="stop_damping_s_m")] = 0.5
    seal_friction: Annotated[float, Field(alias="seal_friction_n")] = 0.0

    def strut(self) -> Strut:
        """As the solver takes it."""
        metering = tuple((stroke, ratio) for stroke, ratio in self.metering)
        return Strut(**(self.given() | {"metering": metering}))


class TyrePart(_Part):
    """See `solver.gear.parameters.Tyre`, which checks the values; per tyre."""

    free_radius: Annotated[float, Field(alias="free_radius_m")]
    vertical_coefficient: Annotated[float, Field(alias="vertical_coefficient_n_per_m_r")]
    vertical_exponent: float
    longitudinal_stiffness: Annotated[float, Field(alias="longitudinal_stiffness_n")]
    cornering_stiffness: Annotated[float, Field(alias="cornering_stiffness_n_rad")]
    maximum_friction: float
    minimum_friction: float
    width: Annotated[float, Field(alias="width_m")]
    wheel_inertia: Annotated[float, Field(alias="wheel_inertia_kg_m2")]
    count: int = 1
    bottoming_deflection: Annotated[float, Field(alias="bottoming_deflection_m")] = np.inf
    bottoming_stiffness: Annotated[float | None, Field(alias="bottoming_stiffness_n_m")] = None
    rolling_resistance: Annotated[float, Field(alias="rolling_resistance_m")] = 0.0
    rolling_share: float = 1 / 3
    vertical_damping: Annotated[float, Field(alias="vertical_damping_s_m")] = 0.0
    crown_radius: Annotated[float | None, Field(alias="crown_radius_m")] = None
    wheel_transverse_inertia: Annotated[
        float | None, Field(alias="wheel_transverse_inertia_kg_m2")
    ] = None


class SpringBackPart(_Part):
    """Fore-aft swing of constant stiffness."""

    stiffness: Annotated[float, Field(gt=0, alias="stiffness_n_m_rad")]
    damping_ratio: Annotated[float, Field(ge=0, le=1)] = 0.04


class PinPart(_Part):
    """See `solver.gear.parameters.Pin`."""

    name: str
    position: Annotated[Vector, Field(alias="position_m")]
    stiffness: Annotated[
        list[float], Field(min_length=6, max_length=6, alias="stiffness_n_m_and_n_m_rad")
    ]


class GearPart(_Part):
    """See `solver.gear.parameters.Gear`; without spring_back the leg is rigid."""

    name: str
    unsprung_mass: Annotated[float, Field(gt=0, alias="unsprung_mass_kg")]
    pivot: Annotated[Vector, Field(alias="pivot_m")]
    axis: Vector = [0.0, 0.0, -1.0]
    strut: StrutPart
    tyre: TyrePart
    spring_back: SpringBackPart | None = None
    pins: list[PinPart] = []

    def gear(self) -> Gear:
        """As the solver takes it."""
        spring_back = SpringBack.rigid()
        if self.spring_back is not None:
            spring_back = SpringBack(**self.spring_back.given())
        return Gear(
            name=self.name,
            strut=self.strut.strut(),
            tyre=Tyre(**self.tyre.given()),
            spring_back=spring_back,
            unsprung_mass=self.unsprung_mass,
            pivot=np.array(self.pivot),
            axis=np.array(self.axis),
            pins=tuple(
                Pin(pin.name, np.array(pin.position), np.array(pin.stiffness)) for pin in self.pins
            ),
        )


class AerodynamicsPart(_Part):
    """See `solver.landing.aircraft.Aerodynamics`."""

    drag_area: Annotated[float, Field(ge=0, alias="drag_area_m2")] = 0.0
    roll_damping: Annotated[float, Field(ge=0, alias="roll_damping_m4")] = 0.0
    pitch_damping: Annotated[float, Field(ge=0, alias="pitch_damping_m4")] = 0.0
    yaw_damping: Annotated[float, Field(ge=0, alias="yaw_damping_m4")] = 0.0
    lift_slope_area: Annotated[float, Field(ge=0, alias="lift_slope_area_m2_rad")] = 0.0
    air_density: Annotated[float, Field(gt=0, le=2, alias="air_density_kg_m3")] = 1.225
    lift_point: Annotated[Vector | None, Field(alias="lift_point_m")] = None

    def aerodynamics(self) -> Aerodynamics:
        """As the solver takes it."""
        given = self.given()
        if self.lift_point is not None:
            given["lift_point"] = np.array(self.lift_point)
        return Aerodynamics(**given)


class AircraftPart(_Part):
    """An aircraft in full: the airframe without the unsprung masses, and its gears."""

    mass: Annotated[float, Field(gt=0, alias="airframe_mass_kg")]
    centre_of_gravity: Annotated[Vector, Field(alias="airframe_centre_of_gravity_m")]
    inertia: Annotated[
        list[Vector], Field(min_length=3, max_length=3, alias="airframe_inertia_kg_m2")
    ]
    gears: Annotated[list[GearPart], Field(min_length=1)]
    aerodynamics: AerodynamicsPart = AerodynamicsPart()

    def aircraft(self) -> LandingAircraft:
        """As the solver takes it."""
        return LandingAircraft(
            mass=self.mass,
            centre_of_gravity=np.array(self.centre_of_gravity),
            inertia=np.array(self.inertia),
            gears=tuple(gear.gear() for gear in self.gears),
            aerodynamics=self.aerodynamics.aerodynamics(),
        )


class OptionsPart(_Part):
    """See `solver.landing.simulate.SimulationOptions`."""

    output_interval: Annotated[float, Field(ge=1e-5, le=0.01, alias="output_interval_s")] = 1e-3
    time_limit: Annotated[float, Field(gt=0, le=60, alias="time_limit_s")] = 4.0
    stop_when_settled: bool = True

    def options(self) -> SimulationOptions:
        """As the solver takes it."""
        return SimulationOptions(**self.given())


class LandingFile(_Part):
    """One landing.

    The aircraft is either described in full, or that of a folder by ``aircraft`` (the example's
    unless named) in the loading state that ``mass_kg``, ``fuel_kg`` and ``payload_kg`` ask for.
    """

    contact: ContactPart
    lift: LiftPart = LiftPart()
    aircraft: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]*$")] = EXAMPLE_AIRCRAFT
    mass: Annotated[float | None, Field(gt=0, alias="mass_kg")] = None
    fuel: Annotated[dict[str, float], Field(alias="fuel_kg")] = {}
    payload: Annotated[dict[str, float], Field(alias="payload_kg")] = {}
    aircraft_description: AircraftPart | None = None
    options: OptionsPart = OptionsPart()

    @model_validator(mode="after")
    def _one_aircraft(self) -> Self:
        folder_keys = {"aircraft", "mass", "fuel", "payload"} & self.model_fields_set
        if self.aircraft_description is not None and folder_keys:
            raise ValueError(
                f"aircraft_description leaves nothing to say to {', '.join(sorted(folder_keys))}"
            )
        return self

    def landing_contact(self) -> Contact:
        """Contact with its lift."""
        return Contact(**self.contact.given(), lift=self.lift.lift())
