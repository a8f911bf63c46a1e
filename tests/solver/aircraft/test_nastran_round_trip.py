"""What is written is read back: numbers to their last fitting digit, models field by field."""

import math
from dataclasses import fields, is_dataclass
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from solver.aircraft.nastran import parse_bulk_data, read_bulk_data
from solver.aircraft.nastran_cards import Card
from solver.aircraft.nastran_sections import section_property
from solver.aircraft.nastran_writer import format_bulk_data, format_real, write_bulk_data
from solver.errors import ModelError
from solver.fe.model import (
    BeamProperty,
    Beams,
    FiniteElementModel,
    Interpolation,
    Material,
    PointMasses,
    RigidBody,
    ShellProperty,
    Shells,
)
from tests.solver.aircraft.mini import mini_model

LENGTHS = st.floats(-30.0, 30.0).map(lambda x: 0.0 if abs(x) < 1e-6 else x)
SMALL = st.floats(1e-10, 1e-2)
#: as drawings have them; section figures are differences and would magnify a lost digit
WALLS = st.integers(1, 400).map(lambda tenths: tenths / 10_000)


def assert_same(one, other, tolerance):
    """Compare dataclasses, mappings and arrays leaf by leaf."""
    assert type(one) is type(other)
    if is_dataclass(one):
        for field in fields(one):
            assert_same(getattr(one, field.name), getattr(other, field.name), tolerance)
    elif isinstance(one, dict):
        assert list(one) == list(other)
        for key in one:
            assert_same(one[key], other[key], tolerance)
    elif isinstance(one, tuple):
        assert len(one) == len(other)
        for a, b in zip(one, other, strict=True):
            assert_same(a, b, tolerance)
    elif isinstance(one, np.ndarray):
        assert one.shape == other.shape
        np.testing.assert_allclose(other, one, rtol=tolerance, atol=0)
    elif isinstance(one, float):
        assert other == pytest.approx(one, rel=tolerance, abs=0)
    else:
        assert one == other


@st.composite
def models(draw):
    """A few nodes with every kind of card on them; not meant to carry load."""
    count = draw(st.integers(5, 9))
    nodes = draw(
        st.lists(st.integers(1, 99_999_999), min_size=count, max_size=count, unique=True).map(
            sorted
        )
    )
    places = np.array(
        draw(st.lists(st.tuples(LENGTHS, LENGTHS, LENGTHS), min_size=count, max_size=count))
    )
    # two bar nodes apart along x, so that a bar along them has a direction
    places[0], places[1] = (-40.0, 0.0, 0.0), (40.0, 1.0, 2.0)
    ratio = draw(st.floats(0.01, 0.45))
    young = draw(st.floats(1e6, 1e12))
    material = Material(7, young, young / (2 * (1 + ratio)), ratio, draw(st.floats(0.1, 2e4)))
    named = section_property(
        4, 7, "BOX", [0.1, 0.2, draw(WALLS), draw(WALLS)],
        draw(st.sampled_from([0.0, 1.25])),
    )  # fmt: skip
    free = BeamProperty(
        identifier=5,
        material=7,
        area=draw(SMALL),
        inertia_1=draw(SMALL),
        inertia_2=draw(SMALL),
        torsion_constant=draw(SMALL),
        stress_points=np.array(draw(st.lists(LENGTHS, min_size=8, max_size=8))).reshape(4, 2),
        shear_factor_1=draw(SMALL),
        shear_factor_2=0.5,
        nonstructural_mass=draw(st.sampled_from([0.0, 3.5])),
    )
    offsets = np.array(draw(st.lists(LENGTHS.map(lambda x: x / 10), min_size=12, max_size=12)))
    lever = np.array(draw(st.lists(LENGTHS, min_size=3, max_size=3)))
    inertia = draw(st.booleans()) * (lever @ lever * np.eye(3) - np.outer(lever, lever))
    return FiniteElementModel(
        node_identifiers=np.array(nodes, dtype=np.int64),
        coordinates=places,
        materials={7: material},
        shell_properties={
            3: ShellProperty(3, 7, draw(st.floats(1e-4, 0.1)), draw(st.sampled_from([0.0, 2.5])))
        },
        beam_properties={5: free, 4: named},
        quads=Shells(np.array([11]), np.array([[0, 1, 2, 3]]), np.array([3])),
        triangles=Shells(np.array([12]), np.array([[1, 2, 4]]), np.array([3])),
        beams=Beams(
            np.array([13, 14]),
            np.array([[0, 1], [1, 0]]),
            np.array([4, 5]),
            np.array([[0.0, 0.0, 1.0], [0.1, 0.2, draw(st.floats(0.5, 2.0))]]),
            np.stack([np.zeros((2, 3)), offsets[:6].reshape(2, 3)]),
        ),
        point_masses=PointMasses(
            np.array([15, 16]),
            np.array([2, 3]),
            np.array([draw(SMALL), 2.0]),
            np.stack([offsets[6:9], np.zeros(3)]),
            np.stack([inertia, np.zeros((3, 3))]),
        ),
        rigid_bodies=(RigidBody(17, 0, np.arange(1, count, dtype=np.int64)),),
        interpolations=(
            Interpolation(
                18, 4, np.array([0, 1, 2]), np.array(draw(st.tuples(SMALL, SMALL, SMALL)))
            ),
        ),
    )


@settings(max_examples=60, deadline=None)
@given(models())
def test_a_model_survives_writing_and_reading(model):
    read = parse_bulk_data(format_bulk_data(model)).model
    assert_same(model, read, 5e-11)
    assert_same(read, parse_bulk_data(format_bulk_data(read)).model, 0.0)


def test_the_mini_aircraft_survives_writing_and_reading(tmp_path: Path):
    model = mini_model()
    write_bulk_data(model, tmp_path / "a.bdf", ["written by a test"])
    read = read_bulk_data(tmp_path / "a.bdf").model
    for name in ("node_identifiers", "quads", "triangles", "rigid_bodies", "interpolations"):
        assert_same(getattr(model, name), getattr(read, name), 0.0)
    assert_same(model.coordinates, read.coordinates, 1e-14)
    assert_same(model.point_masses, read.point_masses, 1e-12)
    assert_same(model.beams, read.beams, 1e-13)


@settings(max_examples=400, deadline=None)
@given(st.floats(1e-9, 1e12), st.sampled_from([1.0, -1.0]))
@example(0.1, 1.0)
@example(9.9999999999999995e-5, -1.0)
@example(999999999999.9999, -1.0)
def test_numbers_of_airframes_keep_twelve_significant_digits(size, sign):
    value = sign * size
    text = format_real(value)
    assert len(text) <= 16
    read = Card("deck", 1, "GRID", [text]).real(0, "X1")
    assert read == pytest.approx(value, rel=5e-12, abs=0)
    assert Card("deck", 1, "GRID", [format_real(read)]).real(0, "X1") == read


@settings(max_examples=400, deadline=None)
@given(st.floats(-1e300, 1e300, allow_subnormal=False))
def test_any_number_fits_sixteen_characters(value):
    text = format_real(value)
    assert len(text) <= 16
    assert Card("deck", 1, "GRID", [text]).real(0, "X1") == pytest.approx(value, rel=1e-9, abs=0)


@given(st.integers(-10_000_000, 10_000_000), st.integers(0, 6))
def test_decimal_numbers_that_fit_are_exact(digits, places):
    value = digits / 10**places
    assert Card("deck", 1, "GRID", [format_real(value)]).real(0, "X1") == value


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_numbers_without_a_decimal_form_are_refused(value):
    with pytest.raises(ModelError, match="cannot be written"):
        format_real(value)


def test_a_torsion_radius_without_a_shape_cannot_be_written():
    model = mini_model()
    section = BeamProperty(9, 1, 1.0, 1.0, 1.0, 1.0, np.zeros((4, 2)), torsion_radius=0.5)
    odd = FiniteElementModel(
        **{
            field.name: {9: section}
            if field.name == "beam_properties"
            else getattr(model, field.name)
            for field in fields(model)
        }
    )
    with pytest.raises(ModelError, match="beam property 9: a torsion radius needs a named shape"):
        format_bulk_data(odd)
