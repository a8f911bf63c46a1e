"""Stations and branches of the example aircraft's stick model, as in the paper's Fig 18."""

from typing import TypeAlias

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, IntArray
from solver.flexible_landing.stations import Branch, Station, fitting_station, section_station
from solver.landing.aircraft import LandingAircraft

Places: TypeAlias = tuple[tuple[float, float], ...]

#: Positions of stations along structural x, and half the width over which their nodes lie [m]; off
#: the bulkheads, whose own bulging is not the section's motion.
FORWARD: Places = ((7.9, 0.16), (7.0, 0.16), (6.1, 0.16), (5.2, 0.16), (4.3, 0.16), (3.4, 0.16),
           (2.51, 0.15), (1.8, 0.16), (0.9, 0.18))  # fmt: skip
AFT: Places = ((11.56, 0.13), (12.29, 0.13), (13.15, 0.13), (13.85, 0.46), (14.7, 0.16),
       (15.8, 0.74), (17.27, 0.2), (18.02, 0.2))  # fmt: skip
#: Along structural y, away from the plane of symmetry.
WING: Places = ((0.78, 0.05), (1.5, 0.16), (2.75, 0.05), (3.82, 0.14), (4.88, 0.14), (5.94, 0.14),
        (7.0, 0.14), (8.07, 0.14), (8.86, 0.14), (9.65, 0.05))  # fmt: skip
TAILPLANE: Places = ((0.8, 0.18), (1.6, 0.18), (2.4, 0.18), (3.2, 0.1))
#: Along structural z.
FIN: Places = ((3.6, 0.16), (4.17, 0.16), (4.74, 0.16))
#: Nodes of the tailplane this near to the plane of symmetry are the fin's tip [m].
FIN_TIP = 0.25
#: The station that holds the engines' pylons, the fin, the nose gear and the main gears.
ENGINES, FIN_ROOT, NOSE_GEAR, MAIN_GEAR = AFT[3][0], AFT[5][0], FORWARD[6][0], WING[1][0]
SIDES = {"left": -1.0, "right": 1.0}


def example_stations(
    airframe: Airframe, aircraft: LandingAircraft
) -> tuple[tuple[Station, ...], tuple[Branch, ...]]:
    """Stations, the centre box first, and branches."""
    structure = airframe.structure
    coordinates = structure.model.coordinates
    parts = component_nodes(airframe)
    stations = [section_station("centre box", structure, parts["wing centre box"])]
    branches = []

    def chain(
        root: str,
        name: str,
        nodes: IntArray,
        distance: Array,
        places: Places,
    ) -> list[str]:
        names = [root]
        for place, half in places:
            names.append(f"{name} {place:g}")
            chosen = nodes[np.abs(distance[nodes] - place) <= half]
            stations.append(section_station(names[-1], structure, chosen))
        return names

    x, y, z = coordinates.T
    for places in (FORWARD, AFT):
        names = chain("centre box", "fuselage", parts["fuselage"], x, places)
        branches.append(Branch(tuple(names)))
    fin = chain(f"fuselage {FIN_ROOT:g}", "fin", parts["fin"], z, FIN)
    tip = parts["tailplane"][np.abs(y[parts["tailplane"]]) <= FIN_TIP]
    stations.append(section_station("fin tip", structure, tip))
    branches.append(Branch((*fin, "fin tip")))
    engines = [body.independent for body in structure.model.rigid_bodies]
    for side, sign in SIDES.items():
        for part, root, places in (
            ("wing", "centre box", WING),
            ("tailplane", "fin tip", TAILPLANE),
        ):
            names = chain(root, f"{part} {side}", parts[part], sign * y, places)
            branches.append(Branch(tuple(names)))
        engine = np.array([node for node in engines if sign * y[node] > 0])
        stations.append(section_station(f"engine {side}", structure, engine))
        branches.append(Branch((f"fuselage {ENGINES:g}", f"engine {side}")))
    first = 0
    for gear in aircraft.gears:
        rows = airframe.pin_rows[first : first + len(gear.pins)]
        first += len(gear.pins)
        stations.append(fitting_station(structure, gear, rows))
        side = "left" if gear.pivot[1] < 0 else "right"
        holder = f"fuselage {NOSE_GEAR:g}" if gear.pivot[1] == 0 else f"wing {side} {MAIN_GEAR:g}"
        branches.append(Branch((holder, gear.name)))
    return tuple(stations), tuple(branches)


def component_nodes(airframe: Airframe) -> dict[str, IntArray]:
    """Node rows of every component of the aircraft's definition."""
    model = airframe.structure.model
    nodes: dict[str, list[IntArray]] = {}
    first = 0
    for corners in (model.quads.nodes, model.triangles.nodes, model.beams.nodes):
        owners = airframe.element_zone[first : first + len(corners)]
        first += len(corners)
        for zone in np.unique(owners):
            component = airframe.definition.zones[zone].component
            nodes.setdefault(component, []).append(corners[owners == zone].ravel())
    return {component: np.unique(np.concatenate(rows)) for component, rows in nodes.items()}
