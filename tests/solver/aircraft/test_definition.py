"""The definition file: what it says comes out in SI values, what it may not say is named."""

import math
from pathlib import Path

import numpy as np
import pytest

from solver.aircraft.definition import AircraftDefinition, IdentifierSet
from solver.aircraft.definition_reader import content_hash, load_definition
from solver.assessment import Verdict
from solver.errors import ModelError
from tests.solver.aircraft.mini import DEFINITION

TEXT = DEFINITION.read_text()


def changed(folder: Path, *changes: tuple[str, str]) -> AircraftDefinition:
    """Read the mini definition after replacing text, which must be there."""
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "definition.toml").write_text(text)
    return load_definition(folder)


class TestValues:
    def test_values_come_out_as_written(self, tmp_path):
        definition = changed(tmp_path)
        assert (definition.name, definition.bulk_data) == ("mini", "airframe.bdf")
        assert definition.masses.maximum_landing == 12292.0
        nose, left, right = definition.gears
        assert [gear.position for gear in definition.gears] == ["nose", "main", "main"]
        assert (len(nose.pins), len(left.pins), len(right.pins)) == (4, 3, 3)
        assert left.limits.vertical == 110e3
        assert left.tyre.count == 2
        assert left.strut.extended_length == 1.15
        assert left.strut == right.strut
        np.testing.assert_array_equal(left.pins[0].stiffness, [2e8] * 3 + [1e4] * 3)
        assert [group.name for group in definition.groups] == ["wing_left", "wing_right", "cabin"]
        assert definition.verdict.roll_limit == pytest.approx(math.radians(5.0))
        assert definition.verdict.nose_first is Verdict.INSPECT

    def test_chord_fraction_is_zero_at_the_leading_edge_and_one_at_the_trailing_edge(
        self, tmp_path
    ):
        reference = changed(tmp_path).reference
        assert reference.chord_fraction(9.2316) == pytest.approx(0.0, abs=1e-12)
        assert reference.chord_fraction(9.2316 + 2.6737) == pytest.approx(1.0)

    def test_scatter_and_probabilities_have_defaults_and_may_be_stated(self, tmp_path):
        defined = changed(tmp_path)
        assert defined.scatter.gas_pressure == 0.05
        assert defined.scatter.allowable == 0.0
        assert defined.verdict.inspect_probability == pytest.approx(1 / 21)
        stated = changed(
            tmp_path,
            (
                "[verdict]",
                '[scatter]\ntyre_friction_relative_sd = 0.2\nallowable_basis = "B"\n\n'
                "[verdict]\nmissed_over_needless_cost = 99",
            ),
        )
        assert stated.scatter.tyre_friction == 0.2
        assert stated.scatter.allowable_basis.deviations_below_mean == pytest.approx(1.2816, 1e-4)
        assert stated.verdict.inspect_probability == pytest.approx(0.01)

    def test_hard_may_not_come_before_inspect(self, tmp_path):
        with pytest.raises(ModelError, match="hard_probability"):
            changed(tmp_path, ("[verdict]", "[verdict]\nhard_probability = 0.04"))

    def test_spring_back_by_frequency(self, tmp_path):
        # k = (2 pi f L)^2 m with L at the stated stroke
        spring = changed(
            tmp_path, ("frequency_hz = 25.0", "frequency_hz = 25.0\nfrequency_stroke_m = 0.05")
        ).gears[1].spring_back  # fmt: skip
        assert spring.stiffness == pytest.approx((2 * math.pi * 25.0 * 1.10) ** 2 * 95.0)

    def test_spring_back_by_stiffness(self, tmp_path):
        spring = changed(tmp_path, ("frequency_hz = 25.0", "stiffness_n_m_rad = 2.5e6"))
        assert spring.gears[1].spring_back.stiffness == 2.5e6

    def test_spring_back_by_two_tubes(self, tmp_path):
        tubes = (
            "cylinder_rigidity_n_m2 = 1.1e6\ncylinder_length_m = 0.55\npiston_rigidity_n_m2 = 4e5"
        )
        spring = changed(tmp_path, ("frequency_hz = 25.0", tubes)).gears[1].spring_back
        assert spring.is_two_tube
        assert (spring.cylinder_rigidity, spring.cylinder_length) == (1.1e6, 0.55)

    def test_a_metering_pin_is_a_table_of_area_ratios(self, tmp_path):
        table = "metering = [{ stroke_m = 0.0, area_ratio = 1.0 }, " \
            "{ stroke_m = 0.3, area_ratio = 0.5 }]"  # fmt: skip
        strut = changed(
            tmp_path, ("polytropic_exponent = 1.1", f"polytropic_exponent = 1.1\n{table}")
        )
        assert strut.gears[1].strut.metering == ((0.0, 1.0), (0.3, 0.5))

    def test_identifier_sets_hold_single_numbers_and_inclusive_ranges(self):
        chosen = IdentifierSet(((3, 3), (10, 12)))
        assert chosen.contains([2, 3, 4, 9, 10, 12, 13]).tolist() == [
            False, True, False, False, True, True, False,
        ]  # fmt: skip
        assert str(chosen) == "3, 10-12"


class TestRefusals:
    @pytest.mark.parametrize(
        ("old", "new", "message"),
        [
            ("stroke_m = 0.38", "strokes_m = 0.38", r"gear_types\.main\.strut\.strokes_m: Extra"),
            ("stroke_m = 0.38\n", "", r"gear_types\.main\.strut\.stroke_m: Field required"),
            ("count = 2", "count = 0", r"tyre\.count: .*greater than or equal to 1, got 0"),
            ("count = 2", "count = 2.5", r"tyre\.count: .*valid integer, got 2\.5"),
            ("wing_span_m = 19.3", "wing_span_m = 19300.0", r"wing_span_m: .*200, got 19300"),
            ("wing_span_m = 19.3", 'wing_span_m = "19.3"', r"wing_span_m: .*valid number"),
            ("wing_span_m = 19.3", "wing_span_m = nan", r"wing_span_m: .*finite number"),
            ("operating_empty_kg = 8235.0", "operating_empty_kg = -1.0", "operating_empty_kg"),
            ("maximum_zero_fuel_kg = 9435.0", "maximum_zero_fuel_kg = 8000.0", "masses: .*rise"),
            ("limit_allowable_pa = 290e6", "limit_allowable_pa = 290.0", "limit_allowable_pa"),
            ("damping_ratio = 0.02", "damping_ratio = 2.0", "modal_damping_ratio"),
            ("pitch_damping_per_rad = -18.0", "pitch_damping_per_rad = 18.0", "pitch_damping"),
            ("firm_utilisation = 0.45", "firm_utilisation = 0.95", "verdict: .*less than"),
            ("pivot_m = [2.2219, 0.0, 1.274155]", "pivot_m = [2.2219, 0.0]", "pivot_m"),
            ("axis = [0.0, 0.0, -1.0]", "axis = [0.0, 0.5, -1.0]", "nose: axis must have unit"),
            ('type = "nose"', 'type = "skid"', "type 'skid' is not among gear_types"),
            ('name = "main_left"', 'name = "nose"', r"gears\.name: 'nose' is used more than once"),
            ("node = 902", "node = 901", r"pins\.node: 901 is used more than once"),
            ('name = "cabin"', 'name = "wing_left"', "'wing_left' is used more than once"),
            ("conm2 = [[7001, 7099]]", "conm2 = [[7099, 7001]]", "runs backwards"),
            ("conm2 = [[7001, 7099]]", "conm2 = []", "conm2"),
            ("mat1 = 2", "mat1 = 1", r"materials\.mat1: 1 is used more than once"),
            ("gas_volume_m3 = 0.002234", "gas_volume_m3 = 0.0002", "gear_types.main: full_stroke"),
            ("friction_minimum = 0.5", "friction_minimum = 0.9", "must not exceed"),
            ("frequency_hz = 25.0\n", "", "exactly one of frequency_hz"),
            ("frequency_hz = 25.0", "cylinder_length_m = 0.5", "two tubes need"),
            ('bulk_data = "airframe.bdf"', 'bulk_data = "../airframe.bdf"', "bulk_data"),
            ("span_position_m = 0.0", "span_position_m = 10.0", "rise from root to tip"),
            ("properties = [40]\ndrag_share", "drag_share", "needs properties or nodes"),
            ('nose_first = "INSPECT"', 'nose_first = "inspect"', "nose_first"),
            ('ata_chapter = "55-30"', 'ata_chapter = "fin"', "ata_chapter"),
        ],
    )  # fmt: skip
    def test_a_bad_entry_is_named_with_its_value_and_range(self, tmp_path, old, new, message):
        with pytest.raises(ModelError, match=message):
            changed(tmp_path, (old, new))

    def test_all_findings_come_at_once(self, tmp_path):
        with pytest.raises(ModelError) as caught:
            changed(tmp_path, ("count = 2", "count = -2"), ("wing_span_m = 19.3", "span = 19.3"))
        assert all(name in str(caught.value) for name in ("tyre.count", "wing_span_m", "span"))

    def test_a_missing_file_is_named(self, tmp_path):
        with pytest.raises(ModelError, match=r"definition\.toml: cannot be read"):
            load_definition(tmp_path / "nowhere")

    def test_broken_toml_is_named_with_its_place(self, tmp_path):
        (tmp_path / "definition.toml").write_text("name = \n")
        with pytest.raises(ModelError, match=r"not valid TOML: .*line 1"):
            load_definition(tmp_path)


class TestContentHash:
    def test_it_is_stable(self, mini_folder, tmp_path):
        for name in ("definition.toml", "airframe.bdf"):
            (tmp_path / name).write_bytes((mini_folder / name).read_bytes())
        assert content_hash(tmp_path, "airframe.bdf") == content_hash(mini_folder, "airframe.bdf")

    @pytest.mark.parametrize("name", ["definition.toml", "airframe.bdf"])
    @pytest.mark.parametrize("place", [0, 777, -1])
    def test_any_byte_changes_it(self, mini_folder, tmp_path, name, place):
        for each in ("definition.toml", "airframe.bdf"):
            (tmp_path / each).write_bytes((mini_folder / each).read_bytes())
        content = bytearray((tmp_path / name).read_bytes())
        content[place] ^= 1
        (tmp_path / name).write_bytes(content)
        assert content_hash(tmp_path, "airframe.bdf") != content_hash(mini_folder, "airframe.bdf")

    def test_a_byte_that_moves_between_the_files_changes_it(self, tmp_path):
        (tmp_path / "definition.toml").write_bytes(b"ab")
        (tmp_path / "airframe.bdf").write_bytes(b"c")
        before = content_hash(tmp_path, "airframe.bdf")
        (tmp_path / "definition.toml").write_bytes(b"a")
        (tmp_path / "airframe.bdf").write_bytes(b"bc")
        assert content_hash(tmp_path, "airframe.bdf") != before


class TestMakersRule:
    def test_is_optional(self, tmp_path):
        assert changed(tmp_path).makers_rule == "ebj-19"
        assert changed(tmp_path, ('makers_rule = "ebj-19"\n', "")).makers_rule is None

    def test_a_file_of_the_folder_is_part_of_the_content_hash(self, tmp_path):
        definition = changed(tmp_path, ('"ebj-19"', '"own.toml"'))
        assert definition.files == ("airframe.bdf", "own.toml")
        assert changed(tmp_path).files == ("airframe.bdf",)
        (tmp_path / "airframe.bdf").write_text("CEND")
        hashes = set()
        for text in ("a", "b"):
            (tmp_path / "own.toml").write_text(text)
            hashes.add(content_hash(tmp_path, *definition.files))
        assert len(hashes) == 2

    @pytest.mark.parametrize("name", ["../own.toml", "a/b", "", ".hidden"])
    def test_no_name_leads_out_of_the_folder(self, tmp_path, name):
        with pytest.raises(ModelError, match=r"verdict\.makers_rule"):
            changed(tmp_path, ('"ebj-19"', f'"{name}"'))
