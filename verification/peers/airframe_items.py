"""The full-size airframe in Kratos: how it is written out, and its free modes."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from solver.aircraft.bizjet import build_bizjet
from solver.aircraft.nastran import read_bulk_data
from solver.arrays import Array, IntArray
from solver.fe.model import FiniteElementModel
from verification.chapter import Comparisons, Item, Plot, Table, Text
from verification.comparison import Comparison
from verification.peers.apart import apart
from verification.peers.element_items import COMMON_RATIO, SOURCE
from verification.peers.kratos_model import THIN_QUAD
from verification.peers.kratos_runs import PeerMatrices, free_modes, matrices, versions
from verification.peers.portable import portable_model
from verification.peers.variants import (
    RIGID,
    Modes,
    Pair,
    elastic_modes,
    likeness,
    our_modes,
    paired,
    solved,
    triangulated,
    with_poisson_ratio,
)
from verification.plots import Line, Panel, line_plot
from verification.run import Run

#: Lowest elastic modes compared.
COUNT = 20
#: More of them are computed, so that each of the lowest finds its like.
MARGIN = 6
#: Divisions of every bay in the finer model.
FINER = 2
#: Modes whose shape is found again with less than this are not paired.
LEAST_ASSURANCE = 0.8
#: Nor are modes that the peer's own meshes put further apart than this.
GREATEST_CHANGE = 0.1
SOURCES = (
    "solver/fe",
    "solver/aircraft/bizjet",
    "verification/peers/kratos_model.py",
    "verification/peers/kratos_runs.py",
    "verification/peers/portable.py",
    "verification/peers/variants.py",
)


def bulk_data_model(run: Run) -> FiniteElementModel:
    """Read the example aircraft as its bulk data stand: tanks and bays full."""
    file = run.airframe.definition.bulk_data
    return read_bulk_data(run.folder / "aircraft" / file).model


def written_items(model: FiniteElementModel) -> list[Item]:
    """How the model was written out."""
    portable = portable_model(model)
    offsets = portable.node_count - model.node_count
    numbers = versions()
    return [
        Text(
            "The airframe is written out for Kratos Multiphysics, an independent finite-element "
            "code: every beam offset becomes a node that follows its shell node as a rigid body, "
            "every lumped mass beside its node a point mass on such a node, every lumped inertia "
            "six points that have the same tensor; rigid and averaging connections become "
            "linear equations between freedoms, derived anew. Kratos eliminates them itself. "
            "Mass is consistent in both codes. Quadrilaterals are cut into two triangles for the "
            "peer, since neither of its own can serve; see the table above."
        ),
        Table(
            "The airframe as written",
            ("what", "number"),
            (
                ("nodes of the bulk data", f"{model.node_count}"),
                ("nodes added for offsets and lumped inertias", f"{offsets}"),
                ("shells (triangles for the peer)",
                 f"{len(triangulated(model).triangles.identifiers)}"),
                ("beams", f"{len(model.beams.identifiers)}"),
                ("linked nodes", f"{len(portable.links)}"),
                ("point masses", f"{len(portable.masses)}"),
                *((name, number) for name, number in numbers.items()),
            ),
        ),
    ]  # fmt: skip


def modes_items(run: Run, model: FiniteElementModel) -> list[Item]:
    """Lowest 20 free modes: twin, as it stands in triangles, and the product's quadrilaterals."""
    cut = triangulated(model)
    twin = with_poisson_ratio(cut, COMMON_RATIO)
    peer_twin = _peer_modes(run, "twin", twin)
    peer = _peer_modes(run, "triangles", cut)
    run.progress("free modes by the solver", 0.0)
    ours_twin, ours_cut = our_modes(twin, COUNT), our_modes(cut, COUNT)
    ours = our_modes(model, COUNT + MARGIN)
    run.progress("free modes by the solver", 1.0)
    finer, rows = _finer_peer_modes(run, model)
    return [
        Comparisons(
            "Lowest 20 free modes, the same triangles at a Poisson ratio of 1/6",
            _same_mesh(
                ours_twin,
                peer_twin,
                "twin",
                2e-4,
                "the triangles of both codes are the same at this ratio but for transverse "
                "shear, (t/h)^2 = 1e-4, and the rotary inertia of sections; everything else, from "
                "offsets to averaging connections and lumped inertias, must agree to rounding",
                0.999,
            ),
        ),
        Comparisons(
            "Lowest 20 free modes, the same triangles at the airframe's Poisson ratios",
            _same_mesh(
                ours_cut,
                peer,
                "triangles",
                0.05,
                "the peer's triangle is 1.6 times stiffer in bending in its plane, as on the "
                "panels; local modes of single panels feel it most",
                0.85,
            ),
        ),
        _spread_plot(ours_twin, peer_twin, ours_cut, peer, ours, finer, rows),
        Text(
            "The product's own elements are quadrilaterals. They are compared with the peer's "
            "triangles on a mesh twice as fine, as two discretisations that should both be near "
            "what is true. (For this size matrices are assembled by the peer, its links "
            "eliminated and the modes found by the solver's factorisation.) What the peer "
            "itself still changes by when its mesh is halved is the measure."
        ),
        Comparisons(
            "Lowest free modes: quadrilaterals as they stand against the peer on a finer mesh",
            _against_finer(ours, peer, finer, rows),
        ),
    ]


def _peer_modes(run: Run, name: str, model: FiniteElementModel) -> Modes:
    step = f"free modes by Kratos, {name}"

    def compute() -> dict[str, Array]:
        return apart(
            free_modes,
            model,
            COUNT + MARGIN + RIGID,
            THIN_QUAD,
            report=lambda share: run.progress(step, share),
        )

    kept = run.stored(f"peer-modes-{name}", [model], SOURCES, compute)
    return elastic_modes(kept["eigenvalues"], kept["shapes"])


def _finer_peer_modes(run: Run, model: FiniteElementModel) -> tuple[Modes, IntArray]:
    """Modes of the finer mesh at the nodes that the model has too, and their rows there."""
    folder = run.folder / "aircraft-finer"

    def compute() -> dict[str, Array]:
        run.progress("finer mesh by Kratos", 0.0)
        build_bizjet(folder, FINER)
        fine = triangulated(read_bulk_data(folder / run.airframe.definition.bulk_data).model)
        found: PeerMatrices = apart(
            matrices,
            fine,
            THIN_QUAD,
            report=lambda share: run.progress("finer mesh by Kratos", 0.6 * share),
        )
        stiffness = (found.stiffness + found.stiffness.T) / 2.0
        values, vectors = solved(stiffness, found.mass, COUNT + MARGIN + RIGID)
        everywhere = np.zeros((6 * fine.node_count, vectors.shape[1]))
        everywhere[found.free] = vectors
        distance, row = cKDTree(fine.coordinates).query(model.coordinates)
        is_free = np.isin(6 * row, found.free)
        rows = np.flatnonzero((distance < 1e-6) & is_free)
        shapes = everywhere.reshape(fine.node_count, 6, -1)[row[rows]]
        run.progress("finer mesh by Kratos", 1.0)
        return {"eigenvalues": values, "shapes": shapes, "rows": rows}

    kept = run.stored("peer-modes-finer", [model, FINER], SOURCES, compute)
    return elastic_modes(kept["eigenvalues"], kept["shapes"]), kept["rows"].astype(np.int64)


def _same_mesh(
    ours: Modes, peer: Modes, name: str, tolerance: float, reason: str, least: float
) -> tuple[Comparison, ...]:
    rows = [
        Comparison(
            f"{name}, mode {pair.first + 1}",
            float(ours.frequencies[pair.first]),
            float(peer.frequencies[pair.second]),
            tolerance,
            "Hz",
            SOURCE,
            reason,
        )
        for pair in paired(ours, peer)[:COUNT]
    ]
    alike = likeness(ours, peer, within=tolerance)[:COUNT]
    worst = int(np.argmin(alike))
    rows.append(
        Comparison(
            f"{name}, least likeness of the shapes (mode {worst + 1})",
            float(alike[worst]),
            1.0,
            1.0 - least,
            "",
            SOURCE,
            f"modal assurance, summed over modes within {tolerance:.2g} in frequency, the "
            "difference admitted there: such modes may mix freely, farther ones in proportion to "
            "the difference of the stiffness over their distance",
        )
    )
    return tuple(rows)


@dataclass(frozen=True, slots=True)
class _Found:
    """A mode of the product's mesh, of the peer's on the same nodes, and on the finer mesh."""

    mode: int
    ours: float
    peer: float
    finer: float


def _found_again(ours: Modes, peer: Modes, finer: Modes, rows: IntArray) -> list[_Found]:
    """Modes that all three have."""
    found = []
    same = paired(ours, peer)
    fine: list[Pair] = paired(ours.at(rows), finer)
    for first, second in zip(same[:COUNT], fine[:COUNT], strict=True):
        one = _Found(
            first.first,
            float(ours.frequencies[first.first]),
            float(peer.frequencies[first.second]),
            float(finer.frequencies[second.second]),
        )
        is_like = min(first.assurance, second.assurance) >= LEAST_ASSURANCE
        if is_like and abs(one.peer / one.finer - 1.0) <= GREATEST_CHANGE:
            found.append(one)
    return found


def _against_finer(
    ours: Modes, peer: Modes, finer: Modes, rows: IntArray
) -> tuple[Comparison, ...]:
    found = _found_again(ours, peer, finer, rows)
    comparisons = [
        Comparison(
            f"quadrilaterals, mode {one.mode + 1}",
            one.ours,
            one.finer,
            max(0.02, abs(one.peer / one.finer - 1.0)),
            "Hz",
            SOURCE.replace("same mesh", "every bay divided in two each way"),
            "no further from the finer mesh than the peer's own coarse mesh is, or 2 %",
        )
        for one in found
    ]
    comparisons.append(
        Comparison(
            "modes found again in all three meshes",
            len(found),
            COUNT,
            0.4,
            "",
            "count of the modes compared",
            "modes of single panels change with the mesh; at least 12 of 20 must not",
        )
    )
    return tuple(comparisons)


def _spread_plot(
    ours_twin: Modes,
    peer_twin: Modes,
    ours_cut: Modes,
    peer: Modes,
    ours: Modes,
    finer: Modes,
    rows: IntArray,
) -> Plot:
    number = np.arange(1, COUNT + 1, dtype=float)

    def share(first: Modes, second: Modes) -> Array:
        pairs = paired(first, second)[:COUNT]
        ratio = [first.frequencies[p.first] / second.frequencies[p.second] for p in pairs]
        return np.abs(np.array(ratio) - 1.0)

    found = _found_again(ours, peer, finer, rows)
    modes = np.array([one.mode + 1.0 for one in found])
    product = np.array([one.ours / one.finer - 1.0 for one in found])
    coarse = np.array([one.peer / one.finer - 1.0 for one in found])
    return line_plot(
        "peers-free-modes",
        "Lowest 20 free modes of the whole airframe. Left, the solver beside Kratos on the same "
        "triangles: at a Poisson ratio of 1/6, where the elements are the same, and at the "
        "airframe's. Right, how far the product's quadrilaterals and the peer's triangles on the "
        "same nodes are from the peer on a mesh twice as fine.",
        [
            Panel(
                "mode",
                "difference of the frequency",
                [
                    Line(number, share(ours_twin, peer_twin), "ratio 1/6", "marked"),
                    Line(number, share(ours_cut, peer), "ratio 0.33", "marked"),
                ],
                "Solver and Kratos, same triangles",
                log="y",
            ),
            Panel(
                "mode",
                "from the finer mesh [%]",
                [
                    Line(modes, 100 * product, "quadrilaterals, solver", "marked"),
                    Line(modes, 100 * coarse, "triangles, peer", "marked"),
                ],
                "Coarse meshes and a finer one",
            ),
        ],
    )
