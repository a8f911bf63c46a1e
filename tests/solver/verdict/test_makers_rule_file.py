"""Rule files: what is wrong is named with its file, its key and what is allowed."""

from pathlib import Path

import pytest

from solver.assessment import Verdict
from solver.errors import ModelError
from solver.verdict.makers_rule_reader import (
    load_makers_rule,
    packaged_rule,
    packaged_rules,
    read_makers_rule,
)

GOOD = """
title = "Some maker"
note = "A test."
overweight_margin = { value = 1000, unit = "lb" }

[sources.manual]
text = "Manual, page 1"
certainty = "read"

[[criterion]]
name = "normal load factor"
quantity = "normal load factor"
unit = "g"
action = "HARD"

[[criterion.limit]]
rate_hz = 8
weight = "up to landing mass"
over = { quantity = "roll", unit = "deg" }
points = [[0, 2.1], [6, 1.5]]
outside = "inspect"
source = "manual"

[[criterion.limit]]
rate_hz = 8
weight = "above landing mass"
value = 1.6
greatest = 1.7
source = "manual"
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "some-maker.toml"
    path.write_text(text)
    return path


def test_a_good_file_comes_out_in_si(tmp_path: Path) -> None:
    rule = read_makers_rule(written(tmp_path, GOOD))
    assert (rule.name, rule.title) == ("some-maker", "Some maker")
    assert rule.overweight_margin == pytest.approx(453.59237)
    (criterion,) = rule.criteria
    assert criterion.action is Verdict.HARD
    sloping, flat = criterion.limits
    assert sloping.curve.arguments == pytest.approx((0.0, 0.10471975511965977))
    assert flat.curve.value(123.0) == 1.6
    assert flat.greatest == 1.7


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('title = "Some maker"', "", "title: Field required"),
        ('note = "A test."', 'note = "A test."\nnotes = "x"', "notes: Extra inputs"),
        ("rate_hz = 8", "rate_hz = -1", "criterion[0].limit[0].rate_hz: Input should be greater"),
        ("rate_hz = 8", "rate_hz = '8'", "limit[0].rate_hz: Input should be a valid number"),
        ("rate_hz = 8", "", "criterion[0].limit[0].rate_hz: is needed for a limit of the normal"),
        ("rate_hz = 8", "rate_hz = 16", "criterion[0].limit: 0 limits above landing mass at 16 Hz"),
        ('"up to landing mass"', '"light"', "'up to landing mass' or 'above landing mass'"),
        ('weight = "up to landing mass"', "", "2 limits above landing mass at 8 Hz"),
        ('quantity = "roll", unit = "deg"', 'quantity = "pitch", unit = "deg"', "'roll' or 'mass'"),
        ('unit = "deg"', 'unit = "kg"', "'kg' is no unit of angle (deg, rad)"),
        ('unit = "g"', 'unit = "kt"', "'kt' is no unit of load factor (g, m/s2)"),
        ("[6, 1.5]", "[6, 150]", "points[1]: 150 g is outside 0.05 to 10 g"),
        ("[6, 1.5]", "[60, 1.5]", "points[1]: 60 deg is outside 0 to 45.84 deg"),
        ("[6, 1.5]", "[6, 1.5, 3]", "points[1]: List should have at most 2 items"),
        ("[6, 1.5]", "[-6, 1.5]", "points[1][0]: Input should be greater than or equal to 0"),
        ("[6, 1.5]", "[6, nan]", "points[1][1]: Input should be a finite number"),
        ("[[0, 2.1], [6, 1.5]]", "[[6, 2.1], [0, 1.5]]", "limit[0].points: roll must not fall"),
        ('"inspect"', '"ignore"', "'hold', 'inspect' or 'cannot tell'"),
        ("value = 1.6", "", "limit[1]: Value error, needs either value or points"),
        ("value = 1.6", "value = 1.6\noutside = 'inspect'", "outside belongs to points"),
        ("points = [[0, 2.1], [6, 1.5]]", "value = 2", "points and over come together"),
        ("greatest = 1.7", "greatest = 1.5", "limit[1].greatest: must not be less than the limit"),
        ('source = "manual"', 'source = "hearsay"', "'hearsay' is not in [sources] (manual)"),
        ('certainty = "read"', 'certainty = "sure"', "sources.manual.certainty: Input should be"),
        ('action = "HARD"', 'action = "GROUND"', "action: Input should be 'INSPECT' or 'HARD'"),
        ('unit = "lb"', 'unit = "st"', "overweight_margin: 'st' is no unit of mass (kg, lb, t)"),
        ("[sources.manual]", "[sources.manual", "not valid TOML"),
        (
            "\n[[criterion]]",
            '\n[[criterion]]\nname = "v"\nquantity = "sink rate"\nunit = "ft/min"\n'
            'action = "INSPECT"\nlimit = [{ rate_hz = 8, value = 600, source = "manual" }]\n'
            "\n[[criterion]]",
            "criterion[0].limit[0].rate_hz: does not belong to a limit of the sink rate",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(tmp_path: Path, old: str, new: str, told: str) -> None:
    assert old in GOOD
    path = written(tmp_path, GOOD.replace(old, new, 1))
    with pytest.raises(ModelError) as refused:
        read_makers_rule(path)
    assert str(refused.value).startswith(str(path))
    assert told in str(refused.value)


def test_not_text(tmp_path: Path) -> None:
    path = tmp_path / "some-maker.toml"
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(ModelError, match="not valid TOML"):
        read_makers_rule(path)


def test_a_name_is_a_rule_of_the_program_and_a_file_lies_in_the_aircrafts_folder(
    tmp_path: Path,
) -> None:
    written(tmp_path, GOOD)
    assert load_makers_rule(tmp_path, None) is None
    named, own = (load_makers_rule(tmp_path, name) for name in ("boeing-767", "some-maker.toml"))
    assert named == packaged_rule("boeing-767")
    assert own is not None
    assert own.title == "Some maker"


def test_an_unknown_name_lists_the_known() -> None:
    with pytest.raises(ModelError) as refused:
        packaged_rule("boeing-707")
    assert all(name in str(refused.value) for name in packaged_rules())


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"absent\.toml: cannot be read: No such file"):
        load_makers_rule(tmp_path, "absent.toml")
