"""Where wheels, centre of gravity and sensors sit: all that the estimate needs of an aircraft."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.gear.parameters import Gear
from solver.gear.place import Place, place_of
from solver.landing.aircraft import LandingAircraft
from solver.landing.records import GRAVITY


@dataclass(frozen=True, slots=True)
class Wheel:
    """Lowest point of a gear's tyres with the strut extended, aircraft level."""

    gear: str
    place: Place
    position: Array  #: (3,) structural axes [m]


@dataclass(frozen=True, slots=True)
class Installation:
    """Where the recorder's sensors sit, structural axes [m].

    The radio altimeter is set to read zero as the main wheels touch at ``zero_pitch``.
    """

    accelerometer: Array  #: (3,)
    antenna: Array  #: (3,) of the radio altimeter
    zero_pitch: float = np.deg2rad(5.0)  #: [rad]
    position_sd: float = 0.1  #: of each coordinate of both [m]


@dataclass(frozen=True, slots=True)
class Geometry:
    """Points of an aircraft in its loading state."""

    centre_of_gravity: Array  #: (3,) structural axes [m]
    wheels: tuple[Wheel, ...]
    installation: Installation
    centre_of_gravity_sd: float = 0.05  #: of its station [m]
    static_closure: float = 0.2  #: of strut and tyre of a main gear, aircraft rolling [m]
    static_closure_sd: float = 0.1  #: servicing of the struts, lift left [m]
    nose_travel: float = 0.35  #: of strut and tyre of a nose gear [m]
    rolling_pitch: float = 0.0  #: against the runway, on all wheels [rad]
    rolling_pitch_sd: float = np.deg2rad(0.22)  #: servicing, struts at work [rad]

    def of(self, place: Place) -> tuple[Wheel, ...]:
        """Wheels at a place."""
        return tuple(wheel for wheel in self.wheels if wheel.place is place)

    @property
    def mains(self) -> tuple[Wheel, ...]:
        """Wheels that are not the nose's."""
        return tuple(wheel for wheel in self.wheels if wheel.place is not Place.NOSE)


def usual_installation(centre_of_gravity: Array, gears: tuple[Gear, ...]) -> Installation:
    """Sensors where they are put unless somebody says otherwise.

    The accelerometer is near the centre of gravity, as 14 CFR 25.1459(a)(2) asks for (within its
    limits of the mean aerodynamic chord); the antenna is under the fuselage, forward of the main
    gear.  The distances are assumptions.
    """
    lowest = min(float(gear.pivot[2]) for gear in gears)
    return Installation(
        accelerometer=np.array([centre_of_gravity[0] - 0.4, 0.0, centre_of_gravity[2]]),
        antenna=np.array([centre_of_gravity[0] - 1.5, 0.0, lowest]),
    )


def aircraft_geometry(
    aircraft: LandingAircraft, installation: Installation | None = None
) -> Geometry:
    """Geometry of an aircraft of the landing simulation."""
    return geometry_on_gears(
        aircraft.gears, aircraft.total_centre_of_gravity, aircraft.total_mass, installation
    )


def geometry_on_gears(
    gears: tuple[Gear, ...],
    centre_of_gravity: Array,
    mass: float,
    installation: Installation | None = None,
    centre_of_gravity_sd: float = 0.05,
) -> Geometry:
    """Geometry from gears, centre of gravity (3,) structural axes [m] and mass [kg]."""
    wheels = []
    for gear in gears:
        bottom = gear.extended_axle - np.array([0.0, 0.0, gear.tyre.free_radius])
        wheels.append(Wheel(gear.name, place_of(gear, gears), bottom))
    return Geometry(
        centre_of_gravity=centre_of_gravity,
        wheels=tuple(wheels),
        installation=installation or usual_installation(centre_of_gravity, gears),
        centre_of_gravity_sd=centre_of_gravity_sd,
        static_closure=_main_closure(gears, wheels, centre_of_gravity, mass),
        nose_travel=_nose_travel(gears, wheels, centre_of_gravity, mass),
        rolling_pitch=_rolling_pitch(gears, wheels, centre_of_gravity, mass),
    )


def _main_closure(
    gears: tuple[Gear, ...], wheels: list[Wheel], centre_of_gravity: Array, mass: float
) -> float:
    """Closure of strut and tyre of a main gear that carries its share of the weight [m]."""
    mains = [
        gear for gear, wheel in zip(gears, wheels, strict=True) if wheel.place is not Place.NOSE
    ]
    share = 1.0 - _nose_share(gears, wheels, centre_of_gravity)
    return _static_closure(mains[0], share * mass * GRAVITY / len(mains))


def _rolling_pitch(
    gears: tuple[Gear, ...], wheels: list[Wheel], centre_of_gravity: Array, mass: float
) -> float:
    """Pitch at which the closed struts and tyres of nose and mains are on one line [rad].

    Lift that is left hardly matters: it relieves both.
    """
    noses = [n for n, wheel in enumerate(wheels) if wheel.place is Place.NOSE]
    mains = [n for n, wheel in enumerate(wheels) if wheel.place is not Place.NOSE]
    if not noses or not mains:
        return 0.0
    nose, main = wheels[noses[0]].position, wheels[mains[0]].position
    load = _nose_share(gears, wheels, centre_of_gravity) * mass * GRAVITY / len(noses)
    deeper = _main_closure(gears, wheels, centre_of_gravity, mass) - _static_closure(
        gears[noses[0]], load
    )
    return float((deeper + main[2] - nose[2]) / (main[0] - nose[0]))


def _nose_share(gears: tuple[Gear, ...], wheels: list[Wheel], centre_of_gravity: Array) -> float:
    """Part of the weight that the nose gear carries, by the lever arms of the pivots."""
    pairs = list(zip(gears, wheels, strict=True))
    main = next(float(gear.pivot[0]) for gear, wheel in pairs if wheel.place is not Place.NOSE)
    nose = next(
        (float(wheel.position[0]) for _, wheel in pairs if wheel.place is Place.NOSE), -np.inf
    )
    return float((main - centre_of_gravity[0]) / (main - nose))


def _nose_travel(
    gears: tuple[Gear, ...], wheels: list[Wheel], centre_of_gravity: Array, mass: float
) -> float:
    """Closure of a nose gear whose strut is closed and whose tyre carries its share at rest [m]."""
    load = _nose_share(gears, wheels, centre_of_gravity) * mass * GRAVITY
    return max(
        (
            gear.strut.full_stroke + _tyre_deflection(gear, load)
            for gear, wheel in zip(gears, wheels, strict=True)
            if wheel.place is Place.NOSE
        ),
        default=0.0,
    )


def _static_closure(gear: Gear, load: float) -> float:
    """Closure of strut and tyre of a gear under a load [m].

    Oleo as a gas spring at rest (NACA Report 1154).
    """
    strut = gear.strut
    volume, area = strut.initial_gas_volume, strut.pneumatic_area
    preload = strut.initial_gas_pressure * area
    packed = (preload / load) ** (1 / strut.polytropic_exponent) if load > preload else 1.0
    stroke = min(volume / area * (1 - packed), strut.full_stroke)
    return float(stroke + _tyre_deflection(gear, load))


def _tyre_deflection(gear: Gear, load: float) -> float:
    """Deflection of a gear's tyres under a load, by their own static law [m]."""
    tyre = gear.tyre
    of_each = max(load, 0.0) / tyre.count / tyre.vertical_coefficient
    return float(of_each ** (1 / tyre.vertical_exponent))


def point_geometry() -> Geometry:
    """Aircraft of which nothing is known: everything happens at the accelerometer."""
    nowhere = np.zeros(3)
    return Geometry(
        centre_of_gravity=nowhere,
        wheels=(Wheel("gear", Place.LEFT, nowhere),),
        installation=Installation(nowhere, nowhere, zero_pitch=0.0, position_sd=0.0),
        centre_of_gravity_sd=0.0,
        static_closure_sd=0.3,
    )


def antenna_height(geometry: Geometry) -> float:
    """Height of the antenna as the main wheels touch at the installation's zero pitch [m]."""
    installation = geometry.installation
    pitch = installation.zero_pitch
    drop = [
        float(
            (wheel.position - installation.antenna) @ np.array([-np.sin(pitch), 0, np.cos(pitch)])
        )
        for wheel in geometry.mains
    ]
    return -min(drop)
