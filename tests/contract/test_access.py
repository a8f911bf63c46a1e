"""Who may do what: every endpoint against no key, a key without the scope, and a foreign key."""

import pytest

from app.cli.key import create_key
from app.fleet.service import revoke_key
from tests.conftest import Service
from tests.records import record

UNKNOWN = "00000000-0000-7000-8000-000000000000"

#: method, path, scope needed
ENDPOINTS = [
    ("POST", "/v1/landings", "post"),
    ("POST", "/v1/flight-data", "post"),
    ("POST", "/v1/landings/bulk", "post"),
    ("GET", "/v1/landings", "read"),
    ("GET", "/v1/landings/{landing}", "read"),
    ("GET", "/v1/assessments/{assessment}", "read"),
    ("POST", "/v1/assessments/{assessment}/retry", "review"),
    ("GET", "/v1/assessments/{assessment}/hot-spots", "read"),
    ("GET", "/v1/assessments/{assessment}/histories", "read"),
    ("GET", "/v1/assessments/{assessment}/peak-field", "read"),
    ("GET", "/v1/aircraft", "read"),
    ("GET", "/v1/models/{model}", "read"),
    ("GET", "/v1/models/{model}/mesh", "read"),
]
OPEN = ["/healthz", "/readyz", "/metrics"]
SCOPES = ("post", "read", "review", "admin")


def test_every_endpoint_is_listed_here(shared_service: Service) -> None:
    described = {
        (method.upper(), path)
        for path, methods in shared_service.client.get("/openapi.json").json()["paths"].items()
        for method in methods
    }
    names = {"{landing_id}": "{landing}", "{assessment_id}": "{assessment}"}
    names["{model_hash}"] = "{model}"
    for old, new in names.items():
        described = {(method, path.replace(old, new)) for method, path in described}
    assert described == {(m, p) for m, p, _ in ENDPOINTS} | {("GET", path) for path in OPEN}


@pytest.mark.parametrize(("method", "path", "scope"), ENDPOINTS)
class TestAccess:
    def test_anonymous(self, shared_service: Service, method: str, path: str, scope: str) -> None:
        response = shared_service.client.request(method, _filled(path), json=record())
        assert response.status_code == 401
        assert response.json()["type"] == "urn:hardlanding:problem:unauthenticated"
        assert response.headers["www-authenticate"]

    def test_unknown_key(self, shared_service: Service, method: str, path: str, scope: str) -> None:
        headers = {"X-API-Key": "hl_nobody"}
        response = shared_service.client.request(
            method, _filled(path), json=record(), headers=headers
        )
        assert response.status_code == 401

    def test_missing_scope(
        self, shared_service: Service, method: str, path: str, scope: str
    ) -> None:
        others = [other for other in SCOPES if other != scope]
        headers = shared_service.key("alpha", *others)
        response = shared_service.client.request(
            method, _filled(path), json=record(), headers=headers
        )
        assert response.status_code == 403
        problem = response.json()
        assert problem["type"] == "urn:hardlanding:problem:missing-scope"
        assert f"needed: {scope}" in problem["detail"]


def _filled(path: str) -> str:
    return path.format(landing=UNKNOWN, assessment=UNKNOWN, model="0" * 64)


def test_foreign_landings_do_not_exist(service: Service) -> None:
    own = service.post(record()).json()
    service.work()
    stranger = service.key("beta", "read", "review")
    for path in own["links"].values():
        assert service.get(path).status_code == 200
        foreign = service.get(path, headers=stranger)
        unknown = service.get(_unknown(path), headers=stranger)
        assert foreign.status_code == unknown.status_code == 404
        assert foreign.json()["type"] == unknown.json()["type"]
    retry = service.client.post(f"{own['links']['assessment']}/retry", headers=stranger)
    assert retry.status_code == 404
    assert service.get("/v1/landings", headers=stranger).json()["items"] == []
    (mini,) = service.get("/v1/aircraft", headers=stranger).json()["items"]
    assert mini["tails"] == []


def _unknown(path: str) -> str:
    parts = path.split("/")
    parts[3] = UNKNOWN
    return "/".join(parts)


def test_operators_may_use_the_same_record_id(service: Service) -> None:
    first = service.post(record(record_id="r-1")).json()
    second = service.post(record(record_id="r-1"), headers=service.key("beta", "post")).json()
    assert first["landing_id"] != second["landing_id"]
    assert not second["is_repeated"]


def test_a_conditional_request_does_not_disclose_a_foreign_assessment(service: Service) -> None:
    location = service.post(record()).headers["Location"]
    headers = {
        **service.key("beta", "read"),
        "If-None-Match": service.get(location).headers["etag"],
    }
    assert service.get(location, headers=headers).status_code == 404


def test_a_revoked_key_is_dead_at_once(service: Service) -> None:
    secret = create_key(service.settings, operator="alpha", scopes=("read",))
    headers = {"X-API-Key": secret}
    assert service.get("/v1/aircraft", headers=headers).status_code == 200
    assert revoke_key(service.engine, secret[:10])
    assert service.get("/v1/aircraft", headers=headers).status_code == 401


@pytest.mark.parametrize("path", OPEN)
def test_health_needs_no_key(service: Service, path: str) -> None:
    assert service.client.get(path).status_code == 200
