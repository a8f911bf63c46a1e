"""Contact of the nose wheel: parts of the pitch model in closed form, its switch, its attitude."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from solver.arrays import Array
from solver.flight_data.alignment import aligned
from solver.flight_data.contacts import ContactKind
from solver.flight_data.derotation import _with_kisses
from solver.flight_data.geometry import Geometry
from solver.flight_data.onset import indicator
from solver.flight_data.parameter import Parameter
from solver.flight_data.pitch_model import PitchModel, _integrated
from solver.flight_data.reconstruction import reconstruct
from solver.flight_data.vote import closing_indicator
from solver.flight_data.window import Window
from solver.frames import euler_from_quaternion
from solver.landing.history import LandingHistory


@pytest.fixture
def model() -> PitchModel:
    """A load that does nothing: only the nose wheel bends the pitch."""
    time = np.arange(0.0, 4.0, 0.005)
    return PitchModel(
        start=-1.0,
        first=0.0,
        mains=(0.0,),
        time=time,
        by_load=np.zeros_like(time),
        by_damping=np.zeros_like(time),
        load_lever=-0.9,
        nose_acceleration=0.6,
    )


def test_white_noise_integrated_twice_has_the_covariance_of_its_integral() -> None:
    # Independent: S times the integral of (t - u)+ (t' - u)+ from where the noise begins.
    times = np.array([[-0.3, 0.4, 1.1, 1.7]])
    result = _integrated(times, 0.02)[0]
    for i, one in enumerate(times[0]):
        for j, other in enumerate(times[0]):
            end = max(min(one, other), 0.0)
            integral, _ = quad(lambda u, t=one, s=other: (t - u) * (s - u), 0.0, end)
            assert result[i, j] == pytest.approx(0.02 * integral, abs=1e-12)


def test_pitch_bends_as_under_a_constant_acceleration_once_the_nose_is_down(
    model: PitchModel,
) -> None:
    time = np.array([[-0.5, 0.5, 1.0, 2.0]] * 2)
    mean, covariance = model.moments(time, np.array([1.0, 3.0]))
    np.testing.assert_allclose(mean, [[0.0, 0.0, 0.0, 0.3], np.zeros(4)], atol=1e-15)
    # What comes after the last time looked at changes nothing before it.
    np.testing.assert_allclose(covariance[0][:3, :3], covariance[1][:3, :3])
    assert covariance[0, 3, 3] > covariance[1, 3, 3]
    assert np.all(np.linalg.eigvalsh(covariance) > 0)


def test_a_switch_bounds_the_contact_by_its_lateness_and_its_sampling(window: Window) -> None:
    (switch,) = aligned(window, Parameter.GEAR_NOSE)
    closed = int(np.flatnonzero(np.diff(switch.value) > 0.5)[0]) + 1
    shown, before = float(switch.time[closed]), float(switch.time[closed - 1])
    grid = np.arange(before - 2.0, shown + 1.0, 0.01)
    takes = np.full(len(grid), 0.05)
    result = closing_indicator("switch", switch, grid, takes)
    assert result is not None
    most = switch.entry.late_most.value
    inside = (grid > before - most - 0.05) & (grid < shown - 0.05)
    assert result.log_likelihood[inside].min() > result.log_likelihood[grid > shown].max()
    # Uniform lateness: the mean is that of lateness and of a sample at a random time; a tenth
    # stands for a touch that moved no switch, anywhere before.
    only = indicator("inside", grid[inside], result.log_likelihood[inside])
    assert only.time == pytest.approx((shown + before - most) / 2 - 0.05, abs=0.02)


def test_a_switch_that_stays_open_tells_nothing(window: Window) -> None:
    (switch,) = aligned(window, Parameter.GEAR_NOSE)
    never = replace(switch, value=np.zeros_like(switch.value))
    grid = np.arange(0.0, 2.0, 0.02)
    assert closing_indicator("switch", never, grid, np.zeros(len(grid))) is None


def test_a_light_touch_is_as_likely_as_the_height_has_it() -> None:
    grid = np.arange(0.0, 2.0, 0.02)
    lasting = -0.5 * ((grid - 1.5) / 0.05) ** 2
    level = np.zeros(len(grid))

    def passing(time: float, sure: float) -> Array:
        shape = np.exp(-0.5 * ((grid - time) / 0.03) ** 2)
        return sure * shape / shape.sum()

    def early(weight: Array) -> float:
        return float(weight[grid < 1.0].sum())

    # A fifth by assumption where the height is sure to have passed zero, nothing where it was not.
    assert early(_with_kisses(lasting, level, passing(0.5, 1.0))) == pytest.approx(0.2, abs=1e-3)
    assert early(_with_kisses(lasting, level, passing(0.5, 0.0))) == pytest.approx(0.0, abs=1e-9)
    # Bayes: odds of one to four times that of the wheel being lower before the touch that lasts.
    lower = np.where(grid > 1.0, np.log(0.1), 0.0)
    odds = 0.2 / (0.8 * 0.1)
    assert early(_with_kisses(lasting, lower, passing(0.5, 1.0))) == pytest.approx(
        odds / (1.0 + odds), abs=1e-3
    )
    # After the touch that lasts there is no first one.
    assert _with_kisses(lasting, level, passing(1.9, 1.0))[grid > 1.8].sum() < 1e-3


def test_aircraft_rolls_at_the_attitude_of_its_closed_struts(
    history: LandingHistory, geometry: Geometry
) -> None:
    # Independent: the landing simulation, where it has come to rest on its struts.
    settled = history.time > 4.0
    _, pitch, _ = euler_from_quaternion(history.attitude[settled])
    assert abs(np.mean(pitch) - geometry.rolling_pitch) < 1.5 * geometry.rolling_pitch_sd


def test_without_pitch_after_the_touch_the_nose_wheel_is_not_made_up(
    window: Window, geometry: Geometry
) -> None:
    cut = replace(
        window,
        channels=tuple(
            replace(c, time=c.time[c.time < 1.2], value=c.value[c.time < 1.2])
            for c in window.channels
        ),
    )
    answer = reconstruct(cut, geometry)
    for contact in answer.contacts:
        assert contact.kind is not ContactKind.DEROTATION or contact.time < 1.2
