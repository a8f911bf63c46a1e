"""The provisional verdict over HTTP, on both stacks, from an envelope known in closed form."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select

from app.assessments.provisional import difference, differs
from app.audit.models import AuditEntry
from app.db import reading
from solver.assessment import Verdict
from solver.envelope.store import envelope_path, save_envelope
from tests.conftest import Service, Stack, make_service
from tests.records import contact, record
from tests.solver.envelope.synthetic import linear_envelope
from worker.warm import Models

FOOT = 0.3048


@pytest.fixture
def bare(stack: Stack, models: Models, tmp_path: Path) -> Iterator[Service]:
    """A service that finds no envelope, in a cache of its own."""
    object.__setattr__(stack.settings, "cache_dir", tmp_path / "cache")
    with make_service(stack, models) as made:
        yield made


def install(service: Service, limit: float) -> None:
    """Store an envelope by which landings use ``sink rate / limit`` of a limit."""
    content_hash = service.models.get("mini").content_hash
    path = envelope_path(service.settings.cache_folder, content_hash)
    save_envelope(path, linear_envelope(limit, 0.1, 0.1, content_hash=content_hash))


def flown(sink_rate: float = 6.0, **fields: Any) -> dict[str, Any]:
    """A record that the envelope covers: it leaves the centre of gravity to the loading."""
    given = record(sink_rate, **fields)
    del given["mass"]["cg"]
    return given


class TestPost:
    def test_the_answer_carries_it(self, bare: Service) -> None:
        install(bare, limit=4.0)
        given = bare.post(flown(6.0)).json()["provisional"]
        assert given["is_provisional"] is True
        assert given["verdict"] == "FIRM"
        assert given["reasons"] == []
        assert given["sink_rate_m_s"] == pytest.approx(6.0 * FOOT)
        assert given["utilisation"]["value"] == pytest.approx(6.0 * FOOT / 4.0, rel=2e-3)
        assert given["utilisation"]["high"] == pytest.approx(1.1 * 6.0 * FOOT / 4.0, rel=2e-3)
        assert given["limit_sink_rate_m_s"]["value"] == pytest.approx(4.0, rel=2e-3)
        assert given["limit_sink_rate_m_s"]["low"] == pytest.approx(4.0 / 1.1, rel=2e-3)
        assert "400 simulated landings" in given["rests_on"]
        assert given["model_hash"] == bare.models.get("mini").content_hash
        assert "Advisory only" in given["advisory"]

    def test_a_repeated_record_gets_the_one_it_was_given(self, bare: Service) -> None:
        install(bare, limit=4.0)
        first = bare.post(flown(6.0)).json()
        install(bare, limit=1.0)
        again = bare.post(flown(6.0)).json()
        assert again["is_repeated"]
        assert again["provisional"] == first["provisional"]

    def test_without_an_envelope_it_says_so(self, bare: Service) -> None:
        given = bare.post(flown()).json()["provisional"]
        assert given["verdict"] is None
        assert "hardlanding envelope mini" in given["reasons"][0]
        # It is found as soon as it is there.
        install(bare, limit=4.0)
        assert bare.post(flown(7.0)).json()["provisional"]["verdict"] == "FIRM"

    def test_an_unknown_sink_rate_is_never_normal(self, bare: Service) -> None:
        install(bare, limit=100.0)
        thin = flown(contacts=[contact(1.0), contact(1.0)])
        del thin["contacts"][1]["sink_rate"]
        given = bare.post(thin).json()["provisional"]
        assert given["verdict"] is None
        assert "contacts[1].sink_rate" in given["reasons"][0]

    def test_nose_first_is_not_covered(self, bare: Service) -> None:
        install(bare, limit=100.0)
        nose = flown(contacts=[contact(1.0, pitch={"value": -2.0, "unit": "deg"})])
        given = bare.post(nose).json()["provisional"]
        assert given["verdict"] is None
        assert "main gears do not clearly touch first" in given["reasons"][0]

    def test_another_friction_is_not_covered(self, bare: Service) -> None:
        install(bare, limit=100.0)
        slippery = flown(leg={"runway_friction": {"value": 0.4}})
        given = bare.post(slippery).json()["provisional"]
        assert given["verdict"] is None
        assert "runway's friction" in given["reasons"][0]

    def test_a_back_fill_has_none(self, bare: Service) -> None:
        install(bare, limit=4.0)
        headers = {**bare.key("alpha", "post"), "content-type": "application/x-ndjson"}
        lines = "\n".join(json.dumps(flown(1.0 + 0.01 * n)) for n in range(120))
        answer = bare.client.post("/v1/landings/bulk", content=lines, headers=headers)
        row = json.loads(answer.text.splitlines()[0])
        assert bare.get(f"/v1/assessments/{row['assessment_id']}").json()["provisional"] is None
        assert bare.post(flown(1.0)).json()["provisional"] is None
        bare.work()
        done = bare.get(f"/v1/assessments/{row['assessment_id']}").json()
        assert (done["provisional"], done["provisional_differs"]) == (None, None)


class TestFullVerdict:
    @pytest.mark.parametrize(("limit", "how"), [(1.5, "milder"), (100.0, "stricter")])
    def test_one_that_differs_is_reported_so(self, bare: Service, limit: float, how: str) -> None:
        install(bare, limit)
        sink_rate = 6.0 if how == "milder" else 16.0
        place = bare.post(flown(sink_rate)).headers["location"]
        before = bare.get(place).json()
        assert before["result"] is None
        assert before["provisional_differs"] is None
        assert before["provisional_difference"] is None
        bare.work()
        after = bare.get(place).json()
        assert after["provisional"] == before["provisional"]
        assert after["provisional_differs"] is True
        given, full = after["provisional"]["verdict"], after["result"]["verdict"]
        assert (
            f"full verdict {full} is {how} than the provisional {given}"
            in after["provisional_difference"]
        )
        metrics = bare.client.get("/metrics").text
        assert f'hardlanding_provisional_verdicts_total{{verdict="{given}"}} 1.0' in metrics
        assert 'hardlanding_provisional_differences{differs="true"} 1.0' in metrics

    def test_one_that_agrees(self, bare: Service) -> None:
        install(bare, limit=20.0)
        answer = bare.assessed(flown(2.0))
        assert answer["result"]["verdict"] == answer["provisional"]["verdict"] == "NORMAL"
        assert answer["provisional_differs"] is False
        assert answer["provisional_difference"] is None

    def test_it_is_in_the_audit_log(self, bare: Service) -> None:
        install(bare, limit=100.0)
        landing = bare.post(flown(16.0)).json()["landing_id"]
        bare.work()
        with reading(bare.engine) as session:
            entries = session.scalars(
                select(AuditEntry).where(AuditEntry.subject_id == landing).order_by(AuditEntry.at)
            ).all()
        received, assessed = entries
        assert received.detail["provisional"] == "NORMAL"
        assert assessed.detail["provisional_differs"] is True


def test_without_a_provisional_verdict_nothing_differs() -> None:
    for stored in (None, {"verdict": None, "reasons": ["no envelope"]}):
        assert differs(stored, Verdict.HARD) is None
        assert difference(stored, Verdict.HARD, 1.2) is None
