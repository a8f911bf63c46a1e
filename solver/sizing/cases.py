"""Design cases of the example aircraft: what its structure must carry at limit load.

Landings are simulated (14 CFR 25.473 to 25.481); the conditions that the rules prescribe as forces
(25.483 to 25.493) and manoeuvres in flight are static.  Every case is a history of applied loads:
six components at each pin, then the resultant of the air loads about the structural origin.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.aerodynamics import (
    FIN_AREA,
    FIN_CENTRE,
    FIN_HEIGHT,
    TAIL_AREA,
    TAIL_CENTRE,
    fin_slope,
)
from solver.arrays import Array, IntArray
from solver.gear.pins import pin_load_matrix
from solver.inertia_relief.loads import LandingLoads, landing_loads
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.simulate import simulate_landing

STANDARD_GRAVITY = 9.80665  #: [m/s2]
LIMIT_SINK, TAKEOFF_SINK = 3.048, 1.829  #: 10 ft/s and 6 ft/s, 25.473(a) [m/s]
#: Own criterion for landings on one wheel first, where a T-tail answers the roll: 8 ft/s [m/s].
ROLLED_SINK = 2.438
TOUCHDOWN_SPEED = 55.0  #: over ground; near 1.25 V_L2 of 25.479(a) for a jet of this size [m/s]
TAXI_LOAD_FACTOR = 2.0  #: of a bump, all wheels; the usual static equivalent, assumed
AIR_DENSITY = 1.225  #: [kg/m3]
#: Lateral gust at cruising speed: gust, equivalent air speed [m/s], alleviation; assumed.
GUST, CRUISING_SPEED, ALLEVIATION = 15.2, 160.0, 0.8
#: Pitching manoeuvre at manoeuvring speed: change of tail lift coefficient, speed [m/s]; assumed.
TAIL_LIFT, MANOEUVRING_SPEED = 0.35, 100.0
#: Strut closure and tyre deflection at which prescribed forces act, near those of the peak [m].
CLOSURE, TYRE_DEFLECTION = 0.25, 0.03

Masses = dict[str, float]


@dataclass(frozen=True, slots=True)
class DesignLoading:
    """A loading state that structure is sized for."""

    name: str
    fuel: float  #: both wing tanks together [kg]
    payload: float  #: share of every bay's capacity


#: Maximum landing mass with full payload and with fuel only; take-off; no fuel; end of a flight.
LOADINGS = (
    DesignLoading("landing", 2857.0, 1.0),
    DesignLoading("landing, no payload", 4057.0, 0.0),
    DesignLoading("take-off", 4308.0, 1.0),
    DesignLoading("no fuel", 0.0, 1.0),
    DesignLoading("light", 600.0, 0.5),
)


@dataclass(frozen=True, slots=True)
class LandingCase:
    """A landing that is simulated."""

    name: str
    loading: str
    contact: Contact


@dataclass(frozen=True, slots=True)
class AppliedLoads:
    """One case as applied loads; ``landing`` where it is a simulated landing as it is."""

    name: str
    loading: str
    amplitudes: Array  #: (n_samples, 6 n_pins + 6) [N, N m]
    landing: LandingLoads | None = None
    in_flight: bool = False


def _landing(
    name: str,
    loading: str,
    sink: float,
    pitch: float,
    lift: LiftModel = LiftModel.HELD,
    roll: float = 0.0,
) -> LandingCase:
    """Landing with pitch and roll in degrees."""
    contact = Contact(
        sink_rate=sink,
        ground_speed=TOUCHDOWN_SPEED,
        pitch=math.radians(pitch),
        roll=math.radians(roll),
        lift=Lift(lift),
    )
    return LandingCase(name, loading, contact)


DECAYS = LiftModel.DECAYING
LANDINGS = (
    _landing("two wheels, 10 ft/s", "landing", LIMIT_SINK, 1.0),
    _landing("two wheels, 10 ft/s, lift decays", "landing", LIMIT_SINK, 1.0, DECAYS),
    _landing("two wheels, 10 ft/s, no payload", "landing, no payload", LIMIT_SINK, 1.0),
    _landing("two wheels, 10 ft/s, light", "light", LIMIT_SINK, 1.0, DECAYS),
    _landing("three wheels, 10 ft/s", "landing", LIMIT_SINK, 0.0, DECAYS),
    _landing("tail down 3 degrees, 10 ft/s", "landing", LIMIT_SINK, 3.0, DECAYS),
    _landing("tail down 8 degrees, 10 ft/s", "landing", LIMIT_SINK, 8.0, DECAYS),
    _landing("one wheel first, 3 degrees, 8 ft/s", "landing", ROLLED_SINK, 2.0, DECAYS, roll=3.0),
    _landing("two wheels, take-off mass, 6 ft/s", "take-off", TAKEOFF_SINK, 1.0, DECAYS),
    _landing("three wheels, take-off mass, 6 ft/s", "take-off", TAKEOFF_SINK, 0.0),
)


def fill_factors(airframe: Airframe, loading: DesignLoading) -> Array:
    """Fill factors (n_groups,) of a design loading."""
    tanks = {tank.name: loading.fuel / 2 for tank in airframe.definition.tanks}
    bays = {bay.name: loading.payload * bay.capacity for bay in airframe.definition.bays}
    return airframe.fill_factors(tanks, bays)


def design_cases(airframe: Airframe) -> list[AppliedLoads]:
    """All design cases of an airframe."""
    factors = {loading.name: fill_factors(airframe, loading) for loading in LOADINGS}
    aircraft = {name: airframe.landing_aircraft(fill) for name, fill in factors.items()}
    cases = [_simulated(airframe, aircraft[case.loading], case) for case in LANDINGS]
    level = cases[0]
    cases.append(_one_gear(airframe, level))
    vertical = float(_main_vertical(airframe, level))
    cases += _prescribed(aircraft["landing"], "landing", vertical)
    cases.append(_taxi(aircraft["take-off"], "take-off"))
    for name, load_factor, loading in (
        ("2.5 g, take-off mass", 2.5, "take-off"),
        ("2.5 g, no fuel", 2.5, "no fuel"),
        ("-1 g, take-off mass", -1.0, "take-off"),
    ):
        cases.append(_manoeuvre(name, aircraft[loading], loading, load_factor))
    cases += _empennage(aircraft["landing"], "landing")
    return cases


def _simulated(airframe: Airframe, aircraft: LandingAircraft, case: LandingCase) -> AppliedLoads:
    loads = landing_loads(airframe, simulate_landing(aircraft, case.contact))
    return AppliedLoads(
        case.name, case.loading, loads.applied_amplitudes()[telling(loads.time)], loads
    )


def telling(time: Array) -> IntArray:
    """Choose samples to look at: every 5 ms while the gears strike, every 50 ms later."""
    step = max(1, round(0.005 / float(time[1] - time[0])))
    border = int(np.searchsorted(time, 0.45))
    early, late = np.arange(0, border, step), np.arange(border, len(time), 10 * step)
    return np.concatenate([early, late])


def _pin_blocks(airframe: Airframe) -> list[slice]:
    """Columns of each gear's pins among the applied loads."""
    blocks, first = [], 0
    for gear in airframe.definition.gears:
        blocks.append(slice(6 * first, 6 * (first + len(gear.pins))))
        first += len(gear.pins)
    return blocks


def _one_gear(airframe: Airframe, level: AppliedLoads) -> AppliedLoads:
    """25.483: the level landing's loads of one main gear alone, the rest reacted by inertia."""
    amplitudes = level.amplitudes.copy()
    for gear, block in zip(airframe.definition.gears, _pin_blocks(airframe), strict=True):
        if not gear.name.endswith("right"):
            amplitudes[:, block] = 0.0
    return AppliedLoads("one gear (25.483)", level.loading, amplitudes)


def _main_vertical(airframe: Airframe, level: AppliedLoads) -> float:
    """Largest vertical load of one main gear on the airframe [N]."""
    peaks = []
    for gear, block in zip(airframe.definition.gears, _pin_blocks(airframe), strict=True):
        if gear.position == "main":
            forces = level.amplitudes[:, block].reshape(len(level.amplitudes), -1, 6)
            peaks.append(forces[:, :, 2].sum(axis=1).max())
    return float(max(peaks))


def _main_share(aircraft: LandingAircraft) -> float:
    """Share of the weight at rest on one main gear."""
    nose, main = (aircraft.gears[k].pivot[0] for k in (0, 1))
    return float((aircraft.total_centre_of_gravity[0] - nose) / (main - nose)) / 2


def _taxi(aircraft: LandingAircraft, loading: str) -> AppliedLoads:
    """25.491: the worst bump of the runway as a static load factor."""
    weight = TAXI_LOAD_FACTOR * aircraft.total_mass * STANDARD_GRAVITY
    share = _main_share(aircraft)
    pins = [
        _ground_force(aircraft, gear, np.array([0.0, 0.0, part * weight]))
        for gear, part in enumerate((1 - 2 * share, share, share))
    ]
    amplitudes = np.concatenate([*pins, np.zeros(6)])[None]
    return AppliedLoads("taxi, 2 g (25.491)", loading, amplitudes)


def _prescribed(aircraft: LandingAircraft, loading: str, vertical: float) -> list[AppliedLoads]:
    """Ground conditions given as forces: drag aft, side starboard, vertical up on the tyre [N]."""
    weight = aircraft.total_mass * STANDARD_GRAVITY
    share = _main_share(aircraft)
    centre = aircraft.total_centre_of_gravity
    drift = 0.75 * vertical
    half = 0.5 * vertical
    braked = 1.2 * weight * share
    front = 1.2 * weight * (1 - 2 * share)
    zero = (0.0, 0.0, 0.0)
    table: Sequence[tuple[str, float, tuple[tuple[float, float, float], ...]]] = (
        ("drift (25.479(d)(2))", 1.0,
         (zero, (0.4 * drift, 0.25 * drift, drift), (0.4 * drift, 0.25 * drift, drift))),
        ("side load (25.485)", 1.0,
         (zero, (0.0, 0.8 * half, half), (0.0, 0.6 * half, half))),
        ("braked roll, 1.2 g (25.493(b))", 0.0,
         ((0.0, 0.0, front), (0.8 * braked, 0.0, braked), (0.8 * braked, 0.0, braked))),
        ("nose-wheel yaw (25.499)", 0.0,
         ((0.0, 0.8 * front / 1.2, front / 1.2), (0.0, 0.0, braked / 1.2),
          (0.0, 0.0, braked / 1.2))),
    )  # fmt: skip
    cases = []
    for name, lift, forces in table:
        pins = [_ground_force(aircraft, gear, np.array(force)) for gear, force in enumerate(forces)]
        air = _vertical_air_load(lift * weight, centre)
        cases.append(AppliedLoads(name, loading, np.concatenate([*pins, air])[None]))
    return cases


def _ground_force(aircraft: LandingAircraft, number: int, force: Array) -> Array:
    """Pin loads (6 n_pins,) of a force on a tyre at the ground, structural axes."""
    gear = aircraft.gears[number]
    length = gear.strut.extended_length - CLOSURE
    ground = gear.pivot + length * gear.axis
    ground = ground - np.array([0.0, 0.0, gear.tyre.free_radius - TYRE_DEFLECTION])
    wrench = np.concatenate([force, np.cross(ground - gear.pivot, force)])
    return np.asarray(pin_load_matrix(gear.pins, gear.pivot) @ wrench)


def _vertical_air_load(lift: float, centre: Array) -> Array:
    """Resultant (6,) about the structural origin of a lift through ``centre``."""
    force = np.array([0.0, 0.0, lift])
    return np.concatenate([force, np.cross(centre, force)])


def _manoeuvre(
    name: str, aircraft: LandingAircraft, loading: str, load_factor: float
) -> AppliedLoads:
    """Symmetrical manoeuvre; the unsprung masses hang on the pins."""
    acceleration = load_factor * STANDARD_GRAVITY
    pins = []
    for gear in aircraft.gears:
        weight = np.array([0.0, 0.0, -gear.unsprung_mass * acceleration])
        wrench = np.concatenate([weight, np.cross(gear.extended_axle - gear.pivot, weight)])
        pins.append(pin_load_matrix(gear.pins, gear.pivot) @ wrench)
    lift = _vertical_air_load(aircraft.total_mass * acceleration, aircraft.total_centre_of_gravity)
    return AppliedLoads(name, loading, np.concatenate([*pins, lift])[None], in_flight=True)


def _empennage(aircraft: LandingAircraft, loading: str) -> list[AppliedLoads]:
    """Load fin and tailplane in 1 g flight: lateral gust, pitching manoeuvre."""
    steady = _manoeuvre("1 g", aircraft, loading, 1.0).amplitudes[0]
    gust = 0.5 * AIR_DENSITY * CRUISING_SPEED * GUST * ALLEVIATION * fin_slope() * FIN_AREA
    pull = 0.5 * AIR_DENSITY * MANOEUVRING_SPEED**2 * TAIL_LIFT * TAIL_AREA
    fin = np.array([FIN_CENTRE[0], 0.0, dim.FIN_ROOT_HEIGHT + FIN_CENTRE[1] * FIN_HEIGHT])
    tail = np.array([TAIL_CENTRE[0], 0.0, dim.FIN_TIP_HEIGHT])
    cases = []
    for name, place, force in (
        ("lateral gust (25.341)", fin, np.array([0.0, gust, 0.0])),
        ("pitching manoeuvre, tail up (25.331)", tail, np.array([0.0, 0.0, pull])),
        ("pitching manoeuvre, tail down (25.331)", tail, np.array([0.0, 0.0, -pull])),
    ):
        amplitudes = steady.copy()
        amplitudes[-6:] += np.concatenate([force, np.cross(place, force)])
        cases.append(AppliedLoads(name, loading, amplitudes[None], in_flight=True))
    return cases
