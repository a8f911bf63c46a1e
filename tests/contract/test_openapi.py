"""The interface changes only on purpose."""

import json
from typing import Any

from tests.contract.snapshot import SNAPSHOT, interface


def described() -> dict[str, Any]:
    document: dict[str, Any] = json.loads(SNAPSHOT.read_text())
    return document


def operations() -> list[dict[str, Any]]:
    return [op for methods in described()["paths"].values() for op in methods.values()]


def test_the_interface_is_as_committed() -> None:
    assert interface() == SNAPSHOT.read_text(), "meant? then run `make openapi` and review the diff"


def test_every_operation_has_a_name_of_its_own_and_says_what_it_does() -> None:
    names = [operation["operationId"] for operation in operations()]
    assert len(set(names)) == len(names)
    assert all(operation["description"] for operation in operations())


def test_refusals_are_problem_documents() -> None:
    for operation in operations():
        for status, response in operation["responses"].items():
            if status.startswith("4"):
                assert set(response["content"]) == {"application/problem+json"}, operation


def test_every_reference_leads_somewhere() -> None:
    text = SNAPSHOT.read_text()
    schemas = described()["components"]["schemas"]
    references = {part.split('"')[0] for part in text.split("#/components/schemas/")[1:]}
    assert references <= set(schemas)


def test_units_and_keys_are_described() -> None:
    schemas = described()["components"]["schemas"]
    assert schemas["SinkRate"]["properties"]["unit"]["enum"] == [
        "m/s", "ft/s", "ft/min", "kt", "km/h",
    ]  # fmt: skip
    assert schemas["TouchdownRecordIn"]["examples"]
    (scheme,) = described()["components"]["securitySchemes"].values()
    assert (scheme["type"], scheme["in"], scheme["name"]) == ("apiKey", "header", "X-API-Key")
