"""The parts of the example aircraft put together into one mesh."""

from dataclasses import dataclass

from solver.aircraft.bizjet.catalogue import Catalogue
from solver.aircraft.bizjet.divisions import Divisions
from solver.aircraft.bizjet.empennage import build_fin, build_tailplane
from solver.aircraft.bizjet.engines import build_engine
from solver.aircraft.bizjet.fuselage import Fuselage, build_fuselage
from solver.aircraft.bizjet.main_gear import PinNode, build_main_gear
from solver.aircraft.bizjet.mesh import Mesh
from solver.aircraft.bizjet.nose_gear import build_nose_gear
from solver.aircraft.bizjet.wing import Wing, build_centre_box, build_wing
from solver.arrays import IntArray


@dataclass(frozen=True, slots=True)
class Parts:
    """The mesh and what later steps need to find in it."""

    mesh: Mesh
    divisions: Divisions
    fuselage: Fuselage
    wings: dict[int, Wing]  #: by side, -1 port, +1 starboard
    fin: IntArray
    tailplane: dict[int, IntArray]
    engines: dict[int, int]  #: node row by side
    nose_pins: list[PinNode]
    main_pins: dict[int, list[PinNode]]


def assemble(refinement: float, catalogue: Catalogue) -> Parts:
    """Mesh the whole structure, without non-structural masses."""
    divisions = Divisions(refinement)
    mesh = Mesh(catalogue)
    fuselage = build_fuselage(mesh, divisions)
    wings = {side: build_wing(mesh, divisions, side) for side in (-1, 1)}
    build_centre_box(mesh, divisions, fuselage, list(wings.values()))
    main_pins = {
        side: build_main_gear(mesh, divisions, fuselage, wing) for side, wing in wings.items()
    }
    nose_pins = build_nose_gear(mesh, divisions, fuselage)
    fin = build_fin(mesh, divisions, fuselage)
    tailplane = build_tailplane(mesh, divisions, fin)
    engines = {side: build_engine(mesh, divisions, fuselage, side) for side in (-1, 1)}
    return Parts(mesh, divisions, fuselage, wings, fin, tailplane, engines, nose_pins, main_pins)
