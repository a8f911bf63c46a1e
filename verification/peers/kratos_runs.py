"""What Kratos is asked for: matrices, free modes, a free transient; each a job of `apart`.

Everything is Kratos's own: elements, assembly, constraints, eigensolver and time integration.  For
models too large for its direct solver `matrices` hands the assembled ones out.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array

from solver.arrays import Array, IntArray
from solver.fe.model import FiniteElementModel
from verification.peers.apart import Report
from verification.peers.kratos_model import (
    DISPLACEMENTS,
    DISTRIBUTIONS,
    ROTATIONS,
    KratosModel,
    kratos,
    write_model,
)
from verification.peers.portable import PortableModel, portable_model

#: Eigenvalue about which the lowest modes are looked for; below zero, as rigid modes have zero.
SHIFT = -100.0


def stiffness_of_quadrilaterals(
    model: FiniteElementModel, quad: str, repeats: int, report: Report
) -> Array:
    """Element stiffness (24, 24) of the first quadrilateral, formed over and over.

    An element that writes beyond its memory does not outlive this.
    """
    core, _, _ = kratos()
    written = write_model(portable_model(model), quad)
    element = written.part.GetElement(1)
    element.Initialize(written.part.ProcessInfo)
    stiffness = core.Matrix()
    for step in range(repeats):
        stiffness = core.Matrix()
        element.CalculateLeftHandSide(stiffness, written.part.ProcessInfo)
        report(step / repeats)
    return np.array(stiffness)


def free_modes(
    model: FiniteElementModel, count: int, quad: str, report: Report
) -> dict[str, Array]:
    """Lowest modes of the unsupported model by Kratos's own eigensolver (Spectra, shifted).

    Returns
    -------
    dict
        ``eigenvalues`` (count,) and ``shapes`` (n, 6, count) of the model's nodes.
    """
    core, structural, linear = kratos()
    portable = portable_model(model)
    written = write_model(portable, quad)
    report(0.1)
    settings = core.Parameters(
        f'{{"solver_type": "spectra_sym_g_eigs_shift", "number_of_eigenvalues": {count},'
        f' "max_iteration": 1000, "shift": {SHIFT}, "echo_level": 0}}'
    )
    solver = linear.SpectraSymGEigsShiftSolver(settings)
    builder = core.ResidualBasedBlockBuilderAndSolver(solver)
    strategy = structural.EigensolverStrategy(
        written.part, structural.EigensolverDynamicScheme(), builder, 0.0, 1.0, False, False
    )
    strategy.Initialize()
    strategy.InitializeSolutionStep()
    strategy.SolveSolutionStep()
    report(0.9)
    eigenvalues = np.array(written.part.ProcessInfo[structural.EIGENVALUE_VECTOR])
    names = (*DISPLACEMENTS, *ROTATIONS)
    # Kratos keeps the freedoms of a node in the order of their variables' keys.
    order = np.argsort([getattr(core, name).Key() for name in names])
    shapes = np.zeros((portable.node_count, 6, len(eigenvalues)))
    for row, node in enumerate(written.part.Nodes):
        if portable.turning[row]:
            shapes[row, order] = np.array(node.GetValue(structural.EIGENVECTOR_MATRIX)).T
    rising = np.argsort(eigenvalues)
    everywhere = _followed(portable, shapes[:, :, rising])
    return {"eigenvalues": eigenvalues[rising], "shapes": everywhere[: model.node_count]}


@dataclass(frozen=True, slots=True)
class PeerMatrices:
    """Matrices assembled by Kratos, its links eliminated."""

    stiffness: csc_array
    mass: csc_array
    free: IntArray  #: (n_free,) rows of all node freedoms, as `solver.fe.structure.Structure`


def matrices(model: FiniteElementModel, quad: str, report: Report) -> PeerMatrices:
    """Stiffness and mass as Kratos assembles them; the links are eliminated outside of it."""
    core, structural, _ = kratos()
    portable = portable_model(model)
    written = write_model(portable, quad)
    report(0.2)
    scheme = structural.EigensolverDynamicScheme()
    builder = core.ResidualBasedBlockBuilderAndSolver(core.LinearSolver())
    strategy = core.ResidualBasedLinearStrategy(
        written.part, scheme, builder, False, False, False, False
    )
    strategy.Initialize()
    strategy.InitializeSolutionStep()
    # What Kratos numbers as (mass, stiffness).
    mass, stiffness = (
        _built(core, structural, written.part, strategy, builder, scheme, level) for level in (1, 2)
    )
    report(0.8)
    transformation, free = _transformation(written)
    return PeerMatrices(
        stiffness=csc_array(transformation.T @ stiffness @ transformation),
        mass=csc_array(transformation.T @ mass @ transformation),
        free=free,
    )


@dataclass(frozen=True, slots=True)
class NodeLoads:
    """Forces and moments at nodes over uniform steps; zero before the first."""

    step: float  #: [s]
    nodes: IntArray  #: (k,) rows
    loads: Array  #: (nt, k, 6) at the ends of the steps [N, N m]


def free_transient(
    model: FiniteElementModel, loads: NodeLoads, quad: str, report: Report
) -> dict[str, Array]:
    """Motion of the unsupported model from rest, by Kratos's Newmark scheme (beta 1/4).

    Returns
    -------
    dict
        ``displacement`` (nt, n, 6) of the model's nodes; stresses (nt, n_shells, 3, 3) of the
        shells' faces ``bottom`` and ``top``, mean over each element, in structural axes.
    """
    core, structural, linear = kratos()
    portable = portable_model(model)
    written = write_model(portable, quad)
    part = written.part
    _add_load_conditions(part, loads)
    solver = linear.SparseLUSolver(core.Parameters('{"solver_type": "sparse_lu"}'))
    scheme = structural.StructuralMechanicsBossakScheme(
        core.Parameters('{"damp_factor_m": 0.0, "newmark_beta": 0.25}')
    )
    strategy = core.ResidualBasedLinearStrategy(
        part, scheme, core.ResidualBasedBlockBuilderAndSolver(solver), False, False, False, False
    )
    strategy.Initialize()
    part.ProcessInfo[core.DELTA_TIME] = loads.step
    places = [part.GetNode(int(node) + 1) for node in loads.nodes]
    found: dict[str, list[Array]] = {"displacement": [], "bottom": [], "top": []}
    for number, now in enumerate(loads.loads, start=1):
        part.CloneTimeStep(number * loads.step)
        part.ProcessInfo[core.STEP] = number
        for node, load in zip(places, now.tolist(), strict=True):
            node.SetSolutionStepValue(structural.POINT_LOAD, load[:3])
            node.SetSolutionStepValue(structural.POINT_MOMENT, load[3:])
        strategy.InitializeSolutionStep()
        strategy.Predict()
        strategy.SolveSolutionStep()
        strategy.FinalizeSolutionStep()
        found["displacement"].append(_displacement(core, written))
        for name, face in (("bottom", "BOTTOM"), ("top", "TOP")):
            variable = core.KratosGlobals.GetVariable(f"SHELL_STRESS_{face}_SURFACE_GLOBAL")
            found[name].append(_shell_values(written, variable))
        report(number / len(loads.loads))
    return {name: np.array(values) for name, values in found.items()}


def _add_load_conditions(part: Any, loads: NodeLoads) -> None:
    properties = part.Properties[1]
    number = 0
    for node in loads.nodes.tolist():
        for kind in ("PointLoadCondition3D1N", "PointMomentCondition3D1N"):
            number += 1
            part.CreateNewCondition(kind, number, [node + 1], properties)


def _displacement(core: Any, written: KratosModel) -> Array:
    count = written.portable.model.node_count
    values = np.zeros((count, 6))
    for row in range(count):
        node = written.part.GetNode(row + 1)
        values[row, :3] = node.GetSolutionStepValue(core.DISPLACEMENT)
        values[row, 3:] = node.GetSolutionStepValue(core.ROTATION)
    return values


def _shell_values(written: KratosModel, variable: Any) -> Array:
    """Mean over its integration points of a tensor of every shell (n_shells, 3, 3)."""
    info = written.part.ProcessInfo
    values = np.zeros((written.shell_count, 3, 3))
    for row in range(written.shell_count):
        points = written.part.GetElement(row + 1).CalculateOnIntegrationPoints(variable, info)
        values[row] = np.mean([np.array(point) for point in points], axis=0)
    return values


def _built(
    core: Any, structural: Any, part: Any, strategy: Any, builder: Any, scheme: Any, level: int
) -> csr_array:
    """Matrix of all equations, links not applied."""
    part.ProcessInfo[structural.BUILD_LEVEL] = level
    space = core.UblasSparseSpace()
    matrix = strategy.GetSystemMatrix()
    space.SetToZeroMatrix(matrix)
    right = space.CreateEmptyVectorPointer()
    space.ResizeVector(right, space.Size1(matrix))
    space.SetToZeroVector(right)
    builder.Build(scheme, part, matrix, right)
    size = matrix.Size1()
    entries = (
        np.array(matrix.value_data()),
        np.array(matrix.index2_data()),
        np.array(matrix.index1_data()),
    )
    return csr_array(entries, shape=(size, size))


def _equations(written: KratosModel) -> IntArray:
    """Equation numbers (n, 6) of all nodes; -1 where a node has no such freedom."""
    core, _, _ = kratos()
    numbers = np.full((written.portable.node_count, 6), -1, dtype=np.int64)
    for row, node in enumerate(written.part.Nodes):
        names = (*DISPLACEMENTS, *ROTATIONS) if written.portable.turning[row] else DISPLACEMENTS
        for column, name in enumerate(names):
            numbers[row, column] = node.GetDof(getattr(core, name)).EquationId
    return numbers


def _transformation(written: KratosModel) -> tuple[csr_array, IntArray]:
    """All equations of Kratos from the freedoms that no link holds."""
    portable = written.portable
    numbers = _equations(written)
    linked = {link.node for link in portable.links}
    own = np.array([node for node in range(portable.model.node_count) if node not in linked])
    free = (6 * own[:, None] + np.arange(6)).ravel()
    column = np.full(6 * portable.node_count, -1, dtype=np.int64)
    column[free] = np.arange(len(free))
    rows, columns = [numbers.ravel()[free]], [np.arange(len(free))]
    values = [np.ones(len(free))]
    for link in portable.links:
        height = len(link.coefficients)
        leading = column[(6 * link.leaders[:, None] + np.arange(6)).ravel()]
        rows.append(np.repeat(numbers[link.node, :height], len(leading)))
        columns.append(np.tile(leading, height))
        values.append(link.coefficients.ravel())
    at = (np.concatenate(rows), np.concatenate(columns))
    shape = (int(numbers.max()) + 1, len(free))
    return csr_array(coo_array((np.concatenate(values), at), shape=shape)), free


def _followed(portable: PortableModel, values: Array) -> Array:
    """Motion (n, 6, k) of all nodes with the linked ones following their leaders."""
    moved = values.copy()
    for link in portable.links:
        leading = values[link.leaders].reshape(-1, values.shape[2])
        moved[link.node, : len(link.coefficients)] = link.coefficients @ leading
    return moved


def versions() -> Mapping[str, str]:
    """Versions of Kratos and its applications as installed."""
    return {name: version(name) for name in DISTRIBUTIONS}
