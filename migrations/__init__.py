"""The history of the schema: one chain for SQLite and Postgres."""
