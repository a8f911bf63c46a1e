"""The landings of a fleet in service, and how they are drawn so that rare ones are seen.

Service is a mixture of kinds.  Each kind is flown more or less often than it occurs and with sink
rates drawn nearer to the limit than they occur; the weight of a landing is its density in service
over its density as flown (importance sampling; Kahn and Marshall, "Methods of reducing sample size
in Monte Carlo computations", Operations Research 1, 1953), so that weighted sums are those of
service.

Sink rates of ordinary landings have mean and standard deviation of 1,218 landings of an airliner
fleet, 126 and 68 ft/min.  The shares of the other kinds and their sink rates are assumed, after
these facts: 0.4 % of those landings reached 1.6 g and 0.08 % 1.75 g; operators flag 0.1 to 0.4 %;
of 17 published hard landings 9 struck the nose gear and 8 bounced.
"""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from solver.landing.contact import Contact, Lift

FEET_PER_MINUTE = 0.3048 / 60.0
_DEGREE = np.deg2rad(1.0)


@dataclass(frozen=True, slots=True)
class SinkRates:
    """Gamma distribution above a least sink rate, cut off at the most that is simulated [m/s]."""

    least: float
    mean_above: float
    sd: float
    most: float = 5.0

    def density(self, sink_rate: float) -> float:
        """Probability density at a sink rate [s/m]."""
        if not self.least <= sink_rate <= self.most:
            return 0.0
        inside = self._gamma.cdf(self.most - self.least)
        return float(self._gamma.pdf(sink_rate - self.least) / inside)

    def draw(self, rng: np.random.Generator) -> float:
        """One sink rate [m/s]."""
        inside = self._gamma.cdf(self.most - self.least)
        return float(self.least + self._gamma.ppf(rng.uniform() * inside))

    @property
    def _gamma(self) -> stats.rv_continuous:
        shape = (self.mean_above / self.sd) ** 2
        return stats.gamma(shape, scale=self.sd**2 / self.mean_above)


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of landing."""

    name: str
    share: float  #: of all landings in service
    flown: float  #: of all landings flown here
    service: SinkRates
    enriched: SinkRates  #: half of the landings flown come from here, half from `service`
    pitch: tuple[float, float] = (5.0, 1.2)  #: mean and standard deviation [deg]
    lift: tuple[float, float] = (0.97, 0.03)  #: over the weight at the contact, cut off at 1
    spoilers: float = 0.5  #: when lift begins to decay [s]

    def draw_sink_rate(self, rng: np.random.Generator) -> tuple[float, float]:
        """Sink rate as flown [m/s], and its weight: density in service over density as flown."""
        sink_rate = (self.service, self.enriched)[int(rng.uniform() < 0.5)].draw(rng)
        served = self.service.density(sink_rate)
        as_flown = 0.5 * served + 0.5 * self.enriched.density(sink_rate)
        return sink_rate, self.share / self.flown * served / as_flown


#: Near the limit of an aircraft that is designed to 10 ft/s.
_NEAR_LIMIT = SinkRates(least=0.0, mean_above=3.0, sd=0.5)

KINDS = (
    Kind(
        "ordinary",
        share=0.980,
        flown=0.30,
        service=SinkRates(0.0, 126.0 * FEET_PER_MINUTE, 68.0 * FEET_PER_MINUTE),
        enriched=SinkRates(0.0, 1.4, 0.5),
    ),
    Kind("firm", 0.012, 0.40, SinkRates(1.2, 0.6, 0.6), _NEAR_LIMIT),
    Kind("nose first", 0.003, 0.15, SinkRates(0.4, 1.0, 0.7), _NEAR_LIMIT, pitch=(-1.5, 0.7)),
    Kind(
        "bounced", 0.005, 0.15, SinkRates(0.9, 0.8, 0.6), _NEAR_LIMIT,
        lift=(1.0, 0.01), spoilers=1.0,
    ),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class DrawnLanding:
    """A landing that will be flown; SI units."""

    number: int
    kind: str
    weight: float  #: landings of service that it stands for, of one
    contact: Contact
    fuel_fill: float  #: of every tank
    payload_fill: tuple[float, float, float]  #: of the bays in order, repeated if there are more
    seed: int  #: of approach, sensors, recorder and the aircraft's own scatter


def draw_landing(number: int, seed: int) -> DrawnLanding:
    """Draw one landing of a fleet; the same number and seed give the same landing."""
    rng = np.random.default_rng([seed, number])
    edges = np.cumsum([kind.flown for kind in KINDS])
    # Spread evenly (golden section): a short fleet has its share of every kind.
    place = (number * 0.6180339887498949 + 0.5) % 1.0
    kind = KINDS[min(int(np.searchsorted(edges, place)), len(KINDS) - 1)]
    sink_rate, weight = kind.draw_sink_rate(rng)
    normal = rng.normal
    pitch = normal(*kind.pitch)
    if kind.pitch[0] < 0.0:
        pitch = min(pitch, -0.3)
    contact = Contact(
        sink_rate=max(sink_rate, 0.05),
        ground_speed=float(normal(60.0, 4.0)),
        pitch=float(pitch * _DEGREE),
        roll=float(normal(0.0, 1.5) * _DEGREE),
        drift=float(normal(0.0, 2.0) * _DEGREE),
        pitch_rate=float(normal(0.0, 1.0) * _DEGREE),
        roll_rate=float(normal(0.0, 1.5) * _DEGREE),
        yaw_rate=float(normal(0.0, 0.8) * _DEGREE),
        # With more lift than weight the simulated aircraft, which has no pilot, balloons and falls.
        lift=Lift(fraction=min(float(normal(*kind.lift)), 1.0), decay_start=kind.spoilers),
    )
    return DrawnLanding(
        number=number,
        kind=kind.name,
        weight=weight,
        contact=contact,
        fuel_fill=float(rng.uniform(0.15, 0.6)),
        payload_fill=(float(rng.uniform()), float(rng.uniform()), float(rng.uniform())),
        seed=int(rng.integers(2**62)),
    )
