"""Stick models: identified on an airframe that is one already, and on the mini aircraft."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from solver.errors import ModelError
from solver.fe.model import BeamProperty, Beams, FiniteElementModel, Material, PointMasses, Shells
from solver.fe.structure import Structure, build_structure
from solver.flexible_landing.full_airframe import dense_modes
from solver.flexible_landing.identification import BayLoads, bay_section
from solver.flexible_landing.lumping import lumped_masses
from solver.flexible_landing.stations import (
    Branch,
    Station,
    carried,
    fitting_station,
    section_station,
    wrench_transfer,
)
from solver.flexible_landing.stick import build_stick, stick_modes
from solver.gear.parameters import Pin
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.static import inertia_relief
from solver.landing.aircraft import LandingAircraft
from tests.solver.flexible_landing.conftest import Mini

#: Nodes and chains of a T of beams; the gears hang on nodes of their own.
POINTS = {
    "nose cone": (0.0, 0.0, 2.0),
    "front": (2.0, 0.0, 2.0),
    "middle": (4.0, 0.0, 2.0),
    "tail": (8.0, 0.0, 2.3),
    "left root": (4.2, -1.5, 1.9),
    "left tip": (4.6, -4.0, 2.1),
    "right root": (4.2, 1.5, 1.9),
    "right tip": (4.6, 4.0, 2.1),
    "nose": (2.1, 0.0, 1.3),
    "main_left": (4.5, -1.5, 1.4),
    "main_right": (4.5, 1.5, 1.4),
}
CHAINS = (
    ("middle", "front", "nose cone"),
    ("middle", "tail"),
    ("middle", "left root", "left tip"),
    ("middle", "right root", "right tip"),
    ("front", "nose"),
    ("left root", "main_left"),
    ("right root", "main_right"),
)
MATERIAL = Material(1, 70e9, 27e9, 0.3, 0.0)
GEARS = ("nose", "main_left", "main_right")


@pytest.fixture(scope="module")
def beams() -> Structure:
    """Every bay with its own section, axis beside the nodes, and shear flexibility."""
    names = list(POINTS)
    bays = [bay for chain in CHAINS for bay in pairwise(chain)]
    coordinates = np.array([POINTS[name] for name in names])
    generator = np.random.default_rng(3)
    offsets, orientations = [], []
    for inner, outer in bays:
        along = np.subtract(POINTS[outer], POINTS[inner])
        along = along / np.linalg.norm(along)
        side = generator.standard_normal(3)
        offset = generator.uniform(-0.1, 0.1, 3)
        orientations.append(side - along * (along @ side))
        offsets.append(offset - along * (along @ offset))
    sections = {
        k + 1: BeamProperty(
            k + 1, 1, 4e-3 * (1 + 0.1 * k), 3e-5 * (1 + 0.2 * k), 1e-5 * (1 + 0.1 * k), 2e-5,
            np.zeros((4, 2)), shear_factor_1=0.5, shear_factor_2=0.4,
        )
        for k in range(len(bays))
    }  # fmt: skip
    none = np.zeros(0, dtype=np.int64)
    count = len(names)
    return build_structure(
        FiniteElementModel(
            np.arange(1, count + 1), coordinates, {1: MATERIAL}, {}, sections,
            Shells(none, none.reshape(0, 4), none), Shells(none, none.reshape(0, 3), none),
            Beams(
                np.arange(1, len(bays) + 1),
                np.array([[names.index(inner), names.index(outer)] for inner, outer in bays]),
                np.arange(1, len(bays) + 1),
                np.array(orientations),
                np.array([[offset, offset] for offset in offsets]),
            ),
            PointMasses(
                np.arange(1, count + 1),
                np.arange(count),
                generator.uniform(100.0, 900.0, count),
                np.zeros((count, 3)),
                generator.uniform(20.0, 50.0, count)[:, None, None] * np.eye(3),
            ),
        )
    )  # fmt: skip


def test_stick_of_a_stick_is_the_same_stick(beams: Structure, mini: Mini) -> None:
    names = list(POINTS)
    gears = tuple(
        replace(
            gear,
            pivot=np.array(POINTS[gear.name]),
            pins=(Pin("only", np.array(POINTS[gear.name]), np.full(6, 1e8)),),
        )
        for gear in mini.aircraft.gears
    )
    body = beams.inertia.rigid_body_properties()
    aircraft = LandingAircraft(body.mass, body.centre_of_gravity, body.inertia, gears)
    stations = [
        section_station(name, beams, np.array([names.index(name)]))
        for name in names
        if name not in GEARS
    ]
    stations += [fitting_station(beams, gear, np.array([names.index(gear.name)])) for gear in gears]
    air = beams.nodal_loads(np.array([names.index("middle")])).toarray()
    stick = build_stick(
        beams, beams.inertia, inertia_relief(free_body(beams)), air, aircraft, tuple(stations),
        tuple(Branch(chain) for chain in CHAINS),
    )  # fmt: skip
    model = beams.model
    for k, found in enumerate(stick.sections):
        section = model.beam_properties[k + 1]
        rigidity = MATERIAL.shear_modulus * section.area
        expected = [
            MATERIAL.young_modulus * section.area,
            MATERIAL.young_modulus * section.inertia_1,
            MATERIAL.young_modulus * section.inertia_2,
            MATERIAL.shear_modulus * section.torsion_constant,
            rigidity * section.shear_factor_1,
            rigidity * section.shear_factor_2,
        ]
        values = [
            found.axial, found.bending_1, found.bending_2, found.torsion, found.shear_1,
            found.shear_2,
        ]  # fmt: skip
        assert values == pytest.approx(expected, rel=1e-5)
        assert found.offset == pytest.approx(model.beams.offsets[k, 0], abs=1e-6)
        side = model.beams.orientations[k] / np.linalg.norm(model.beams.orientations[k])
        assert abs(found.orientation @ side) == pytest.approx(1.0, abs=1e-8)
    frequency, _ = dense_modes(beams, beams.inertia)
    modes = stick_modes(stick, aircraft, RayleighDamping())
    assert modes.circular_frequency == pytest.approx(frequency, rel=1e-5)


def mini_stations(mini: Mini) -> tuple[tuple[Station, ...], tuple[np.ndarray, ...]]:
    structure = mini.airframe.structure
    x = structure.model.coordinates[:, 0]
    cuts = np.quantile(x, np.linspace(0.0, 1.0, 7))
    stations = [
        section_station(f"slice {k}", structure, np.flatnonzero((x >= low) & (x <= high)))
        for k, (low, high) in enumerate(pairwise(cuts))
    ]
    first = 0
    for gear in mini.aircraft.gears:
        rows = mini.airframe.pin_rows[first : first + len(gear.pins)]
        first += len(gear.pins)
        stations.append(fitting_station(structure, gear, rows))
    pins = tuple(np.array([pin.position for pin in gear.pins]) for gear in mini.aircraft.gears)
    return tuple(stations), pins


def test_lumped_masses_keep_mass_centre_and_inertia(mini: Mini) -> None:
    stations, pins = mini_stations(mini)
    masses = lumped_masses(mini.airframe.structure, mini.inertia, stations, pins)
    assert masses.masses.sum() == pytest.approx(mini.aircraft.mass, rel=1e-12)
    points = np.array([station.point for station in stations]) + masses.offsets
    centre = masses.masses @ points / masses.masses.sum()
    assert centre == pytest.approx(mini.aircraft.centre_of_gravity, abs=1e-10)
    levers = points - centre
    second = np.einsum("k,ki,kj->ij", masses.masses, levers, levers)
    inertia = np.trace(second) * np.eye(3) - second + masses.inertias.sum(axis=0)
    assert inertia == pytest.approx(mini.aircraft.inertia, rel=1e-10, abs=1e-6)


def test_stations_follow_rigid_motion_exactly(mini: Mini) -> None:
    stations, _ = mini_stations(mini)
    rigid = mini.airframe.structure.rigid_modes(np.zeros(3))
    for station in stations:
        expected = wrench_transfer(station.point).T
        assert np.abs(station.motion @ rigid - expected).max() < 1e-9


def test_station_of_nothing_or_of_a_line_is_refused(mini: Mini) -> None:
    structure = mini.airframe.structure
    with pytest.raises(ModelError, match="no nodes"):
        section_station("void", structure, np.array([], dtype=np.int64))
    y, z = structure.model.coordinates[:, 1:].T
    line = np.flatnonzero((y == 0.0) & (z == 2.2))
    assert len(line) > 2
    with pytest.raises(ModelError, match="lie on one line"):
        section_station("fuselage", structure, line)


def test_bay_that_yields_the_wrong_way_is_refused(mini: Mini) -> None:
    stations, _ = mini_stations(mini)
    section = np.random.default_rng(1).standard_normal((6, 12))
    with pytest.raises(ModelError, match="slice 0 to slice 1"):
        bay_section(stations[0], stations[1], BayLoads(section, -1e-8 * section))


def test_wrench_and_motion_carried_along_do_the_same_work() -> None:
    generator = np.random.default_rng(2)
    motion, wrench, arm = (generator.standard_normal(size) for size in (6, 6, 3))
    at_arm = np.linalg.solve(wrench_transfer(arm), wrench)
    assert carried(motion, arm) @ at_arm == pytest.approx(motion @ wrench)


def test_axial_flexibility_that_cannot_be_told_is_taken_as_small(mini: Mini) -> None:
    """The bay answers all loads like a beam but axial ones, whose motion opposes them."""
    stations, _ = mini_stations(mini)
    section = np.random.default_rng(1).standard_normal((6, 12))
    flexibility = np.array([-1e-9, 6e-9, 3e-8, 5e-8, 5e-8, 9e-9])
    inner = stations[0]
    # along x the bay's own axes are structural ones
    outer = replace(stations[1], point=inner.point + np.array([0.8, 0.0, 0.0]))
    bay = bay_section(inner, outer, BayLoads(section, flexibility[:, None] * section))
    assert bay.axial == pytest.approx(bay.length / (1e-2 * 6e-9))
    assert bay.torsion == pytest.approx(bay.length / 5e-8)
