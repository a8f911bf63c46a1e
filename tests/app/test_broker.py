"""Nudges: cheap, coalesced, and never in the way of a landing."""

import threading
from pathlib import Path

from app.broker import Nudger
from app.config import Settings


class Slow(Nudger):
    """A broker that takes nudges only when told to, and refuses them if told so."""

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings)
        self.has_begun, self.may_go_on = threading.Event(), threading.Event()
        self.sent: list[int] = []
        self.takes = True

    def _send(self, count: int) -> bool:
        self.sent.append(count)
        self.has_begun.set()
        assert self.may_go_on.wait(10.0)
        return self.takes


def test_who_comes_while_another_sends_need_not_wait(tmp_path: Path) -> None:
    slow = Slow(Settings(_env_file=None, var=tmp_path, nudge_window=3))
    sender = threading.Thread(target=slow.nudge)
    sender.start()
    assert slow.has_begun.wait(10.0)
    for _ in range(5):
        slow.nudge()  # would hang here
    slow.may_go_on.set()
    sender.join()
    assert slow.sent == [1, 3]


def test_a_refused_nudge_does_not_block_the_next_one(tmp_path: Path) -> None:
    slow = Slow(Settings(_env_file=None, var=tmp_path))
    slow.may_go_on.set()
    slow.takes = False
    assert not slow.nudge(2)
    slow.takes = True
    assert slow.nudge()
    assert slow.sent == [2, 1]
