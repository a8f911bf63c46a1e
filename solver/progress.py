"""How long work tells whoever waits how far it is."""

from typing import Protocol


class Progress(Protocol):
    """Called with the name of the step under way and the share of it that is done, 0 to 1."""

    def __call__(self, step: str, share: float) -> None:
        """Report that ``share`` of ``step`` is done."""


def silent(step: str, share: float) -> None:
    """Report to nobody."""
