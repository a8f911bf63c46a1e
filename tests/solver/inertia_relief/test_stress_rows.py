"""Stress rows against the stress recovery they stand for."""

import numpy as np
import pytest

from solver.aircraft.airframe import Airframe, load_airframe
from solver.inertia_relief import stress_rows
from solver.inertia_relief.stress_rows import reduced_stress_rows
from tests.solver.aircraft.mini import write_mini_aircraft


@pytest.fixture(scope="module")
def airframe(tmp_path_factory) -> Airframe:
    return load_airframe(write_mini_aircraft(tmp_path_factory.mktemp("rows")))


@pytest.mark.parametrize("together", [7, 1024])
def test_rows_of_any_number_of_elements_at_once_give_the_stress(airframe, monkeypatch, together):
    monkeypatch.setattr(stress_rows, "_TOGETHER", together)
    recovery = airframe.recovery
    assert recovery.shell_operator.shape[0] % (6 * 7) != 0  # the last block is not whole
    basis = np.random.default_rng(5).standard_normal((airframe.structure.n_free, 9))
    amplitudes = np.random.default_rng(6).standard_normal((9, 4))
    rows = reduced_stress_rows(recovery, basis)
    faces = (rows.shells @ amplitudes).reshape(-1, 2, 3, 4)
    shells = np.sqrt(np.square(faces).sum(axis=2).max(axis=1))
    beams = rows.beams @ amplitudes
    points = rows.points @ beams[:, :5]
    sections = np.sqrt(np.square(points).max(axis=1) + np.square(beams[:, 5]))
    displacement = basis @ amplitudes
    expected = recovery.von_mises(
        recovery.shell_operator @ displacement, recovery.beam_operator @ displacement
    )
    found = np.concatenate([shells, sections])
    np.testing.assert_allclose(found, expected, rtol=2e-5, atol=1e-6 * expected.max())
