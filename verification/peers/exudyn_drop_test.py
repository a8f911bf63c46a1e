"""The drop test of NACA Report 1154 built of exudyn's own mass points; a job of `apart`.

Two mass points on one vertical line, each held to it by two coordinate constraints; the strut
between them and the tyre on the ground are connectors with user functions, the lift a force.  The
stop at full extension is a stiff spring that carries the preload, as in the landing simulation;
the drop test of the solver has a strut that is rigid until it breaks out.
"""

import importlib
from dataclasses import dataclass
from typing import Any

import numpy as np

from solver.arrays import Array
from solver.gear.drop_test import DropTestParameters
from verification.peers.apart import Report

GRAVITY = 9.80665


@dataclass(frozen=True, slots=True)
class PeerDropTest:
    """Histories of a drop test; each (nt,)."""

    time: Array  #: from contact [s]
    stroke: Array  #: [m]
    ground_force: Array  #: [N]
    strut_force: Array  #: [N]


def drop(
    test: DropTestParameters, duration: float, step: float, stop_stiffness: float, report: Report
) -> PeerDropTest:
    """Simulate one drop with a stop of the given stiffness [N/m]."""
    exudyn: Any = importlib.import_module("exudyn")
    make: Any = importlib.import_module("exudyn.utilities")
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    throttle = (
        test.fluid_density
        * test.hydraulic_area**3
        / (2.0 * (test.discharge_coefficient * test.orifice_area) ** 2)
    )

    def strut(stroke: float, closing: float) -> float:
        volume = test.initial_gas_volume - test.pneumatic_area * stroke
        gas: float = test.initial_gas_pressure * (test.initial_gas_volume / volume) ** (
            test.polytropic_exponent
        )
        stop = stop_stiffness * min(stroke, 0.0)
        return gas * test.pneumatic_area + throttle * closing * abs(closing) + stop

    def tyre(deflection: float) -> float:
        return float(test.tyre_coefficient * max(deflection, 0.0) ** test.tyre_exponent)

    # The strut hangs on its stop under the lower mass; heights are measured from contact.
    start = -(test.preload + test.lower_mass * GRAVITY) / stop_stiffness
    ground = system.CreateGround()
    upper, lower = (
        system.CreateMassPoint(
            referencePosition=[0.0, 0.0, 1.0 if is_upper else 0.0],
            initialDisplacement=[0.0, 0.0, -start if is_upper else 0.0],
            initialVelocity=[0.0, 0.0, -test.contact_speed],
            mass=test.upper_mass if is_upper else test.lower_mass,
            gravity=[0.0, 0.0, -GRAVITY],
        )
        for is_upper in (True, False)
    )
    fixed = system.AddMarker(
        make.MarkerNodeCoordinate(
            nodeNumber=system.AddNode(make.NodePointGround(referenceCoordinates=[0.0, 0.0, 0.0])),
            coordinate=0,
        )
    )
    for body in (upper, lower):
        node = system.GetObject(body)["nodeNumber"]
        for coordinate in (0, 1):
            marker = system.AddMarker(
                make.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate)
            )
            system.AddObject(make.CoordinateConstraint(markerNumbers=[fixed, marker]))

    def between(_m: Any, _t: float, _i: int, gap: Any, speed: Any, *_: Any) -> list[float]:
        return [0.0, 0.0, -strut(1.0 - gap[2], -speed[2])]

    def below(_m: Any, _t: float, _i: int, height: Any, _speed: Any, *_: Any) -> list[float]:
        return [0.0, 0.0, -tyre(-height[2])]

    for first, second, law in ((lower, upper, between), (ground, lower, below)):
        markers = [
            system.AddMarker(make.MarkerBodyPosition(bodyNumber=body)) for body in (first, second)
        ]
        system.AddObject(
            make.CartesianSpringDamper(markerNumbers=markers, springForceUserFunction=law)
        )
    lift = test.lift_ratio * test.mass * GRAVITY
    system.CreateForce(itemNumber=upper, loadVector=[0.0, 0.0, lift])
    system.Assemble()

    rows: list[tuple[float, float, float, float]] = []
    kinds = exudyn.OutputVariableType

    def keep(_system: Any, time: float) -> bool:
        top, bottom = (
            system.GetObjectOutputBody(body, kinds.Position)[2] for body in (upper, lower)
        )
        rise, sink = (
            system.GetObjectOutputBody(body, kinds.Velocity)[2] for body in (upper, lower)
        )
        stroke = 1.0 - (top - bottom)
        rows.append((time, stroke, tyre(-bottom), strut(stroke, sink - rise)))
        if len(rows) % 100 == 0:
            report(time / duration)
        return True

    system.SetPostStepUserFunction(keep)
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    settings.solution.file.write = False
    system.SolveDynamic(settings)
    return PeerDropTest(*np.array(rows).T)
