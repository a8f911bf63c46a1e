"""Order, duplicates, gaps, implausible samples, overflow and interleaving of one channel."""

import numpy as np

from solver.arrays import Array
from solver.flight_data.parameter import HEADINGS, KINDS, SWITCHES, Parameter
from solver.flight_data.window import Channel, Note
from solver.units import FOOT

#: A gap is a step of more than so many sampling intervals.
GAP = 3.0

#: Words of a radio altimeter are 12 or 13 bits of a foot: it starts again at the other end.
_OVERFLOWS = (4096 * FOOT, 8192 * FOOT)  #: [m]


def clean(
    parameter: Parameter, source: str, time: Array, value: Array
) -> tuple[list[Channel], list[Note]]:
    """Channels of one column in order, plausible and unwrapped, and what was done.

    Parameters
    ----------
    parameter : Parameter
    source : str
    time : (n,) array
        As filed [s].
    value : (n,) array
        SI, load factors in g.

    Returns
    -------
    list of Channel
        None, one, or two where two sources turn out to be interleaved.
    list of Note
    """
    notes: list[Note] = []
    label = f"{parameter} {source}".strip()
    time, value = _ordered(time, value, label, notes)
    if parameter in HEADINGS:
        value = np.unwrap(value)
    elif parameter is Parameter.RADIO_ALTITUDE:
        value = _without_overflow(value, label, notes)
    if parameter not in HEADINGS:
        time, value = _plausible(parameter, time, value, label, notes)
    if len(time) == 0:
        notes.append(Note("empty", f"{label}: no usable sample"))
        return [], notes
    _note_gaps(time, label, notes)
    channel = Channel(parameter, source, time, value)
    if parameter is Parameter.RADIO_ALTITUDE and _is_interleaved(time, value):
        notes.append(Note("interleaved", f"{label}: two sources take turns; taken apart"))
        return [
            Channel(parameter, f"{source or 'RA'}.{part + 1}", time[part::2], value[part::2])
            for part in (0, 1)
        ], notes
    return [channel], notes


def _ordered(time: Array, value: Array, label: str, notes: list[Note]) -> tuple[Array, Array]:
    if np.any(np.diff(time) < 0):
        order = np.argsort(time, kind="stable")
        time, value = time[order], value[order]
        notes.append(Note("unordered", f"{label}: samples were not in order of time; sorted"))
    same = np.flatnonzero(np.diff(time) == 0) + 1
    if len(same):
        differ = int(np.sum(value[same] != value[same - 1]))
        text = f"{label}: {len(same)} samples at a time already given"
        text += f", {differ} with another value" if differ else ""
        notes.append(Note("duplicates", f"{text}; the first of each is kept"))
        time, value = np.delete(time, same), np.delete(value, same)
    return time, value


def _without_overflow(value: Array, label: str, notes: list[Note]) -> Array:
    """Undo the start-again of an altimeter word; no aircraft moves 1,000 ft between samples."""
    steps = np.diff(value)
    jumps = np.abs(steps) > 1000 * FOOT
    if not np.any(jumps):
        return value
    for span in _OVERFLOWS:
        turns = np.round(steps / span)
        if np.all(np.abs(steps - turns * span)[jumps] < 300 * FOOT):
            whole = np.concatenate([[0.0], np.cumsum(turns)])
            # Near the ground it reads true, so the lowest stretch keeps its values.
            unwrapped = value - (whole - whole[np.argmin(np.abs(value))]) * span
            notes.append(
                Note("overflow", f"{label}: passed the end of its word {int(jumps.sum())} times")
            )
            return np.asarray(unwrapped)
    return value


def _plausible(
    parameter: Parameter, time: Array, value: Array, label: str, notes: list[Note]
) -> tuple[Array, Array]:
    kind = KINDS[parameter]
    good = (value >= kind.least) & (value <= kind.greatest)
    if parameter in SWITCHES:
        good = (value == 0) | (value == 1)
    bad = int(np.sum(~good))
    if bad:
        notes.append(
            Note(
                "implausible",
                f"{label}: {bad} of {len(value)} samples outside {kind.least:g} to "
                f"{kind.greatest:g} left out",
            )
        )
    if bad > len(value) / 2:
        notes.append(Note("refused", f"{label}: mostly implausible, not used"))
        return time[:0], value[:0]
    return time[good], value[good]


def _note_gaps(time: Array, label: str, notes: list[Note]) -> None:
    if len(time) < 3:
        return
    steps = np.diff(time)
    wide = steps > GAP * np.median(steps)
    if np.any(wide):
        longest = int(np.argmax(steps))
        notes.append(
            Note(
                "gap",
                f"{label}: {int(wide.sum())} gaps, the longest {steps[longest]:.2f} s from "
                f"{time[longest]:.2f} s",
            )
        )


def _is_interleaved(time: Array, value: Array) -> bool:
    """Whether odd and even samples differ by a constant that their own scatter does not explain.

    The second difference of a smooth course is small and of slow sign; two biased sources in turn
    give one that alternates with four times half their difference.
    """
    low = value < 60.0
    if np.sum(low) < 12 or np.std(np.diff(time[low])) > 0.1 * np.median(np.diff(time[low])):
        return False
    bend = np.diff(value[low], 2)
    turned = bend * (-1.0) ** np.arange(len(bend))
    offset = float(np.mean(turned)) / 2
    spread = float(np.std(turned)) / 2 / np.sqrt(len(turned))
    return bool(abs(offset) > max(4 * spread, 0.5))
