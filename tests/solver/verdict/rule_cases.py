"""Landings to hold against makers' rules."""

import dataclasses
import math
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.definition_reader import load_definition
from solver.assessment import RuleFinding, RuleStatus, RuleVerdict, TouchdownRecord
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.recorded import RecordedContact, RecordedPeak
from solver.verdict.makers_rule import MakersRule
from solver.verdict.makers_rule_reader import packaged_rule
from solver.verdict.rule_findings import apply_rule
from tests.solver.aircraft.mini import DEFINITION

PASSED, EXCEEDED, CANNOT_TELL = RuleStatus
POUND = 0.45359237
#: Maximum landing mass of the tests' aircraft [kg]; each rule is relative to it.
LANDING_MASS = 60_000.0


@cache
def mini_definition() -> AircraftDefinition:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "definition.toml").write_bytes(DEFINITION.read_bytes())
        return load_definition(Path(folder))


def contact(
    nz: float | None = None,
    hz: float = 16.0,
    *,
    ny: float | None = None,
    roll: float | None = 0.0,
    **fields: Any,
) -> RecordedContact:
    """A contact with a main gear first; roll in degrees."""
    return RecordedContact(
        normal_load_factor=None if nz is None else RecordedPeak(nz, hz),
        lateral_load_factor=None if ny is None else RecordedPeak(ny, hz),
        roll=None if roll is None else math.radians(roll),
        **({"nose_first": False} | fields),
    )


def held(
    rule: MakersRule | str,
    *contacts: RecordedContact,
    mass: float | None = LANDING_MASS,
    maximum_landing: float = LANDING_MASS,
    simulated: tuple[Contact, ...] = (),
    histories: tuple[LandingHistory, ...] = (),
) -> RuleVerdict:
    """What a rule says of contacts."""
    masses = dataclasses.replace(mini_definition().masses, maximum_landing=maximum_landing)
    definition = dataclasses.replace(mini_definition(), masses=masses)
    record = TouchdownRecord("any", simulated, mass=mass, recorded=contacts)
    rule = packaged_rule(rule) if isinstance(rule, str) else rule
    return apply_rule(rule, definition, record, histories)


def finding(verdict: RuleVerdict, criterion: str, index: int = 0) -> RuleFinding:
    """The finding of one criterion at one contact."""
    (found,) = (f for f in verdict.findings if (f.criterion, f.contact) == (criterion, index))
    return found
