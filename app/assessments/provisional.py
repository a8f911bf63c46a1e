"""The provisional verdict of a landing: made when it comes in, held against the full one later."""

import math
from typing import Any

from solver.assessment import TouchdownRecord, Verdict
from solver.envelope.envelope import COVERED_SHARE, Envelope
from solver.envelope.provisional import CoveredContact, provisional_verdict
from solver.verdict.judge import SEVERITY


def provisional(envelope: Envelope | None, record: TouchdownRecord) -> dict[str, Any]:
    """Provisional verdict as it is stored and answered; see `answers.ProvisionalOut`."""
    if envelope is None:
        return {
            "verdict": None,
            "reasons": [
                f"no envelope of {record.aircraft} is there yet; "
                f"`hardlanding envelope {record.aircraft}` makes it"
            ],
        }
    found = provisional_verdict(envelope, record)
    basis, error = found.basis, envelope.error
    return {
        "verdict": found.verdict,
        "reasons": list(found.reasons),
        **({} if found.driving is None else _driving(found.driving)),
        "rests_on": (
            f"envelope of {basis.landings} simulated landings; of {error.landings} others, "
            f"{COVERED_SHARE:.1%} used at most {error.above:.0%} more of a limit than it says"
        ),
        "model_hash": basis.content_hash,
        "program_version": basis.program_version,
    }


def _driving(contact: CoveredContact) -> dict[str, Any]:
    expected, limit = contact.expected, contact.limit_sink_rate
    return {
        "contact": contact.contact,
        "sink_rate_m_s": contact.sink_rate,
        "utilisation": {
            "value": expected.utilisation,
            "low": expected.low,
            "high": expected.high,
        },
        "limit_sink_rate_m_s": {
            name: value if math.isfinite(value) else None
            for name, value in (("value", limit.value), ("low", limit.low), ("high", limit.high))
        },
    }


def differs(stored: dict[str, Any] | None, verdict: Verdict) -> bool | None:
    """Whether a full verdict is another than the provisional one; None if there was none."""
    if stored is None or stored["verdict"] is None:
        return None
    return Verdict(stored["verdict"]) is not verdict


def difference(stored: dict[str, Any] | None, verdict: Verdict, used: float | None) -> str | None:
    """Say in one sentence how the full verdict differs; None if it does not."""
    if stored is None or not differs(stored, verdict):
        return None
    before = Verdict(stored["verdict"])
    expected = stored["utilisation"]
    found = "" if used is None else f", and its airframe used {used:.0%}"
    how = "stricter" if SEVERITY[verdict] > SEVERITY[before] else "milder"
    return (
        f"The full verdict {verdict} is {how} than the provisional {before}: the envelope expected "
        f"{expected['value']:.0%} of a limit ({expected['low']:.0%} to {expected['high']:.0%})"
        f"{found}."
    )
