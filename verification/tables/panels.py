"""Whether the linear state of stress is stable around an element.

A linear analysis knows nothing of buckling.  Where the stresses it finds exceed what the panel
around an element can carry, the nonlinear analysis bends aside and the two part.
"""

import numpy as np
from scipy.sparse import csc_array

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.nonlinear.buckling import buckling_modes, geometric_stiffness
from solver.nonlinear.structure import loaded_model, nonlinear_structure

#: Everything farther from the element is held [m].
REACH = 0.6
#: Freedoms below which a neighbourhood is no panel.
_FEWEST = 12


class PanelStability:
    """Critical factors of the neighbourhoods of elements under one state of linear stress.

    All nodes beyond `REACH` of an element's centroid are held, which can only raise the factor: if
    it is below one, the unheld airframe is unstable there as well.

    Parameters
    ----------
    factors : (g,) array
        Fill of tanks and bays.
    displacement : (n_free,) array
        Of the linear analysis [m, rad].
    """

    def __init__(self, airframe: Airframe, factors: Array, displacement: Array) -> None:
        structure = nonlinear_structure(loaded_model(airframe, factors))
        self._airframe = airframe
        self._stiffness: csc_array = airframe.structure.stiffness
        self._geometric = geometric_stiffness(structure, displacement)
        self._places = structure.model.coordinates[structure.free_nodes]

    def factor(self, element: int) -> float:
        """Lowest factor of the stresses at which the neighbourhood of an element buckles."""
        away = np.linalg.norm(self._places - self._airframe.centroids[element], axis=1)
        moving = np.flatnonzero(np.repeat(away < REACH, 6))
        if len(moving) < _FEWEST:
            return np.inf
        modes = buckling_modes(self._stiffness, self._geometric, moving, count=1)
        return float(modes.factors[0])
