"""`hardlanding key create | list | revoke`"""

from collections.abc import Sequence
from typing import Annotated

import typer

from app.config import Settings, get_settings
from app.db import get_engine, make_engine
from app.fleet import service
from app.security import Scope

key = typer.Typer(no_args_is_help=True)


@key.command()
def create(
    operator: Annotated[str, typer.Option(help="Airline that the key belongs to; made if new.")],
    scopes: Annotated[
        str, typer.Option(help=f"Comma-separated: {', '.join(Scope)}.")
    ] = "post,read",
    label: Annotated[str, typer.Option(help="What the key is for.")] = "",
) -> None:
    """Make a key and print it; it is never shown again."""
    names = [name.strip() for name in scopes.split(",") if name.strip()]
    unknown = [name for name in names if name not in set(Scope)]
    if unknown or not names:
        wrong = ", ".join(unknown) or "none given"
        typer.echo(f"Unknown scope: {wrong}. Scopes are: {', '.join(Scope)}.", err=True)
        raise typer.Exit(2)
    typer.echo(create_key(get_settings(), operator=operator, scopes=names, label=label))


def create_key(settings: Settings, *, operator: str, scopes: Sequence[str], label: str = "") -> str:
    """Make a key in the database of these settings."""
    engine = make_engine(settings.sqlalchemy_url)
    try:
        return service.create_key(
            engine,
            operator=operator,
            scopes=frozenset(Scope(name) for name in scopes),
            label=label,
        )
    finally:
        engine.dispose()


@key.command(name="list")
def list_keys() -> None:
    """Show every key's operator, prefix, scopes and state."""
    for operator, prefix, scopes, label, is_in_use in service.list_keys(get_engine()):
        state = "in use" if is_in_use else "revoked"
        typer.echo(f"{operator}\t{prefix}...\t{scopes}\t{state}\t{label}")


@key.command()
def revoke(prefix: Annotated[str, typer.Argument(help="The first characters of the key.")]) -> None:
    """Take a key out of use."""
    if not service.revoke_key(get_engine(), prefix):
        typer.echo(f"There is no key with the prefix {prefix!r}.", err=True)
        raise typer.Exit(1)
    typer.echo(f"Key {prefix}... is revoked.")
