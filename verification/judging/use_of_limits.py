"""Largest use of a limit, airframe or gear, in landings of an aircraft whose gears may be any."""

from collections.abc import Sequence

from solver.arrays import Array
from solver.assess import AssessmentModel
from solver.inertia_relief.loading import ReducedLoading, assemble
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.sequence import simulate_contacts
from solver.verdict.gear_loads import gear_loads

#: Loadings whose modes are kept.
_KEPT = 4


class UseOfLimits:
    """What an assessment finds, without the verdict; the modes of recent loadings are kept."""

    def __init__(self, model: AssessmentModel) -> None:
        self.model = model
        self._reduced: dict[bytes, ReducedLoading] = {}

    def __call__(
        self,
        aircraft: LandingAircraft,
        fills: Array,
        contacts: Sequence[Contact],
        least: float = 0.0,
    ) -> float:
        """Largest use of a limit in any of the contacts; above 1 the landing was hard.

        Parameters
        ----------
        aircraft : LandingAircraft
        fills : (n_groups,) array
            Of tanks and bays, the same loading.
        contacts : sequence of Contact
        least : float
            Where elements stay below this they are not looked at closer, and it is the answer.
        """
        airframe = self.model.airframe
        reduced, used = self._at(fills), [least]
        for history in simulate_contacts(aircraft, contacts):
            response = landing_response(reduced, landing_loads(airframe, history))
            peaks = find_peaks(self.model.reduced, response, least * airframe.allowables)
            used.append(float((peaks.stress / airframe.allowables).max()))
            used += [load.utilisation for load in gear_loads(airframe.definition.gears, history, 0)]
        return max(used)

    def _at(self, fills: Array) -> ReducedLoading:
        key = fills.tobytes()
        if key not in self._reduced:
            if len(self._reduced) == _KEPT:
                self._reduced.pop(next(iter(self._reduced)))
            self._reduced[key] = assemble(self.model.reduced, fills)
        return self._reduced[key]
