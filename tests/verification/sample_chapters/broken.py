"""A chapter that raises."""

from verification.chapter import Chapter
from verification.run import Run


def chapter(run: Run) -> Chapter:
    raise RuntimeError("the bridge is out")
