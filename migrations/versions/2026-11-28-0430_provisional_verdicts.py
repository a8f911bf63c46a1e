"""provisional verdicts"""

import sqlalchemy as sa
from alembic import op

revision = "provisional_verdicts"
down_revision = "makers_rules"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("assessment", sa.Column("provisional", sa.JSON(), nullable=True))
    op.add_column("verdict", sa.Column("provisional_differs", sa.Boolean(), nullable=True))


def downgrade() -> None:
    with op.batch_alter_table("verdict") as table:
        table.drop_column("provisional_differs")
    with op.batch_alter_table("assessment") as table:
        table.drop_column("provisional")
