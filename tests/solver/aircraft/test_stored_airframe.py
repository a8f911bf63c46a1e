"""The airframe as assessments map it is the one that was parsed, and never another's."""

from dataclasses import fields

import numpy as np
import pytest

from solver.aircraft.airframe import load_airframe
from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.stored_airframe import load_stored_airframe, store_airframe
from tests.solver.aircraft.mini import write_mini_aircraft

ARRAYS = [
    field.name
    for field in fields(AssessedAirframe)
    if field.name not in ("definition", "content_hash", "mass_states")
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stored") / "mini"
    write_mini_aircraft(folder)
    return folder


@pytest.fixture
def stored(folder, tmp_path) -> AssessedAirframe:
    return store_airframe(load_airframe(folder), tmp_path)


def test_nothing_is_found_before_anything_is_stored(folder, tmp_path):
    assert load_stored_airframe(folder, tmp_path) is None


def test_the_stored_airframe_is_the_parsed_one(folder, tmp_path, stored):
    mapped, parsed = load_stored_airframe(folder, tmp_path), load_airframe(folder)
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(mapped, name), getattr(parsed, name))
    assert mapped.content_hash == parsed.content_hash
    assert mapped.mass_states.empty.mass == parsed.mass_states.empty.mass
    factors = np.linspace(0.2, 0.9, len(parsed.groups))
    mine, its = mapped.landing_aircraft(factors), parsed.landing_aircraft(factors)
    assert mine.mass == its.mass
    np.testing.assert_array_equal(mine.inertia, its.inertia)
    np.testing.assert_array_equal(mine.centre_of_gravity, its.centre_of_gravity)
    for gear, other in zip(mine.gears, its.gears, strict=True):
        for pin, same in zip(gear.pins, other.pins, strict=True):
            assert pin.name == same.name
            np.testing.assert_array_equal(pin.position, same.position)
    asked = parsed.definition.masses.operating_empty + 0.5 * parsed.groups[0].capacity
    np.testing.assert_array_equal(
        mapped.loading_for(mass=asked).factors, parsed.loading_for(mass=asked).factors
    )


def test_its_arrays_are_maps_of_files_that_processes_share(stored):
    with open("/proc/self/maps") as lines:
        regions = [line.split() for line in lines]
    for name in ARRAYS:
        array = getattr(stored, name)
        assert not array.flags.writeable
        address = array.ctypes.data
        found = [
            parts
            for parts in regions
            if int(parts[0].split("-")[0], 16) <= address < int(parts[0].split("-")[1], 16)
        ]
        assert found[0][1] == "r--s"  # read-only and shared, no private copy
        assert found[0][-1].endswith(f"/{name}.npy")


def test_a_changed_file_is_another_airframe(folder, tmp_path):
    changed = tmp_path / "changed"
    write_mini_aircraft(changed)
    cache = tmp_path / "cache"
    store_airframe(load_airframe(changed), cache)
    assert load_stored_airframe(changed, cache) is not None
    deck = changed / "airframe.bdf"
    deck.write_text(deck.read_text() + "$ one more comment\n")
    assert load_stored_airframe(changed, cache) is None


def test_arrays_of_another_format_are_not_used(folder, tmp_path, stored, monkeypatch):
    assert load_stored_airframe(folder, tmp_path) is not None
    monkeypatch.setattr("solver.aircraft.stored_airframe.FORMAT", 10_000)
    assert load_stored_airframe(folder, tmp_path) is None


def test_storing_twice_keeps_the_first(folder, tmp_path, stored):
    before = {path: path.stat().st_ino for path in tmp_path.rglob("*.npy")}
    store_airframe(load_airframe(folder), tmp_path)
    assert {path: path.stat().st_ino for path in tmp_path.rglob("*.npy")} == before


def test_a_missing_bulk_data_file_is_left_to_the_reader_to_name(folder, tmp_path):
    broken = tmp_path / "broken"
    write_mini_aircraft(broken)
    (broken / "airframe.bdf").unlink()
    assert load_stored_airframe(broken, tmp_path) is None
