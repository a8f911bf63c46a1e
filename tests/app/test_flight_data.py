"""Recorder windows posted: understood, turned into records, assessed like them."""

import gzip
import io
import zipfile
from dataclasses import replace
from pathlib import Path

import httpx2
import numpy as np
import pytest

from solver.aircraft.airframe import load_airframe
from solver.flight_data.fleet import SyntheticLanding, synthetic_landing
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import aircraft_geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.window import Channel, Window
from solver.flight_data.writing import long_form
from tests.conftest import Service

FRAME = "business-jet-16"


def flown(aircraft_folder: Path, seed: int) -> SyntheticLanding:
    airframe = load_airframe(aircraft_folder / "mini")
    loading = airframe.loading_for(mass=None, fuel={}, payload={})
    aircraft = airframe.landing_aircraft(loading.factors)
    return synthetic_landing(aircraft, aircraft_geometry(aircraft), packaged_frame(FRAME), seed)


@pytest.fixture(scope="module")
def landing(aircraft_folder: Path) -> SyntheticLanding:
    return flown(aircraft_folder, 21)


@pytest.fixture(scope="module")
def late_nose(aircraft_folder: Path) -> SyntheticLanding:
    """A landing whose nose comes down half a second after the last contact of the main wheels."""
    return flown(aircraft_folder, 22)


def zip_bomb() -> bytes:
    """A thousand times its size once unpacked, which is the most that deflate does."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("window.csv", b"0" * 100_000_000)
    return packed.getvalue()


def post(service: Service, content: str | bytes, **query: str) -> httpx2.Response:
    return service.client.post(
        "/v1/flight-data",
        content=content,
        params={"aircraft": "mini", **query},
        headers={**service.key("alpha", "post"), "Content-Type": "text/csv"},
    )


def exaggerated(window: Window) -> Window:
    """Window whose normal acceleration shows three times what happened after the contact."""

    def swung(channel: Channel) -> Channel:
        if channel.parameter is not Parameter.NORMAL_ACCELERATION:
            return channel
        after = (channel.time > 0.0) & (channel.time < 1.0)
        value = 1.0 + 3.0 * (channel.value - 1.0)
        return replace(channel, value=np.where(after, value, channel.value))

    return replace(window, channels=tuple(swung(channel) for channel in window.channels))


class TestPost:
    def test_a_window_becomes_a_landing_with_its_contacts(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        response = post(service, long_form(landing.window), frame=FRAME, tail="T-7")
        assert response.status_code == 202, response.text
        answer = response.json()
        assert answer["cannot_tell"] == []
        first = answer["contacts"][0]
        assert abs(first["time_s"]) < 0.1  # the synthetic contact is at time 0
        error = first["sink_rate_m_s"] - landing.contact.sink_rate
        assert abs(error) < 4 * first["sink_rate_sd_m_s"]
        assert response.headers["location"] == answer["links"]["assessment"]
        stored = service.get(answer["links"]["landing"]).json()
        assert stored["tail"] == "T-7"
        assert stored["record"]["source"]["frame"] == FRAME
        given = stored["record"]["contacts"][0]
        assert given["sink_rate"]["method"] == "smoother + response"
        # Pressed into the record with its own deviation, not with a default.
        assert stored["sd"]["contacts[0].sink_rate"] == pytest.approx(first["sink_rate_sd_m_s"])

    def test_the_simulated_response_is_checked_against_the_recorded_one(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        answer = post(service, long_form(landing.window), frame=FRAME).json()
        response = answer["contacts"][0]["response"]
        assert response["is_explained"], response["summary"]
        peak = response["peak"]
        assert abs(peak["simulated_posterior_g"] - peak["recorded_g"]) < 0.1
        sink = next(each for each in response["parameters"] if each["name"] == "sink_rate")
        assert sink["unit"] == "m/s"
        assert sink["posterior_sd"] < sink["prior_sd"]
        assert sink["posterior"] == pytest.approx(answer["contacts"][0]["sink_rate_m_s"])
        stored = service.get(answer["links"]["landing"]).json()["inputs"]
        (uncertainty, *_) = stored["uncertainties"]
        assert uncertainty["covariance"][0][0] == pytest.approx(sink["posterior_sd"] ** 2)
        # What is known of the lift's course goes along: it is not drawn anew.
        time = next(each for each in response["parameters"] if each["name"] == "decay_time")
        assert uncertainty["lift_course"][1] == pytest.approx(time["posterior_sd"])

    def test_a_measured_friction_goes_with_the_record(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        known = {"runway_friction": "0.6", "runway_friction_sd": "0.03"}
        answer = post(service, long_form(landing.window), frame=FRAME, **known).json()
        friction = next(
            each
            for each in answer["contacts"][0]["response"]["parameters"]
            if each["name"] == "tyre_friction"
        )
        assert friction["prior_sd"] == pytest.approx(0.05)  # of its logarithm
        stored = service.get(answer["links"]["landing"]).json()
        assert stored["record"]["leg"]["runway_friction"]["value"] == 0.6
        assert stored["inputs"]["runway_friction"] == 0.6
        assert stored["inputs"]["runway_friction_deviation"] == 0.03
        # The same file is the same landing, of which this says something else.
        assert post(service, long_form(landing.window), frame=FRAME).status_code == 409

    def test_a_response_that_cannot_be_explained_is_undetermined(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        text = long_form(exaggerated(landing.window))
        answer = post(service, text, frame=FRAME).json()
        first = answer["contacts"][0]
        assert not first["response"]["is_explained"]
        assert "cannot explain" in first["response_unused_because"]
        service.work()
        result = service.get(answer["links"]["assessment"]).json()["result"]
        reasons = {reason["code"]: reason for reason in result["reasons"]}
        assert "normal acceleration peaked at" in reasons["recorded_response_unexplained"]["text"]
        assert reasons["recorded_response_unexplained"]["verdict"] == "UNDETERMINED"
        assert result["verdict"] in ("UNDETERMINED", "HARD")

    def test_it_is_assessed_as_a_posted_record_is(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        location = post(service, long_form(landing.window), frame=FRAME).headers["location"]
        service.work()
        answer = service.get(location).json()
        assert answer["state"] == "assessed"
        assert answer["result"]["verdict"] != "UNDETERMINED", answer

    def test_its_recorded_peaks_are_held_against_the_makers_rule(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        location = post(service, long_form(landing.window), frame=FRAME).headers["location"]
        service.work()
        rule = service.get(location).json()["result"]["makers_rule"]
        findings = {finding["criterion"]: finding for finding in rule["findings"]}
        for axis, least in (("normal", 1.0), ("lateral", -1.0)):
            assert findings[f"{axis} load factor"]["value"] > least
            assert findings[f"{axis} load factor"]["status"] in ("passed", "exceeded")

    def test_the_peak_of_a_nose_that_comes_down_late_belongs_to_the_last_contact(
        self, service: Service, late_nose: SyntheticLanding
    ) -> None:
        found = post(service, long_form(late_nose.window), frame=FRAME).json()["contacts"]
        (nose,) = [c["time_s"] for c in found if c["kind"] == "derotation"]
        landed = [c["time_s"] for c in found if c["kind"] in ("first", "bounce")]
        assert nose > landed[-1] + 0.1  # the landing is one of that kind

        def struck(channel: Channel) -> Channel:
            if channel.parameter is not Parameter.NORMAL_ACCELERATION:
                return channel
            value = channel.value.copy()
            value[np.argmin(np.abs(channel.time - (nose + 0.5)))] = 2.9
            return replace(channel, value=value)

        window = replace(late_nose.window, channels=tuple(map(struck, late_nose.window.channels)))
        answer = post(service, long_form(window), frame=FRAME).json()
        record = service.get(answer["links"]["landing"]).json()["record"]
        peaks = [contact["nz_peak"]["value"] for contact in record["contacts"]]
        assert peaks[-1] == pytest.approx(2.9)
        assert max(peaks[:-1], default=0.0) < 2.9

    def test_the_same_file_is_the_same_landing(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        one, other = (post(service, long_form(landing.window)).json() for _ in range(2))
        assert one["landing_id"] == other["landing_id"]
        assert other["is_repeated"]

    def test_another_file_under_the_same_identifier_is_a_conflict(
        self, service: Service, landing: SyntheticLanding
    ) -> None:
        text = long_form(landing.window)
        assert post(service, text, record_id="w-1").status_code == 202
        assert post(service, text + "\n", record_id="w-1").status_code == 409


def test_a_window_of_one_sample_a_second_is_undetermined_and_says_why(service: Service) -> None:
    rows = [f"{t},{90 - t},{60 - t / 10},1.0" for t in np.arange(0.0, 60.0)]
    response = post(service, "t_s,RALT,GS,VRTG\n" + "\n".join(rows) + "\n")
    assert response.status_code == 202
    answer = response.json()
    assert answer["contacts"] == []
    assert "slow_normal_acceleration" in {each["code"] for each in answer["cannot_tell"]}
    service.work()
    assessment = service.get(answer["links"]["assessment"]).json()
    result = assessment["result"]
    assert result["verdict"] == "UNDETERMINED"
    text = " ".join(reason["text"] for reason in result["reasons"])
    assert "normal acceleration at 4 Hz or more" in text
    assert "falls between its samples" in text


def transponder_trace() -> str:
    """ADS-B as receivers give it: 25 ft, 64 ft/min (DO-260B), nothing for seconds on the ground."""
    rows = ["t_s,baro_alt_ft,gs_kt,track_deg,vrate_fpm,on_ground"]
    for t in np.arange(-60.0, 20.0, 2.5):
        height = "" if t > 0 else f"{25 * round(12.0 * -t / 25)}"
        speed = f"{64 * round(-700 / 64)}" if t < -4 else "0"
        rows.append(f"{t},{height},{135 + min(-t, 0):.0f},84.3,{speed},{int(t > 6)}")
    return "\n".join(rows) + "\n"


def telephone_log() -> str:
    """A telephone in the cabin: three axes of its own at 2 Hz, pressure and sound."""
    rows = ["t_s,ax,ay,az,pressure_hpa,sound_db"]
    rows += [f"{t},0.4,{0.1 * (t % 3)},9.{int(t) % 9},1008.2,71" for t in np.arange(0, 60, 0.5)]
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize(
    ("content", "reason", "settled_by"),
    [
        (transponder_trace(), "64 ft/min", "radio altitude, or inertial vertical speed"),
        (telephone_log(), "normal acceleration is not recorded", "from the flight recorder"),
    ],
    ids=["transponder", "telephone"],
)
def test_what_cannot_carry_a_verdict_is_undetermined_and_says_what_would_settle_it(
    content: str, reason: str, settled_by: str, service: Service
) -> None:
    response = post(service, content)
    assert response.status_code == 202, response.text
    answer = response.json()
    assert answer["contacts"] == []
    assert any(reason in each["reason"] for each in answer["cannot_tell"])
    assert any(settled_by in each["settled_by"] for each in answer["cannot_tell"])
    service.work()
    result = service.get(answer["links"]["assessment"]).json()["result"]
    assert result["verdict"] == "UNDETERMINED"
    text = " ".join(each["text"] for each in result["reasons"])
    assert reason in text
    assert settled_by in text


@pytest.mark.parametrize(
    ("content", "field", "allowed"),
    [
        (b"t_s,param,value,unit\n0,VRTG,=1+1,g\n", "line 2, column 3", "numbers and names"),
        (b"t_s,param,value,unit\n0,VRTG,1.0,g\n0,VR", "line 3", "4 fields"),
        (b"t_s,param,value,unit\n0,VRTG \xb0,1,g\n", "line 2, byte", "UTF-8"),
        (b"PK\x03\x04....", "byte 0", "not packed"),
        (b"\x1f\x8b....", "byte 0", "not packed"),
        (gzip.compress(b"0" * 100_000_000), "byte 0", "not packed"),
        (zip_bomb(), "byte 0", "not packed"),
        ("t_s,param,value,unit\n0,VRTG,1.0,g\n".encode("utf-16"), "byte 0", "UTF-8"),
        (b"a,b\n1,2\n", "line 1", "t_s"),
    ],
)
def test_a_file_that_is_no_window_is_refused_with_its_place(
    content: bytes, field: str, allowed: str, shared_service: Service
) -> None:
    response = post(shared_service, content)
    assert response.status_code == 422
    (error,) = response.json()["errors"]
    assert field in error["field"]
    assert allowed in error["allowed"]
    assert shared_service.get("/v1/landings").json()["items"] == []  # nothing half stored


def test_unknown_aircraft_and_frame_are_named(shared_service: Service) -> None:
    unknown = post(shared_service, b"t_s,VRTG\n0,1\n", aircraft="no-such")
    assert unknown.json()["errors"][0]["allowed"] == "mini"
    frame = post(shared_service, b"t_s,VRTG\n0,1\n", frame="dc-3")
    assert "737-3c" in frame.json()["errors"][0]["allowed"]


def test_a_window_that_is_too_large_is_refused(shared_service: Service) -> None:
    response = post(shared_service, b"0" * (2 * 2**20))
    assert response.status_code == 413
    assert shared_service.get("/v1/landings").json()["items"] == []


def test_ten_declared_gigabytes_are_refused_by_their_declaration(shared_service: Service) -> None:
    response = shared_service.client.post(
        "/v1/flight-data",
        content=b"t_s,VRTG\n0,1\n",
        params={"aircraft": "mini"},
        headers={
            **shared_service.key("alpha", "post"),
            "Content-Type": "text/csv",
            "Content-Length": str(10 * 2**30),
        },
    )
    assert response.status_code == 413
    assert response.headers["content-type"].startswith("application/problem+json")
    assert shared_service.get("/v1/landings").json()["items"] == []
