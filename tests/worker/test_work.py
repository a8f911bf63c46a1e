"""What a worker makes of solvers that fail."""

import os
import shutil
import signal
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select, update

import worker.work
from app.artefacts.models import Artefact
from app.assessments import queue, recording
from app.assessments.models import AssessmentJob, VerdictRow
from app.broker import Nudger
from app.config import LANES
from app.db import reading, writing
from app.fleet.registry import AircraftRegistry
from solver.assess import AssessmentModel
from solver.assessment import Assessment, TouchdownRecord
from solver.errors import EquilibriumError, ModelError, RecordError, SimulationDivergedError
from tests.conftest import Service
from tests.records import record
from worker.pace import Pace
from worker.solve import solve
from worker.warm import Models
from worker.work import work_off

Solver = Callable[[AssessmentModel, TouchdownRecord], Assessment]


@pytest.fixture
def failing(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[Exception], None]]:
    """Make the solver raise."""

    def arrange(error: Exception) -> None:
        def broken(model: AssessmentModel, landing: TouchdownRecord, **options: Any) -> Assessment:
            raise error

        monkeypatch.setattr(worker.work, "solve", broken)

    return arrange


def outcome(service: Service) -> dict[str, object]:
    return service.assessed(record())


@pytest.mark.parametrize(
    "error", [RecordError("roll is 50 deg, range 0 to 40"), SimulationDivergedError("energy 3 %")]
)
def test_what_the_record_cannot_carry_is_undetermined(
    service: Service, failing: Callable[[Exception], None], error: Exception
) -> None:
    failing(error)
    answer = outcome(service)
    assert answer["state"] == "assessed"
    assert answer["result"]["verdict"] == "UNDETERMINED"
    assert answer["result"]["reasons"][0]["text"] == str(error)
    assert answer["attempts"] == 1


def test_a_defect_of_the_model_fails_at_once(
    service: Service, failing: Callable[[Exception], None]
) -> None:
    failing(EquilibriumError("residual 1e-3"))
    answer = outcome(service)
    assert (answer["state"], answer["attempts"]) == ("failed", 1)
    assert answer["last_error"] == "EquilibriumError: residual 1e-3"
    assert answer["result"] is None


def test_a_defect_of_the_program_is_tried_again_and_then_dead(
    service: Service, failing: Callable[[Exception], None]
) -> None:
    failing(ZeroDivisionError("division by zero"))
    answer = outcome(service)
    assert (answer["state"], answer["attempts"]) == ("dead", service.settings.max_attempts)
    assert answer["last_error"] == "ZeroDivisionError: division by zero"


def test_an_aircraft_that_was_taken_away_fails_with_its_name(service: Service) -> None:
    location = service.post(record()).headers["location"]
    with writing(service.engine) as session:
        landing = session.scalars(select(worker.work._all_tables.Landing)).one()
        landing.inputs = {**landing.inputs, "aircraft": "gone"}
    service.work()
    answer = service.get(location).json()
    assert answer["state"] == "failed"
    assert "'gone' is not installed here; installed: mini" in answer["last_error"]


def test_a_worker_that_lost_its_claim_leaves_the_database_untouched(service: Service) -> None:
    location = service.post(record()).headers["location"]
    with writing(service.engine) as session:
        (late,) = queue.claim(session, worker="w", lanes=(0,), lease=-1.0, max_attempts=5)
    service.work()
    before = service.get(location).json()
    model = service.models.get("mini")
    assessed = solve(model, worker.work.inputs.from_json(late.inputs), propagate_uncertainty=False)
    answer = recording.answer(late, assessed, keeps_arrays_from=0.0)
    with writing(service.engine) as session:
        assert recording.record_answers(session, [answer]) == []
    assert service.get(location).json() == before
    with reading(service.engine) as session:
        assert len(session.scalars(select(VerdictRow)).all()) == 1


def test_work_passes_the_nudge_on_when_its_time_is_used_up(service: Service) -> None:
    for sink_rate in (3.0, 4.0, 5.0):
        service.post(record(sink_rate))
    settings = service.settings.model_copy(update={"drain_budget": 0.0})
    sent = []

    class Counting(Nudger):
        def nudge(self, count: int = 1) -> bool:
            sent.append(count)
            return True

    assert work_off(service.engine, settings, service.models, Counting(settings)) == 1
    assert sent == [1]


def test_arrays_are_kept_for_landings_near_a_limit_only(service: Service) -> None:
    settings = service.settings.model_copy(update={"keep_arrays_above": 0.5})
    places = [service.post(record(rate)).headers["location"] for rate in (2.0, 20.0)]
    nudger = Nudger(settings)
    while work_off(service.engine, settings, service.models, nudger):
        pass
    soft, hard = (service.get(place).json() for place in places)
    assert soft["result"]["worst_utilisation"] < 0.5 < hard["result"]["worst_utilisation"]
    with reading(service.engine) as session:
        kept = set(session.scalars(select(Artefact.assessment_id)))
    assert kept == {hard["id"]}
    response = service.get(soft["links"]["peak_field"])
    assert response.status_code == 404
    assert response.json()["type"] == "urn:hardlanding:problem:not-kept"


def test_the_default_keeps_everything_on_one_machine_and_what_matters_in_a_fleet(
    service: Service,
) -> None:
    settings = service.settings.model_copy(update={"keep_arrays_above": None})
    assert settings.keeps_arrays_from == (0.0 if settings.database_url is None else 0.8)


class TestBatch:
    """Several landings in one claim."""

    @pytest.fixture
    def fast(self, monkeypatch: pytest.MonkeyPatch, service: Service) -> list[str]:
        """Three landings wait and the worker believes itself fast enough for all of them."""
        monkeypatch.setattr(Pace, "batch", lambda _self, **limits: limits["most"])
        return [service.post(record(rate)).headers["location"] for rate in (2.0, 3.0, 4.0)]

    def states(self, service: Service, places: list[str]) -> list[tuple[str, int]]:
        answers = [service.get(place).json() for place in places]
        return [(answer["state"], answer["attempts"]) for answer in answers]

    def test_is_answered_whole(self, service: Service, fast: list[str]) -> None:
        service.work()
        assert self.states(service, fast) == [("assessed", 1)] * 3
        with reading(service.engine) as session:
            found = session.scalars(select(VerdictRow).order_by(VerdictRow.worst_utilisation))
            rates = [verdict.inputs["contacts"][0]["sink_rate"] for verdict in found]
        assert rates == sorted(rates)

    def test_a_failure_takes_nobody_with_it(
        self, service: Service, fast: list[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def fragile(model: AssessmentModel, landing: TouchdownRecord, **options: Any) -> Assessment:
            if landing.contacts[0].sink_rate == pytest.approx(3.0 * 0.3048):
                raise EquilibriumError("residual 1e-3")
            return solve(model, landing, **options)

        monkeypatch.setattr(worker.work, "solve", fragile)
        service.work()
        assert self.states(service, fast) == [("assessed", 1), ("failed", 1), ("assessed", 1)]

    def test_an_answer_that_cannot_be_written_takes_nobody_with_it(
        self, service: Service, fast: list[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def unwritable(
            model: AssessmentModel, landing: TouchdownRecord, **options: Any
        ) -> Assessment:
            answer = solve(model, landing, **options)
            if landing.contacts[0].sink_rate == pytest.approx(3.0 * 0.3048):
                return replace(answer, model_hash=None)
            return answer

        monkeypatch.setattr(worker.work, "solve", unwritable)
        service.work()
        attempts = service.settings.max_attempts
        assert self.states(service, fast) == [("assessed", 1), ("dead", attempts), ("assessed", 1)]

    def test_what_would_take_too_long_is_put_back_and_priority_comes_first(
        self, service: Service, fast: list[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        with writing(service.engine) as session:
            session.execute(update(AssessmentJob).values(lane=LANES["bulk"]))
        order: list[float] = []

        def interrupted(
            model: AssessmentModel, landing: TouchdownRecord, **options: Any
        ) -> Assessment:
            order.append(round(landing.contacts[0].sink_rate / 0.3048, 3))
            if len(order) == 1:
                service.post(record(9.0))
            return solve(model, landing, **options)

        monkeypatch.setattr(worker.work, "solve", interrupted)
        settings = service.settings.model_copy(update={"batch_seconds": 0.0})
        nudger = Nudger(settings)
        while work_off(service.engine, settings, service.models, nudger):
            pass
        nudger.close()
        assert order == [2.0, 9.0, 3.0, 4.0]
        assert self.states(service, fast) == [("assessed", 1)] * 3


class TestPace:
    def test_begins_with_one(self) -> None:
        assert Pace().batch(within=0.25, most=32) == 1

    @pytest.mark.parametrize(("seconds", "batch"), [(0.0, 32), (0.02, 12), (0.2, 1), (3.0, 1)])
    def test_claims_what_fits(self, seconds: float, batch: int) -> None:
        pace = Pace()
        pace.note(seconds)
        assert pace.batch(within=0.25, most=32) == batch

    def test_follows_the_fleet(self) -> None:
        pace = Pace(0.01)
        for _ in range(20):
            pace.note(1.0)
        assert pace.batch(within=0.25, most=32) == 1


class TestNewAircraft:
    """An aircraft that was installed after the worker had loaded its models."""

    def test_the_worker_asks_to_be_started_again(
        self, service: Service, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
    ) -> None:
        asked: list[tuple[int, int]] = []
        monkeypatch.setattr(worker.work.os, "kill", lambda *request: asked.append(request))
        service.models = Models(service.models.registry, tmp_path, is_sealed=True)
        location = service.post(record()).headers["location"]
        service.work()
        assert asked == [(os.getppid(), signal.SIGTERM)]
        answer = service.get(location).json()
        assert (answer["state"], answer["attempts"]) == ("queued", 0)
        assert "mini is new here" in answer["last_error"]

    def test_one_that_could_not_be_loaded_is_not_tried_for_ever(
        self, service: Service, tmp_path: Path
    ) -> None:
        broken = tmp_path / "aircraft" / "mini"
        shutil.copytree(service.settings.aircraft_folder / "mini", broken)
        (broken / "airframe.bdf").write_text("BEGIN BULK\nPLOTEL,1,2,3\nENDDATA\n")
        models = Models(AircraftRegistry(broken.parent), tmp_path)
        models.warm_up()
        with pytest.raises(ModelError, match="PLOTEL"):
            models.get("mini")
