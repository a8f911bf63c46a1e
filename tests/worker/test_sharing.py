"""Models in the memory of several processes at once: one copy, never sent anywhere."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import redis

from app.broker import QUEUE, Nudger
from tests.conftest import Stack
from tests.servers import free_port, wait_until
from tests.worker.programs import Programs, children, programs
from worker.warm import Models

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")


def mapped(pid: int, folder: Path) -> dict[str, str]:
    """Files of a folder that a process has in its memory: inode by name."""
    found = {}
    for line in Path(f"/proc/{pid}/maps").read_text().splitlines():
        words = line.split(maxsplit=5)
        if len(words) == 6 and words[5].startswith(str(folder)):
            found[words[5]] = words[4]
    return found


def test_large_arrays_are_windows_on_files(models: Models, cache_folder: Path) -> None:
    reduced = models.get("mini").reduced
    for name in ("mass", "rate_operators", "applied", "inertia"):
        array = getattr(reduced, name)
        assert not array.flags.writeable
        assert isinstance(array.base, np.memmap)
        assert Path(str(array.base.filename)).is_relative_to(cache_folder)


@pytest.fixture
def working(stack: Stack, tmp_path: Path) -> Iterator[Programs]:
    settings = stack.settings.model_copy(update={"port": free_port(), "auto_migrate": False})
    with programs(settings, tmp_path) as running:
        running.start_api()
        yield running


def test_workers_and_their_children_share_them(
    working: Programs, stack: Stack, cache_folder: Path
) -> None:
    supervisors = [working.start_worker(concurrency=2), working.start_worker(concurrency=1)]

    def pools() -> list[list[int]]:
        workers = [children(supervisor.pid)[0] for supervisor in supervisors]
        found = [[worker, *children(worker)] for worker in workers]
        return found if [len(pool) for pool in found] == [3, 2] else []

    processes = [pid for pool in wait_until(pools, "the children", 120.0) for pid in pool]
    files = [mapped(pid, cache_folder) for pid in processes]
    for array in ("rate_operators", "allowables"):  # of the reduced model, of the airframe
        assert any(name.endswith(f"/{array}.npy") for name in files[0])
    assert all(found == files[0] for found in files)


def test_a_message_says_only_that_there_is_work(stack: Stack) -> None:
    nudger = Nudger(stack.settings)
    assert nudger.nudge()
    nudger.close()
    if stack.settings.broker_url is None:
        (file,) = (stack.settings.broker_folder / "messages").iterdir()
        message = json.loads(file.read_text())
    else:
        with redis.Redis.from_url(stack.settings.broker_url) as client:
            message = json.loads(client.lindex(QUEUE, 0))
    assert message["content-type"] == "application/json"
    assert message["headers"]["argsrepr"] == "()"
    assert message["headers"]["kwargsrepr"] == "{}"
    assert len(json.dumps(message)) < 2000
