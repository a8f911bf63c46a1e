"""Progress of long measurements on a terminal or in a log."""

import sys
from time import monotonic


class ConsoleProgress:
    """One line for each step: rewritten on a terminal, a line every few seconds in a log."""

    def __init__(self, log_interval: float = 15.0) -> None:
        self._terminal = sys.stderr.isatty()
        self._interval = 0.2 if self._terminal else log_interval
        self._step = ""
        self._start = self._last = monotonic()

    def __call__(self, step: str, share: float) -> None:
        """Show that ``share`` of ``step`` is done and how long the rest may take."""
        now = monotonic()
        if step != self._step:
            self._step, self._start, self._last = step, now, now - self._interval
        if now - self._last < self._interval and share < 1.0:
            return
        self._last = now
        elapsed = now - self._start
        rest = f", {elapsed / share - elapsed:.0f} s to go" if 0.02 < share < 1.0 else ""
        line = f"  {step}: {share:4.0%}, {elapsed:.0f} s{rest}"
        if self._terminal:
            print(f"\r{line:<70}", end="\n" if share >= 1.0 else "", file=sys.stderr, flush=True)
        else:
            print(line, file=sys.stderr, flush=True)
