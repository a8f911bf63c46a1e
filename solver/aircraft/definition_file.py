"""The aircraft definition as an engineer writes it: every key of ``definition.toml`` and its range.

Units stand in the key names, SI throughout.  The ranges are wide enough for any aeroplane and
narrow enough to catch millimetres, pounds and degrees put where metres, kilograms and radians
belong.  Unknown keys are refused.  `solver.aircraft.definition` turns what passes here into the
frozen values the solver uses.
"""

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

Name = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]{0,63}$")]
Text = Annotated[str, Field(min_length=1, max_length=2000)]
Identifier = Annotated[int, Field(ge=1, le=99_999_999)]
Mass = Annotated[float, Field(gt=0, le=1e6)]
Length = Annotated[float, Field(gt=0, le=200)]
Station = Annotated[float, Field(ge=-200, le=200)]
Point = Annotated[list[Station], Field(min_length=3, max_length=3)]
Direction = Annotated[list[Annotated[float, Field(ge=-1, le=1)]], Field(min_length=3, max_length=3)]
Force = Annotated[float, Field(gt=0, le=1e8)]
Stress = Annotated[float, Field(ge=1e6, le=5e9)]
Share = Annotated[float, Field(ge=0, le=1)]
Ratio = Annotated[float, Field(gt=0, lt=1)]
Derivative = Annotated[float, Field(ge=-200, le=0)]
Span = Annotated[list[Identifier], Field(min_length=2, max_length=2)]
#: identifiers one by one or as inclusive pairs [first, last]
Identifiers = Annotated[list[Identifier | Span], Field(min_length=1)]


class Section(BaseModel):
    """A table of the file: exact types, finite numbers, no unknown keys."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class MassesSection(Section):
    """[masses]."""

    operating_empty_kg: Mass  #: with the unsprung masses, without fuel and payload
    maximum_zero_fuel_kg: Mass
    maximum_landing_kg: Mass
    maximum_takeoff_kg: Mass

    @model_validator(mode="after")
    def _in_order(self) -> "MassesSection":
        if not (
            self.operating_empty_kg < self.maximum_zero_fuel_kg <= self.maximum_takeoff_kg
            and self.operating_empty_kg < self.maximum_landing_kg <= self.maximum_takeoff_kg
        ):
            raise ValueError(
                "must rise from operating empty over zero fuel and landing to take-off"
            )
        return self


class ReferenceSection(Section):
    """[reference]: reference geometry and centre-of-gravity range."""

    wing_area_m2: Annotated[float, Field(gt=0, le=2000)]
    wing_span_m: Length
    mean_chord_m: Length
    mean_chord_leading_edge_station_m: Station
    forward_centre_of_gravity_station_m: Station
    aft_centre_of_gravity_station_m: Station

    @model_validator(mode="after")
    def _in_order(self) -> "ReferenceSection":
        if self.forward_centre_of_gravity_station_m >= self.aft_centre_of_gravity_station_m:
            raise ValueError("the forward centre-of-gravity station must be less than the aft one")
        return self


class AerodynamicsSection(Section):
    """[aerodynamics]: what damps and slows the landing aircraft; lift comes with the landing."""

    air_density_kg_m3: Annotated[float, Field(ge=0.5, le=1.6)]
    drag_coefficient: Annotated[float, Field(ge=0, le=1)]
    pitch_damping_per_rad: Derivative  #: C_mq, per q c / (2 V)
    roll_damping_per_rad: Derivative  #: C_lp, per p b / (2 V)
    yaw_damping_per_rad: Derivative  #: C_nr, per r b / (2 V)
    #: C_n_beta, positive where sideslip turns the nose into the wind
    weathercock_per_rad: Annotated[float, Field(ge=0, le=1)] = 0.0
    source: Text = "not stated"


class MeteringSection(Section):
    """One point of the metering pin: orifice area over that of the compression damping."""

    stroke_m: Annotated[float, Field(ge=0, le=2)]
    area_ratio: Annotated[float, Field(gt=0, le=100)]


class StrutSection(Section):
    """[gear_types.X.strut]: oleo-pneumatic shock strut."""

    length_m: Length  #: pivot of the fore-aft swing to the axle at full extension
    stroke_m: Annotated[float, Field(gt=0, le=2)]
    pneumatic_area_m2: Annotated[float, Field(ge=1e-5, le=1)]
    gas_pressure_pa: Annotated[float, Field(ge=1e4, le=1e8)]  #: at full extension, gauge
    gas_volume_m3: Annotated[float, Field(ge=1e-6, le=1)]  #: at full extension
    polytropic_exponent: Annotated[float, Field(ge=1, le=1.7)]
    compression_damping_n_s2_m2: Annotated[float, Field(gt=0, le=1e8)]  #: rho A_h^3/(2 (C_d A_n)^2)
    rebound_damping_n_s2_m2: Annotated[float, Field(gt=0, le=1e8)]
    metering: Annotated[list[MeteringSection], Field(max_length=32)] = []
    stop_stiffness_n_m: Annotated[float, Field(ge=1e4, le=1e10)] = 2.0e7
    seal_friction_n: Annotated[float, Field(ge=0, le=1e6)] = 0.0


class TyreSection(Section):
    """[gear_types.X.tyre]: one tyre of the gear, modified Fiala."""

    designation: Text
    count: Annotated[int, Field(ge=1, le=12)]
    free_radius_m: Annotated[float, Field(gt=0.02, le=2)]
    width_m: Annotated[float, Field(gt=0.01, le=1)]
    stiffness_n_m_r: Annotated[float, Field(ge=1e3, le=1e9)]  #: m of F = m z^r
    exponent: Annotated[float, Field(ge=1, le=3)]  #: r of F = m z^r
    bottoming_deflection_m: Annotated[float, Field(gt=0, le=1)]
    bottoming_stiffness_n_m: Annotated[float, Field(gt=0, le=1e10)] | None = None
    wheel_inertia_kg_m2: Annotated[float, Field(gt=0, le=1000)]  #: of one wheel about its axle
    slip_stiffness_n: Force
    cornering_stiffness_n_rad: Force
    friction_maximum: Annotated[float, Field(gt=0, le=1.5)]
    friction_minimum: Annotated[float, Field(gt=0, le=1.5)]
    rolling_resistance_m: Annotated[float, Field(ge=0, le=0.1)] = 0.0


class SpringBackSection(Section):
    """[gear_types.X.spring_back]: fore-aft bending of the lower strut, stated in one of three ways.

    By the fore-aft frequency of the unsprung mass at ``frequency_stroke_m``, by a rotational
    stiffness, or by cylinder and piston tubes in series with their attachment.
    """

    damping_ratio: Ratio
    frequency_hz: Annotated[float, Field(ge=2, le=200)] | None = None
    frequency_stroke_m: Annotated[float, Field(ge=0, le=2)] = 0.0
    stiffness_n_m_rad: Annotated[float, Field(ge=1e3, le=1e10)] | None = None
    cylinder_rigidity_n_m2: Annotated[float, Field(ge=1e2, le=1e10)] | None = None
    cylinder_length_m: Length | None = None
    piston_rigidity_n_m2: Annotated[float, Field(ge=1e2, le=1e10)] | None = None
    attachment_stiffness_n_m_rad: Annotated[float, Field(ge=1e3, le=1e12)] | None = None

    @model_validator(mode="after")
    def _one_way(self) -> "SpringBackSection":
        tubes = [self.cylinder_rigidity_n_m2, self.cylinder_length_m, self.piston_rigidity_n_m2]
        if any(value is not None for value in tubes) and any(value is None for value in tubes):
            raise ValueError(
                "two tubes need cylinder_rigidity_n_m2, cylinder_length_m and piston_rigidity_n_m2"
            )
        ways = [self.frequency_hz, self.stiffness_n_m_rad, self.cylinder_rigidity_n_m2]
        if sum(way is not None for way in ways) != 1:
            raise ValueError(
                "needs exactly one of frequency_hz, stiffness_n_m_rad and the two-tube keys"
            )
        return self


class LimitsSection(Section):
    """[gear_types.X.limits]: design limit loads of one gear at the ground."""

    vertical_n: Force
    drag_n: Force
    side_n: Force
    source: Text = "not stated"


class GearTypeSection(Section):
    """[gear_types.X]: what port and starboard gear have in common."""

    unsprung_mass_kg: Annotated[float, Field(gt=0, le=20_000)]
    strut: StrutSection
    tyre: TyreSection
    spring_back: SpringBackSection
    limits: LimitsSection


class PinSection(Section):
    """[[gears.pins]]: one attachment of a gear to the airframe."""

    name: Name
    node: Identifier  #: GRID of the bulk data
    translational_stiffness_n_m: Annotated[
        list[Annotated[float, Field(ge=0, le=1e12)]], Field(min_length=3, max_length=3)
    ]
    rotational_stiffness_n_m_rad: Annotated[
        list[Annotated[float, Field(ge=0, le=1e12)]], Field(min_length=3, max_length=3)
    ]


class GearSection(Section):
    """[[gears]]: one gear."""

    name: Name
    type: Name
    position: Literal["nose", "main"]
    pivot_m: Point  #: hinge of the fore-aft swing, structural axes
    axis: Direction  #: from the pivot to the axle, structural axes
    pins: Annotated[list[PinSection], Field(min_length=1, max_length=12)]


class MassGroupSection(Section):
    """[[tanks]] and [[bays]]: CONM2 cards that make up the full group."""

    name: Name
    capacity_kg: Mass
    conm2: Identifiers
    default_fill: Share = 0.0


class PlanformSection(Section):
    """One chord of a lifting surface: position along its span, leading edge, chord."""

    span_position_m: Station
    leading_edge_station_m: Station
    chord_m: Length


class SurfaceSection(Section):
    """[air_loads.wing], [air_loads.tail], [air_loads.fin]: who carries the load, and its law."""

    properties: Identifiers | None = None  #: PSHELL or PBAR(L) identifiers of the loaded skin
    nodes: Identifiers | None = None  #: GRID identifiers; with `properties`, both must hold
    law: Literal["schrenk", "uniform"] = "schrenk"
    centre_of_pressure: Ratio = 0.25  #: fraction of the chord
    planform: Annotated[list[PlanformSection], Field(min_length=2, max_length=50)]

    @model_validator(mode="after")
    def _consistent(self) -> "SurfaceSection":
        if self.properties is None and self.nodes is None:
            raise ValueError("needs properties or nodes")
        positions = [station.span_position_m for station in self.planform]
        if any(b <= a for a, b in pairwise(positions)):
            raise ValueError("planform span positions must rise from root to tip")
        return self


class FuselageSection(Section):
    """[air_loads.fuselage]: carries side force and its share of the drag by skin area."""

    properties: Identifiers | None = None
    nodes: Identifiers | None = None
    drag_share: Share = 0.5  #: of the aircraft's drag; the wing carries the rest

    @model_validator(mode="after")
    def _named(self) -> "FuselageSection":
        if self.properties is None and self.nodes is None:
            raise ValueError("needs properties or nodes")
        return self


class AirLoadsSection(Section):
    """[air_loads]."""

    wing: SurfaceSection
    tail: SurfaceSection
    fin: SurfaceSection
    fuselage: FuselageSection


class MaterialSection(Section):
    """[[materials]]: limit allowable of a MAT1."""

    name: Text
    mat1: Identifier
    limit_allowable_pa: Stress
    source: Text = "not stated"


class ZoneSection(Section):
    """[[zones]]: a piece of the airframe that an inspector can be sent to."""

    name: Text
    component: Text
    side: Literal["port", "starboard", "centre"]
    ata_chapter: Annotated[str, Field(pattern=r"^\d{2}(-\d{2}){0,2}$")]
    properties: Identifiers
    look_for: Text
    access: Text = "not stated"
    shell_limit_allowable_pa: Stress | None = None  #: replaces the material's
    beam_limit_allowable_pa: Stress | None = None  #: replaces the material's


class StructureSection(Section):
    """[structure]."""

    modal_damping_ratio: Annotated[float, Field(ge=0, le=0.2)]
    source: Text = "not stated"


class VerdictSection(Section):
    """[verdict]: utilisation is peak stress over limit allowable, or gear load over limit load."""

    firm_utilisation: Ratio  #: from here FIRM
    inspect_utilisation: Ratio  #: from here INSPECT; HARD from 1
    overweight_factor: Annotated[float, Field(gt=0, le=1)]  #: on both above maximum landing mass
    roll_limit_deg: Annotated[float, Field(gt=0, le=45)]  #: at a contact, from here INSPECT
    nose_first: Literal["NORMAL", "FIRM", "INSPECT", "HARD"]  #: least verdict, nose gear first
    #: vertical speed of the nose wheel at its touchdown, from here INSPECT.  By itself a nose comes
    #: down at up to 1.7 m/s; nose gears were damaged inside below their limit loads.
    nose_closure_limit_m_s: Annotated[float, Field(gt=0, le=6)] = 2.0
    #: what a missed exceedance costs over what a needless inspection costs
    missed_over_needless_cost: Annotated[float, Field(ge=1, le=1e4)] = 20.0
    hard_probability: Annotated[float, Field(gt=0, lt=1)] = 0.9  #: from here HARD
    #: maker's hard-landing rule: one of the program's by name, or a file (*.toml) in this folder
    makers_rule: Annotated[str, Field(pattern=r"^[\w-][\w.-]{0,99}$")] | None = None
    source: Text = "not stated"

    @model_validator(mode="after")
    def _in_order(self) -> "VerdictSection":
        if self.firm_utilisation >= self.inspect_utilisation:
            raise ValueError("firm_utilisation must be less than inspect_utilisation")
        if self.hard_probability * (1.0 + self.missed_over_needless_cost) <= 1.0:
            raise ValueError(
                "hard_probability must be more than 1 / (1 + missed_over_needless_cost), from "
                "which a landing is inspected"
            )
        return self


RelativeDeviation = Annotated[float, Field(ge=0, le=0.5)]


class ScatterSection(Section):
    """[scatter]: standard deviations of what nobody records, see `solver.aircraft.scatter`."""

    gas_pressure_relative_sd: RelativeDeviation = 0.05
    strut_damping_relative_sd: RelativeDeviation = 0.08
    tyre_stiffness_relative_sd: RelativeDeviation = 0.05
    tyre_friction_relative_sd: RelativeDeviation = 0.15
    lift_decay_start_sd_s: Annotated[float, Field(ge=0, le=5)] = 0.125
    lift_decay_time_relative_sd: RelativeDeviation = 0.25
    residual_lift_fraction_sd: Annotated[float, Field(ge=0, le=0.5)] = 0.08
    structural_damping_relative_sd: RelativeDeviation = 0.25
    allowable_relative_sd: Annotated[float, Field(ge=0, le=0.3)] = 0.0
    allowable_basis: Literal["limit", "A", "B"] = "limit"
    source: Text = "not stated"


class DefinitionFile(Section):
    """The whole file."""

    name: Name
    title: Text
    description: Text
    disclaimer: Text
    bulk_data: Annotated[str, Field(pattern=r"^[\w.-]+$")]  #: file name in the same folder
    masses: MassesSection
    reference: ReferenceSection
    aerodynamics: AerodynamicsSection
    structure: StructureSection
    verdict: VerdictSection
    scatter: ScatterSection = ScatterSection()
    gear_types: Annotated[dict[Name, GearTypeSection], Field(min_length=1)]
    gears: Annotated[list[GearSection], Field(min_length=1, max_length=12)]
    tanks: list[MassGroupSection] = []
    bays: list[MassGroupSection] = []
    air_loads: AirLoadsSection
    materials: Annotated[list[MaterialSection], Field(min_length=1)]
    zones: Annotated[list[ZoneSection], Field(min_length=1)]
