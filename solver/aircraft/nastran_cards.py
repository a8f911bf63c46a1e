"""From bulk-data text to cards: fixed, large and free fields, continuations, field values.

A card is its name and its data fields in order, whatever the format: field 1 of the Quick
Reference Guide is the name, ``fields[0]`` its field 2; the names and continuation marks of the
following lines are gone.  Everything that cannot be read for certain is refused with file and line.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from solver.errors import ModelError

_NAME = re.compile(r"[A-Z][A-Z0-9]*\*?$")
_REAL = re.compile(r"([+-]?(?:\d+\.\d*|\.\d+))(?:[ED]([+-]?\d+)|([+-]\d+))?$")
_ZERO = re.compile(r"[+-]?(?:0+\.?0*|\.0+)(?:[ED][+-]?\d+|[+-]\d+)?$")
_INTEGER = re.compile(r"[+-]?\d+$")
_BEGIN = re.compile(r"\s*BEGIN\b(.*)$", re.IGNORECASE)
_BULK = re.compile(r"\s+BULK\s*$", re.IGNORECASE)
_INCLUDE = re.compile(r"\s*INCLUDE\b", re.IGNORECASE)


@dataclass(slots=True)
class Card:
    """One card of a bulk-data file."""

    source: str  #: file name, for messages
    line: int  #: of the card's first line, from 1
    name: str  #: upper case, without the asterisk of the large-field format
    fields: list[str]  #: stripped, upper case; missing ones are not there

    def error(self, message: str) -> ModelError:
        """Error that names file, line and card."""
        identity = f" {self.fields[0]}" if self.fields and self.fields[0] else ""
        return ModelError(f"{self.source} line {self.line}: {self.name}{identity}: {message}")

    def text(self, index: int) -> str:
        """Field ``index`` (0 follows the name), empty if missing."""
        return self.fields[index] if index < len(self.fields) else ""

    def real(self, index: int, name: str, default: float | None = None) -> float:
        """Real number; the decimal point is required, as Nastran requires it."""
        text = self.text(index)
        if not text:
            if default is None:
                raise self.error(f"field {name} is blank, a real number is needed")
            return default
        match = _REAL.match(text)
        if match is None:
            hint = " (write a decimal point)" if _INTEGER.match(text) else ""
            raise self.error(f"field {name}: {text!r} is not a real number{hint}")
        mantissa, exponent, bare = match.groups()
        value = float(f"{mantissa}E{exponent or bare}" if exponent or bare else mantissa)
        if value in (float("inf"), float("-inf")):
            raise self.error(f"field {name}: {text!r} is too large")
        return value

    def integer(self, index: int, name: str, default: int | None = None, minimum: int = 1) -> int:
        """Whole number not below ``minimum``."""
        text = self.text(index)
        if not text:
            if default is None:
                raise self.error(f"field {name} is blank, a whole number is needed")
            return default
        if _INTEGER.match(text) is None:
            raise self.error(f"field {name}: {text!r} is not a whole number")
        value = int(text)
        if not minimum <= value <= 99_999_999:
            raise self.error(f"field {name}: {value} is outside {minimum} to 99999999")
        return value

    def vector(self, index: int, names: tuple[str, str, str]) -> tuple[float, float, float]:
        """Three reals from ``index`` on, blanks are zero."""
        return (
            self.real(index, names[0], 0.0),
            self.real(index + 1, names[1], 0.0),
            self.real(index + 2, names[2], 0.0),
        )

    def refuse_beyond(self, count: int) -> None:
        """Refuse anything that stands after the first ``count`` fields."""
        if len(self.fields) > count:
            for text in self.fields[count:]:
                if text:
                    raise self.error(f"unexpected {text!r} after field {count + 1}")

    def refuse(self, index: int, name: str, why: str) -> None:
        """Refuse a field that is neither blank nor zero."""
        text = self.text(index)
        if text and not _ZERO.match(text):
            raise self.error(f"field {name} = {text}: {why}")


def read_cards(text: str, source: str) -> Iterator[Card]:
    """Cards of the bulk-data section, in the order of the file.

    Without a ``BEGIN BULK`` line the whole text is bulk data (a punch file).  Executive and case
    control are skipped, ``ENDDATA`` ends reading.

    Raises
    ------
    ModelError
        ``INCLUDE``, a superelement section, a continuation that does not follow its card, a line
        that starts no card, too many free fields; names file and line.
    """
    lines = text.splitlines()
    card: Card | None = None
    tag = ""
    half_open = False
    start = _bulk_start(lines, source)
    for number, raw in enumerate(lines[start:], start + 1):
        line = raw.split("$", 1)[0].rstrip().upper()
        if not line.strip():
            continue
        if "\t" in line:
            line = line.expandtabs(8)
        if line.startswith("ENDDATA"):
            break
        if _BEGIN.match(line):
            raise ModelError(f"{source} line {number}: a second BEGIN is not supported")
        if _INCLUDE.match(line):
            raise ModelError(f"{source} line {number}: INCLUDE is not supported; join the files")
        head, fields, next_tag = _split(line, source, number)
        large = "*" in head
        if head and head[0] not in "+*":
            if card is not None:
                _refuse_open(card, tag, number)
                yield card
            if _NAME.match(head) is None:
                raise ModelError(f"{source} line {number}: {head!r} starts no card")
            card = Card(source, number, head.rstrip("*"), fields)
            half_open = large
        else:
            if card is None:
                raise ModelError(f"{source} line {number}: continuation without a card")
            mark = head[1:] if head else ""
            if mark != tag:
                raise card.error(f"line {number} does not continue it: {tag!r} is expected")
            if half_open and not large:
                card.fields.extend([""] * 4)
                half_open = False
            card.fields.extend(fields)
            half_open = large and not half_open
        tag = next_tag
    if card is not None:
        _refuse_open(card, tag, len(lines))
        yield card


def _bulk_start(lines: list[str], source: str) -> int:
    """Index of the first line of bulk data."""
    for index, line in enumerate(lines):
        match = _BEGIN.match(line.split("$", 1)[0])
        if match:
            if _BULK.match(match.group(1)) is None:
                raise ModelError(f"{source} line {index + 1}: only BEGIN BULK is supported")
            for earlier, head in enumerate(lines[:index], 1):
                if _INCLUDE.match(head):
                    raise ModelError(
                        f"{source} line {earlier}: INCLUDE is not supported; join the files"
                    )
            return index + 1
    return 0


def _split(line: str, source: str, number: int) -> tuple[str, list[str], str]:
    """Head, data fields (4 of a large-field line, 8 of others) and continuation mark of a line."""
    if "," in line:
        items = [item.strip() for item in line.split(",")]
        head, data = items[0], items[1:]
        count = 4 if "*" in head else 8
        if len(data) > count + 1:
            raise ModelError(
                f"{source} line {number}: {len(data)} free fields after {head!r}, at most "
                f"{count} and a continuation mark are allowed"
            )
        fields, mark = data[:count], data[count] if len(data) > count else ""
        if mark and mark[0] not in "+*":
            raise ModelError(
                f"{source} line {number}: {mark!r} in field 10 is no continuation mark"
            )
        fields.extend([""] * (count - len(fields)))
    else:
        head = line[:8].strip()
        if "*" in head:
            fields = [line[k : k + 16].strip() for k in (8, 24, 40, 56)]
        else:
            fields = [line[k : k + 8].strip() for k in (8, 16, 24, 32, 40, 48, 56, 64)]
        mark = line[72:80].strip()
    return head, fields, mark.lstrip("+*")


def _refuse_open(card: Card, tag: str, number: int) -> None:
    if tag:
        raise card.error(f"its continuation {tag!r} does not follow before line {number}")
