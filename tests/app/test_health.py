"""Health, readiness, metrics, and the sweeper behind them."""

from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from app.broker import Nudger
from app.config import Settings
from app.main import create_app
from app.observe import Metrics
from app.sweeper import Sweeper
from tests.conftest import Service, Stack, make_service, make_stack
from tests.records import record
from tests.servers import free_port
from worker.warm import Models


def test_ready(shared_service: Service) -> None:
    answer = shared_service.client.get("/readyz").json()
    assert answer["is_ready"]
    assert answer["database"] == answer["broker"] == "ok"
    assert answer["aircraft"] == ["mini"]


def test_a_database_behind_the_program_is_not_ready(tmp_path: Path) -> None:
    settings = Settings(_env_file=None, var=tmp_path, log_format="console")
    with TestClient(create_app(settings)) as client:
        response = client.get("/readyz")
        assert client.get("/healthz").status_code == 200
    assert response.status_code == 503
    assert "hardlanding migrate" in response.json()["database"]


def test_an_unreachable_database_is_not_ready_and_says_no_more(tmp_path: Path) -> None:
    url = f"postgresql://nobody:secret@127.0.0.1:{free_port()}/none"
    settings = Settings(_env_file=None, var=tmp_path, database_url=url, log_format="console")
    with TestClient(create_app(settings), raise_server_exceptions=False) as client:
        response = client.get("/readyz")
        broken = client.get("/v1/landings", headers={"X-API-Key": "k"})
    assert response.status_code == 503
    assert response.json()["database"] == "unreachable"
    assert broken.status_code == 500
    assert broken.headers["content-type"] == "application/problem+json"
    assert "secret" not in broken.text
    assert "psycopg" not in broken.text


def test_landings_are_accepted_while_the_broker_is_away(
    request: pytest.FixtureRequest, tmp_path: Path, models: Models
) -> None:
    away = f"redis://127.0.0.1:{free_port()}/0"
    with make_stack("sqlite+filesystem", tmp_path / "var", request) as stack:
        settings = stack.settings.model_copy(update={"broker_url": away, "sweep_interval": 60.0})
        with make_service(Stack(stack.name, settings), models) as service:
            assert service.post(record()).status_code == 202
            ready = service.client.get("/readyz")
            assert ready.status_code == 200
            assert "unreachable" in ready.json()["broker"]
        with make_service(stack, models) as service:
            assert service.work() == 1


def test_a_cleared_message_folder_is_made_again(tmp_path: Path) -> None:
    settings = Settings(_env_file=None, var=tmp_path)
    nudger = Nudger(settings)
    assert nudger.nudge()
    for path in sorted(settings.broker_folder.rglob("*"), reverse=True):
        path.unlink() if path.is_file() else path.rmdir()
    assert nudger.nudge(2)
    assert len(list((settings.broker_folder / "messages").iterdir())) == 2


def test_metrics_come_from_the_table(service: Service) -> None:
    service.post(record(3.0))
    service.post(record(3.0))
    headers = service.key("alpha", "post")
    service.client.post("/v1/landings?lane=bulk", json=record(4.0), headers=headers)
    waiting = _metrics(service)
    assert waiting['hardlanding_queue_depth{lane="interactive",state="queued"}'] == 1
    assert waiting['hardlanding_queue_depth{lane="bulk",state="queued"}'] == 1
    assert 0 <= waiting['hardlanding_queue_oldest_seconds{lane="bulk"}'] < 60
    assert waiting['hardlanding_landings_received_total{outcome="new"}'] == 2
    assert waiting['hardlanding_landings_received_total{outcome="repeated"}'] == 1
    service.work()
    done = _metrics(service)
    assert 'hardlanding_queue_depth{lane="bulk",state="queued"}' not in done
    assert done['hardlanding_queue_oldest_seconds{lane="bulk"}'] == 0
    assert done['hardlanding_assessments{state="assessed"}'] == 2
    assert sum(v for k, v in done.items() if k.startswith("hardlanding_verdicts{")) == 2


def test_requests_are_counted_by_route_and_never_by_address(service: Service) -> None:
    service.get("/v1/landings/00000000-0000-7000-8000-000000000000")
    service.client.request("BREW", "/v1/landings")
    names = [name for name in _metrics(service) if "http_request_seconds_count" in name]
    assert any('route="/v1/landings/{landing_id}"' in name for name in names)
    assert not any("00000000" in name or "BREW" in name for name in names)


def _metrics(service: Service) -> dict[str, float]:
    lines = service.client.get("/metrics").text.splitlines()
    pairs = [line.rsplit(" ", 1) for line in lines if not line.startswith("#")]
    return {name: float(value) for name, value in pairs}


def test_requests_carry_an_identity(shared_service: Service) -> None:
    given = "0b5ad7a7c9f34a5fa5b4a6d5c9f3e2d1"
    answer = shared_service.client.get("/healthz", headers={"X-Request-ID": given})
    assert answer.headers["x-request-id"] == given


@pytest.mark.parametrize(("waiting", "expected"), [(0, 0), (2, 2), (6, 4)])
def test_the_sweeper_nudges_for_what_is_due_up_to_its_window(
    service: Service, waiting: int, expected: int
) -> None:
    for number in range(waiting):
        service.post(record(2.0 + number))
    sent = []

    class Counting(Nudger):
        def nudge(self, count: int = 1) -> bool:
            sent.append(count)
            return True

    settings = service.settings
    sweeper = Sweeper(settings, service.engine, Counting(settings), Metrics(service.engine))
    assert sweeper.sweep() == expected
    assert sum(sent) == expected
