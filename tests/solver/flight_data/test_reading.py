"""Windows from files: forms, names, units, faults, and files that are no windows."""

import gzip
import tracemalloc
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from solver.errors import FlightDataError
from solver.flight_data.parameter import Parameter
from solver.flight_data.reading import read_window
from solver.flight_data.table import Limits
from solver.flight_data.window import Channel, Window
from solver.flight_data.writing import long_form

FOOT = 0.3048
G = 9.80665


def read(text: str) -> Window:
    return read_window(text.encode())


def only(window: Window) -> Channel:
    assert len(window.channels) == 1, window
    return window.channels[0]


def codes(window: Window) -> set[str]:
    return {note.code for note in window.notes}


def test_what_is_written_is_read_back(window: Window) -> None:
    again = read_window(long_form(window).encode(), window.frame)
    assert codes(again) == set()
    kept = {(c.parameter, c.source): c for c in again.channels}
    assert len(kept) == len(window.channels)
    for channel in window.channels:
        same = kept[channel.parameter, channel.source]
        np.testing.assert_allclose(same.time, channel.time, atol=1e-6)
        value = channel.value
        if channel.parameter is Parameter.HEADING:
            value = np.unwrap(value)
        np.testing.assert_allclose(same.value, value, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "unit", "given", "parameter", "expected"),
    [
        ("VRTG", "g", 1.2, Parameter.NORMAL_ACCELERATION, 1.2),
        ("Acceleration Normal", "m/s2", 12.0, Parameter.NORMAL_ACCELERATION, 12.0 / G),
        ("Acceleration Longitudinal", "mg", 120.0, Parameter.LONGITUDINAL_ACCELERATION, 0.12),
        ("RALT1", "ft", 30.0, Parameter.RADIO_ALTITUDE, 30.0 * FOOT),
        ("Altitude Radio (A)", "feet", 30.0, Parameter.RADIO_ALTITUDE, 30.0 * FOOT),
        ("IVVR", "fpm", -120.0, Parameter.VERTICAL_SPEED, -2.0 * FOOT),
        ("PTCH", "degrees", 4.5, Parameter.PITCH, np.deg2rad(4.5)),
        ("Groundspeed", "kts", 100.0, Parameter.GROUND_SPEED, 100 * 1852 / 3600),
        ("GndSpd", "kt", 100.0, Parameter.GROUND_SPEED, 100 * 1852 / 3600),
        ("GW", "lbs", 1000.0, Parameter.GROSS_MASS, 453.59237),
        ("LDGL", "bool", 1.0, Parameter.GEAR_LEFT, 1.0),
        ("Gear (R) On Ground", "", 1.0, Parameter.GEAR_RIGHT, 1.0),
        # ARINC 429 counts drift from heading to track, this project from track to heading.
        ("DRIFT", "deg", 3.0, Parameter.DRIFT, -np.deg2rad(3.0)),
    ],
)
def test_names_and_units_of_the_trade(
    name: str, unit: str, given: float, parameter: Parameter, expected: float
) -> None:
    rows = "".join(f"{t},{name},{given},{unit}\n" for t in (0, 1))
    channel = only(read(f"t_s,param,value,unit\n{rows}"))
    assert channel.parameter is parameter
    np.testing.assert_allclose(channel.value, expected, rtol=1e-12)


def test_wide_form_keeps_each_columns_own_rate() -> None:
    window = read(
        "t_s;Pitch (deg);vertical_speed_m_s;RALT\n0.00;1.0;-1.0;\n0.25;2.0;;100\n0.50;3.0;-1.5;\n"
    )
    pitch = window.first(Parameter.PITCH)
    speed = window.first(Parameter.VERTICAL_SPEED)
    radio = window.first(Parameter.RADIO_ALTITUDE)
    assert pitch is not None
    assert speed is not None
    assert radio is not None
    np.testing.assert_allclose(np.rad2deg(pitch.value), [1.0, 2.0, 3.0])
    np.testing.assert_allclose(speed.time, [0.0, 0.5])
    np.testing.assert_allclose(radio.value, [100 * FOOT])
    assert "unit_assumed" in codes(window)


def test_general_aviation_log_with_its_line_of_units_and_nz_less_one() -> None:
    window = read(
        '#airframe_info, log_version="1.00"\n'
        "#yyyy-mm-dd, hh:mm:ss, deg, G, kt, enum\n"
        "Lcl Date, Lcl Time, Pitch, NormAc, GndSpd, HSIS\n"
        "2014-05-01, 23:59:59, 2.0, 0.02, 61, GPS\n"
        "2014-05-02, 00:00:00, 2.5, -0.05, 60, GPS\n"
        "2014-05-02, 00:00:01, 2.5, 0.10, 58, GPS\n"
    )
    normal = window.first(Parameter.NORMAL_ACCELERATION)
    assert normal is not None
    np.testing.assert_allclose(normal.value, [1.02, 0.95, 1.10])
    np.testing.assert_allclose(np.diff(normal.time), 1.0)  # over midnight
    assert {"one_g_added", "unknown_column"} <= codes(window)


def test_order_duplicates_gaps_and_missing_samples_are_put_right_and_noted() -> None:
    rows = [(0.0, "1.0"), (0.25, "1.3"), (0.125, "1.1"), (0.125, "1.2"), (0.375, "nan")]
    rows += [(1.5, "1.0"), (1.625, "1.0"), (1.75, "99"), (1.875, "")]
    text = "t_s,param,value,unit\n" + "".join(f"{t},VRTG,{v},g\n" for t, v in rows)
    window = read(text)
    channel = only(window)
    np.testing.assert_allclose(channel.time, [0.0, 0.125, 0.25, 1.5, 1.625])
    np.testing.assert_allclose(channel.value, [1.0, 1.1, 1.3, 1.0, 1.0])
    assert {"unordered", "duplicates", "gap", "missing", "implausible"} <= codes(window)


def test_invalid_samples_are_left_out() -> None:
    window = read("t_s,param,value,unit,valid\n0,VRTG,1.0,g,1\n1,VRTG,3.0,g,0\n2,VRTG,1.0,g,1\n")
    np.testing.assert_allclose(only(window).value, 1.0)


def test_radio_altitude_beyond_its_word_is_unwrapped() -> None:
    true = np.arange(2400.0, 0.0, -50.0)
    shown = (true + 2048) % 4096 - 2048
    rows = "".join(f"{i},RALT,{v},ft\n" for i, v in enumerate(shown))
    window = read(f"t_s,param,value,unit\n{rows}")
    np.testing.assert_allclose(only(window).value, true * FOOT, atol=1e-9)
    assert "overflow" in codes(window)


def test_two_altimeters_in_turn_are_taken_apart() -> None:
    time = np.arange(0.0, 12.0, 0.5)
    height = 20.0 - 1.5 * time + np.where(np.arange(len(time)) % 2, 0.9, -0.9)
    rows = "".join(f"{t},RALT,{h},m\n" for t, h in zip(time, height, strict=True))
    window = read(f"t_s,param,value,unit\n{rows}")
    first, second = window.channels
    np.testing.assert_allclose(first.value, 19.1 - 1.5 * first.time)
    np.testing.assert_allclose(second.value, 20.9 - 1.5 * second.time)
    assert "interleaved" in codes(window)


def test_heading_is_unwrapped() -> None:
    window = read("t_s,HDG\n0,359\n1,1\n2,3\n")
    np.testing.assert_allclose(np.diff(np.rad2deg(only(window).value)), 2.0)


def test_loose_devices_and_transponders_are_refused_with_the_reason() -> None:
    phone = read("t_s,ax,ay,az\n0,0.1,0.2,9.8\n1,0.1,0.2,9.8\n")
    assert phone.channels == ()
    assert "loose device" in phone.notes[0].text
    broadcast = read("t_s,on_ground,vrate_fpm\n0,0,-640\n1,0,-576\n")
    assert only(broadcast).parameter is Parameter.BAROMETRIC_SPEED
    assert "transponder" in broadcast.notes[0].text


HEAD = "t_s,param,value,unit\n"
BAD = {
    "empty": ("", "file: no content"),
    "no time": ("a,b\n1,2\n", "line 1: no time column"),
    "cut off": (HEAD + "0,VRTG,1.0,g\n0.1,VRT", "line 3: 2 fields where the header has 4.*cut off"),
    "comma as decimal point": (HEAD + "0,VRTG,1,02,g\n", "line 2: 5 fields"),
    "word": (HEAD + "0,VRTG,fast,g\n", r"line 2, column 3 \(VRTG\): 'fast'"),
    "wrong unit": (HEAD + "0,VRTG,1.0,ft\n", "unit 'ft' of normal_acceleration.*g, m/s2"),
    "bad time": (HEAD + "noon,VRTG,1.0,g\n", "line 2, column 1: time 'noon'"),
    "formula": (HEAD + '0,VRTG,"=cmd|A1",g\n', "line 2, column 3: a formula '=cmd"),
    "formula with plus": (HEAD + "0,VRTG,+SUM(A1),g\n", "line 2, column 3: a formula"),
    "formula in a name": (HEAD + "0,@x,1.0,g\n", "line 2, column 2: a formula"),
    "words in a known column": ("t_s,Pitch\n0,up\n1,2\n", "line 2, column 2.*'up'"),
    "huge cell": (HEAD + f"0,{'x' * 500},1.0,g\n", "500 characters.*up to 200"),
    "null byte": (HEAD + "0,VRTG,1.\x000,g\n", "line 2: a null byte"),
}


@pytest.mark.parametrize("name", BAD)
def test_file_that_is_no_window_says_where_and_what_is_allowed(name: str) -> None:
    text, message = BAD[name]
    with pytest.raises(FlightDataError, match=message):
        read(text)


def test_wrong_encodings_are_named() -> None:
    with pytest.raises(FlightDataError, match=r"line 2, byte \d+: byte 0xb0 is not UTF-8"):
        read_window((HEAD + "0,VRTG °,1.0,g\n").encode("latin-1"))
    with pytest.raises(FlightDataError, match="UTF-16"):
        read_window((HEAD + "0,VRTG,1.0,g\n").encode("utf-16"))
    assert read_window(("\ufeff" + HEAD + "0,VRTG,1.0,g\n").encode()).channels


def test_packed_files_are_refused_before_anything_is_unpacked() -> None:
    with pytest.raises(FlightDataError, match="a gzip file"):
        read_window(gzip.compress(b"\0" * 10_000_000))
    with pytest.raises(FlightDataError, match="a zip file"):
        read_window(b"PK\x03\x04 and so on")


def test_a_packed_bomb_is_refused_in_bounded_memory() -> None:
    bomb = gzip.compress(b"\0" * 50_000_000)
    tracemalloc.start()
    try:
        with pytest.raises(FlightDataError, match="a gzip file"):
            read_window(bomb)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 2**20  # of the fifty million bytes within


def test_endless_rows_are_refused_in_bounded_memory() -> None:
    rows = b"t_s,VRTG\n" + b"0,1\n" * 2_000_000
    tracemalloc.start()
    try:
        with pytest.raises(FlightDataError, match="more rows"):
            read_window(rows, limits=Limits(rows=1000))
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    # The text and its lines, and nothing of the two million samples (32 bytes each at least).
    assert most < 2_000_000 * 32


def test_ten_gigabytes_are_refused_without_being_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.csv"
    with path.open("wb") as file:
        file.truncate(10 * 2**30)  # sparse: it takes no room
    with pytest.raises(FlightDataError, match=r"10737418240 bytes.*up to 16777216"):
        read_window(path)


def test_rows_and_columns_are_limited() -> None:
    with pytest.raises(FlightDataError, match=r"line 12: more rows.*up to 10 rows"):
        read_window(("t_s,VRTG\n" + "0,1\n" * 20).encode(), limits=Limits(rows=10))
    with pytest.raises(FlightDataError, match=r"400 columns.*up to 300"):
        read("t_s," + ",".join(f"p{i}" for i in range(399)) + "\n")


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(FlightDataError, match=r"nothing.csv: No such file"):
        read_window(tmp_path / "nothing.csv")


@pytest.mark.skipif(find_spec("pyarrow") is not None, reason="the extra is installed")
def test_parquet_without_its_extra_names_it() -> None:
    with pytest.raises(FlightDataError, match=r"pip install 'hardlanding\[parquet\]'"):
        read_window(b"PAR1 something PAR1")


class TestParquet:
    @pytest.fixture(autouse=True)
    def _extra(self) -> None:
        pytest.importorskip("pyarrow.parquet")

    def written(self, table: dict[str, list[object]], tmp_path: Path) -> bytes:
        import pyarrow
        from pyarrow import parquet

        path = tmp_path / "window.parquet"
        parquet.write_table(pyarrow.table(table), path)
        return path.read_bytes()

    def test_long_form(self, tmp_path: Path) -> None:
        content = self.written(
            {
                "t_s": [0.0, 0.5, 1.0],
                "param": ["VRTG", "VRTG", "VRTG"],
                "value": [1.0, None, 1.2],
                "unit": ["g", "g", "g"],
                "valid": [True, True, True],
            },
            tmp_path,
        )
        np.testing.assert_allclose(only(read_window(content)).value, [1.0, 1.2])

    def test_wide_form(self, tmp_path: Path) -> None:
        content = self.written({"t_s": [0.0, 0.5], "Pitch (deg)": [1.0, 2.0]}, tmp_path)
        np.testing.assert_allclose(np.rad2deg(only(read_window(content)).value), [1.0, 2.0])

    def test_cut_off(self, tmp_path: Path) -> None:
        content = self.written({"t_s": [0.0, 0.5], "Pitch": [1.0, 2.0]}, tmp_path)
        with pytest.raises(FlightDataError, match="no Parquet footer"):
            read_window(content[:-10])
        with pytest.raises(FlightDataError, match="damaged Parquet"):
            read_window(content[:40] + content[-8:])

    def test_declared_size_is_checked_before_reading(self, tmp_path: Path) -> None:
        table: dict[str, list[object]] = {"t_s": [0.0] * 1000, "Pitch": [1.0] * 1000}
        content = self.written(table, tmp_path)
        with pytest.raises(FlightDataError, match=r"1000 rows.*up to 100"):
            read_window(content, limits=Limits(rows=100))
