"""Runs migrations; called by Alembic."""

from alembic import context
from sqlalchemy import text

from app.config import get_settings
from app.db import make_engine
from app.models import Base

#: Any number does, as long as every replica takes the same one.
_ADVISORY_LOCK = 7_310_284

url = context.config.attributes.get("url") or get_settings().sqlalchemy_url
engine = make_engine(url).execution_options(writes=True)

with engine.connect() as connection:
    context.configure(
        connection=connection,
        target_metadata=Base.metadata,
        # SQLite cannot alter a table; a batch rebuilds it.
        render_as_batch=True,
        transactional_ddl=True,
        compare_type=True,
    )
    with context.begin_transaction():
        if connection.dialect.name == "postgresql":
            # Several replicas may start at once; the others wait here and find nothing to do.
            connection.execute(text(f"SELECT pg_advisory_xact_lock({_ADVISORY_LOCK})"))
        context.run_migrations()
engine.dispose()
