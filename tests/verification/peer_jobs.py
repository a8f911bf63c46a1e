"""Jobs for another process; the module imports little, as each process imports it anew."""

import os
from collections.abc import Callable


def doubled(number: int, report: Callable[[float], None]) -> int:
    print("what a peer prints goes nowhere", flush=True)
    report(0.5)
    return 2 * number


def refused(report: Callable[[float], None]) -> None:
    report(0.0)
    raise ValueError("no such thing")


def crashed(report: Callable[[float], None]) -> None:
    report(0.0)
    os.abort()
