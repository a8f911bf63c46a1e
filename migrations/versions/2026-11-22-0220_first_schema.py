"""first schema"""

import sqlalchemy as sa
from alembic import op

import app.db

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "airframe_model",
        sa.Column("hash", sa.String(length=64), nullable=False),
        sa.Column("aircraft", sa.String(length=100), nullable=False),
        sa.Column("title", sa.Text(), nullable=False),
        sa.Column("definition", sa.Text(), nullable=False),
        sa.Column("first_seen_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("hash", name=op.f("pk_airframe_model")),
    )
    op.create_index("ix_airframe_model_aircraft", "airframe_model", ["aircraft"], unique=False)

    op.create_table(
        "operator",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("name", sa.String(length=100), nullable=False),
        sa.Column("created_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_operator")),
        sa.UniqueConstraint("name", name=op.f("uq_operator_name")),
    )
    op.create_table(
        "api_key",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("operator_id", sa.String(length=36), nullable=False),
        sa.Column("prefix", sa.String(length=12), nullable=False),
        sa.Column("digest", sa.String(length=64), nullable=False),
        sa.Column("scopes", sa.String(length=100), nullable=False),
        sa.Column("label", sa.String(length=100), nullable=False),
        sa.Column("created_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.Column("revoked_at", app.db.UtcDateTime(timezone=True), nullable=True),
        sa.ForeignKeyConstraint(
            ["operator_id"], ["operator.id"], name=op.f("fk_api_key_operator_id_operator")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_api_key")),
        sa.UniqueConstraint("digest", name=op.f("uq_api_key_digest")),
    )
    op.create_index("ix_api_key_operator_id", "api_key", ["operator_id"], unique=False)

    op.create_table(
        "audit_entry",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("operator_id", sa.String(length=36), nullable=False),
        sa.Column("at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.Column("actor", sa.String(length=100), nullable=False),
        sa.Column("action", sa.String(length=40), nullable=False),
        sa.Column("subject", sa.String(length=20), nullable=False),
        sa.Column("subject_id", sa.String(length=36), nullable=False),
        sa.Column("model_hash", sa.String(length=64), nullable=True),
        sa.Column("program_version", sa.String(length=60), nullable=True),
        sa.Column("detail", sa.JSON(), nullable=False),
        sa.ForeignKeyConstraint(
            ["operator_id"], ["operator.id"], name=op.f("fk_audit_entry_operator_id_operator")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_audit_entry")),
    )
    op.create_index("ix_audit_entry_operator_id", "audit_entry", ["operator_id"], unique=False)
    op.create_index(
        "ix_audit_entry_subject", "audit_entry", ["subject", "subject_id", "at"], unique=False
    )

    op.create_table(
        "landing",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("operator_id", sa.String(length=36), nullable=False),
        sa.Column("record_id", sa.String(length=110), nullable=False),
        sa.Column("body_digest", sa.String(length=64), nullable=False),
        sa.Column("aircraft", sa.String(length=100), nullable=False),
        sa.Column("tail", sa.String(length=100), nullable=True),
        sa.Column("touchdown_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.Column("received_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.Column("record", sa.JSON(), nullable=False),
        sa.Column("inputs", sa.JSON(), nullable=False),
        sa.Column("sd", sa.JSON(), nullable=False),
        sa.Column("sd_defaulted", sa.JSON(), nullable=False),
        sa.Column("taken_as_zero", sa.JSON(), nullable=False),
        sa.ForeignKeyConstraint(
            ["operator_id"], ["operator.id"], name=op.f("fk_landing_operator_id_operator")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_landing")),
        sa.UniqueConstraint(
            "operator_id", "record_id", name=op.f("uq_landing_operator_id_record_id")
        ),
    )
    op.create_index(
        "ix_landing_operator_id_tail",
        "landing",
        ["operator_id", "tail", "touchdown_at"],
        unique=False,
    )
    op.create_index(
        "ix_landing_operator_id_touchdown_at_id",
        "landing",
        ["operator_id", "touchdown_at", "id"],
        unique=False,
    )

    op.create_table(
        "assessment",
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("operator_id", sa.String(length=36), nullable=False),
        sa.Column("landing_id", sa.String(length=36), nullable=False),
        sa.Column("lane", sa.SmallInteger(), nullable=False),
        sa.Column("state", sa.String(length=10), nullable=False),
        sa.Column("attempts", sa.Integer(), nullable=False),
        sa.Column("token", sa.String(length=36), nullable=True),
        sa.Column("lease_until", app.db.UtcDateTime(timezone=True), nullable=True),
        sa.Column("created_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.Column("started_at", app.db.UtcDateTime(timezone=True), nullable=True),
        sa.Column("finished_at", app.db.UtcDateTime(timezone=True), nullable=True),
        sa.Column("worker", sa.String(length=100), nullable=True),
        sa.Column("last_error", sa.Text(), nullable=True),
        sa.Column("version", sa.Integer(), nullable=False),
        sa.ForeignKeyConstraint(
            ["landing_id"], ["landing.id"], name=op.f("fk_assessment_landing_id_landing")
        ),
        sa.ForeignKeyConstraint(
            ["operator_id"], ["operator.id"], name=op.f("fk_assessment_operator_id_operator")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_assessment")),
        sa.UniqueConstraint("landing_id", name=op.f("uq_assessment_landing_id")),
    )
    op.create_index(
        "ix_assessment_pending",
        "assessment",
        ["lane", "created_at", "id"],
        unique=False,
        postgresql_where=sa.text("state IN ('queued', 'running')"),
        sqlite_where=sa.text("state IN ('queued', 'running')"),
    )

    op.create_table(
        "idempotency_key",
        sa.Column("operator_id", sa.String(length=36), nullable=False),
        sa.Column("key", sa.String(length=255), nullable=False),
        sa.Column("body_digest", sa.String(length=64), nullable=False),
        sa.Column("landing_id", sa.String(length=36), nullable=False),
        sa.Column("expires_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(
            ["landing_id"], ["landing.id"], name=op.f("fk_idempotency_key_landing_id_landing")
        ),
        sa.ForeignKeyConstraint(
            ["operator_id"], ["operator.id"], name=op.f("fk_idempotency_key_operator_id_operator")
        ),
        sa.PrimaryKeyConstraint("operator_id", "key", name=op.f("pk_idempotency_key")),
    )
    op.create_index(
        "ix_idempotency_key_expires_at", "idempotency_key", ["expires_at"], unique=False
    )

    op.create_table(
        "artefact",
        sa.Column("assessment_id", sa.String(length=36), nullable=False),
        sa.Column("kind", sa.String(length=40), nullable=False),
        sa.Column("body", sa.LargeBinary(), nullable=False),
        sa.Column("created_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(
            ["assessment_id"], ["assessment.id"], name=op.f("fk_artefact_assessment_id_assessment")
        ),
        sa.PrimaryKeyConstraint("assessment_id", "kind", name=op.f("pk_artefact")),
    )
    op.create_table(
        "hot_spot",
        sa.Column("assessment_id", sa.String(length=36), nullable=False),
        sa.Column("rank", sa.Integer(), nullable=False),
        sa.Column("component", sa.String(length=200), nullable=False),
        sa.Column("zone", sa.String(length=200), nullable=False),
        sa.Column("side", sa.String(length=20), nullable=False),
        sa.Column("element", sa.Integer(), nullable=False),
        sa.Column("element_kind", sa.String(length=20), nullable=False),
        sa.Column("x", sa.Float(), nullable=False),
        sa.Column("y", sa.Float(), nullable=False),
        sa.Column("z", sa.Float(), nullable=False),
        sa.Column("peak_stress", sa.Float(), nullable=False),
        sa.Column("allowable", sa.Float(), nullable=False),
        sa.Column("utilisation", sa.Float(), nullable=False),
        sa.Column("margin", sa.Float(), nullable=True),
        sa.Column("time", sa.Float(), nullable=False),
        sa.Column("contact", sa.Integer(), nullable=False),
        sa.Column("ata_chapter", sa.String(length=20), nullable=False),
        sa.Column("inspection", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(
            ["assessment_id"], ["assessment.id"], name=op.f("fk_hot_spot_assessment_id_assessment")
        ),
        sa.PrimaryKeyConstraint("assessment_id", "rank", name=op.f("pk_hot_spot")),
    )
    op.create_table(
        "verdict",
        sa.Column("assessment_id", sa.String(length=36), nullable=False),
        sa.Column("operator_id", sa.String(length=36), nullable=False),
        sa.Column("landing_id", sa.String(length=36), nullable=False),
        sa.Column("verdict", sa.String(length=12), nullable=False),
        sa.Column("is_provisional", sa.Boolean(), nullable=False),
        sa.Column("probability_limit_exceeded", sa.Float(), nullable=True),
        sa.Column("driving_contact", sa.Integer(), nullable=True),
        sa.Column("worst_utilisation", sa.Float(), nullable=True),
        sa.Column("worst_margin", sa.Float(), nullable=True),
        sa.Column("peak_normal_load_factor", sa.Float(), nullable=True),
        sa.Column("energy_error", sa.Float(), nullable=True),
        sa.Column("equilibrium_residual", sa.Float(), nullable=True),
        sa.Column("reasons", sa.JSON(), nullable=False),
        sa.Column("gear_loads", sa.JSON(), nullable=False),
        sa.Column("notes", sa.JSON(), nullable=False),
        sa.Column("timing", sa.JSON(), nullable=True),
        sa.Column("advisory", sa.Text(), nullable=False),
        sa.Column("model_hash", sa.String(length=64), nullable=False),
        sa.Column("program_version", sa.String(length=60), nullable=False),
        sa.Column("inputs", sa.JSON(), nullable=False),
        sa.Column("created_at", app.db.UtcDateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(
            ["assessment_id"], ["assessment.id"], name=op.f("fk_verdict_assessment_id_assessment")
        ),
        sa.ForeignKeyConstraint(
            ["landing_id"], ["landing.id"], name=op.f("fk_verdict_landing_id_landing")
        ),
        sa.ForeignKeyConstraint(
            ["operator_id"], ["operator.id"], name=op.f("fk_verdict_operator_id_operator")
        ),
        sa.PrimaryKeyConstraint("assessment_id", name=op.f("pk_verdict")),
    )
    op.create_index("ix_verdict_landing_id", "verdict", ["landing_id"], unique=False)
    op.create_index(
        "ix_verdict_operator_id_verdict", "verdict", ["operator_id", "verdict"], unique=False
    )
    if op.get_bind().dialect.name == "postgresql":
        # The arrays come compressed; a second attempt would only cost time.
        op.execute("ALTER TABLE artefact ALTER COLUMN body SET STORAGE EXTERNAL")


def downgrade() -> None:

    op.drop_table("verdict")
    op.drop_table("hot_spot")
    op.drop_table("artefact")

    op.drop_table("idempotency_key")

    op.drop_table("assessment")

    op.drop_table("landing")

    op.drop_table("audit_entry")

    op.drop_table("api_key")
    op.drop_table("operator")

    op.drop_table("airframe_model")
