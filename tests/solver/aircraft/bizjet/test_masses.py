"""Mass, balance, inertia and free vibration of the example aircraft."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from solver.aircraft.airframe import Airframe
from solver.aircraft.bizjet import loading
from solver.aircraft.bizjet.masses import spread
from solver.arrays import Array
from solver.errors import ModelError
from solver.fe.inertia import combine
from solver.inertia_relief.basis import elastic_modes
from solver.inertia_relief.free_body import free_body


def reference_factors(airframe: Airframe) -> Array:
    fuel = loading.REFERENCE_FUEL_SHARE * loading.FUEL_CAPACITY
    return airframe.fill_factors(
        {"wing-left": fuel, "wing-right": fuel},
        {name: capacity for name, capacity, _, _ in loading.PAYLOAD_BAYS},
    )


def whole(airframe: Airframe, factors: Array) -> tuple[float, Array, Array]:
    """Mass, centre and inertia about it, with the unsprung masses at full extension."""
    body = airframe.mass_properties(factors)
    parts = [(body.mass, body.centre_of_gravity, body.inertia)]
    parts += [(mass, np.array(place), np.zeros((3, 3))) for mass, place in loading.UNSPRUNG]
    mass = sum(part[0] for part in parts)
    centre = sum((part[0] * part[1] for part in parts), start=np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for part, place, own in parts:
        lever = place - centre
        inertia += own + part * (lever @ lever * np.eye(3) - np.outer(lever, lever))
    return mass, centre, inertia


def test_reference_loading_meets_mass_balance_and_inertia(airframe: Airframe) -> None:
    mass, centre, inertia = whole(airframe, reference_factors(airframe))
    assert mass == pytest.approx(12_292.0, abs=0.01)
    assert centre == pytest.approx([9.9, 0.0, 1.95], abs=1e-4)
    # Radii of gyration 0.28, 0.33, 0.43 of the usual lengths; pitch is met by construction.
    assert inertia[1, 1] == pytest.approx(125_300, rel=1e-3)
    assert inertia[0, 0] == pytest.approx(89_741, rel=0.15)
    assert inertia[2, 2] == pytest.approx(212_197, rel=0.10)
    assert inertia[0, 2] == pytest.approx(-8_488, rel=0.15)
    assert np.abs(inertia[[0, 1], [1, 2]]).max() < 1.0


def test_operating_empty_mass_and_groups(airframe: Airframe) -> None:
    empty = airframe.mass_properties(np.zeros(5)).mass + loading.UNSPRUNG_MASS
    assert empty == pytest.approx(8_235.0, abs=0.01)
    capacities = {group.name: group.capacity for group in airframe.groups}
    assert capacities["wing-left"] == pytest.approx(2_545.5, abs=0.01)
    assert capacities["wing-right"] == pytest.approx(2_545.5, abs=0.01)
    bays = [capacities[name] for name, *_ in loading.PAYLOAD_BAYS]
    assert sum(bays) == pytest.approx(1_200.0, abs=0.01)


def test_fuel_lies_between_the_tanks_ends(airframe: Airframe) -> None:
    for group, side in zip(airframe.groups[:2], (-1, 1), strict=True):
        y = group.inertia.points[:, 1] * side
        centre = group.moments.first[1] / group.capacity * side
        assert y.min() > 0.7
        assert y.max() < 9.7
        # Between the centroid of a prism (4.8 m) and that of a pyramid over its span (2.9 m).
        assert 2.9 < centre < 4.8


def test_every_loading_lies_in_the_centre_of_gravity_range(airframe: Airframe) -> None:
    reference = airframe.definition.reference
    for fuel in (0.2, 0.56, 0.8):
        for payload in (0.0, 0.5, 1.0):
            _, centre, _ = whole(airframe, np.array([fuel] * 2 + [payload] * 3))
            assert centre[0] > reference.forward_centre_of_gravity
            assert centre[0] < reference.aft_centre_of_gravity


def test_rigid_modes_store_no_energy(airframe: Airframe) -> None:
    structure = airframe.structure
    modes = structure.rigid_modes(np.array([9.9, 0.0, 1.95]))
    forces = structure.stiffness @ modes
    assert np.abs(forces).max() < 1e-12 * np.abs(structure.stiffness.data).max()


def test_lowest_modes_are_global_and_symmetric_or_antisymmetric(airframe: Airframe) -> None:
    structure = airframe.structure
    inertia = combine(
        [(1.0, structure.inertia), *((0.5, group.inertia) for group in airframe.groups)]
    )
    body = free_body(structure, inertia)
    frequencies, shapes = elastic_modes(body, 8)
    hertz = frequencies / (2 * np.pi)
    # Wing bending of business jets lies between 2 and 6 Hz; below it nothing may be loose.
    assert 2.0 < hertz[0] < 6.0
    nodes = structure.nodal_displacements(shapes)
    points = structure.model.coordinates
    twin = cKDTree(points).query(points * [1, -1, 1])[1]
    flip = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    mirrored = nodes[twin] * flip[None, :, None]
    symmetric = np.linalg.norm(nodes + mirrored, axis=(0, 1)) / 2
    antisymmetric = np.linalg.norm(nodes - mirrored, axis=(0, 1)) / 2
    share = symmetric**2 / (symmetric**2 + antisymmetric**2)
    assert np.all((share < 1e-6) | (share > 1 - 1e-6))
    assert share[0] > 0.5  # first wing bending is symmetric
    assert np.any(share < 0.5)


def test_spread_has_the_moments_it_is_asked_for() -> None:
    random = np.random.default_rng(4)
    points = random.uniform([0, -1, 0], [18, 1, 3], (60, 3))
    masses = spread(points, np.ones(60), 100.0, np.array([830.0, 140.0]), 9_000.0)
    assert masses.sum() == pytest.approx(100.0)
    assert masses @ points[:, 0] == pytest.approx(830.0)
    assert masses @ points[:, 2] == pytest.approx(140.0)
    assert masses @ (points[:, 0] ** 2 + points[:, 2] ** 2) == pytest.approx(9_000.0)
    assert masses.min() > 0


def test_spread_without_demands_is_the_base() -> None:
    points = np.random.default_rng(5).uniform(-1, 1, (20, 3))
    base = np.arange(1.0, 21.0)
    own = base / base.sum()
    moments = own @ points[:, [0, 2]]
    polar = own @ (points[:, 0] ** 2 + points[:, 2] ** 2)
    assert spread(points, base, 1.0, moments, float(polar)) == pytest.approx(own)


def test_impossible_moments_are_refused() -> None:
    points = np.random.default_rng(6).uniform(0, 1, (20, 3))
    with pytest.raises(ModelError, match="no spread"):
        spread(points, np.ones(20), 1.0, np.array([2.0, 0.5]), 1.0)
