"""Aircraft, their models, and the keys of their operators."""

from collections.abc import Sequence

from sqlalchemy import Engine, select
from sqlalchemy.orm import Session

from app.artefacts.container import Container
from app.audit import service as audit
from app.db import DatabaseTime, new_id, reading, writing
from app.errors import not_found
from app.fleet import mesh, repository
from app.fleet.models import ApiKey, Operator
from app.fleet.registry import AircraftRegistry, RegisteredAircraft
from app.fleet.schemas import AircraftList, AircraftOut, MassGroupOut, ModelOut, ZoneOut
from app.security import Principal, Scope, digest, new_secret, prefix
from solver.aircraft.definition import DEFINITION_FILE, MassGroup


def aircraft_list(engine: Engine, registry: AircraftRegistry, principal: Principal) -> AircraftList:
    with reading(engine) as session:
        tails = repository.tails(session, principal)
    return AircraftList(items=[_aircraft(aircraft, tails) for aircraft in registry.all()])


def _aircraft(aircraft: RegisteredAircraft, tails: Sequence[tuple[str, str]]) -> AircraftOut:
    definition = aircraft.definition
    return AircraftOut(
        name=definition.name,
        title=definition.title,
        disclaimer=definition.disclaimer,
        model_hash=aircraft.content_hash,
        operating_empty_kg=definition.masses.operating_empty,
        maximum_landing_kg=definition.masses.maximum_landing,
        maximum_takeoff_kg=definition.masses.maximum_takeoff,
        tanks=[_group(group) for group in definition.tanks],
        bays=[_group(group) for group in definition.bays],
        gears=[gear.name for gear in definition.gears],
        tails=[tail for name, tail in tails if name == definition.name],
        links={"model": f"/v1/models/{aircraft.content_hash}"},
    )


def _group(group: MassGroup) -> MassGroupOut:
    return MassGroupOut(
        name=group.name, capacity_kg=group.capacity, default_fill=group.default_fill
    )


def remember_models(engine: Engine, registry: AircraftRegistry) -> None:
    """Note every installed model, so that its hash keeps a meaning when it is replaced."""
    for aircraft in registry.all():
        repository.remember_model(
            engine,
            model_hash=aircraft.content_hash,
            aircraft=aircraft.definition.name,
            title=aircraft.definition.title,
            definition=(aircraft.folder / DEFINITION_FILE).read_text(),
        )


def model(engine: Engine, registry: AircraftRegistry, model_hash: str) -> ModelOut:
    installed = registry.by_hash(model_hash)
    with reading(engine) as session:
        known = repository.model(session, model_hash)
    if known is None and installed is not None:
        remember_models(engine, registry)
        with reading(engine) as session:
            known = repository.model(session, model_hash)
    if known is None:
        raise not_found("model", model_hash)
    base = f"/v1/models/{model_hash}"
    return ModelOut(
        hash=known.hash,
        aircraft=known.aircraft,
        title=known.title,
        first_seen_at=known.first_seen_at,
        is_installed=installed is not None,
        definition=known.definition,
        zones=[
            ZoneOut(
                name=zone.name,
                component=zone.component,
                side=zone.side,
                ata_chapter=zone.ata_chapter,
                look_for=zone.look_for,
                access=zone.access,
            )
            for zone in (installed.definition.zones if installed else ())
        ],
        links={"mesh": f"{base}/mesh"} if installed else {},
    )


def mesh_of(registry: AircraftRegistry, model_hash: str) -> tuple[bytes, Container]:
    """Mesh of an installed model, packed and unpacked."""
    aircraft = registry.by_hash(model_hash)
    if aircraft is None:
        raise not_found("installed model", model_hash)
    return mesh.mesh_bytes(aircraft), mesh.mesh(aircraft)


def create_key(engine: Engine, *, operator: str, scopes: frozenset[Scope], label: str = "") -> str:
    """Make a key (and its operator, if new); the answer is the only time the key is seen."""
    secret = new_secret()
    with writing(engine) as session:
        owner = repository.operator_by_name(session, operator) or _new_operator(session, operator)
        key = ApiKey(
            id=new_id(),
            operator_id=owner.id,
            prefix=prefix(secret),
            digest=digest(secret),
            scopes=" ".join(sorted(scopes)),
            label=label,
        )
        session.add(key)
        session.flush()
        audit.record(
            session, operator_id=owner.id, actor="command line", action="key created",
            subject="key", subject_id=key.id, prefix=key.prefix, scopes=key.scopes,
        )  # fmt: skip
    return secret


def _new_operator(session: Session, name: str) -> Operator:
    operator = Operator(id=new_id(), name=name)
    session.add(operator)
    session.flush()
    return operator


def revoke_key(engine: Engine, key_prefix: str) -> bool:
    """Take a key out of use; false if there is none with this prefix."""
    with writing(engine) as session:
        key = repository.key_by_prefix(session, key_prefix)
        if key is None:
            return False
        key.revoked_at = session.execute(select(DatabaseTime())).scalar_one()
        audit.record(
            session, operator_id=key.operator_id, actor="command line", action="key revoked",
            subject="key", subject_id=key.id, prefix=key.prefix,
        )  # fmt: skip
    return True


def list_keys(engine: Engine) -> list[tuple[str, str, str, str, bool]]:
    """Operator, prefix, scopes, label and whether the key is in use."""
    with reading(engine) as session:
        return [
            (operator, key.prefix, key.scopes, key.label, key.revoked_at is None)
            for key, operator in repository.keys(session)
        ]
