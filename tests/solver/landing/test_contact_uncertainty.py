import numpy as np
import pytest

from solver.landing.contact_uncertainty import CONTACT_COMPONENTS, ContactUncertainty


def test_independent_components_stand_on_the_diagonal() -> None:
    uncertainty = ContactUncertainty.independent(sink_rate=0.3, lift_fraction=0.1)
    expected = np.zeros((9, 9))
    expected[0, 0], expected[8, 8] = 0.3**2, 0.1**2
    assert np.array_equal(uncertainty.matrix, expected)
    assert CONTACT_COMPONENTS[0] == "sink_rate"


@pytest.mark.parametrize(
    ("matrix", "words"),
    [
        (np.eye(8), r"\(9, 9\)"),
        (np.triu(np.ones((9, 9))), "not symmetric"),
        (-np.eye(9), "negative"),
    ],
)
def test_what_is_no_covariance_is_refused(matrix: np.ndarray, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        ContactUncertainty.from_matrix(matrix)


def test_a_component_that_does_not_exist_is_named() -> None:
    with pytest.raises(ValueError, match="sideslip"):
        ContactUncertainty.independent(sideslip=1.0)
