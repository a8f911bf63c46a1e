"""API keys, scopes and the operator behind a request.

A key is 256 random bits, so its plain SHA-256 is a safe thing to store and look up; a slow
password hash would only slow the service down.
"""

import hashlib
import secrets
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated

from fastapi import Request, Security
from fastapi.security import APIKeyHeader, SecurityScopes
from sqlalchemy import select

from app.db import reading
from app.errors import problem
from app.fleet.models import ApiKey, Operator

API_KEY_HEADER = "X-API-Key"


class Scope(StrEnum):
    """What a key may do."""

    POST = "post"  #: hand in landings
    READ = "read"  #: see landings, assessments, aircraft
    REVIEW = "review"  #: act on assessments
    ADMIN = "admin"  #: keys and operators


@dataclass(frozen=True, slots=True)
class Principal:
    """Who is asking."""

    operator_id: str
    operator: str
    key_prefix: str
    scopes: frozenset[str]

    @property
    def actor(self) -> str:
        return f"key:{self.key_prefix}"


def new_secret() -> str:
    """A fresh key as its holder sees it, once."""
    return f"hl_{secrets.token_urlsafe(32)}"


def digest(secret: str) -> str:
    return hashlib.sha256(secret.encode("utf-8", "surrogateescape")).hexdigest()


def prefix(secret: str) -> str:
    """The part of a key that may be shown and logged."""
    return secret[:10]


_header = APIKeyHeader(
    name=API_KEY_HEADER, auto_error=False, description="Key made by `hardlanding key create`."
)


def authenticate(
    request: Request,
    needed: SecurityScopes,
    secret: Annotated[str | None, Security(_header)],
) -> Principal:
    """The holder of the request's key, if the key has every scope the endpoint needs."""
    if secret is None:
        raise problem(
            401, "unauthenticated", "A key is needed", f"send it in the {API_KEY_HEADER} header",
            headers={"WWW-Authenticate": "ApiKey"},
        )  # fmt: skip
    with reading(request.app.state.context.engine) as session:
        row = session.execute(
            select(ApiKey.prefix, ApiKey.scopes, Operator.id, Operator.name)
            .join(Operator, Operator.id == ApiKey.operator_id)
            .where(ApiKey.digest == digest(secret), ApiKey.revoked_at.is_(None))
        ).one_or_none()
    if row is None:
        raise problem(
            401, "unauthenticated", "The key is not known", "it is mistyped or was revoked",
            headers={"WWW-Authenticate": "ApiKey"},
        )  # fmt: skip
    principal = Principal(row.id, row.name, row.prefix, frozenset(row.scopes.split()))
    lacking = [scope for scope in needed.scopes if scope not in principal.scopes]
    if lacking:
        raise problem(
            403, "missing-scope", "The key lacks a scope",
            f"needed: {', '.join(lacking)}; the key has: {', '.join(sorted(principal.scopes))}",
        )  # fmt: skip
    return principal


Poster = Annotated[Principal, Security(authenticate, scopes=[Scope.POST])]
Reader = Annotated[Principal, Security(authenticate, scopes=[Scope.READ])]
Reviewer = Annotated[Principal, Security(authenticate, scopes=[Scope.REVIEW])]
