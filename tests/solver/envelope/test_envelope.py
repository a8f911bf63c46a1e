"""The envelope of the mini aircraft against landings solved afresh."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import qmc

from solver.assess import AssessmentModel, assess_landing
from solver.envelope import build
from solver.envelope.build import EnvelopeBusyError, build_envelope
from solver.envelope.domain import COORDINATES, ROLL, SINK_RATE, landings_at, record_at
from solver.envelope.envelope import Envelope
from solver.envelope.provisional import provisional_verdict
from solver.envelope.samples import Sample, SampleFile
from solver.envelope.sampling import solve_one
from solver.envelope.sections import limit_at, loading_at
from solver.envelope.store import envelope_path, load_envelope, save_envelope
from solver.envelope.surface import GRADED
from solver.verdict.judge import SEVERITY
from tests.solver.envelope.conftest import LANDINGS
from tests.solver.envelope.synthetic import linear_envelope
from tests.solver.verdict.rule_cases import mini_definition


@pytest.fixture(scope="module")
def fresh(mini_model: AssessmentModel, mini_envelope: Envelope) -> list[Sample]:
    """Landings that the envelope has not seen, from a sequence of their own."""
    cube = qmc.Sobol(len(COORDINATES), seed=11).random(64)
    # Softer than the whole range, so that most of them lie about the thresholds.
    cube[:, SINK_RATE] = 0.1 + 0.5 * cube[:, SINK_RATE]
    landings = landings_at(mini_envelope.domain, mini_model.airframe.definition, cube)
    samples = [solve_one(mini_model, number, row) for number, row in enumerate(landings)]
    return [sample for sample in samples if sample.is_solved]


def test_landings_it_has_not_seen_lie_within_its_stated_error(
    mini_envelope: Envelope, fresh: list[Sample]
) -> None:
    """Either side covers 97.5 %: of some 40 landings, 5 outside would be a chance of 1 in 300."""
    surface, error = mini_envelope.surface, mini_envelope.error
    assert 0.0 < error.above < 0.5, "an error that excuses everything would prove nothing"
    expected, _ = surface(mini_envelope.domain.unit(np.array([s.coordinates for s in fresh])))
    graded = (expected > GRADED[0]) & (expected < GRADED[1])
    assert graded.sum() >= 30
    found = np.array([s.utilisations.max() for s in fresh])[graded]
    assert np.sum(found > expected[graded] * (1.0 + error.above)) <= 4
    assert np.sum(found < expected[graded] * (1.0 - error.below)) <= 4


def test_a_provisional_verdict_is_rarely_milder_than_the_full_one(
    mini_model: AssessmentModel, mini_envelope: Envelope, fresh: list[Sample]
) -> None:
    milder = compared = 0
    for sample in fresh[:24]:
        record = record_at(mini_model.airframe.definition, sample.coordinates)
        given = provisional_verdict(mini_envelope, record).verdict
        if given is None:
            continue  # its loading cannot be met
        compared += 1
        full = assess_landing(mini_model, record).verdict
        milder += SEVERITY[full] > SEVERITY[given]
    assert compared >= 20
    assert milder <= 1


def test_roll_to_either_side_is_the_same_landing(
    mini_model: AssessmentModel, mini_envelope: Envelope, fresh: list[Sample]
) -> None:
    coordinates = next(s.coordinates for s in fresh if s.coordinates[ROLL] > 0.02)
    record = record_at(mini_model.airframe.definition, coordinates)
    (contact,) = record.contacts
    mirrored = replace(
        record,
        contacts=(
            replace(
                contact,
                roll=-contact.roll,
                drift=-contact.drift,
                roll_rate=-contact.roll_rate,
                yaw_rate=-contact.yaw_rate,
            ),
        ),
    )
    one, other = (provisional_verdict(mini_envelope, r).driving for r in (record, mirrored))
    assert one is not None
    assert other is not None
    assert one.expected == other.expected
    # Folding is right only if the solver agrees.
    used = [assess_landing(mini_model, r).worst_utilisation for r in (record, mirrored)]
    assert used[0] == pytest.approx(used[1], rel=1e-3), "to what the step control leaves"


def test_the_limit_sink_rate_falls_with_weight(mini_envelope: Envelope) -> None:
    masses = mini_envelope.mass_states.definition.masses
    light, heavy = (
        limit_at(mini_envelope, loading_at(mini_envelope, mass))
        for mass in (masses.operating_empty + 600.0, masses.maximum_landing)
    )
    assert heavy.value < light.value
    assert heavy.low < heavy.value < heavy.high


class TestMaking:
    def test_what_an_interrupted_run_solved_is_not_solved_again(
        self,
        mini_folder: Path,
        mini_model: AssessmentModel,
        mini_envelope: Envelope,
        tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:
        """The landings of the first run come back line by line; the last line was cut off."""
        monkeypatch.setattr(build, "load_assessment_model", lambda *_: mini_model)
        domain = mini_envelope.domain
        monkeypatch.setattr(build, "find_domain", lambda _: domain)
        solved: list[int] = []

        def imitated(_: AssessmentModel, number: int, coordinates: np.ndarray) -> Sample:
            solved.append(number)
            used = 1.2 * (coordinates[SINK_RATE] / domain.high[SINK_RATE])
            return Sample(number, coordinates, np.array([used]), np.array([0.5]))

        class StoppedError(Exception):
            pass

        def stopping(model: AssessmentModel, number: int, coordinates: np.ndarray) -> Sample:
            if len(solved) == 100:
                raise StoppedError
            return imitated(model, number, coordinates)

        monkeypatch.setattr(build, "solve_one", stopping)
        with pytest.raises(StoppedError):
            build_envelope(mini_folder, tmp_path, 260, processes=1)
        (lines,) = tmp_path.glob("*.jsonl")
        assert len(SampleFile(lines).read()) == 100
        lines.write_text(lines.read_text()[:-40])
        solved.clear()
        monkeypatch.setattr(build, "solve_one", imitated)
        made = build_envelope(mini_folder, tmp_path, 260, processes=1)
        assert sorted(solved) == list(range(99, 260))
        assert made.basis.landings == 260 - 260 // 5
        assert not lines.exists()
        # The next one finds it.
        solved.clear()
        again = build_envelope(mini_folder, tmp_path, 260, processes=1)
        assert solved == []
        assert again.error == made.error

    def test_processes_of_a_pool_solve_as_this_one_does(
        self,
        mini_folder: Path,
        mini_cache: Path,
        mini_model: AssessmentModel,
        fresh: list[Sample],
    ) -> None:
        sample = fresh[0]
        asked = [(7, sample.coordinates)]
        (found,) = build._solved(mini_model, mini_folder, mini_cache, asked, processes=2)
        (alone,) = build._solved(mini_model, mini_folder, mini_cache, asked, processes=1)
        assert found.number == 7
        assert found.utilisations == pytest.approx(alone.utilisations, rel=1e-12)
        assert found.stops == pytest.approx(alone.stops, rel=1e-12)

    def test_two_processes_do_not_make_the_same(
        self, mini_folder: Path, mini_cache: Path, mini_model: AssessmentModel
    ) -> None:
        lock = envelope_path(mini_cache, mini_model.content_hash).with_suffix(".lock")
        with build._alone(lock), pytest.raises(EnvelopeBusyError, match="another process"):
            build_envelope(mini_folder, mini_cache, LANDINGS, processes=1)


class TestStore:
    def test_it_comes_back_the_same(self, mini_envelope: Envelope, tmp_path: Path) -> None:
        path = tmp_path / "envelope.npz"
        save_envelope(path, mini_envelope)
        again = load_envelope(path, mini_envelope.mass_states.definition)
        assert again is not None
        assert (again.basis, again.error) == (mini_envelope.basis, mini_envelope.error)
        place = 0.5 * (again.domain.low + again.domain.high)
        assert again.course(place).expected(2.0) == mini_envelope.course(place).expected(2.0)
        assert loading_at(again, 11_000.0).factors == pytest.approx(
            loading_at(mini_envelope, 11_000.0).factors
        )
        assert path.stat().st_size < 500_000

    def test_another_aircraft_or_program_looks_for_another(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        path = envelope_path(tmp_path, "a" * 64)
        assert envelope_path(tmp_path, "b" * 64) != path
        monkeypatch.setattr("solver.envelope.store.__version__", "0.0.other")
        assert envelope_path(tmp_path, "a" * 64) != path

    def test_what_is_not_there_or_not_whole_is_none(self, tmp_path: Path) -> None:
        path = tmp_path / "envelope.npz"
        assert load_envelope(path, mini_definition()) is None
        save_envelope(path, linear_envelope())
        path.write_bytes(path.read_bytes()[:1000])
        assert load_envelope(path, mini_definition()) is None


@pytest.fixture(autouse=True)
def _no_draft_is_left(tmp_path: Path) -> Iterator[None]:
    yield
    assert list(tmp_path.glob(".envelope-*")) == []
