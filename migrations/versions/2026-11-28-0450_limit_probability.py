"""probability that a limit was exceeded, with its sampling error, per landing and hot spot"""

import sqlalchemy as sa
from alembic import op

revision = "limit_probability"
down_revision = "provisional_verdicts"
branch_labels = None
depends_on = None

_OF_SPOTS = ("probability_limit_exceeded", "probability_standard_error")


def upgrade() -> None:
    op.add_column("verdict", sa.Column("limit_probability", sa.JSON(), nullable=True))
    for name in _OF_SPOTS:
        op.add_column("hot_spot", sa.Column(name, sa.Float(), nullable=True))


def downgrade() -> None:
    with op.batch_alter_table("hot_spot") as table:
        for name in _OF_SPOTS:
            table.drop_column(name)
    with op.batch_alter_table("verdict") as table:
        table.drop_column("limit_probability")
