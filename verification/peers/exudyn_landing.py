"""A landing built of exudyn's own bodies, joints and connectors; a job of `apart`.

Airframe, lower legs and wheels are rigid bodies with Euler parameters.  A prismatic joint lets
each leg slide on the airframe, a revolute joint lets its wheels spin; the unsprung mass is shared
between leg and wheels.  Strut and ground act as user functions.  exudyn's generalised-alpha
integrator solves the differential-algebraic equations in redundant coordinates (index 2); the
solver has minimal coordinates and an explicit integrator, so that no step is alike.

Axes: x ahead, y to port, z up.  Legs are rigid fore and aft; lift is constant, air drag none.
"""

import importlib
import importlib.util
from dataclasses import dataclass
from typing import Any

import numpy as np

from solver.arrays import Array
from solver.errors import RecordError
from solver.gear.parameters import Gear
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, LiftModel
from verification.peers.apart import Report
from verification.peers.gear_laws import UP, GroundReaction, ground_reaction, strut_force

GRAVITY = 9.80665
#: Structural axes (x aft, y starboard, z up) and flight axes (x ahead, y starboard, z down) as
#: half turns of those used here.
FROM_STRUCTURAL = np.diag([-1.0, -1.0, 1.0])
FROM_FLIGHT = np.diag([1.0, -1.0, -1.0])
#: Share of the amplitude of the highest frequencies that a step leaves; 1 damps nothing, and lets
#: the rolling wheels ring between two steps.
SPECTRAL_RADIUS = 0.9
#: Inertia that exudyn's joints want of a body that has none in the solver's model [kg m2]; a part
#: in 1e8 of the airframe's.
SMALL_INERTIA = 1e-4
PORT = np.array([0.0, 1.0, 0.0])


def is_installed() -> bool:
    """Whether exudyn can be imported."""
    return importlib.util.find_spec("exudyn") is not None


@dataclass(frozen=True, slots=True)
class PeerLanding:
    """Histories of a landing, one row per step; each gear in the order of the aircraft's."""

    time: Array  #: (nt,) from the first contact [s]
    stroke: Array  #: (nt, g) [m]
    strut_force: Array  #: (nt, g) [N]
    ground_force: Array  #: (nt, g, 3) ahead, to port, up; world axes [N]
    wheel_speed: Array  #: (nt, g) [rad/s]
    rate: Array  #: (nt, 3) roll, pitch, yaw rate in flight axes [rad/s]
    attitude: Array  #: (nt, 3, 3) flight body axes to flight earth axes


def land(
    aircraft: LandingAircraft, contact: Contact, duration: float, step: float, report: Report
) -> PeerLanding:
    """Simulate one landing.

    Raises
    ------
    RecordError
        The lift is not held, the legs bend, or there is drag: not modelled here.
    """
    _check(aircraft, contact)
    model = _Model(aircraft, contact)
    steps = round(duration / step)
    model.solve(steps, duration, report)
    return model.histories()


def _check(aircraft: LandingAircraft, contact: Contact) -> None:
    air = aircraft.aerodynamics
    if contact.lift.model is not LiftModel.HELD:
        raise RecordError("the peer's landing has a constant lift")
    if air.drag_area or air.lift_slope_area or air.roll_damping or air.pitch_damping:
        raise RecordError("the peer's landing has no air loads but the lift")
    if any(gear.spring_back.enabled for gear in aircraft.gears):
        raise RecordError("the peer's landing has rigid legs")


def _attitude(contact: Contact) -> Array:
    """Turn from body to earth, both in the axes used here: yaw, then pitch, then roll."""
    turns = []
    for angle, axis in ((contact.drift, 2), (contact.pitch, 1), (contact.roll, 0)):
        c, s = np.cos(angle), np.sin(angle)
        turn = np.eye(3)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn[i, i] = turn[j, j] = c
        turn[i, j], turn[j, i] = -s, s
        turns.append(turn)
    flight = turns[0] @ turns[1] @ turns[2]
    attitude: Array = FROM_FLIGHT @ flight @ FROM_FLIGHT
    return attitude


class _Model:
    """The multibody system of one landing."""

    def __init__(self, aircraft: LandingAircraft, contact: Contact) -> None:
        self.exudyn: Any = importlib.import_module("exudyn")
        self.utilities: Any = importlib.import_module("exudyn.utilities")
        self.container: Any = self.exudyn.SystemContainer()
        self.system: Any = self.container.AddSystem()
        self.aircraft = aircraft
        self.rows: list[list[float]] = []
        self.legs: list[tuple[Gear, Any, Any]] = []
        self._build(contact)

    def _at(self, structural: Array) -> Array:
        """Place in the airframe's axes, from its centre of gravity."""
        return FROM_STRUCTURAL @ (structural - self.aircraft.centre_of_gravity)

    def _build(self, contact: Contact) -> None:
        aircraft, system = self.aircraft, self.system
        self.turn = _attitude(contact)
        spin = self.turn @ (
            FROM_FLIGHT @ np.array([contact.roll_rate, contact.pitch_rate, contact.yaw_rate])
        )
        centre = self.turn @ self._at(aircraft.total_centre_of_gravity)
        velocity = np.array([contact.ground_speed, 0.0, -contact.sink_rate])
        self.velocity = velocity - np.cross(spin, centre)
        self.spin = spin
        axles = [self._hanging_axle(gear) for gear in aircraft.gears]
        depths = [
            ground_reaction(
                self.turn @ axle, np.zeros(3), np.zeros(3), self.turn @ PORT, gear.tyre
            ).deflection
            for axle, gear in zip(axles, aircraft.gears, strict=True)
        ]
        self.origin = np.array([0.0, 0.0, max(depths)])
        self.ground = system.CreateGround()
        self.airframe = self._body(
            np.zeros(3), aircraft.mass, FROM_STRUCTURAL @ aircraft.inertia @ FROM_STRUCTURAL
        )
        point = aircraft.aerodynamics.lift_point
        where = aircraft.total_centre_of_gravity if point is None else point
        lift = contact.lift.fraction * aircraft.total_mass * GRAVITY
        system.CreateForce(
            itemNumber=self.airframe, localPosition=self._at(where), loadVector=lift * UP
        )
        for gear, axle in zip(aircraft.gears, axles, strict=True):
            self._add_gear(gear, axle)
        system.Assemble()

    def _body(self, arm: Array, mass: float, inertia: Array) -> Any:
        """Rigid body that starts with the airframe's motion at ``arm`` from its centre."""
        place = self.turn @ arm
        return self.system.CreateRigidBody(
            referencePosition=self.origin + place,
            referenceRotationMatrix=self.turn,
            initialVelocity=self.velocity + np.cross(self.spin, place),
            initialAngularVelocity=self.spin,
            inertia=self.utilities.RigidBodyInertia(mass=mass, inertiaTensor=inertia),
            gravity=[0.0, 0.0, -GRAVITY],
        )

    def _hanging_axle(self, gear: Gear) -> Array:
        """Axle where the stop at full extension carries the preload and the unsprung weight."""
        strut = gear.strut
        down = FROM_STRUCTURAL @ gear.axis
        weight = -gear.unsprung_mass * GRAVITY * float((self.turn @ down)[2])
        preload = strut.initial_gas_pressure * strut.pneumatic_area
        length = strut.extended_length + (preload + weight) / strut.stop_stiffness
        axle: Array = self._at(gear.pivot) + length * down
        return axle

    def _add_gear(self, gear: Gear, axle: Array) -> None:
        system, make = self.system, self.utilities
        down = FROM_STRUCTURAL @ gear.axis
        half = gear.unsprung_mass / 2
        leg = self._body(axle, half, SMALL_INERTIA * np.eye(3))
        across = max(gear.tyre.count * gear.tyre.transverse_inertia, SMALL_INERTIA)
        spinning = gear.tyre.count * gear.tyre.wheel_inertia
        wheels = self._body(axle, half, np.diag([across, spinning, across]))
        place = self.origin + self.turn @ axle
        system.CreatePrismaticJoint(
            itemNumbers=[self.airframe, leg], position=place, axis=self.turn @ down
        )
        system.CreateRevoluteJoint(itemNumbers=[leg, wheels], position=place, axis=self.turn @ PORT)
        extended = self._at(gear.pivot) + gear.strut.extended_length * down

        def strut(_m: Any, _t: float, _i: int, moved: Any, _r: Any, speed: Any, *_: Any) -> Any:
            force = strut_force(-float(down @ moved), -float(down @ speed), gear.strut)
            return [*(-force * down), 0.0, 0.0, 0.0]

        def ground(_m: Any, _t: float, _i: int, at: Any, _r: Any, v: Any, w: Any, *_: Any) -> Any:
            axis = self._turn_of(leg) @ PORT
            felt = ground_reaction(np.asarray(at), np.asarray(v), np.asarray(w), axis, gear.tyre)
            return [*(-felt.force), *(-felt.moment)]

        for first, place_on_first, second, law in (
            (self.airframe, extended, leg, strut),
            (self.ground, np.zeros(3), wheels, ground),
        ):
            markers = [
                system.AddMarker(make.MarkerBodyRigid(bodyNumber=body, localPosition=at))
                for body, at in ((first, place_on_first), (second, np.zeros(3)))
            ]
            system.AddObject(
                make.RigidBodySpringDamper(
                    markerNumbers=markers,
                    springForceTorqueUserFunction=law,
                    useIntrinsicFormulation=False,
                )
            )
        self.legs.append((gear, leg, wheels))

    def _output(self, body: Any, name: str) -> Array:
        kind = getattr(self.exudyn.OutputVariableType, name)
        return np.asarray(self.system.GetObjectOutputBody(body, kind))

    def _turn_of(self, body: Any) -> Array:
        return self._output(body, "RotationMatrix").reshape(3, 3)

    def solve(self, steps: int, duration: float, report: Report) -> None:
        """Integrate, keeping a row per step."""

        def keep(_system: Any, time: float) -> bool:
            self.rows.append(self._row(time))
            if len(self.rows) % 50 == 0:
                report(time / duration)
            return True

        self.system.SetPostStepUserFunction(keep)
        settings = self.exudyn.SimulationSettings()
        integration = settings.timeIntegration
        integration.numberOfSteps = steps
        integration.endTime = duration
        integration.verboseMode = 0
        integration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
        integration.newton.useModifiedNewton = True
        settings.solution.file.write = False
        self.system.SolveDynamic(settings)

    def _row(self, time: float) -> list[float]:
        turn = self._turn_of(self.airframe)
        centre = self._output(self.airframe, "Position")
        row = [time, *self._output(self.airframe, "AngularVelocityLocal"), *turn.ravel()]
        for gear, _, wheels in self.legs:
            place, speed, spin = (
                self._output(wheels, name) for name in ("Position", "Velocity", "AngularVelocity")
            )
            felt: GroundReaction = ground_reaction(place, speed, spin, turn @ PORT, gear.tyre)
            down = turn @ (FROM_STRUCTURAL @ gear.axis)
            pivot = centre + turn @ self._at(gear.pivot)
            stroke = gear.strut.extended_length - float((place - pivot) @ down)
            carrier = self._output(self.airframe, "Velocity") + np.cross(
                self._output(self.airframe, "AngularVelocity"), place - centre
            )
            closing = float((carrier - speed) @ down)
            force = strut_force(stroke, closing, gear.strut)
            row += [stroke, force, *felt.force, float(spin @ (turn @ PORT))]
        return row

    def histories(self) -> PeerLanding:
        """Rows as histories in the terms of the solver."""
        table = np.array(self.rows)
        gears = table[:, 13:].reshape(len(table), len(self.legs), 6)
        turns = table[:, 4:13].reshape(-1, 3, 3)
        return PeerLanding(
            time=table[:, 0],
            stroke=gears[:, :, 0],
            strut_force=gears[:, :, 1],
            ground_force=gears[:, :, 2:5],
            wheel_speed=gears[:, :, 5],
            rate=table[:, 1:4] @ FROM_FLIGHT,
            attitude=FROM_FLIGHT @ turns @ FROM_FLIGHT,
        )
