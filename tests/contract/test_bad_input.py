"""Whatever is posted, the answer is a problem document that names field, value and range."""

import json
from typing import Any

import pytest

from tests.conftest import Service
from tests.records import changed, contact, record

SINK = "contacts[0].sink_rate"

#: what is wrong, the record, the field named, what its value and its range must mention
BAD_RECORDS: list[tuple[str, Any, str, str, str]] = [
    ("unknown field", record(colour="red"), "colour", "red", "contacts"),
    (
        "unknown field inside",
        changed("contacts.0.sinkrate", 1),
        "contacts[0].sinkrate",
        "1",
        "sink_rate",
    ),
    (
        "not a number",
        changed("contacts.0.sink_rate.value", float("nan")),
        f"{SINK}.value",
        "nan",
        "finite",
    ),
    (
        "infinite",
        changed("contacts.0.sink_rate.value", float("-inf")),
        f"{SINK}.value",
        "-inf",
        "finite",
    ),
    ("wrong unit", changed("contacts.0.sink_rate.unit", "kg"), f"{SINK}.unit", "kg", "ft/min"),
    ("no unit", changed("contacts.0.sink_rate", 6.0), SINK, "6.0", "m/s"),
    (
        "text for a number",
        changed("contacts.0.sink_rate.value", "6"),
        f"{SINK}.value",
        "6",
        "number",
    ),
    (
        "truth for a number",
        changed("contacts.0.sink_rate.value", True),
        f"{SINK}.value",
        "True",
        "number",
    ),
    (
        "negative mass",
        changed("mass.gross_weight.value", -25_000),
        "mass.gross_weight",
        "-25000 lb",
        "0 to",
    ),
    (
        "mass too small",
        changed("mass.gross_weight.value", 9_000),
        "mass.gross_weight",
        "9000 lb",
        "kg",
    ),
    (
        "negative deviation",
        changed("mass.gross_weight.sd", -1),
        "mass.gross_weight.sd",
        "-1",
        "at least 0",
    ),
    (
        "fuel above capacity",
        record(fuel={"wing_left": {"value": 9000, "unit": "kg"}}),
        "fuel.wing_left",
        "9000 kg",
        "0 to 2545.5 kg",
    ),
    (
        "unknown tank",
        record(fuel={"tail": {"value": 1, "unit": "kg"}}),
        "fuel.tail",
        "tail",
        "wing_left",
    ),
    (
        "unknown bay",
        record(payload={"hold": {"value": 1, "unit": "kg"}}),
        "payload.hold",
        "hold",
        "cabin",
    ),
    (
        "pitch 95 degrees",
        changed("contacts.0.pitch.value", 95),
        "contacts[0].pitch",
        "95 deg",
        "-30 to 30 deg",
    ),
    (
        "roll in rad",
        changed("contacts.0.roll", {"value": 3, "unit": "rad"}),
        "contacts[0].roll",
        "3 rad",
        "rad",
    ),
    ("sinking upward", changed("contacts.0.sink_rate.value", -3), SINK, "-3 ft/s", "0 to"),
    ("centre of gravity", changed("mass.cg.value", 150), "mass.cg", "150 %MAC", "-20 to 80 %MAC"),
    (
        "unknown aircraft",
        changed("aircraft.model_id", "zeppelin"),
        "aircraft.model_id",
        "zeppelin",
        "mini",
    ),
    ("no aircraft", {"contacts": [contact()]}, "aircraft", "None", "required"),
    ("no contacts", record(contacts=[]), "contacts", "[]", "at least 1"),
    ("too many contacts", record(contacts=[contact()] * 13), "contacts", "sink_rate", "at most 12"),
    (
        "crew",
        record(crew_report={"hard_landing_suspected": True}),
        "crew_report",
        "not repeated",
        "no crew",
    ),
    (
        "pilot",
        changed("contacts.0.pilot_flying", "x"),
        "contacts[0].pilot_flying",
        "not repeated",
        "no crew",
    ),
    (
        "peak without rate",
        changed("contacts.0.nz_peak", {"value": 1.5, "unit": "g"}),
        "contacts[0].nz_peak.rate_hz",
        "None",
        "required",
    ),
    (
        "number for a time",
        changed("contacts.0.t_utc", 1_700_000_000),
        "contacts[0].t_utc",
        "1700000000",
        "ISO 8601",
    ),
    (
        "time without zone",
        changed("contacts.0.t_utc", "2026-03-01T04:00:00"),
        "contacts[0].t_utc",
        "2026",
        "timezone",
    ),
    (
        "far future",
        changed("contacts.0.t_utc", "2999-01-01T00:00:00Z"),
        "contacts[0].t_utc",
        "2999",
        "1970-01-01 to",
    ),
    (
        "lift twice",
        record(contacts=[contact(lift={}, lift_fraction={"value": 1})]),
        "contacts[0].lift_fraction",
        "1",
        "absent",
    ),
    (
        "trimmed to nothing",
        record(contacts=[contact(lift={"model": "trimmed"})]),
        "contacts[0].lift.normal_acceleration",
        "None",
        "g",
    ),
    ("contacts out of order", record(contacts=[contact(seq=2)]), "contacts[0].seq", "2", "1"),
    (
        "friction of no runway",
        record(leg={"runway_friction": {"value": 3.0}}),
        "leg.runway_friction",
        "3",
        "0.05 to 1.2",
    ),
    (
        "nose wheel down before it touched",
        record(contacts=[contact(nose_wheel_down=True)]),
        "contacts[0].nose_wheel_down",
        "True",
        "false",
    ),
    (
        "nose wheel down and first",
        record(contacts=[contact(), contact(nose_wheel_down=True, first_gear="N")]),
        "contacts[1].first_gear",
        "N",
        "a main gear",
    ),
    ("null byte", record(record_id="a\0b"), "record_id", "a\\0b", "matching"),
    ("half a character", record(record_id="\ud800"), "record_id", "ud800", ""),
    (
        "half a character for a tank",
        record(fuel={"\ud800": {"value": 1, "unit": "kg"}}),
        "fuel",
        "ud800",
        "",
    ),
    ("another operator", record(operator_token="beta"), "operator_token", "beta", "alpha"),
    ("a list", [record()], "body", "aircraft", "object"),
    ("a text", "record", "body", "record", "object"),
    ("nothing", None, "body", "None", "object"),
]


@pytest.mark.parametrize(
    ("body", "field", "value", "allowed"),
    [pytest.param(*case[1:], id=case[0]) for case in BAD_RECORDS],
)
def test_names_field_value_and_range(
    shared_service: Service, body: Any, field: str, value: str, allowed: str
) -> None:
    response = shared_service.client.post(
        "/v1/landings",
        content=json.dumps(body),
        headers={"content-type": "application/json", **shared_service.key("alpha", "post")},
    )
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"
    problem = response.json()
    assert problem["type"] == "urn:hardlanding:problem:invalid-record"
    assert problem["status"] == 422
    assert problem["title"]
    found = [error for error in problem["errors"] if error["field"].startswith(field)]
    assert found, problem["errors"]
    assert value in str(found[0]["value"]) or value in found[0]["field"]
    assert allowed in found[0]["allowed"]
    assert found[0]["field"] in problem["detail"] or len(problem["errors"]) > 1


def test_every_fault_is_named_at_once(shared_service: Service) -> None:
    bad = record(
        fuel={"wing_left": {"value": 9000, "unit": "kg"}, "tail": {"value": 1, "unit": "kg"}}
    )
    errors = shared_service.post(bad).json()["errors"]
    assert {error["field"] for error in errors} == {"fuel.wing_left", "fuel.tail"}


@pytest.mark.parametrize(
    ("content", "content_type"),
    [
        (b"{", "application/json"),
        (b"\xff\xfe", "application/json"),
        (b'{"a": ' + b"9" * 5000 + b"}", "application/json"),
        (b"[" * 100_000, "application/json"),
        (b"aircraft=mini", "application/x-www-form-urlencoded"),
        (b"", "application/json"),
    ],
    ids=["cut off", "not text", "endless number", "deep nesting", "form", "empty"],
)
def test_a_body_that_is_no_json_is_refused(
    shared_service: Service, content: bytes, content_type: str
) -> None:
    headers = {"content-type": content_type, **shared_service.key("alpha", "post")}
    response = shared_service.client.post("/v1/landings", content=content, headers=headers)
    assert response.status_code in (400, 422)
    assert response.headers["content-type"] == "application/problem+json"


def test_a_body_of_fifty_megabytes_is_refused(shared_service: Service) -> None:
    response = shared_service.client.post(
        "/v1/landings",
        content=b" " * 50_000_000,
        headers={"content-type": "application/json", **shared_service.key("alpha", "post")},
    )
    assert response.status_code == 413
    (error,) = response.json()["errors"]
    assert error["field"] == "body"
    assert error["value"] == 50_000_000
    assert str(shared_service.settings.max_body_bytes) in error["allowed"]


def test_a_streamed_body_is_counted(shared_service: Service) -> None:
    response = shared_service.client.post(
        "/v1/landings",
        content=(b" " * 100_000 for _ in range(20)),
        headers={"content-type": "application/json", **shared_service.key("alpha", "post")},
    )
    assert response.status_code == 413


@pytest.mark.parametrize(
    "path",
    [
        "/v1/landings?limit=0",
        "/v1/landings?limit=1000",
        "/v1/landings?cursor=nonsense",
        "/v1/landings?cursor=WzEsMl0",
        "/v1/landings?tail=%00",
        "/v1/landings?verdict=FINE",
        "/v1/landings?colour=red",
        "/v1/landings?from=yesterday",
        "/v1/landings/1",
        "/v1/assessments/x",
        "/v1/models/abc",
    ],
)
def test_bad_questions_are_refused(shared_service: Service, path: str) -> None:
    response = shared_service.get(path)
    assert response.status_code == 422
    (error,) = response.json()["errors"]
    assert set(error) == {"field", "value", "allowed", "message"}


@pytest.mark.parametrize("path", ["/nowhere", "/v1", "/v1/landings/"])
def test_unknown_addresses_are_problems(shared_service: Service, path: str) -> None:
    response = shared_service.client.get(path, follow_redirects=False)
    assert response.status_code in (404, 307)
    if response.status_code == 404:
        assert response.headers["content-type"] == "application/problem+json"


def test_a_wrong_method_is_a_problem(shared_service: Service) -> None:
    response = shared_service.client.delete("/v1/landings")
    assert response.status_code == 405
    assert response.headers["content-type"] == "application/problem+json"
