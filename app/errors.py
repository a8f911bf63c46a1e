"""Every answer that is not a success is a problem document (RFC 9457).

``type`` is stable and what a program should branch on; ``detail`` is for people; ``errors`` names
each refused field with its value and what is allowed.
"""

import logging
from collections.abc import Sequence
from dataclasses import asdict
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi_problem.error import Problem
from fastapi_problem.handler import add_exception_handler, new_exception_handler
from pydantic import BaseModel, Field

from app.landings.field_errors import FieldError, InvalidRecordError, field_errors

_PREFIX = "urn:hardlanding:problem:"


class FieldProblem(BaseModel):
    """One refused field."""

    field: str
    value: Any
    allowed: str
    message: str


class ProblemDocument(BaseModel):
    """RFC 9457 problem document."""

    type: str = Field(examples=[f"{_PREFIX}invalid-record"])
    title: str
    status: int
    detail: str | None = None
    errors: list[FieldProblem] | None = Field(
        default=None, description="Each refused field, its value and what is allowed."
    )


def problem(
    status: int,
    kind: str,
    title: str,
    detail: str | None = None,
    *,
    errors: Sequence[FieldError] = (),
    headers: dict[str, str] | None = None,
    **extra: Any,
) -> Problem:
    """A problem to raise."""
    if errors:
        extra["errors"] = [asdict(error) for error in errors]
    return Problem(
        title, type_=f"{_PREFIX}{kind}", detail=detail, status=status, headers=headers, **extra
    )


def not_found(what: str, identifier: str) -> Problem:
    """Also for what belongs to another operator: its existence is not disclosed."""
    return problem(404, "not-found", f"No such {what}", f"{what} {identifier!r} is not known")


def invalid_record(errors: Sequence[FieldError]) -> Problem:
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return problem(
        422, "invalid-record", "The request cannot be accepted", f"{errors[0]}{more}",
        errors=errors,
    )  # fmt: skip


def unsupported_type(given: str, allowed: Sequence[str]) -> Problem:
    """For a body in a form that an endpoint does not read."""
    one_of = ", ".join(allowed)
    refused = FieldError("content-type", given, one_of, "is not read here")
    return problem(
        415, "unsupported-media-type", "The body is of another type", str(refused),
        errors=[refused], headers={"Connection": "close"},
    )  # fmt: skip


def responses(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """Problem responses of an endpoint, for the interface description."""
    return {
        status: {
            "description": HTTPStatus(status).phrase,
            "content": {
                "application/problem+json": {
                    "schema": {"$ref": "#/components/schemas/ProblemDocument"}
                }
            },
        }
        for status in statuses
    }


def _validation_problem(_handler: Any, request: Request, error: RequestValidationError) -> Problem:
    route = request.scope.get("route")
    body = getattr(getattr(route, "body_field", None), "field_info", None)
    model = getattr(body, "annotation", None)
    is_model = isinstance(model, type) and issubclass(model, BaseModel)
    return invalid_record(field_errors(error.errors(), model if is_model else None))


def _record_problem(_handler: Any, _request: Request, error: InvalidRecordError) -> Problem:
    return invalid_record(error.errors)


def _http_problem(_handler: Any, _request: Request, error: Any) -> Problem:
    phrase = HTTPStatus(error.status_code).phrase
    kind = phrase.lower().replace(" ", "-")
    detail = None if error.detail == phrase else str(error.detail)
    return problem(error.status_code, kind, phrase, detail, headers=error.headers)


class _InternalProblem(Problem):
    """Says nothing about the inside; the log has the whole story under the request's id."""

    def __init__(self, _detail: str, **_: Any) -> None:
        super().__init__(
            "Internal error", type_=f"{_PREFIX}internal-error", status=500,
            detail="The request failed; its X-Request-ID finds it in the log.",
        )  # fmt: skip


def install(app: FastAPI) -> None:
    """Make the application answer with problem documents only."""
    handler = new_exception_handler(
        logger=logging.getLogger("app.errors"),
        unhandled_wrappers={"default": _InternalProblem},  # type: ignore[dict-item]
        handlers={InvalidRecordError: _record_problem},
        http_exception_handler=_http_problem,
        request_validation_handler=_validation_problem,
    )
    add_exception_handler(app, handler, generic_swagger_defaults=False)
    app.add_exception_handler(InvalidRecordError, handler)
