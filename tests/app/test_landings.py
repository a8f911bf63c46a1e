"""Taking landings in: once each, found again, listed page by page."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy import func, select

from app.assessments.models import AssessmentJob
from app.audit.models import AuditEntry
from app.db import reading
from app.landings.models import Landing
from tests.conftest import Service
from tests.records import contact, record


class TestPost:
    def test_answers_where_the_assessment_will_be(self, service: Service) -> None:
        response = service.post(record())
        assert response.status_code == 202
        answer = response.json()
        assert response.headers["location"] == f"/v1/assessments/{answer['assessment_id']}"
        assert response.headers["retry-after"] == "1"
        assert answer["state"] == "queued"
        assert service.get(response.headers["location"]).json()["state"] == "queued"

    def test_says_which_numbers_were_assumed(self, service: Service) -> None:
        answer = service.post(record()).json()
        assert answer["sd_defaulted"] == [
            "contacts[0].ground_speed",
            "contacts[0].pitch",
            "contacts[0].roll",
        ]
        assert "contacts[0].drift" in answer["taken_as_zero"]
        assert answer["missing"] == []

    def test_landing_job_and_audit_come_together(self, service: Service) -> None:
        landing = service.post(record()).json()["landing_id"]
        with reading(service.engine) as session:
            assert session.get(Landing, landing) is not None
            jobs = session.scalars(select(AssessmentJob)).all()
            entries = session.scalars(select(AuditEntry).where(AuditEntry.subject_id == landing))
            actions = [entry.action for entry in entries]
        assert [job.landing_id for job in jobs] == [landing]
        assert actions == ["received"]

    def test_a_bulk_landing_waits_in_its_lane(self, service: Service) -> None:
        headers = service.key("alpha", "post")
        response = service.client.post("/v1/landings?lane=bulk", json=record(), headers=headers)
        assert service.get(response.headers["location"]).json()["lane"] == "bulk"

    def test_accepts_what_is_too_thin_for_a_verdict(self, service: Service) -> None:
        thin = record()
        del thin["contacts"][0]["sink_rate"]
        answer = service.post(thin)
        assert answer.status_code == 202
        assert answer.json()["missing"] == ["contacts[0].sink_rate"]


class TestIdempotency:
    def test_the_same_record_id_is_the_same_landing(self, service: Service) -> None:
        first = service.post(record(record_id="r-1"))
        second = service.post(record(record_id="r-1"))
        assert second.status_code == 202
        assert second.headers["location"] == first.headers["location"]
        assert second.json()["is_repeated"]
        assert _landings(service) == 1

    def test_the_same_record_id_with_another_content_is_a_conflict(self, service: Service) -> None:
        service.post(record(3.0, record_id="r-1"))
        response = service.post(record(4.0, record_id="r-1"))
        assert response.status_code == 409
        assert response.json()["type"] == "urn:hardlanding:problem:conflict"
        assert "r-1" in response.json()["detail"]
        assert _landings(service) == 1

    def test_a_record_without_id_is_known_by_its_content(self, service: Service) -> None:
        first = service.post(record())
        shuffled = dict(reversed(list(record().items())))
        assert service.post(shuffled).headers["location"] == first.headers["location"]
        assert service.post(record(7.0)).headers["location"] != first.headers["location"]

    def test_the_same_key_is_the_same_landing(self, service: Service) -> None:
        headers = {**service.key("alpha", "post"), "Idempotency-Key": "k-1"}
        first = service.post(record(record_id="r-1"), headers=headers)
        second = service.post(record(record_id="r-1"), headers=headers)
        assert second.headers["location"] == first.headers["location"]

    def test_the_same_key_with_another_record_is_a_conflict(self, service: Service) -> None:
        headers = {**service.key("alpha", "post"), "Idempotency-Key": "k-1"}
        service.post(record(record_id="r-1"), headers=headers)
        response = service.post(record(record_id="r-2"), headers=headers)
        assert response.status_code == 409
        assert "k-1" in response.json()["detail"]

    def test_another_key_for_a_known_record_finds_it(self, service: Service) -> None:
        keys = [{**service.key("alpha", "post"), "Idempotency-Key": f"k-{n}"} for n in range(2)]
        places = {service.post(record(record_id="r"), headers=k).headers["location"] for k in keys}
        assert len(places) == 1

    def test_a_burst_of_the_same_record_is_one_landing(self, service: Service) -> None:
        service.key("alpha", "post")
        with ThreadPoolExecutor(8) as pool:
            answers = list(pool.map(service.post, [record(record_id="r-1")] * 16))
        assert {answer.status_code for answer in answers} == {202}
        assert len({answer.headers["location"] for answer in answers}) == 1
        assert _landings(service) == 1


def _landings(service: Service) -> int:
    with reading(service.engine) as session:
        assert session.scalar(select(func.count(AssessmentJob.id))) == session.scalar(
            select(func.count(Landing.id))
        )
        return session.scalar(select(func.count(Landing.id))) or 0


class TestList:
    @pytest.fixture
    def landings(self, service: Service) -> list[str]:
        """Seven landings, two of them at the same moment."""
        minutes = [0, 1, 2, 2, 3, 4, 5]
        return [
            service.post(
                record(
                    1.0 + number,
                    aircraft={"model_id": "mini", "tail_token": f"T-{number % 2}"},
                    contacts=[contact(1.0 + number, t_utc=f"2026-03-01T04:0{minute}:00Z")],
                )
            ).json()["landing_id"]
            for number, minute in enumerate(minutes)
        ]

    def test_pages_hold_everything_once_and_latest_first(
        self, service: Service, landings: list[str]
    ) -> None:
        seen, cursor, pages = [], "", 0
        while cursor is not None:
            query = f"?limit=3{cursor and f'&cursor={cursor}'}"
            page = service.get(f"/v1/landings{query}").json()
            seen += [item["id"] for item in page["items"]]
            cursor, pages = page["next"], pages + 1
        assert pages == 3
        assert sorted(seen) == sorted(landings)
        assert [seen[0], seen[-1]] == [landings[-1], landings[0]]

    def test_a_landing_that_arrives_meanwhile_shifts_no_page(
        self, service: Service, landings: list[str]
    ) -> None:
        first = service.get("/v1/landings?limit=4").json()
        service.post(record(contacts=[contact(9.0, t_utc="2026-03-01T05:00:00Z")]))
        second = service.get(f"/v1/landings?limit=10&cursor={first['next']}").json()
        seen = [item["id"] for item in first["items"] + second["items"]]
        assert sorted(seen) == sorted(landings)

    def test_filters(self, service: Service, landings: list[str]) -> None:
        cases = [
            ("tail=T-1", [1, 3, 5]),
            ("tail=T-9", []),
            ("aircraft=mini", [0, 1, 2, 3, 4, 5, 6]),
            ("aircraft=other", []),
            ("state=queued", [0, 1, 2, 3, 4, 5, 6]),
            ("state=assessed", []),
            ("from=2026-03-01T04:02:00Z&to=2026-03-01T04:04:00Z", [2, 3, 4]),
            ("from=2026-03-01T05:03:00%2B01:00", [4, 5, 6]),
        ]
        for query, expected in cases:
            found = {item["id"] for item in service.get(f"/v1/landings?{query}").json()["items"]}
            assert found == {landings[number] for number in expected}, query

    def test_filters_by_verdict(self, service: Service) -> None:
        soft, hard = record(1.0), record(14.0)
        for landing in (soft, hard):
            service.assessed(landing)
        (found,) = service.get("/v1/landings?verdict=HARD").json()["items"]
        assert found["verdict"] == "HARD"
        assert found["worst_utilisation"] > 0
        assert len(service.get("/v1/landings").json()["items"]) == 2


def test_a_landing_keeps_its_record_and_what_was_made_of_it(service: Service) -> None:
    posted = service.post(record(record_id="r-1")).json()
    landing = service.get(posted["links"]["landing"]).json()
    assert landing["record"] == record(record_id="r-1")
    assert landing["inputs"]["contacts"][0]["sink_rate"] == pytest.approx(6 * 0.3048)
    assert landing["sd"]["contacts[0].sink_rate"] == pytest.approx(0.3048)
    assert landing["tail"] == "T-0142"
    assert landing["record_id"] == "r-1"
