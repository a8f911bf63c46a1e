from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from solver.arrays import Array
from solver.gear.parameters import SpringBack
from verification import run as run_module
from verification.run import Run
from verification.store import digest_of, digest_of_sources


@dataclass(frozen=True)
class Loads:
    force: Array
    title: str


def test_digest_sees_every_entry_of_a_long_array() -> None:
    force = np.zeros(100_000)
    changed = force.copy()
    changed[50_000] = 1e-300
    assert digest_of(Loads(force, "a")) == digest_of(Loads(force.copy(), "a"))
    assert digest_of(Loads(force, "a")) != digest_of(Loads(changed, "a"))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (["ab", "c"], ["a", "bc"]),
        ([1.0, [2.0]], [1.0, 2.0]),
        (1, 1.0),
        (np.zeros((2, 3)), np.zeros((3, 2))),
        (np.zeros(3), np.zeros(3, dtype=np.float32)),
        (SpringBack(stiffness=1.0), replace(SpringBack(stiffness=1.0), damping_ratio=0.05)),
        ({"a": 1}, {"a": 2}),
    ],
)
def test_digest_tells_values_apart(one: object, other: object) -> None:
    assert digest_of(one) != digest_of(other)


def test_digest_of_a_mapping_does_not_ask_for_its_order() -> None:
    assert digest_of({"a": 1, "b": 2}) == digest_of({"b": 2, "a": 1})


def test_what_has_no_value_has_no_digest() -> None:
    with pytest.raises(TypeError, match="object"):
        digest_of([object()])


def test_missing_source_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere"):
        digest_of_sources(tmp_path, ["nowhere"])


class Computation:
    """Counts how often it is asked for its result."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self) -> dict[str, Array]:
        self.calls += 1
        return {"x": np.full(3, float(self.calls))}


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of one module in a project of its own."""
    monkeypatch.setattr(run_module, "ROOT", tmp_path)
    path = tmp_path / "package" / "law.py"
    path.parent.mkdir()
    path.write_text("LAW = 1\n")
    return path


def test_result_is_kept_by_a_later_run(tmp_path: Path, source: Path) -> None:
    compute = Computation()
    first, later = Run(tmp_path / "var"), Run(tmp_path / "var")
    for run in (first, later):
        found = run.stored("law", [1, np.ones(2)], ["package"], compute)
        assert found.keys() == {"x"}
        assert found["x"].tolist() == [1.0, 1.0, 1.0]
    assert compute.calls == 1
    assert [result.is_earlier for result in first.taken + later.taken] == [False, True]
    assert later.taken[0].seconds == first.taken[0].seconds


def test_changed_source_input_or_new_module_is_computed_again(tmp_path: Path, source: Path) -> None:
    compute = Computation()
    run = Run(tmp_path / "var")
    run.stored("law", [1], ["package"], compute)
    source.write_text("LAW = 2\n")
    run.stored("law", [1], ["package"], compute)
    assert compute.calls == 2
    run.stored("law", [2], ["package"], compute)
    assert compute.calls == 3
    (source.parent / "second.py").write_text("")
    run.stored("law", [2], ["package"], compute)
    assert compute.calls == 4
    run.stored("law", [2], ["package"], compute)
    assert compute.calls == 4


def test_interrupted_computation_leaves_nothing(tmp_path: Path, source: Path) -> None:
    run = Run(tmp_path / "var")

    def interrupted() -> dict[str, Array]:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.stored("law", [1], ["package"], interrupted)
    compute = Computation()
    run.stored("law", [1], ["package"], compute)
    assert compute.calls == 1
