"""Loading an aircraft folder: parts separated, pins and zones found, misfits refused."""

from pathlib import Path

import numpy as np
import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from solver.errors import ModelError
from tests.solver.aircraft.mini import DEFINITION


def reloaded(
    mini_folder: Path, folder: Path, *changes: tuple[str, str], bulk: str = ""
) -> Airframe:
    """Load a copy of the mini whose definition is changed and whose bulk data is added to."""
    text = DEFINITION.read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "definition.toml").write_text(text)
    deck = (mini_folder / "airframe.bdf").read_text()
    (folder / "airframe.bdf").write_text(deck.replace("ENDDATA", bulk + "\nENDDATA"))
    return load_airframe(folder)


def test_tanks_and_bays_are_not_part_of_the_empty_structure(mini):
    kept = mini.structure.model.point_masses.identifiers
    assert not np.any((kept >= 7000) & (kept < 9000))
    assert [group.name for group in mini.groups] == ["wing_left", "wing_right", "cabin"]
    assert len(mini.groups[0].inertia.points) == 20


def test_pins_come_in_the_order_of_the_gears(mini):
    nodes = mini.structure.model.node_identifiers[mini.pin_rows]
    assert nodes.tolist() == [901, 902, 903, 904, 151, 142, 162, 251, 242, 262]


def test_pin_loads_are_unit_forces_and_moments_at_the_pins(mini):
    modes = mini.structure.rigid_modes(np.zeros(3))
    resultants = (modes.T @ mini.pin_loads.toarray()).reshape(6, -1, 6)
    for pin, row in enumerate(mini.pin_rows):
        place = mini.structure.model.coordinates[row]
        for axis in range(3):
            unit = np.eye(3)[axis]
            np.testing.assert_allclose(
                resultants[:, pin, axis], [*unit, *np.cross(place, unit)], atol=1e-12
            )
            np.testing.assert_allclose(
                resultants[:, pin, 3 + axis], [0.0, 0.0, 0.0, *unit], atol=1e-12
            )


def test_every_element_has_a_zone_an_allowable_and_a_place(mini):
    model = mini.structure.model
    count = len(model.element_identifiers)
    assert mini.element_zone.shape == mini.allowables.shape == (count,)
    assert mini.centroids.shape == (count, 3)
    names = [mini.definition.zones[zone].name for zone in mini.element_zone]
    starboard = [name == "wing box, starboard" for name in names]
    assert np.all(mini.centroids[starboard, 1] > 0.0)
    shells = len(model.quads.identifiers)
    wing = np.array([name.startswith("wing") for name in names])
    assert set(mini.allowables[:shells][wing[:shells]]) == {290e6}
    assert set(mini.allowables[shells:][wing[shells:]]) == {380e6}
    # caps sit 20 mm inside the skin line
    assert mini.recovery.n_shells == shells


def test_a_zone_may_replace_its_materials_allowables(mini_folder, tmp_path):
    extra = 'name = "fuselage"\nbeam_limit_allowable_pa = 111e6'
    airframe = reloaded(
        mini_folder, tmp_path, ('[[zones]]\nname = "fuselage"', f"[[zones]]\n{extra}")
    )
    index = [zone.name for zone in airframe.definition.zones].index("fuselage")
    assert set(airframe.allowables[airframe.element_zone == index]) == {111e6}


def test_steps_are_reported_from_start_to_end(mini_folder):
    steps: dict[str, list[float]] = {}
    load_airframe(mini_folder, lambda step, share: steps.setdefault(step, []).append(share))
    assert "reading the aircraft" in steps
    assert all(shares == sorted(shares) and shares[-1] <= 1.0 for shares in steps.values())


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("properties = [40]\nlook_for", "properties = [41]\nlook_for", "'fuselage': no el"),
        (
            "properties = [11, 13, 15]",
            "properties = [11, 13]",
            "elements belong to no zone; their properties: 15",
        ),
        (
            "properties = [11, 13, 15]",
            "properties = [11, 13, 14, 15]",
            r"element \d+ \(property 14\) belongs to zones 'wing box, port' and 'wing box, star",
        ),
        ("mat1 = 3", "mat1 = 33", "property 12 is of MAT1 3, for which neither"),
        ("node = 904", "node = 905", r"gears\.nose\.pins\.starboard-aft: node 905 is not in"),
        ("capacity_kg = 1200.0", "capacity_kg = 1100.0", r"cabin: its 4 CONM2 \(8001-8099\) weigh"),
        ("conm2 = [[8001, 8099]]", "conm2 = [[8501, 8599]]", "cabin: its 0 CONM2"),
        (
            "conm2 = [[7101, 7199]]",
            "conm2 = [[7001, 7199]]",
            "CONM2 7001 belongs to wing_left and wing_right",
        ),
        ("operating_empty_kg = 8235.0", "operating_empty_kg = 8000.0", "weigh 8235.0 kg"),
        ('bulk_data = "airframe.bdf"', 'bulk_data = "other.bdf"', r"other\.bdf: cannot be read"),
    ],
)  # fmt: skip
def test_a_definition_that_does_not_fit_its_bulk_data_is_refused(
    mini_folder, tmp_path, old, new, message
):
    with pytest.raises(ModelError, match=message):
        reloaded(mini_folder, tmp_path, (old, new))


@pytest.mark.parametrize(
    ("bulk", "message"),
    [
        ("CBUSH,99,1,1,2", "CBUSH 99: this card is not supported"),
        ("GRID,9999,,0.,0.,0.", "9999"),
        ("GRID,9998,,0.,50.,0.\nGRID,9999,,1.,50.,0.\nCBAR,9999,40,9998,9999,0.,0.,1.", "parts"),
    ],
)
def test_bulk_data_that_makes_no_aircraft_is_refused(mini_folder, tmp_path, bulk, message):
    with pytest.raises(ModelError, match=message):
        reloaded(mini_folder, tmp_path, bulk=bulk)


def test_the_hash_is_that_of_the_two_files(mini, mini_folder, tmp_path):
    assert len(mini.content_hash) == 64
    assert reloaded(mini_folder, tmp_path, bulk="$ x").content_hash != mini.content_hash
