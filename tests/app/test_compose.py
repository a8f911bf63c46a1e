"""docker-compose.yml cannot be run here; its commands can."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest
import typer
import yaml

from app.cli.key import create_key
from app.cli.main import app
from app.config import Settings
from tests.conftest import make_stack
from tests.records import record
from tests.servers import free_port, wait_until
from tests.worker.programs import programs

ROOT = Path(__file__).resolve().parents[2]
COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
SERVICES: dict[str, dict[str, Any]] = COMPOSE["services"]
OURS = {name: service for name, service in SERVICES.items() if service.get("build") == "."}


def dockerfile_command() -> list[str]:
    (line,) = (
        line for line in (ROOT / "Dockerfile").read_text().splitlines() if line.startswith("CMD ")
    )
    command: list[str] = json.loads(line.removeprefix("CMD "))
    return command


def resolve(command: list[str]) -> None:
    """Parse a command as the command line would; raises if there is no such one."""
    program, *words = command
    assert program == "hardlanding"
    found: Any = typer.main.get_command(app)
    while hasattr(found, "commands"):
        name, *words = words
        found = found.commands[name]
    with found.make_context(found.name, words):
        pass


def test_the_parts_are_all_there() -> None:
    assert set(SERVICES) == {
        "postgres", "redis", "aircraft", "migrate", "api", "worker", "worker-interactive",
    }  # fmt: skip


@pytest.mark.parametrize("name", sorted(OURS))
def test_every_command_exists(name: str) -> None:
    resolve(OURS[name]["command"])


def test_the_images_own_command_exists() -> None:
    resolve(dockerfile_command())


def test_every_setting_is_one_of_ours() -> None:
    known = {f"HL_{name.upper()}" for name in Settings.model_fields}
    for service in OURS.values():
        assert set(service["environment"]) <= known


def test_services_wait_for_what_they_need() -> None:
    for name, service in SERVICES.items():
        for needed, how in service.get("depends_on", {}).items():
            other = SERVICES[needed]
            if how["condition"] == "service_healthy":
                assert "healthcheck" in other, f"{name} waits for the health of {needed}"
            else:
                assert how["condition"] == "service_completed_successfully"
                assert other["restart"] == "no"


def test_volumes_are_declared() -> None:
    used = {v.split(":")[0] for s in SERVICES.values() for v in s.get("volumes", [])}
    assert used == set(COMPOSE["volumes"])


def test_dockerfile_copies_what_is_there() -> None:
    for line in (ROOT / "Dockerfile").read_text().splitlines():
        if line.startswith("COPY "):
            for source in line.split()[1:-1]:
                assert (ROOT / source).exists(), source


@pytest.fixture
def scaled_out(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Settings]:
    """Settings of the scaled-out form on real servers."""
    with make_stack("postgres+redis", tmp_path / "var", request) as stack:
        yield stack.settings.model_copy(update={"port": free_port()})


def test_the_commands_together_give_a_verdict(scaled_out: Settings, tmp_path: Path) -> None:
    with programs(scaled_out, tmp_path) as started:

        def start(name: str) -> Any:
            return started.start_cli(*OURS[name]["command"][1:])

        assert start("migrate").wait(timeout=60) == 0
        for name in ("api", "worker", "worker-interactive"):
            start(name)
        key = create_key(scaled_out, operator="alpha", scopes=("post", "read"))
        with httpx2.Client(base_url=started.url, headers={"X-API-Key": key}) as client:
            wait_until(lambda: client.get("/readyz").status_code == 200, "the API", 60.0)
            place = client.post("/v1/landings", json=record(2.0)).headers["location"]
            wait_until(
                lambda: client.get(place).json()["state"] == "assessed", "the verdict", 180.0
            )
