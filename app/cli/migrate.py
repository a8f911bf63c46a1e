"""`hardlanding migrate`"""

import typer

from app import migrate as migration
from app.config import Settings, get_settings


def migrate() -> None:
    """Bring the database to the newest schema."""
    upgrade(get_settings())
    typer.echo(f"The database is at revision {migration.head()}.")


def upgrade(settings: Settings) -> None:
    """Make the database if it is a file that is not there yet, and bring it up to date."""
    if settings.database_url is None:
        settings.var.mkdir(parents=True, exist_ok=True)
    migration.upgrade(settings.sqlalchemy_url)
