"""The life of an assessment."""

from enum import StrEnum


class State(StrEnum):
    """Where an assessment stands."""

    QUEUED = "queued"
    RUNNING = "running"
    ASSESSED = "assessed"  #: has a verdict
    FAILED = "failed"  #: the aircraft model cannot be used; trying again would not help
    DEAD = "dead"  #: every attempt ended in an error or a killed worker


PENDING = (State.QUEUED, State.RUNNING)
RETRIABLE = (State.FAILED, State.DEAD)
