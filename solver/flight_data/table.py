"""Raw columns of a file, before anything is known about what they mean."""

from dataclasses import dataclass, field

import numpy as np

from solver.arrays import Array


@dataclass(frozen=True, slots=True)
class Limits:
    """What a window file may be at most; each bounds the memory that reading takes."""

    size: int = 16 * 2**20  #: of the file [bytes]
    rows: int = 200_000
    columns: int = 300
    cell: int = 200  #: characters


@dataclass(slots=True)
class Column:
    """Samples of one name at the times where it has any."""

    name: str
    unit: str  #: as the file states it, "" where it does not
    time: list[float] = field(default_factory=list)
    value: list[float] = field(default_factory=list)
    missing: int = 0  #: cells that were marked as empty, NaN or invalid
    words: str = ""  #: where the first cell that is no number stands, in a column of words

    def arrays(self) -> tuple[Array, Array]:
        """Return times and values."""
        return np.array(self.time, dtype=np.float64), np.array(self.value, dtype=np.float64)


#: What stands for no value.
MISSING = frozenset({"", "nan", "na", "n/a", "null", "none", "-", "--", "---", "*"})

#: States of a switch.
STATES = {
    "true": 1.0,
    "false": 0.0,
    "ground": 1.0,
    "gnd": 1.0,
    "on": 1.0,
    "air": 0.0,
    "off": 0.0,
}

TIME_NAMES = frozenset(
    {"ts", "t", "time", "times", "timesec", "seconds", "elapsed", "elapsedtime", "lcltime", "utc"}
)
PARAMETER_NAMES = frozenset({"param", "parameter", "name", "mnemonic"})
