"""Keeps a few programs running together: starts, restarts, and takes them all down."""

import ctypes
import math
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import IO

SHORTEST_PAUSE = 0.5  #: before a program that ended is started again [s]
LONGEST_PAUSE = 30.0  #: [s]
CALM = 60.0  #: a program that ran this long starts again without delay [s]
GRACE = 15.0  #: between the request to end and the kill [s]

_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None)  #: loaded before any fork


@dataclass(slots=True)
class Program:
    """A program and its present process."""

    name: str
    command: Sequence[str]
    process: subprocess.Popen[bytes] | None = None
    started: float = 0.0
    pause: float = SHORTEST_PAUSE
    due: float = 0.0
    #: Ends by itself when its work is done; it is started again only if it failed.
    is_once: bool = False
    may_start: threading.Event | None = None  #: not before it is set


@dataclass(slots=True)
class Supervisor:
    """Runs programs until it is told to stop; none of them outlives it."""

    programs: Sequence[Program]
    say: Callable[[str], None]
    log: Path | None = None  #: takes what the programs print; None: the terminal
    environment: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
    _is_stopping: bool = False

    def run(self) -> None:
        """Block until SIGTERM or SIGINT."""
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._stop)
        try:
            while not self._is_stopping:
                for program in self.programs:
                    self._tend(program)
                time.sleep(0.1)
        finally:
            self._take_down()

    def _stop(self, _number: int, _frame: FrameType | None) -> None:
        self._is_stopping = True

    def _tend(self, program: Program) -> None:
        now = time.monotonic()
        if program.process is None:
            if program.may_start is not None and not program.may_start.is_set():
                return
            if now >= program.due:
                program.process = self._start(program.command)
                program.started = now
            return
        code = program.process.poll()
        if code is None:
            return
        _kill_group(program.process, signal.SIGKILL)  # children it left behind
        if program.is_once and code == 0:
            program.process, program.due = None, math.inf
            return
        if now - program.started >= CALM:
            program.pause = SHORTEST_PAUSE
        self.say(f"{program.name} ended with {code}; starting it again in {program.pause:g} s")
        program.process = None
        program.due = now + program.pause
        program.pause = min(2 * program.pause, LONGEST_PAUSE)

    def _start(self, command: Sequence[str]) -> subprocess.Popen[bytes]:
        output = None if self.log is None else self.log.open("ab")
        try:
            return self._started(command, output)
        finally:
            if output is not None:
                output.close()  # the program keeps its own copy

    def _started(self, command: Sequence[str], output: IO[bytes] | None) -> subprocess.Popen[bytes]:
        return subprocess.Popen(  # noqa: S603 - our own programs
            command,
            env=dict(self.environment),
            stdout=output,
            stderr=None if output is None else subprocess.STDOUT,
            # A group of its own: Ctrl-C reaches the supervisor only, which then ends all in order.
            start_new_session=True,
            preexec_fn=_die_with_parent if sys.platform == "linux" else None,
        )

    def _take_down(self) -> None:
        processes = [p.process for p in self.programs if p.process is not None]
        for process in processes:
            process.terminate()
        deadline = time.monotonic() + GRACE
        for process in processes:
            try:
                process.wait(timeout=max(0.1, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            _kill_group(process, signal.SIGKILL)


def _kill_group(process: subprocess.Popen[bytes], number: signal.Signals) -> None:
    try:
        os.killpg(process.pid, number)
    except ProcessLookupError:
        return


def _die_with_parent() -> None:
    """Ask the kernel to end this process if the supervisor is killed outright."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
