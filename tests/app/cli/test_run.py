"""`hardlanding run`, as `make run` starts it: airframe, service, demo verdicts, clean end."""

import os
import signal
import subprocess
import sys
from pathlib import Path

from solver.assess import AssessmentModel
from tests.conftest import KEPT_CACHE
from tests.servers import free_port, wait_until

PATIENCE = 240.0


def test_run_shows_the_demo_verdicts_and_stays_up(
    tmp_path: Path, example_jet: AssessmentModel
) -> None:
    assert example_jet.reduced.size > 0  # its reduced model lies in the kept cache by now
    output = tmp_path / "output.txt"
    environment = {
        **os.environ,
        "HL_VAR": str(tmp_path / "var"),
        "HL_CACHE_DIR": str(KEPT_CACHE),
        "HL_MAKES_ENVELOPES": "false",
        "COLUMNS": "200",
    }
    command = [sys.executable, "-m", "app.cli.main", "run", "--port", str(free_port())]
    with output.open("wb") as stream:
        process = subprocess.Popen(
            command, env=environment, stdout=stream, stderr=subprocess.STDOUT, cwd=tmp_path
        )
    try:
        wait_until(lambda: "Stop it with" in output.read_text(), "the demo", PATIENCE)
        text = output.read_text()
        rows = {line.split()[1]: line for line in text.splitlines() if line.startswith("│")}
        assert "NORMAL" in rows["smooth"]
        assert "INSPECT" in rows["ten-feet-per-second"]
        assert "HARD" in rows["rolled-hard"]
        assert "INSPECT" in rows["nose-first"]
        assert process.poll() is None
    finally:
        process.send_signal(signal.SIGINT)
        code = process.wait(timeout=60)
    assert code == 0
    log = (tmp_path / "var" / "service.log").read_text()
    assert "Traceback" not in log
