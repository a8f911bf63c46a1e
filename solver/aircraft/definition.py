"""The aircraft definition: one readable file that says all that the bulk data does not.

`solver.aircraft.definition_reader` reads it; its keys and ranges are in
`solver.aircraft.definition_file`.  Angles are rad, everything else SI, points in structural axes.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from solver.aircraft.scatter import Scatter
from solver.arrays import Array, BoolArray
from solver.assessment import Verdict
from solver.gear.parameters import Gear, Pin, SpringBack, Strut, Tyre

#: Name of the definition in an aircraft's folder.
DEFINITION_FILE = "definition.toml"


@dataclass(frozen=True, slots=True)
class IdentifierSet:
    """Identifiers of cards as inclusive ranges."""

    ranges: tuple[tuple[int, int], ...]

    def contains(self, identifiers: ArrayLike) -> BoolArray:
        """Which of ``identifiers`` belong to the set; same shape."""
        values = np.asarray(identifiers)
        inside = np.zeros(values.shape, dtype=bool)
        for first, last in self.ranges:
            inside |= (values >= first) & (values <= last)
        return inside

    def __str__(self) -> str:
        return ", ".join(f"{a}" if a == b else f"{a}-{b}" for a, b in self.ranges)


@dataclass(frozen=True, slots=True)
class Masses:
    """Design masses [kg]; operating empty holds the unsprung masses, but no fuel or payload."""

    operating_empty: float
    maximum_zero_fuel: float
    maximum_landing: float
    maximum_takeoff: float


@dataclass(frozen=True, slots=True)
class Reference:
    """Reference geometry and centre-of-gravity range; stations along structural x [m]."""

    wing_area: float  #: [m2]
    wing_span: float  #: [m]
    mean_chord: float  #: [m]
    mean_chord_leading_edge: float  #: [m]
    forward_centre_of_gravity: float  #: [m]
    aft_centre_of_gravity: float  #: [m]

    def chord_fraction(self, station: float) -> float:
        """Position of a station on the mean aerodynamic chord, 0 at its leading edge."""
        return (station - self.mean_chord_leading_edge) / self.mean_chord


@dataclass(frozen=True, slots=True)
class AerodynamicDerivatives:
    """What damps and slows the landing aircraft, about its centre of gravity, per rad."""

    air_density: float  #: [kg/m3]
    drag_coefficient: float
    pitch_damping: float  #: C_mq, per q c / (2 V)
    roll_damping: float  #: C_lp, per p b / (2 V)
    yaw_damping: float  #: C_nr, per r b / (2 V)
    weathercock: float  #: C_n_beta, positive where sideslip turns the nose into the wind


@dataclass(frozen=True, slots=True)
class GearLimits:
    """Design limit loads of one gear at the ground [N]."""

    vertical: float
    drag: float
    side: float


@dataclass(frozen=True, slots=True)
class PinDefinition:
    """One attachment of a gear to the airframe."""

    name: str
    node: int  #: GRID of the bulk data
    stiffness: Array  #: (6,) structural axes [N/m, N m/rad]


@dataclass(frozen=True, slots=True)
class GearDefinition:
    """One gear: its mechanics, where it sits, how it is held and what it may carry."""

    name: str
    position: str  #: "nose" or "main"
    strut: Strut
    tyre: Tyre
    spring_back: SpringBack
    unsprung_mass: float  #: [kg]
    pivot: Array  #: (3,) hinge of the fore-aft swing, structural axes [m]
    axis: Array  #: (3,) unit vector from the pivot to the axle, structural axes
    pins: tuple[PinDefinition, ...]
    limits: GearLimits

    def gear(self, pin_positions: Array) -> Gear:
        """Gear on pins at ``pin_positions`` (n_pins, 3), structural axes [m]."""
        return Gear(
            name=self.name,
            strut=self.strut,
            tyre=self.tyre,
            spring_back=self.spring_back,
            unsprung_mass=self.unsprung_mass,
            pivot=self.pivot,
            axis=self.axis,
            pins=tuple(
                Pin(name=pin.name, position=position, stiffness=pin.stiffness)
                for pin, position in zip(self.pins, pin_positions, strict=True)
            ),
        )


@dataclass(frozen=True, slots=True)
class MassGroup:
    """A tank or a payload bay: the CONM2 cards that make it up when full."""

    name: str
    capacity: float  #: [kg]
    point_masses: IdentifierSet  #: CONM2 element identifiers
    default_fill: float  #: share of the capacity assumed when a record says nothing


@dataclass(frozen=True, slots=True)
class Planform:
    """Chords of a lifting surface from root to tip, linear in between; each array (k,)."""

    span_position: Array  #: along structural y (fin: z) [m]
    leading_edge: Array  #: station [m]
    chord: Array  #: [m]


@dataclass(frozen=True, slots=True)
class LoadedSkin:
    """Elements that carry an air load: of these properties, between these nodes, or both."""

    properties: IdentifierSet | None
    nodes: IdentifierSet | None


@dataclass(frozen=True, slots=True)
class LiftingSurface:
    """How wing, tail or fin carries its load."""

    skin: LoadedSkin
    law: str  #: "schrenk" or "uniform" (pressure)
    centre_of_pressure: float  #: fraction of the chord
    planform: Planform


@dataclass(frozen=True, slots=True)
class AirLoadLayout:
    """Where the air loads act."""

    wing: LiftingSurface
    tail: LiftingSurface
    fin: LiftingSurface
    fuselage: LoadedSkin
    fuselage_drag_share: float


@dataclass(frozen=True, slots=True)
class MaterialAllowable:
    """Limit allowable of a material, von Mises [Pa]."""

    name: str
    identifier: int  #: MAT1
    limit_allowable: float


@dataclass(frozen=True, slots=True)
class Zone:
    """A piece of the airframe that an inspector can be sent to."""

    name: str
    component: str
    side: str  #: "port", "starboard" or "centre"
    ata_chapter: str
    properties: IdentifierSet  #: PSHELL, PBAR and PBARL identifiers
    look_for: str
    access: str
    shell_limit_allowable: float | None  #: replaces the material's [Pa]
    beam_limit_allowable: float | None  #: replaces the material's [Pa]


@dataclass(frozen=True, slots=True)
class VerdictThresholds:
    """Utilisations (peak over limit) at which the verdict rises; HARD starts at 1."""

    firm_utilisation: float
    inspect_utilisation: float
    overweight_factor: float  #: on both above the maximum landing mass
    roll_limit: float  #: at a contact [rad]
    nose_first: Verdict  #: least verdict when the nose gear touches first
    nose_closure_limit: float  #: vertical speed of the nose wheel at its touchdown [m/s]
    inspect_probability: float  #: that a limit allowable is exceeded, from here INSPECT
    hard_probability: float  #: the same, from here HARD


@dataclass(frozen=True, slots=True)
class AircraftDefinition:
    """Everything ``definition.toml`` says."""

    name: str
    title: str
    description: str
    disclaimer: str
    bulk_data: str  #: file name in the same folder
    masses: Masses
    reference: Reference
    aerodynamics: AerodynamicDerivatives
    modal_damping_ratio: float
    verdict: VerdictThresholds
    gears: tuple[GearDefinition, ...]
    tanks: tuple[MassGroup, ...]
    bays: tuple[MassGroup, ...]
    air_loads: AirLoadLayout
    materials: tuple[MaterialAllowable, ...]
    zones: tuple[Zone, ...]
    scatter: Scatter
    #: Maker's hard-landing rule: its name, or (``*.toml``) a file in the same folder.
    makers_rule: str | None = None

    @property
    def files(self) -> tuple[str, ...]:
        """Files of the aircraft's folder besides the definition that decide an assessment."""
        rule = self.makers_rule
        own = (rule,) if rule is not None and rule.endswith(".toml") else ()
        return (self.bulk_data, *own)

    @property
    def groups(self) -> tuple[MassGroup, ...]:
        """Tanks, then bays: the order of every array of fill factors."""
        return self.tanks + self.bays
