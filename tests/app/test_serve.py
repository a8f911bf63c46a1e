"""The embedded mode as its user starts it: one command, two programs, no orphans."""

import shutil
import signal
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest

from app.cli.key import create_key
from app.cli.migrate import upgrade
from app.cli.supervisor import Program, Supervisor
from app.config import Settings
from tests.records import record
from tests.servers import free_port, wait_until
from tests.solver.aircraft.mini import write_mini_aircraft
from tests.worker.programs import Programs, children, descendants, is_alive, kill_at_once, programs

PATIENCE = 120.0


@pytest.fixture
def serving(
    tmp_path: Path, aircraft_folder: Path, cache_folder: Path
) -> Iterator[tuple[Programs, httpx2.Client, Any]]:
    """`hardlanding serve` in an empty folder, a client with a key, and the process."""
    settings = Settings(
        _env_file=None,
        var=tmp_path / "var",
        aircraft_dir=shutil.copytree(aircraft_folder, tmp_path / "aircraft"),
        cache_dir=cache_folder,
        port=free_port(),
        worker_concurrency=1,
        lease_seconds=8.0,
        hard_time_limit=7.0,
        soft_time_limit=5.0,
        sweep_interval=0.3,
        makes_envelopes=False,
    )
    upgrade(settings)
    secret = create_key(settings, operator="alpha", scopes=("post", "read"))
    with programs(settings, tmp_path) as started:
        process = started.start_cli("serve")
        with httpx2.Client(base_url=started.url, headers={"X-API-Key": secret}) as client:
            wait_until(lambda: client.get("/readyz").status_code == 200, "the service", PATIENCE)
            yield started, client, process


def verdict(client: httpx2.Client, sink_rate: float) -> str:
    place = client.post("/v1/landings", json=record(sink_rate)).headers["location"]
    answer = wait_until(
        lambda: (found := client.get(place).json())["state"] == "assessed" and found,
        "the verdict",
        PATIENCE,
    )
    text: str = answer["result"]["verdict"]
    return text


def test_a_killed_worker_comes_back_and_nothing_outlives_the_end(
    serving: tuple[Programs, httpx2.Client, Any],
) -> None:
    _, client, process = serving
    assert verdict(client, 2.0) == "NORMAL"
    api, worker = children(process.pid)
    for member in (worker, *descendants(worker)):
        kill_at_once(member)
    assert verdict(client, 2.5) == "NORMAL"
    assert len(children(process.pid)) == 2
    assert api in children(process.pid)
    members = descendants(process.pid)
    assert len(members) >= 3  # API, worker, its child
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=60) == 0
    assert [member for member in members if is_alive(member)] == []


def test_nothing_outlives_a_supervisor_that_is_killed_outright(
    serving: tuple[Programs, httpx2.Client, Any],
) -> None:
    _, client, process = serving
    verdict(client, 2.0)
    members = descendants(process.pid)
    assert len(members) >= 3
    process.kill()
    process.wait()
    wait_until(lambda: not any(map(is_alive, members)), "the end of the orphans", 60.0)


def test_an_aircraft_installed_later_is_assessed_too(
    serving: tuple[Programs, httpx2.Client, Any],
) -> None:
    started, client, _ = serving
    folder = Path(started.settings.aircraft_folder)
    wait_until(lambda: b"worker.warm" in started.log.read_bytes(), "a warm worker", PATIENCE)
    write_mini_aircraft(folder / "late")
    definition = folder / "late" / "definition.toml"
    definition.write_text(definition.read_text().replace('name = "mini"', 'name = "late"', 1))
    posted = record(2.0, aircraft={"model_id": "late"})
    place = client.post("/v1/landings", json=posted).headers["location"]
    wait_until(lambda: client.get(place).json()["state"] == "assessed", "the verdict", PATIENCE)
    assert client.get(place).json()["attempts"] == 1


class TestSupervisor:
    def test_a_program_that_keeps_ending_is_started_ever_less_often(self) -> None:
        said: list[str] = []
        program = Program("brief", ["true"])
        supervisor = Supervisor([program], say=said.append)
        while len(said) < 3:
            supervisor._tend(program)
            if program.process is not None:
                program.process.wait()
            program.due = 0.0
        assert [line.split(" in ")[-1] for line in said] == ["0.5 s", "1 s", "2 s"]

    def test_a_program_that_is_done_is_not_started_again(self) -> None:
        program = Program("brief", ["true"], is_once=True)
        supervisor = Supervisor([program], say=pytest.fail)
        supervisor._tend(program)
        assert program.process is not None
        program.process.wait()
        for _ in range(2):
            supervisor._tend(program)
            assert program.process is None

    def test_one_that_failed_is(self) -> None:
        said: list[str] = []
        program = Program("brief", ["false"], is_once=True)
        supervisor = Supervisor([program], say=said.append)
        supervisor._tend(program)
        assert program.process is not None
        program.process.wait()
        supervisor._tend(program)
        assert "starting it again" in said[0]

    def test_a_program_waits_until_it_may_start(self) -> None:
        may_start = threading.Event()
        program = Program("late", ["true"], may_start=may_start)
        supervisor = Supervisor([program], say=lambda _: None)
        supervisor._tend(program)
        assert program.process is None
        may_start.set()
        supervisor._tend(program)
        assert program.process is not None
        program.process.wait()

    def test_a_program_that_will_not_end_is_killed(
        self, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
    ) -> None:
        monkeypatch.setattr("app.cli.supervisor.GRACE", 0.2)
        deaf = tmp_path / "deaf"
        script = f"trap '' TERM; touch {deaf}; while :; do sleep 0.05; done"
        stubborn = Program("stubborn", ["sh", "-c", script])
        said: list[str] = []
        supervisor = Supervisor([stubborn], say=said.append)
        supervisor._tend(stubborn)
        wait_until(deaf.exists, "the program")
        assert stubborn.process is not None
        supervisor._take_down()
        assert stubborn.process.returncode == -signal.SIGKILL
