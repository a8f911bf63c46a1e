"""What a recorder frame records: rate, resolution, range and error of each parameter.

Every figure keeps how certain it is.  Rates and resolutions stand in frame listings; noise, delay
and the filter before the sampler mostly do not, and are then assumptions that say so.
"""

from dataclasses import dataclass, fields
from enum import StrEnum

from solver.errors import ModelError
from solver.flight_data.parameter import Parameter


class Certainty(StrEnum):
    """Where a figure comes from, best first."""

    DOCUMENT = "document"  #: stands in the frame's own listing
    REGULATION = "regulation"  #: required of every recorder
    COMPUTED = "computed"  #: follows from figures that stand in the listing
    ASSUMED = "assumed"  #: nobody says; a figure of the usual size


@dataclass(frozen=True, slots=True)
class Figure:
    """A number of a frame, SI (load factors in g)."""

    value: float
    certainty: Certainty


@dataclass(frozen=True, slots=True)
class RecordedParameter:
    """How one parameter of one source is recorded."""

    parameter: Parameter
    source: str
    mnemonic: str
    rate: Figure  #: [Hz]
    resolution: Figure  #: step of the recorded value
    least: Figure
    greatest: Figure
    noise: Figure  #: standard deviation of one sample
    bias: Figure  #: standard deviation of what stays the same through a landing
    scale: Figure  #: standard deviation of the relative error of scale
    delay: Figure  #: of the recorded value behind the time it is filed under [s]
    delay_scatter: Figure  #: standard deviation of that delay from aircraft to aircraft [s]
    corner: Figure  #: of the low-pass filter before the sampler, 0 without one [Hz]
    late_most: Figure  #: a switch closes up to so long after its gear is compressed [s]
    wraps: bool  #: beyond its range it starts again at the other end

    def certainties(self) -> dict[str, Certainty]:
        """Certainty of each figure by name."""
        return {
            field.name: value.certainty
            for field in fields(self)
            if isinstance(value := getattr(self, field.name), Figure)
        }


@dataclass(frozen=True, slots=True)
class RecorderFrame:
    """A named frame and its parameters."""

    name: str
    title: str
    sources: dict[str, str]  #: what stands behind each certainty
    parameters: tuple[RecordedParameter, ...]

    def find(self, parameter: Parameter, source: str = "") -> RecordedParameter | None:
        """Entry for a parameter, of that source if there is one, else of any source."""
        entries = [entry for entry in self.parameters if entry.parameter is parameter]
        named = [entry for entry in entries if entry.source == source]
        return next(iter(named or entries), None)

    def require(self, parameter: Parameter, source: str = "") -> RecordedParameter:
        """As `find`; raises `ModelError` where the frame does not hold the parameter."""
        entry = self.find(parameter, source)
        if entry is None:
            raise ModelError(f"frame {self.name} does not record {parameter}")
        return entry
