"""Block Lanczos iteration against eigenvalues in closed form and a dense solution."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csc_array, diags_array, eye_array, kron

from solver.errors import ModelError
from solver.inertia_relief import lanczos
from solver.inertia_relief.factor import factorise
from solver.inertia_relief.lanczos import TOLERANCE, largest_modes


def line(count: int) -> csc_array:
    """Return the chain of unit springs between fixed ends."""
    return csc_array(
        diags_array([-np.ones(count - 1), 2 * np.ones(count), -np.ones(count - 1)],
                    offsets=[-1, 0, 1])
    )  # fmt: skip


@pytest.fixture(scope="module")
def membrane() -> tuple[csc_array, csc_array, np.ndarray]:
    """Return a square lattice, its mass, and its eigenvalues in closed form: most are double."""
    side = 45
    one = 2 - 2 * np.cos(np.pi * np.arange(1, side + 1) / (side + 1))
    matrix = csc_array(kron(line(side), eye_array(side)) + kron(eye_array(side), line(side)))
    values = np.sort((one[:, None] + one[None]).ravel())
    return matrix, csc_array(3.0 * eye_array(side**2)), values / 3.0


def test_lattice_eigenvalues_double_ones_included(membrane):
    matrix, mass, exact = membrane
    count = 40
    values, vectors = largest_modes(factorise(matrix).solve, mass, count, matrix)
    np.testing.assert_allclose(1 / values, exact[:count], rtol=1e-11)
    np.testing.assert_allclose(vectors.T @ (mass @ vectors), np.eye(count), atol=1e-11)
    residual = matrix @ vectors * values - mass @ vectors
    relative = np.linalg.norm(residual, axis=0) / np.linalg.norm(mass @ vectors, axis=0)
    assert relative.max() < 100 * TOLERANCE


def test_small_matrices_taken_whole_agree_with_the_iteration(membrane, monkeypatch):
    matrix, mass, _ = membrane
    rough = csc_array(mass + diags_array(np.random.default_rng(1).random(mass.shape[0])))
    monkeypatch.setattr(lanczos, "_DENSE", 0)
    iterated, _ = largest_modes(factorise(matrix).solve, rough, 30, matrix)
    monkeypatch.setattr(lanczos, "_DENSE", 10**6)
    whole, vectors = largest_modes(factorise(matrix).solve, rough, 30, matrix)
    np.testing.assert_allclose(iterated, whole, rtol=1e-11)
    np.testing.assert_allclose(vectors.T @ (rough @ vectors), np.eye(30), atol=1e-11)


def test_massless_freedoms_do_no_harm():
    matrix = line(60)
    mass = csc_array(diags_array(np.where(np.arange(60) % 3 == 0, 0.0, 1.0)))
    values, _ = largest_modes(factorise(matrix).solve, mass, 20, matrix)
    expected = eigh(mass.toarray(), matrix.toarray(), eigvals_only=True)[::-1][:20]
    np.testing.assert_allclose(values, expected, rtol=1e-10)


def test_modes_that_do_not_converge_are_refused(membrane, monkeypatch):
    matrix, mass, _ = membrane
    monkeypatch.setattr(lanczos, "_LONGEST", 2)
    monkeypatch.setattr(lanczos, "TOLERANCE", 1e-30)
    with pytest.raises(ModelError, match="40 modes did not converge in 120"):
        largest_modes(factorise(matrix).solve, mass, 40, matrix)
