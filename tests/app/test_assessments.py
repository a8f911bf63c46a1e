"""Assessments over HTTP, with the real solver behind them."""

import numpy as np
import pytest
from sqlalchemy import select

from app.artefacts.container import unpack
from app.assessments import queue
from app.audit.models import AuditEntry
from app.db import reading, writing
from app.landings import inputs
from tests.conftest import Service
from tests.records import contact, record
from worker.solve import solve


class TestGet:
    def test_pending(self, service: Service) -> None:
        response = service.get(service.post(record()).headers["location"])
        assert response.json()["result"] is None
        assert response.headers["retry-after"] == "1"

    def test_a_verdict_names_its_basis(self, service: Service) -> None:
        answer = service.assessed(record(6.0))
        result = answer["result"]
        assert answer["state"] == "assessed"
        assert result["verdict"] in ("NORMAL", "FIRM")
        assert result["probability_limit_exceeded"] is None
        assert result["reasons"]
        assert len(result["gear_loads"]) == 3
        assert result["model_hash"] == service.models.get("mini").content_hash
        assert result["program_version"]
        assert "Advisory only" in answer["advisory"]
        assert service.get(answer["links"]["model"]).json()["aircraft"] == "mini"

    def test_a_soft_landing_has_its_probability(self, service: Service) -> None:
        """Settled by two pessimistic landings; every hot spot says the same."""
        service.settings = service.settings.model_copy(update={"propagate_uncertainty": True})
        answer = service.assessed(record(2.0))
        result = answer["result"]
        known = result["limit_probability"]
        assert result["probability_limit_exceeded"] == known["probability"] == 0.0
        assert known["basis"] == "corners"
        assert 0.0 < known["upper"] < 0.05
        assert "limit_probability" in {reason["code"] for reason in result["reasons"]}
        spots = service.get(answer["links"]["hot_spots"]).json()["items"]
        assert {spot["probability_limit_exceeded"] for spot in spots} == {0.0}
        assert all(spot["probability_standard_error"] > 0.0 for spot in spots)

    def test_stored_inputs_give_the_same_answer_again(self, service: Service) -> None:
        result = service.assessed(record(8.0))["result"]
        again = solve(
            service.models.get("mini"),
            inputs.from_json(result["inputs"]),
            propagate_uncertainty=service.settings.propagate_uncertainty,
        )
        assert again.worst_utilisation == result["worst_utilisation"]
        assert again.verdict == result["verdict"]

    def test_not_changed(self, service: Service) -> None:
        location = service.post(record()).headers["location"]
        tag = service.get(location).headers["etag"]
        assert not tag.startswith("W/")
        headers = {**service.key("alpha", "read"), "If-None-Match": tag}
        unchanged = service.get(location, headers=headers)
        assert unchanged.status_code == 304
        assert unchanged.headers["etag"] == tag
        assert unchanged.content == b""
        service.work()
        changed = service.get(location, headers=headers)
        assert changed.status_code == 200
        assert changed.headers["etag"] != tag
        assert "retry-after" not in changed.headers

    def test_the_worst_contact_decides(self, service: Service) -> None:
        bounce = record(contacts=[contact(2.0), contact(12.0), contact(3.0)])
        single = service.assessed(record(12.0))["result"]
        result = service.assessed(bounce)["result"]
        assert result["driving_contact"] == 1
        assert result["verdict"] == single["verdict"]

    def test_a_thin_record_is_never_normal(self, service: Service) -> None:
        thin = record()
        del thin["contacts"][0]["sink_rate"]
        result = service.assessed(thin)["result"]
        assert result["verdict"] == "UNDETERMINED"
        assert any("sink_rate" in reason["text"] for reason in result["reasons"])
        for figure in ("worst_utilisation", "energy_error", "equilibrium_residual"):
            assert result[figure] is None, "nothing was simulated; a zero would read as harmless"

    def test_a_slow_recorder_cannot_show_a_landing(self, service: Service) -> None:
        slow = record(contacts=[contact(2.0, nz_peak={"value": 1.2, "unit": "g", "rate_hz": 2})])
        result = service.assessed(slow)["result"]
        assert result["verdict"] == "UNDETERMINED"
        assert any("4 Hz" in reason["text"] for reason in result["reasons"])

    def test_inadmissible_loading_is_undetermined_with_its_reason(self, service: Service) -> None:
        # As much fuel as the tanks hold, and yet a gross mass that leaves room for none.
        full = {"value": 2500, "unit": "kg"}
        light = record(fuel={"wing_left": full, "wing_right": full})
        light["mass"]["gross_weight"] = {"value": 8400, "unit": "kg"}
        answer = service.assessed(light)
        assert answer["state"] == "assessed"
        assert answer["result"]["verdict"] == "UNDETERMINED"
        assert answer["result"]["reasons"][0]["code"] == "inadmissible_record"
        assert answer["result"]["driving_contact"] is None
        assert answer["result"]["worst_utilisation"] is None


class TestArrays:
    @pytest.fixture
    def links(self, service: Service) -> dict[str, str]:
        return service.assessed(record(10.0, contacts=[contact(3.0), contact(10.0)]))["links"]

    def test_hot_spots_are_ranked(self, service: Service, links: dict[str, str]) -> None:
        answer = service.get(links["hot_spots"]).json()
        spots = answer["items"]
        assert [spot["rank"] for spot in spots] == list(range(1, len(spots) + 1))
        used = [spot["utilisation"] for spot in spots]
        assert used == sorted(used, reverse=True)
        assert spots[0]["peak_stress"] / spots[0]["allowable"] == pytest.approx(used[0])
        assert {"zone", "side", "ata_chapter", "inspection", "position"} <= set(spots[0])

    def test_histories_of_each_contact(self, service: Service, links: dict[str, str]) -> None:
        for number in (0, 1):
            answer = service.get(f"{links['histories']}?contact={number}").json()
            assert answer["contacts"] == 2
            channels = {channel["name"]: channel for channel in answer["channels"]}
            assert channels["main_left.strut_force"]["unit"] == "N"
            assert len(channels["main_left.strut_force"]["values"]) == len(answer["time"])
            assert answer["ground_contacts"]
        missing = service.get(f"{links['histories']}?contact=2")
        assert missing.status_code == 404
        assert "0 to 1" in missing.json()["detail"]

    def test_binary_and_json_histories_agree(self, service: Service, links: dict[str, str]) -> None:
        packed = unpack(service.get(f"{links['histories']}?format=binary").content)
        answer = service.get(links["histories"]).json()
        np.testing.assert_array_equal(packed["time"], np.float32(answer["time"]))

    def test_the_peak_field_matches_mesh_and_hot_spots(
        self, service: Service, links: dict[str, str]
    ) -> None:
        response = service.get(f"{links['peak_field']}?format=binary")
        assert response.headers["content-type"] == "application/octet-stream"
        field = unpack(response.content)
        plain = service.get(links["peak_field"]).json()
        mesh = service.get(f"{links['model']}/mesh").json()
        np.testing.assert_array_equal(field["element"], mesh["element"])
        np.testing.assert_array_equal(field["stress"], np.float32(plain["stress"]))
        worst = service.get(links["hot_spots"]).json()["items"][0]
        row = mesh["element"].index(worst["element"])
        assert field["stress"][row] == pytest.approx(worst["peak_stress"])
        assert field["utilisation"].max() == pytest.approx(worst["utilisation"])

    def test_pending_has_no_arrays_yet(self, service: Service) -> None:
        links = service.post(record()).json()["links"]
        for name in ("hot_spots", "histories", "peak_field"):
            response = service.get(links[name])
            assert response.status_code == 409
            assert response.headers["retry-after"] == "1"


class TestMesh:
    def test_is_cached_for_ever(self, shared_service: Service) -> None:
        (mini,) = shared_service.get("/v1/aircraft").json()["items"]
        address = f"{mini['links']['model']}/mesh"
        response = shared_service.get(f"{address}?format=binary")
        assert "immutable" in response.headers["cache-control"]
        packed, plain = unpack(response.content), shared_service.get(address).json()
        np.testing.assert_array_equal(packed["quads"], plain["quads"])
        count = len(plain["quads"]) + len(plain["triangles"]) + len(plain["beams"])
        assert len(plain["element"]) == len(plain["zone"]) == count
        assert max(plain["zone"]) < len(plain["zones"])

    def test_an_unknown_model(self, shared_service: Service) -> None:
        for path in (f"/v1/models/{'0' * 64}", f"/v1/models/{'0' * 64}/mesh"):
            assert shared_service.get(path).status_code == 404


class TestRetry:
    def test_only_what_failed_can_be_tried_again(self, service: Service) -> None:
        location = service.post(record()).headers["location"]
        headers = service.key("alpha", "review")
        refused = service.client.post(f"{location}/retry", headers=headers)
        assert refused.status_code == 409
        assert "queued" in refused.json()["detail"]

    def test_a_dead_assessment_lives_again(self, service: Service) -> None:
        location = service.post(record()).headers["location"]
        with writing(service.engine) as session:
            (claimed,) = queue.claim(session, worker="w", lanes=(0, 1), lease=60.0, max_attempts=1)
            queue.give_up(session, claimed, "it broke", max_attempts=1)
        dead = service.get(location).json()
        assert (dead["state"], dead["last_error"]) == ("dead", "it broke")
        assert "it broke" in service.get(f"{location}/hot-spots").json()["detail"]
        headers = service.key("alpha", "review")
        revived = service.client.post(f"{location}/retry", headers=headers)
        assert revived.status_code == 202
        assert revived.json()["state"] == "queued"
        service.work()
        assert service.get(location).json()["state"] == "assessed"

    def test_every_step_is_on_record(self, service: Service) -> None:
        landing = service.assessed(record())["landing_id"]
        with reading(service.engine) as session:
            entries = session.scalars(
                select(AuditEntry).where(AuditEntry.subject_id == landing).order_by(AuditEntry.at)
            ).all()
        assert [entry.action for entry in entries] == ["received", "assessed"]
        assert entries[0].actor.startswith("key:hl_")
        assert entries[1].model_hash == service.models.get("mini").content_hash
        assert entries[1].program_version
