"""Conversion for the peers, their laws and their process; no peer needs to be installed."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from solver.errors import ModelError
from solver.fe.inertia import point_mass_inertia
from solver.fe.model import Beams, FiniteElementModel, Interpolation, PointMasses, RigidBody
from solver.fe.structure import build_structure
from solver.gear.oleo import oleo_force
from solver.gear.parameters import Strut, Tyre
from solver.gear.tyre import fiala_forces, tyre_vertical_force
from tests.verification.peer_jobs import crashed, doubled, refused
from verification.chapter import Text
from verification.chapters import peers
from verification.peers import exudyn_landing, kratos_model
from verification.peers.apart import PeerError, apart
from verification.peers.box_torsion import box, bredt_stiffness, measured_stiffness
from verification.peers.gear_laws import fiala, ground_reaction, normal_force, strut_force
from verification.peers.panels import PANELS, flat_panel, ribbed_box, stiffened_panel
from verification.peers.portable import mean_motion, portable_model, six_points
from verification.peers.variants import (
    Modes,
    assurance,
    likeness,
    our_modes,
    paired,
    triangulated,
    with_poisson_ratio,
)
from verification.run import Run

RANDOM = np.random.default_rng(7)


def connected_panel() -> FiniteElementModel:
    """Stiffened panel with masses of every kind, on nodes of every kind."""
    plain = stiffened_panel(1)
    count = plain.node_count
    coordinates = np.concatenate(
        [plain.coordinates, [[0.5, 0.4, 0.3], [0.5, 0.4, 0.6], [0.7, 0.5, 0.6]]]
    )
    tensor = np.diag([0.3, 0.4, 0.5])
    tensor[0, 1] = tensor[1, 0] = 0.05
    return replace(
        plain,
        node_identifiers=np.arange(1, count + 4),
        coordinates=coordinates,
        interpolations=(
            Interpolation(1, count, np.array([7, 8, 13, 14]), np.array([1.0, 2.0, 1.0, 0.5])),
        ),
        # The leader is itself linked: a chain.
        rigid_bodies=(RigidBody(2, count, np.array([count + 1, count + 2])),),
        point_masses=PointMasses(
            identifiers=np.arange(3),
            nodes=np.array([3, count, count + 2]),
            masses=np.array([2.0, 5.0, 8.0]),
            offsets=np.array([[0.0, 0.0, 0.0], [0.1, 0.0, 0.2], [0.0, -0.1, 0.1]]),
            inertias=np.stack([np.zeros((3, 3)), np.zeros((3, 3)), tensor]),
        ),
    )


def test_links_state_what_the_solver_eliminates():
    """The two derivations, from the definition and as a closed form, have nothing in common."""
    model = connected_panel()
    structure = build_structure(model)
    motion = RANDOM.standard_normal(structure.n_free)
    everywhere = structure.nodal_displacements(motion)
    linked = [link for link in portable_model(model).links if link.node < model.node_count]
    assert {link.node for link in linked} == set(range(model.node_count - 3, model.node_count))
    for link in linked:
        assert not {one.node for one in linked} & set(link.leaders.tolist())
        follows = link.coefficients @ everywhere[link.leaders].ravel()
        np.testing.assert_allclose(follows, everywhere[link.node], rtol=0, atol=1e-12)


def test_added_nodes_follow_rigid_motion():
    """Of a rigid motion of the leaders every node makes its own part (closed form)."""
    portable = portable_model(connected_panel())
    shift, turn = RANDOM.standard_normal((2, 3))
    rigid = np.hstack(
        [shift + np.cross(turn, portable.coordinates), np.tile(turn, (portable.node_count, 1))]
    )
    for link in portable.links:
        follows = link.coefficients @ rigid[link.leaders].ravel()
        np.testing.assert_allclose(follows, rigid[link.node, : len(follows)], rtol=0, atol=1e-12)


def test_masses_keep_mass_centre_and_inertia():
    model = connected_panel()
    portable = portable_model(model)
    lumps = model.point_masses
    places = portable.coordinates[portable.mass_nodes]
    assert portable.masses.sum() == pytest.approx(lumps.masses.sum(), rel=1e-12)
    structure = build_structure(model)
    expected = point_mass_inertia(
        structure.transformation, model.coordinates, lumps
    ).rigid_body_properties()
    centre = portable.masses @ places / portable.masses.sum()
    np.testing.assert_allclose(centre, expected.centre_of_gravity, rtol=0, atol=1e-12)
    arms = places - centre
    second = np.einsum("p,pi,pj->ij", portable.masses, arms, arms)
    np.testing.assert_allclose(
        np.trace(second) * np.eye(3) - second, expected.inertia, rtol=0, atol=1e-12
    )


def test_six_points_refuse_a_tensor_no_body_has():
    with pytest.raises(ModelError, match="no body of 2 kg"):
        six_points(2.0, np.diag([1.0, 1.0, 3.0]))


def test_beam_ends_lie_at_their_offsets_once_for_each_place():
    model = stiffened_panel(1)
    portable = portable_model(model)
    ends = model.coordinates[model.beams.nodes] + model.beams.offsets
    np.testing.assert_allclose(portable.coordinates[portable.beam_nodes], ends, rtol=0, atol=1e-12)
    assert portable.node_count - model.node_count == len(np.unique(model.beams.nodes))
    along = ends[:, 1] - ends[:, 0]
    np.testing.assert_allclose(np.sum(along * portable.beam_directions, axis=1), 0.0, atol=1e-12)


def test_beams_without_offset_add_no_nodes():
    plain = stiffened_panel(1)
    beams: Beams = replace(plain.beams, offsets=np.zeros_like(plain.beams.offsets))
    assert portable_model(replace(plain, beams=beams)).node_count == plain.node_count


def test_mean_motion_gives_back_a_rigid_motion_and_nearest_otherwise():
    """The residual of the nearest rigid motion is orthogonal to all of them (normal equations)."""
    points, reference = RANDOM.standard_normal((5, 3)), RANDOM.standard_normal(3)
    weights = RANDOM.uniform(0.5, 2.0, 5)
    coefficients = mean_motion(points, weights, reference)
    moved = RANDOM.standard_normal((5, 6))
    found = coefficients @ moved.ravel()
    left = moved[:, :3] - found[:3] - np.cross(found[3:], points - reference)
    np.testing.assert_allclose(weights @ left, 0.0, atol=1e-12)
    turned = np.sum(weights[:, None] * np.cross(points - reference, left), axis=0)
    np.testing.assert_allclose(turned, 0.0, atol=1e-12)


def test_cut_and_changed_models_keep_mass_and_rigid_modes():
    model = connected_panel()
    cut = with_poisson_ratio(triangulated(model), 1 / 6)
    assert len(cut.quads.identifiers) == 0
    assert len(np.unique(cut.element_identifiers)) == len(cut.element_identifiers)
    whole, structure = build_structure(model).inertia, build_structure(cut)
    before, after = (one.rigid_body_properties() for one in (whole, structure.inertia))
    assert after.mass == pytest.approx(before.mass, rel=1e-12)
    np.testing.assert_allclose(after.inertia, before.inertia, rtol=1e-9)
    strained = structure.stiffness @ structure.rigid_modes(np.zeros(3))
    assert np.abs(strained).max() < 1e-9 * structure.stiffness.max()


@pytest.mark.parametrize("panel", PANELS, ids=lambda panel: panel.name)
def test_panels_are_free_and_whole(panel):
    modes = our_modes(panel.build(1), 2)
    assert modes.frequencies[0] > 1.0


def test_refined_panels_are_the_same_body():
    coarse, fine = (build_structure(ribbed_box(n)).inertia for n in (1, 2))
    assert fine.rigid_body_properties().mass == pytest.approx(
        coarse.rigid_body_properties().mass, rel=1e-12
    )


def test_triangles_twist_a_closed_box_as_bredt_says():
    """Closed form, R. Bredt 1896; what is left is the clamped end."""
    found = measured_stiffness(triangulated(box(1, has_ribs=True)), 1)
    assert found == pytest.approx(bredt_stiffness(), rel=2e-3)


def test_modes_pair_by_shape_not_by_order():
    shapes = RANDOM.standard_normal((40, 6, 3))
    first = Modes(np.array([1.0, 2.0, 3.0]), shapes)
    second = Modes(np.array([2.1, 0.9, 3.2]), -2.0 * shapes[:, :, [1, 0, 2]])
    assert [(pair.first, pair.second) for pair in paired(first, second)] == [(0, 1), (1, 0), (2, 2)]
    np.testing.assert_allclose(np.diag(assurance(first, first)), 1.0)


def test_likeness_lets_modes_of_one_frequency_mix():
    axes = np.linalg.qr(RANDOM.standard_normal((60, 2)))[0].reshape(20, 3, 2)
    shapes = np.concatenate([axes, np.zeros_like(axes)], axis=1)
    mixed = shapes @ np.array([[0.6, 0.8], [-0.8, 0.6]])
    first = Modes(np.array([5.0, 5.01]), shapes)
    second = Modes(np.array([5.0, 5.01]), mixed)
    assert assurance(first, second).max() == pytest.approx(0.64)
    np.testing.assert_allclose(likeness(first, second, within=0.01), 1.0)
    apart_in_frequency = Modes(np.array([5.0, 6.0]), mixed)
    assert likeness(first, apart_in_frequency, within=0.01).max() == pytest.approx(0.64)


STRUT = Strut(0.00539, 2.58e6, 0.002234, 1.1, 1.0e4, 4.0e4, 0.38, 1.15)
TYRE = Tyre(
    0.27559, 3.1376e6, 1.333, 3.158e5, 1.895e5, 0.8, 0.5, 0.1416, 1.1, 2, 0.07239
)  # fmt: skip


@pytest.mark.parametrize("rate", [-0.4, 0.0, 1.7])
def test_strut_law_is_the_solvers(rate):
    """Two independent writings of the same formulae, over the stroke and both stops."""
    strokes = np.linspace(-1e-3, 0.385, 24)
    theirs = [strut_force(float(stroke), rate, STRUT) for stroke in strokes]
    ours = oleo_force(strokes, np.full_like(strokes, rate), STRUT)
    np.testing.assert_allclose(theirs, ours, rtol=1e-12)


def test_tyre_laws_are_the_solvers():
    deflections = np.linspace(-0.01, 0.08, 15)
    theirs = [TYRE.count * normal_force(float(one), TYRE) for one in deflections]
    np.testing.assert_allclose(theirs, tyre_vertical_force(deflections, TYRE), rtol=1e-12)
    for kappa in (-1.0, -0.3, -0.02, 0.0, 0.01):
        for tangent in (-0.6, -0.05, 0.0, 0.02, 0.3):
            ours = fiala_forces(
                3e4,
                kappa,
                tangent,
                TYRE.longitudinal_stiffness,
                TYRE.cornering_stiffness,
                TYRE.maximum_friction,
                TYRE.minimum_friction,
                TYRE.width,
            )
            np.testing.assert_allclose(fiala(3e4, kappa, tangent, TYRE), ours, rtol=1e-12)


def test_rolling_wheel_feels_no_drag_and_locked_one_all_of_it():
    """A wheel that rolls on R - z/3 has no slip; a locked one slides with the least friction."""
    deflection, speed = 0.03, 50.0
    centre = np.array([0.0, 0.0, TYRE.free_radius - deflection])
    port = np.array([0.0, 1.0, 0.0])
    rolling = speed / (TYRE.free_radius - TYRE.rolling_share * deflection)
    ahead = np.array([speed, 0.0, 0.0])
    free = ground_reaction(centre, ahead, rolling * port, port, TYRE)
    assert free.deflection == pytest.approx(deflection)
    np.testing.assert_allclose(free.force[:2], 0.0, atol=1e-6)
    locked = ground_reaction(centre, ahead, np.zeros(3), port, TYRE)
    normal = locked.force[2] / TYRE.count
    limit = TYRE.minimum_friction * normal
    expected = limit - limit**2 / (4 * TYRE.longitudinal_stiffness)
    assert -locked.force[0] / TYRE.count == pytest.approx(expected, rel=1e-12)
    assert locked.moment[1] == pytest.approx(-locked.force[0] * centre[2], rel=1e-9)


def test_ground_pushes_against_drift():
    centre = np.array([0.0, 0.0, TYRE.free_radius - 0.02])
    port = np.array([0.0, 1.0, 0.0])
    moving_left = ground_reaction(centre, np.array([50.0, 3.0, 0.0]), 180 * port, port, TYRE)
    assert moving_left.force[1] < 0.0
    lifted = ground_reaction(centre + 0.1 * np.array([0, 0, 1.0]), np.zeros(3), port, port, TYRE)
    assert lifted.deflection < 0.0
    assert not np.any(lifted.force)


def test_job_apart_answers_and_reports(capfd):
    shares: list[float] = []
    assert apart(doubled, 21, report=shares.append) == 42
    assert shares == [0.5]
    assert capfd.readouterr().out == ""


def test_job_that_raises_or_crashes_is_told_from_one_that_answers():
    with pytest.raises(PeerError, match="ValueError: no such thing"):
        apart(refused)
    with pytest.raises(PeerError, match="ended with status -6"):
        apart(crashed)


def test_chapter_without_peers_says_how_to_get_them(monkeypatch, tmp_path: Path):
    monkeypatch.setattr(kratos_model, "is_installed", lambda: False)
    monkeypatch.setattr(exudyn_landing, "is_installed", lambda: False)
    chapter = peers.chapter(Run(tmp_path, quick=True))
    assert all(isinstance(item, Text) for item in chapter.items)
    words = [item.words for item in chapter.items if isinstance(item, Text)]
    for name in ("Kratos Multiphysics", "exudyn"):
        assert any(line.startswith(f"{name} is not installed") for line in words)
    assert chapter.comparisons == ()


def test_flat_panel_has_the_airframes_density():
    panel = flat_panel(1)
    sides = np.ptp(panel.coordinates[panel.quads.nodes], axis=1)[:, :2]
    np.testing.assert_allclose(sides, 0.2)
