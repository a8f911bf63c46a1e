"""A peer in a process of its own: its prints are not the report's, nor are its crashes.

``python -m verification.peers.apart`` is the other end.  The call arrives pickled on its standard
input; shares done and the answer go back on its standard output, which nothing else is left to
write to.  It ends when its caller does.
"""

import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any, TypeVar, cast

Answer = TypeVar("Answer")

#: Tells the caller what share of the work is done.
Report = Callable[[float], None]


class PeerError(Exception):
    """The peer's process ended without an answer; the message says how."""


def silent(_: float) -> None:
    """Report nothing."""


def apart(job: Callable[..., Answer], *arguments: Any, report: Report = silent) -> Answer:
    """Call ``job(*arguments, report=...)``, a function of a module, in another process.

    Raises
    ------
    PeerError
        The function raised, or its process crashed.
    """
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with subprocess.Popen(
        [sys.executable, "-m", __name__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=environment | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        pickle.dump((job, arguments), process.stdin)
        process.stdin.flush()
        while True:
            try:
                kind, value = pickle.load(process.stdout)
            except (EOFError, pickle.UnpicklingError):
                code = process.wait()
                raise PeerError(f"the peer's process ended with status {code}") from None
            if kind == "share":
                report(value)
            elif kind == "answer":
                return cast("Answer", value)
            else:
                raise PeerError(value)


def _serve() -> None:
    answers = os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    job, arguments = pickle.load(sys.stdin.buffer)

    def end_with_caller() -> None:
        sys.stdin.buffer.read()
        os._exit(1)

    threading.Thread(target=end_with_caller, daemon=True).start()

    def send(kind: str, value: object) -> None:
        pickle.dump((kind, value), answers)
        answers.flush()

    try:
        value = job(*arguments, report=lambda share: send("share", share))
    except Exception as error:  # whatever it is, the caller raises it
        send("error", f"{type(error).__name__}: {error}")
    else:
        send("answer", value)
    # Peers that clean up at exit may crash there; the answer has been given.
    os._exit(0)


if __name__ == "__main__":
    _serve()
