"""The example aircraft EBJ-19, a generic business jet generated from its dimensions."""

from solver.aircraft.bizjet.build import build_bizjet

__all__ = ["build_bizjet"]
