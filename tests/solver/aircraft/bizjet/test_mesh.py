"""The generated mesh: size, joints, element shapes, symmetry, and its two files."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from solver.aircraft.airframe import Airframe
from solver.aircraft.bizjet import build_bizjet
from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.assembly import assemble
from solver.aircraft.bizjet.catalogue import Catalogue
from solver.aircraft.bizjet.divisions import Divisions
from solver.arrays import Array
from solver.errors import ModelError
from solver.fe.model import FiniteElementModel

MIRROR = np.array([1.0, -1.0, 1.0])


@pytest.fixture(scope="module")
def full() -> FiniteElementModel:
    return assemble(1.0, Catalogue()).mesh.model()


def test_full_model_has_the_stated_size(full: FiniteElementModel) -> None:
    # 104 nodes that carry edge masses come with the masses.
    assert 4_500 <= full.node_count + 104 <= 5_100
    assert 8_800 <= len(full.element_identifiers) <= 9_800


def test_same_arguments_give_the_same_bytes(folder: Path, tmp_path: Path) -> None:
    build_bizjet(tmp_path, 0.25)
    for name in ("definition.toml", "airframe.bdf"):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes()


def test_nodes_that_should_join_are_one_node(full: FiniteElementModel) -> None:
    fitting = {link.reference for link in full.interpolations}
    pairs = cKDTree(full.coordinates).query_pairs(2e-3)
    assert not [pair for pair in pairs if not fitting & set(pair)]


def test_mesh_is_symmetric_port_to_starboard(full: FiniteElementModel) -> None:
    distance, twin = cKDTree(full.coordinates).query(full.coordinates * MIRROR)
    assert distance.max() < 1e-9

    def elements(nodes: Array, properties: Array) -> set[tuple[int, ...]]:
        return {
            (*sorted(corners), section % 1000 + section // 10_000 * 10_000)
            for corners, section in zip(nodes.tolist(), properties.tolist(), strict=True)
        }

    for part in (full.quads, full.triangles, full.beams):
        as_built = elements(part.nodes, part.properties)
        assert as_built == elements(twin[part.nodes], part.properties)
    ends = full.coordinates[full.beams.nodes] + full.beams.offsets
    centres = ends.mean(axis=1)
    assert cKDTree(centres).query(centres * MIRROR)[0].max() < 1e-6


def test_shells_are_well_shaped(full: FiniteElementModel) -> None:
    corners = full.coordinates[full.quads.nodes]
    sides = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(sides, axis=2)
    assert (lengths.max(axis=1) / lengths.min(axis=1)).max() < 8
    back = np.roll(corners, 1, axis=1) - corners
    cosines = np.sum(sides * back, axis=2) / lengths / np.linalg.norm(back, axis=2)
    angles = np.degrees(np.arccos(cosines))
    assert angles.min() > 40
    assert angles.max() < 140
    first = np.cross(sides[:, 0], back[:, 0])
    second = np.cross(sides[:, 2], back[:, 2])
    turn = np.sum(first * second, axis=1) / np.linalg.norm(first, axis=1)
    warp = np.degrees(np.arccos(np.clip(turn / np.linalg.norm(second, axis=1), -1, 1)))
    assert warp.max() < 20
    assert np.mean(warp > 5) < 0.02


def test_beams_stand_on_their_skin_side_up(full: FiniteElementModel) -> None:
    points = full.coordinates[full.beams.nodes]
    axis = points[:, 1] - points[:, 0]
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    upright = full.beams.orientations
    upright = upright / np.linalg.norm(upright, axis=1)[:, None]
    # Nowhere may the orientation vector come near the beam's own axis.
    assert np.abs(np.sum(axis * upright, axis=1)).max() < 0.75


def test_refinement_divides_bays_and_keeps_the_structure() -> None:
    once, twice = (assemble(factor, Catalogue()).mesh.model() for factor in (1.0, 2.0))
    assert 3.5 < len(twice.quads.nodes) / len(once.quads.nodes) < 4.2
    assert 1.9 < len(twice.beams.nodes) / len(once.beams.nodes) < 2.6
    assert set(twice.shell_properties) == set(once.shell_properties)
    assert set(twice.beam_properties) == set(once.beam_properties)


@pytest.mark.parametrize("refinement", [0.0, 0.1, 9.0, float("nan")])
def test_refinement_out_of_range_is_refused(refinement: float) -> None:
    with pytest.raises(ModelError, match="refinement"):
        Divisions(refinement)


def test_every_element_lies_in_one_zone(airframe: Airframe) -> None:
    properties = airframe.structure.model.element_properties
    inside = np.array([zone.properties.contains(properties) for zone in airframe.definition.zones])
    assert np.array_equal(inside.sum(axis=0), np.ones(len(properties)))
    assert inside.any(axis=1).all()


def test_sides_of_zones_are_where_they_say(airframe: Airframe) -> None:
    sides = np.array([zone.side for zone in airframe.definition.zones])[airframe.element_zone]
    y = airframe.centroids[:, 1]
    assert np.all(y[sides == "port"] < 0)
    assert np.all(y[sides == "starboard"] > 0)
    assert np.abs(y[sides == "centre"]).max() < 1e-3


def test_pins_sit_on_lug_footprints_around_the_pivot(airframe: Airframe) -> None:
    model = airframe.structure.model
    lugs = {link.reference: link.nodes for link in model.interpolations}
    first = 0
    for gear in airframe.definition.gears:
        rows = airframe.pin_rows[first : first + len(gear.pins)]
        first += len(gear.pins)
        assert len(rows) == (4 if gear.position == "nose" else 3)
        for row in rows:
            footprint = model.coordinates[lugs[int(row)]]
            assert len(footprint) >= 6
            # Half a bay at most, and the bays of the coarse mesh are wide.
            assert np.linalg.norm(model.coordinates[row] - footprint.mean(axis=0)) < 0.35
        # The trunnion's pins lie on either side of the leg, on the height of its pivot.
        trunnion = model.coordinates[rows[:2]]
        assert np.allclose(trunnion[:, 2], gear.pivot[2], atol=1e-4)
        axis = 0 if gear.position == "main" else 1
        assert trunnion[:, axis].min() < gear.pivot[axis] < trunnion[:, axis].max()


def test_section_law_is_that_of_the_naca_four_digit_series() -> None:
    # Report 460: the largest ordinate is half the thickness, at 30 % of the chord.
    x = np.linspace(0, 1, 1001)
    half = dim.half_thickness(x)
    assert half.max() == pytest.approx(0.5, abs=3e-4)
    assert x[half.argmax()] == pytest.approx(0.30, abs=2e-3)


def test_reference_wing_adds_up() -> None:
    span = 2 * dim.HALF_SPAN
    area = span * (dim.WING_ROOT_CHORD + dim.WING_TIP_CHORD) / 2
    assert area == pytest.approx(dim.WING_AREA, rel=1e-3)
    y = np.linspace(0, dim.HALF_SPAN, 4001)
    chord = dim.wing_chord(y)
    mean = 2 / area * np.trapezoid(chord**2, y)
    station = 2 / area * np.trapezoid(chord * dim.wing_leading_edge(y), y)
    assert mean == pytest.approx(dim.MEAN_CHORD, rel=1e-3)
    assert station == pytest.approx(dim.MEAN_CHORD_LEADING_EDGE, rel=1e-3)
