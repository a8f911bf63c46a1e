"""Gears that are on the ground already when another one touches: how far they are closed.

A nose wheel that comes down while the main wheels hop stays down as they come back.  Its strut and
tyre share the depth that the touching wheels leave to it.  What the strut was doing before is not
on record: it closes, or opens, at the speed at which its fitting comes down or rises, and its wheel
goes with the airframe.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from scipy.optimize import brentq

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.landing.equations import AIRFRAME_STATES, GEAR_STATES
from solver.landing.records import Record, Records

#: Of a state: its derivative, and what airframe and gears say.
Evaluation: TypeAlias = Callable[[Array], tuple[Array, Record, Records]]

#: Strokes nearer to each other are the same [m].
_SAME = 1e-9


def stand_on_grounded(
    state: Array, down: tuple[int, ...], gears: Records, evaluation: Evaluation, most: float
) -> None:
    """Close the gears that are down and let their wheels roll, in place.

    An attitude in which they would carry too much at the height at which the others touch is
    wrong: the aircraft then stands higher, and the others touch a moment later.

    Parameters
    ----------
    state : (n,) array
        Of the landing, at the height at which the others touch; these gears hang.
    down : tuple of int
        Which they are.  One that is off the ground at this height is left as it hangs.
    gears : (n_gears,) array of GEAR_RECORD
    evaluation : callable
    most : float
        That they can carry [N].

    Raises
    ------
    SimulationDivergedError
        One of them finds no rest.
    """
    hanging, depth = state.copy(), float(state[2])

    def carried(higher: float) -> float:
        state[:] = hanging
        state[2] = depth - higher
        return sum(_close(state, index, gears[index], evaluation) for index in down)

    if carried(0.0) > most:
        # A little above the depth of the deepest, where rounding leaves nothing on the ground.
        clear = float(evaluation(hanging)[2]["deflection"][list(down)].max()) + 2.0 * _SAME
        carried(brentq(lambda higher: carried(higher) - most, 0.0, clear, xtol=_SAME))


def _close(state: Array, index: int, gear: Record, evaluation: Evaluation) -> float:
    """Close one gear and let its wheel roll; what it carries [N]."""
    at = AIRFRAME_STATES + GEAR_STATES * index
    _, airframe, answers = evaluation(state)
    below = airframe["gravity"] / np.linalg.norm(airframe["gravity"])
    hanging, deflection = float(state[at]), float(answers["deflection"][index])
    if deflection <= 0.0:
        return 0.0
    # A strut that closes lifts its axle along itself.
    upright = float(below @ answers["down"][index])
    rate = float(below @ answers["axle_velocity"][index]) / upright

    def unbalance(stroke: float) -> float:
        state[at] = stroke
        return float(evaluation(state)[0][at + 1])

    # At one end the tyre takes the whole depth, at the other the strut does.
    ends = hanging, hanging + deflection / upright
    # A strut whose oil holds it back from following a rising fitting has left the ground.
    for state[at + 1] in (rate, 0.0):
        if unbalance(ends[0]) > 0.0 > unbalance(ends[1]):
            state[at] = brentq(unbalance, *ends, xtol=_SAME)
            answer = evaluation(state)[2][index]
            # The effective radius in pure rolling, see `solver.landing.leg`.
            radius = gear["free_radius"] - gear["rolling_share"] * answer["deflection"]
            state[at + 4] = np.hypot(state[7], state[8]) / radius
            return float(answer["normal"])
    raise SimulationDivergedError(
        f"a gear that is {deflection:.3g} m deep in the ground finds no rest there"
    )
