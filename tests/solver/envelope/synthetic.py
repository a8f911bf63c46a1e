"""Envelopes whose utilisation is known in closed form, for tests of what is made of it."""

import numpy as np

from solver import __version__
from solver.aircraft.mass_states import LoadedGroup, MassMoments, MassStates
from solver.envelope.domain import COORDINATES, SINK_RATE, domain_of
from solver.envelope.envelope import Basis, Envelope, SurfaceError
from solver.envelope.surface import Surface
from tests.solver.aircraft.mini import EMPTY_MASS, EMPTY_STATION
from tests.solver.verdict.rule_cases import mini_definition

HARDEST = 5.0  #: of the box [m/s]


def linear_envelope(
    limit: float = 4.0,
    above: float = 0.0,
    below: float = 0.0,
    stop: float = 0.5,
    content_hash: str = "0" * 64,
) -> Envelope:
    """Envelope of the mini aircraft that uses ``sink rate / limit`` of a limit, whatever else.

    All stop ratios are ``stop``.  Tanks and bays lie in the plane of symmetry at the empty
    aircraft's centre of gravity, so that every loading has it too.
    """
    definition = mini_definition()
    domain = domain_of(definition, HARDEST)
    places = np.random.default_rng(1).uniform(-1.0, 1.0, (400, len(COORDINATES)))
    # The sink rate alone matters: it is stretched, so that the spline sees a line of points.
    stretch = np.full(len(COORDINATES), 1e-6)
    stretch[SINK_RATE] = 1.0
    sink_rate = domain.low[SINK_RATE] + 0.5 * (places[:, SINK_RATE] + 1.0) * (
        domain.high[SINK_RATE] - domain.low[SINK_RATE]
    )
    used = (sink_rate / limit)[:, None]

    def moments(mass: float) -> MassMoments:
        return MassMoments(mass, mass * np.array([EMPTY_STATION, 0.0, 1.5]), np.eye(3))

    return Envelope(
        basis=Basis(content_hash, __version__, landings=len(places), failed=0),
        domain=domain,
        surface=Surface(stretch, places, used, np.full_like(used, stop)),
        error=SurfaceError(above, below, 0.0, 0.0, landings=100),
        held_out=np.column_stack([used[:50, 0], used[:50, 0]]),
        mass_states=MassStates(
            definition,
            moments(EMPTY_MASS),
            tuple(LoadedGroup(group, moments(group.capacity)) for group in definition.groups),
        ),
    )
