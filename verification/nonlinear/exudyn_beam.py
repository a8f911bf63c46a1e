"""The plane flight of Simo and Vu-Quoc's beam in exudyn; a job of `verification.peers.apart`.

exudyn's plane beams are geometrically exact with linear shape functions and strains of the
cross-section (Simo and Vu-Quoc's own theory), where the solver's are cubic beams in corotating
frames; its integrator is the trapezoidal rule in accelerations (generalised alpha, spectral radius
1).  Nothing but the data is shared.
"""

import importlib
from itertools import pairwise
from typing import Any

import numpy as np

from solver.arrays import Array
from verification.nonlinear.flying_beam import AXIAL, BENDING, LENGTH, LOWER, MASS, ROTARY, SHEAR
from verification.nonlinear.flying_beam import UPPER as UPPER_END
from verification.peers.apart import Report

PULSE = 2.5  #: end of the loads [s]


def plane_flight(count: int, step: float, end: float, report: Report) -> Array:
    """Time and place (nt, 3) of the lower end."""
    exudyn: Any = importlib.import_module("exudyn")
    items: Any = importlib.import_module("exudyn.itemInterface")
    system = exudyn.SystemContainer().AddSystem()
    places = LOWER + np.linspace(0.0, 1.0, count + 1)[:, None] * (UPPER_END - LOWER)
    nodes = [
        system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, y, 0.0]))
        for x, y, _ in places.tolist()
    ]
    for first, second in pairwise(nodes):
        system.AddObject(
            items.ObjectBeamGeometricallyExact2D(
                nodeNumbers=[first, second],
                length=LENGTH / count,
                massPerLength=MASS,
                crossSectionInertia=ROTARY,
                bendingStiffness=BENDING,
                axialStiffness=AXIAL,
                shearStiffness=SHEAR,
            )
        )

    def share(time: float) -> float:
        """Half where the pulse ends, which is what the trapezoidal rule makes of a jump."""
        if abs(time - PULSE) < step / 10:
            return 0.5
        return 1.0 if time < PULSE else 0.0

    def force(_system: object, time: float, load: list[float]) -> list[float]:
        report(time / end)
        return [share(time) * part for part in load]

    def torque(_system: object, time: float, load: list[float]) -> list[float]:
        return [share(time) * part for part in load]

    marker = system.AddMarker(items.MarkerNodeRigid(nodeNumber=nodes[0]))
    system.AddLoad(
        items.Force(markerNumber=marker, loadVector=[8.0, 0.0, 0.0], loadVectorUserFunction=force)
    )
    system.AddLoad(
        items.Torque(
            markerNumber=marker, loadVector=[0.0, 0.0, 80.0], loadVectorUserFunction=torque
        )
    )
    sensor = system.AddSensor(
        items.SensorNode(
            nodeNumber=nodes[0],
            storeInternal=True,
            outputVariableType=exudyn.OutputVariableType.Position,
        )
    )
    system.Assemble()
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime = round(end / step), end
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.newton.relativeTolerance = 1e-8
    integration.newton.absoluteTolerance = 1e-10
    integration.verboseMode = 0
    settings.solution.sensors.writePeriod = step
    settings.solution.file.write = False
    system.SolveDynamic(settings)
    history = np.asarray(system.GetSensorStoredData(sensor), dtype=np.float64)
    return history[:, :3]
