"""Queries on operators, keys, tails and airframe models."""

from collections.abc import Sequence

from sqlalchemy import Engine, select
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.db import writing
from app.fleet.models import AirframeModel, ApiKey, Operator
from app.landings.models import Landing
from app.security import Principal
from app.tenancy import scoped


def operator_by_name(session: Session, name: str) -> Operator | None:
    return session.scalars(select(Operator).where(Operator.name == name)).one_or_none()


def key_by_prefix(session: Session, prefix: str) -> ApiKey | None:
    return session.scalars(select(ApiKey).where(ApiKey.prefix == prefix)).one_or_none()


def keys(session: Session) -> Sequence[tuple[ApiKey, str]]:
    statement = select(ApiKey, Operator.name).join(Operator).order_by(ApiKey.created_at)
    return [(key, name) for key, name in session.execute(statement)]


def tails(session: Session, principal: Principal) -> Sequence[tuple[str, str]]:
    """Aircraft name and tail of everything the operator has posted."""
    statement = (
        scoped(principal, Landing)
        .with_only_columns(Landing.aircraft, Landing.tail)
        .where(Landing.tail.is_not(None))
        .distinct()
        .order_by(Landing.tail)
    )
    return [(aircraft, tail) for aircraft, tail in session.execute(statement) if tail]


def model(session: Session, model_hash: str) -> AirframeModel | None:
    return session.get(AirframeModel, model_hash)


def remember_model(
    engine: Engine, *, model_hash: str, aircraft: str, title: str, definition: str
) -> None:
    """Keep a model's identity, unless it is known already."""
    try:
        with writing(engine) as session:
            if session.get(AirframeModel, model_hash) is None:
                session.add(
                    AirframeModel(
                        hash=model_hash, aircraft=aircraft, title=title, definition=definition
                    )
                )
    except IntegrityError:
        return  # another process was first
