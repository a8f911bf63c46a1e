"""Stick model of an airframe: beams between stations, identified on the full-size airframe."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array, eye_array, vstack

from solver.arrays import Array
from solver.fe.inertia import point_mass_inertia
from solver.fe.model import (
    BeamProperty,
    Beams,
    FiniteElementModel,
    Material,
    PointMasses,
    Shells,
)
from solver.fe.structure import Structure, build_structure, rigid_motion
from solver.flexible_landing.full_airframe import modes_of_structure
from solver.flexible_landing.identification import (
    BaySection,
    bay_loads,
    bay_section,
)
from solver.flexible_landing.lumping import lumped_loads, lumped_masses
from solver.flexible_landing.modes import FlexibleAirframe
from solver.flexible_landing.stations import Branch, Station
from solver.gear.pins import resultant_matrix
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.static import InertiaRelief
from solver.landing.aircraft import LandingAircraft

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia

#: A load case with less strain energy than this share of the largest deforms nothing.
_NO_ENERGY = 1e-12
#: Material that turns rigidities into section figures; any other gives the same beams.
_MATERIAL = Material(1, 70e9, 27e9, 0.3, 0.0)


@dataclass(frozen=True, slots=True)
class Stick:
    """A stick model with what it was made from."""

    structure: Structure
    stations: tuple[Station, ...]
    bays: tuple[tuple[str, str], ...]  #: names of the stations at both ends of every beam
    sections: tuple[BaySection, ...]
    air: Array  #: (n_free, 6) loads of unit air resultants about the structural origin


def build_stick(
    full: Structure,
    inertia: "Inertia",
    relief: InertiaRelief,
    air_shapes: Array,
    aircraft: LandingAircraft,
    stations: tuple[Station, ...],
    branches: tuple[Branch, ...],
) -> Stick:
    """Identify a stick model.

    Parameters
    ----------
    full, inertia, relief
        The full-size airframe, its inertia at the loading wanted, its static solver.
    air_shapes : (n_free, 6) array
        Air loads of unit resultants on the full-size airframe.
    aircraft : LandingAircraft
        The same airframe as a rigid body with its gears.
    stations : tuple of Station
        In any order; those that are fittings in the order of the gears.
    branches : tuple of Branch
        Every bay once; together a tree.
    """
    rows = {station.name: row for row, station in enumerate(stations)}
    bays = tuple(bay for branch in branches for bay in pairwise(branch.stations))
    pins = tuple(np.array([pin.position for pin in gear.pins]) for gear in aircraft.gears)
    masses = lumped_masses(full, inertia, stations, pins)
    points = np.array([station.point for station in stations])
    air = lumped_loads(full, air_shapes, stations, pins)
    tips = np.zeros((len(stations), 6, 6 * len(branches)))
    for k, branch in enumerate(branches):
        tips[rows[branch.stations[-1]], :, 6 * k : 6 * k + 6] = np.eye(6)
    loads = balanced(points, masses, np.concatenate([tips, air], axis=2))
    loads, motions = full_answers(relief, stations, loads)
    parents = {rows[outer]: rows[inner] for inner, outer in bays}
    sections = []
    for outer, inner in parents.items():
        beyond = [(points[k], loads[k]) for k in _outboard(outer, parents)]
        ends = (motions[inner], motions[outer])
        case = bay_loads(stations[inner], stations[outer], ends, beyond)
        sections.append(bay_section(stations[inner], stations[outer], case))
    none = Shells(*(np.zeros(shape, dtype=np.int64) for shape in ((0,), (0, 4), (0,))))
    model = FiniteElementModel(
        node_identifiers=np.arange(1, len(stations) + 1),
        coordinates=points,
        materials={_MATERIAL.identifier: _MATERIAL},
        shell_properties={},
        beam_properties={k + 1: _property(k + 1, section) for k, section in enumerate(sections)},
        quads=none,
        triangles=Shells(none.identifiers, none.nodes[:, :3], none.properties),
        beams=Beams(
            identifiers=np.arange(1, len(bays) + 1),
            nodes=np.array([[rows[inner], rows[outer]] for inner, outer in bays]),
            properties=np.arange(1, len(bays) + 1),
            orientations=np.array([section.orientation for section in sections]),
            offsets=np.array([[section.offset, section.offset] for section in sections]),
        ),
        point_masses=masses,
    )
    structure = build_structure(model)
    nodal = structure.nodal_loads(np.arange(len(stations)))
    return Stick(
        structure,
        stations,
        bays,
        tuple(sections),
        np.asarray(nodal @ air.reshape(-1, air.shape[2])),
    )


def balanced(points: Array, masses: PointMasses, loads: Array) -> Array:
    """Balance loads (n_stations, 6, k) by the inertia of the masses that they call up."""
    inertia = point_mass_inertia(csr_array(eye_array(6 * len(points))), points, masses)
    rigid = rigid_motion(points, inertia.rigid_body_properties().centre_of_gravity)
    momentum = inertia.mass_matrix() @ rigid
    flat = loads.reshape(len(rigid), -1)
    flat = flat - momentum @ np.linalg.solve(rigid.T @ momentum, rigid.T @ flat)
    return np.asarray(flat.reshape(loads.shape))


def full_answers(
    relief: InertiaRelief, stations: tuple[Station, ...], loads: Array
) -> tuple[Array, Array]:
    """Scale loads (n_stations, 6, k) to unit strain energy on the full airframe; its motions."""
    motion = csr_array(vstack([station.motion for station in stations]))
    flat = loads.reshape(motion.shape[0], -1)
    answer = motion @ relief.displacement(motion.T @ flat)
    energy = np.einsum("ik,ik->k", flat, answer)
    kept = energy > _NO_ENERGY * energy.max()
    scale = 1.0 / np.sqrt(energy[kept])
    shape = (len(stations), 6, int(kept.sum()))
    return (flat[:, kept] * scale).reshape(shape), (answer[:, kept] * scale).reshape(shape)


def _outboard(station: int, parents: dict[int, int]) -> list[int]:
    """Give the station and all that hang on it."""
    found = [station]
    for child, parent in parents.items():
        if parent == station:
            found += _outboard(child, parents)
    return found


def stick_modes(
    stick: Stick, aircraft: LandingAircraft, damping: RayleighDamping
) -> FlexibleAirframe:
    """All modes of a stick model, its gears held by their fittings."""
    fittings = [row for row, station in enumerate(stick.stations) if station.is_fitting]
    loads = [
        np.asarray(
            stick.structure.nodal_loads(np.array([row])) @ resultant_matrix(gear.pins, gear.pivot)
        )
        for row, gear in zip(fittings, aircraft.gears, strict=True)
    ]
    return modes_of_structure(
        stick.structure,
        stick.structure.inertia,
        np.hstack([*loads, stick.air]),
        aircraft,
        damping,
    )


def _property(identifier: int, section: BaySection) -> BeamProperty:
    material = _MATERIAL
    area = section.axial / material.young_modulus
    shear = material.shear_modulus * area
    return BeamProperty(
        identifier=identifier,
        material=material.identifier,
        area=area,
        inertia_1=section.bending_1 / material.young_modulus,
        inertia_2=section.bending_2 / material.young_modulus,
        torsion_constant=section.torsion / material.shear_modulus,
        stress_points=np.zeros((4, 2)),
        shear_factor_1=section.shear_1 / shear if np.isfinite(section.shear_1) else 0.0,
        shear_factor_2=section.shear_2 / shear if np.isfinite(section.shear_2) else 0.0,
    )
