"""makers' rules and the action"""

import sqlalchemy as sa
from alembic import op

revision = "makers_rules"
down_revision = "0002"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("verdict", sa.Column("action", sa.String(length=12), nullable=True))
    op.add_column("verdict", sa.Column("rule_difference", sa.String(length=20), nullable=True))
    op.add_column("verdict", sa.Column("makers_rule", sa.JSON(), nullable=True))
    # No rule was known to the program that gave the earlier verdicts.
    op.execute("UPDATE verdict SET action = verdict, rule_difference = 'no_rule'")
    with op.batch_alter_table("verdict") as table:
        table.alter_column("action", existing_type=sa.String(length=12), nullable=False)
        table.alter_column("rule_difference", existing_type=sa.String(length=20), nullable=False)


def downgrade() -> None:
    with op.batch_alter_table("verdict") as table:
        table.drop_column("makers_rule")
        table.drop_column("rule_difference")
        table.drop_column("action")
