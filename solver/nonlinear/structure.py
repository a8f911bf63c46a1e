"""A free structure ready for nonlinear analysis: elements, constraints, inertia."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array, IntArray
from solver.fe.model import FiniteElementModel, PointMasses
from solver.nonlinear.configuration import Configuration
from solver.nonlinear.constraints import FiniteConstraints, finite_constraints
from solver.nonlinear.elements import CorotationalElements, corotational_elements
from solver.nonlinear.inertia import MassPoints, RotaryBodies, finite_inertia

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe


@dataclass(frozen=True, slots=True)
class NonlinearStructure:
    """An unsupported structure at finite rotation, made of the elements of the linear one."""

    model: FiniteElementModel
    elements: CorotationalElements
    constraints: FiniteConstraints
    points: MassPoints
    rotary: RotaryBodies
    free_nodes: IntArray  #: (nf,) ascending; their freedoms are the linear model's free ones

    def on_free_nodes(self, at: Configuration, loads: Array) -> Array:
        """Carry loads (n, 6) to the free nodes, in place, and give theirs (nf, 6)."""
        self.constraints.carry_back(at, loads)
        free: Array = loads[self.free_nodes]
        return free


def nonlinear_structure(model: FiniteElementModel) -> NonlinearStructure:
    """Prepare a model that `solver.fe.structure.build_structure` accepts."""
    constraints = finite_constraints(model)
    points, rotary = finite_inertia(model)
    return NonlinearStructure(
        model=model,
        elements=corotational_elements(model),
        constraints=constraints,
        points=points,
        rotary=rotary,
        free_nodes=np.setdiff1d(np.arange(model.node_count), constraints.nodes),
    )


def loaded_model(airframe: "Airframe", factors: Array) -> FiniteElementModel:
    """Model of an airframe with the lumped masses of its tanks and bays, filled by ``factors``."""
    model = airframe.structure.model
    parts = [(1.0, model.point_masses)]
    parts += [
        (float(factor), group.point_masses)
        for factor, group in zip(factors, airframe.groups, strict=True)
        if factor != 0.0
    ]
    return replace(
        model,
        point_masses=PointMasses(
            identifiers=np.concatenate([masses.identifiers for _, masses in parts]),
            nodes=np.concatenate([masses.nodes for _, masses in parts]),
            masses=np.concatenate([factor * masses.masses for factor, masses in parts]),
            offsets=np.concatenate([masses.offsets for _, masses in parts]),
            inertias=np.concatenate([factor * masses.inertias for factor, masses in parts]),
        ),
    )
