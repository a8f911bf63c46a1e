"""What a recorder shows of a motion that is known."""

from dataclasses import replace

import numpy as np
import pytest

from solver.errors import ModelError
from solver.flight_data.anti_alias import anti_aliased, filter_delay
from solver.flight_data.frame import Certainty, Figure, RecordedParameter, RecorderFrame
from solver.flight_data.frame_file import frame_names, packaged_frame, parse_frame
from solver.flight_data.geometry import Geometry
from solver.flight_data.motion import Motion
from solver.flight_data.parameter import Parameter
from solver.flight_data.recorder import Surroundings, quantised, record
from solver.landing.aircraft import LandingAircraft
from solver.landing.history import LandingHistory
from tests.solver.flight_data.conftest import FRAMES

FOOT = 0.3048


def exact(frame: RecorderFrame) -> RecorderFrame:
    """The frame without error: no noise, bias, scale, delay, step or filter."""
    none = Figure(0.0, Certainty.ASSUMED)
    names = ("noise", "bias", "scale", "delay", "delay_scatter", "corner", "resolution")
    return replace(
        frame,
        parameters=tuple(
            replace(entry, late_most=none, **dict.fromkeys(names, none))
            for entry in frame.parameters
        ),
    )


def test_frames_hold_the_figures_of_their_listings() -> None:
    # Listings of the frames as cited in the files.
    classic = packaged_frame("737-3c")
    normal = classic.require(Parameter.NORMAL_ACCELERATION)
    assert (normal.rate.value, normal.resolution.value) == (8.0, 0.00229)
    assert normal.rate.certainty is Certainty.DOCUMENT
    assert normal.noise.certainty is Certainty.ASSUMED
    assert classic.find(Parameter.VERTICAL_SPEED) is None
    radios = [p for p in classic.parameters if p.parameter is Parameter.RADIO_ALTITUDE]
    assert sorted(p.rate.value for p in radios) == [0.25, 0.25, 0.5]
    speed = packaged_frame("737-7").require(Parameter.VERTICAL_SPEED)
    assert speed.resolution.value == pytest.approx(16 * FOOT / 60)
    roll = packaged_frame("a330").require(Parameter.ROLL)
    assert (roll.rate.value, roll.resolution.value) == (2.0, pytest.approx(np.deg2rad(0.35)))


@pytest.mark.parametrize("name", frame_names())
def test_every_figure_says_where_it_comes_from(name: str) -> None:
    frame = packaged_frame(name)
    for entry in frame.parameters:
        for certainty in entry.certainties().values():
            assert certainty in frame.sources


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no \\[\\[parameter\\]\\]"),
        ('[[parameter]]\nname = "thrust"', "'thrust' is not a parameter"),
        ('[[parameter]]\nname = "pitch"\nmoise = 1', "unknown key moise"),
        ('[[parameter]]\nname = "pitch"', "rate is missing"),
        ('[[parameter]]\nname = "pitch"\nrate = 4', "rate needs value, unit and from"),
        (
            '[[parameter]]\nname = "pitch"\nrate = { value = 4, unit = "1/s", from = "assumed" }',
            "unit '1/s', needed 'Hz'",
        ),
        ("[[parameter", "frame mine"),
    ],
)
def test_faulty_frame_file_says_where(text: str, message: str) -> None:
    with pytest.raises(ModelError, match=message):
        parse_frame(text, "mine")


def test_unknown_frame_names_those_there_are() -> None:
    with pytest.raises(ModelError, match="737-3c, 737-7, a330"):
        packaged_frame("747")


def test_recording_is_the_same_for_the_same_seed(motion: Motion, geometry: Geometry) -> None:
    frame = packaged_frame("737-7")
    one, same, other = (record(motion, frame, geometry, Surroundings(), s) for s in (1, 1, 2))
    for a, b in zip(one.channels, same.channels, strict=True):
        np.testing.assert_array_equal(a.value, b.value)
        np.testing.assert_array_equal(a.time, b.time)
    assert any(
        len(a.value) != len(b.value) or np.any(a.value != b.value)
        for a, b in zip(one.channels, other.channels, strict=True)
    )


@pytest.mark.parametrize("name", FRAMES)
def test_rates_and_steps_are_those_of_the_frame(
    name: str, motion: Motion, geometry: Geometry
) -> None:
    frame = packaged_frame(name)
    window = record(motion, frame, geometry, Surroundings(mass=12e3), 3)
    for channel in window.channels:
        entry = frame.require(channel.parameter, channel.source)
        if len(channel.time) > 3:
            assert channel.rate == pytest.approx(entry.rate.value, rel=1e-9)
        steps = channel.value / entry.resolution.value
        np.testing.assert_allclose(steps, np.round(steps), atol=1e-6)


def test_without_errors_the_accelerometer_at_the_centre_shows_the_load_factor(
    motion: Motion, geometry: Geometry, aircraft: LandingAircraft, history: LandingHistory
) -> None:
    centre = aircraft.total_centre_of_gravity
    at_centre = replace(geometry, installation=replace(geometry.installation, accelerometer=centre))
    window = record(motion, exact(packaged_frame("business-jet-16")), at_centre, Surroundings(), 5)
    normal = window.first(Parameter.NORMAL_ACCELERATION)
    assert normal is not None
    # The simulation's own load factor at the whole aircraft's centre of gravity, from its forces.
    inside = (normal.time > 0.0) & (normal.time < 5.9)
    expected = np.interp(normal.time[inside], history.time, history.normal_load_factor)
    np.testing.assert_allclose(normal.value[inside], expected, atol=1e-9)


def test_filter_passes_slow_courses_with_its_delay_and_halves_the_power_at_its_corner() -> None:
    step = 1e-3
    time = np.arange(0.0, 20.0, step)
    slow = anti_aliased(np.sin(2 * np.pi * 0.2 * time), 4.0, step)
    late = np.sin(2 * np.pi * 0.2 * (time - filter_delay(4.0)))
    np.testing.assert_allclose(slow[5000:], late[5000:], atol=2e-3)
    fast = anti_aliased(np.sin(2 * np.pi * 4.0 * time), 4.0, step)[5000:]
    assert np.std(fast) * np.sqrt(2) == pytest.approx(np.sqrt(0.5), rel=1e-3)  # by definition


def entry(**changes: object) -> RecordedParameter:
    return replace(packaged_frame("a330").require(Parameter.RADIO_ALTITUDE), **changes)  # type: ignore[arg-type]


def test_radio_altitude_starts_again_beyond_its_word() -> None:
    # 2,100 ft in a word of -2,048 to 2,048 ft reads 2,100 - 4,096 = -1,996 ft.
    shown = quantised(np.array([2000.0, 2100.0]) * FOOT, entry())
    np.testing.assert_allclose(shown / FOOT, [2000.0, -1996.0], atol=1e-9)


def test_lateral_acceleration_clips_at_its_range() -> None:
    lateral = packaged_frame("737-7").require(Parameter.LATERAL_ACCELERATION)
    shown = quantised(np.array([0.5, 1.7, -3.0]), lateral)
    np.testing.assert_allclose(shown, [0.5, 1.0, -1.0], atol=lateral.resolution.value)


def test_switches_close_after_their_gear_touched(motion: Motion, geometry: Geometry) -> None:
    for seed in range(8):
        window = record(motion, packaged_frame("737-3c"), geometry, Surroundings(), seed)
        right = window.first(Parameter.GEAR_RIGHT)
        assert right is not None
        closed = right.time[right.value > 0.5]
        assert closed[0] > 0.0
