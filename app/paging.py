"""Keyset pages: a cursor names the last row seen, so pages neither skip nor repeat rows."""

import base64
import binascii
import json
from datetime import datetime
from typing import Annotated, Generic, TypeVar

from pydantic import BaseModel, Field

from app.landings.field_errors import FieldError, InvalidRecordError

LARGEST_PAGE = 200

T = TypeVar("T")


class Page(BaseModel, Generic[T]):
    """A page of results; ``next`` is absent on the last one."""

    items: list[T]
    next: str | None = Field(default=None, description="Cursor of the next page.")


Cursor = Annotated[str | None, Field(max_length=200, description="`next` of the page before.")]
Limit = Annotated[int, Field(ge=1, le=LARGEST_PAGE)]


def encode_cursor(moment: datetime, identifier: str) -> str:
    text = json.dumps([moment.isoformat(), identifier])
    return base64.urlsafe_b64encode(text.encode()).decode().rstrip("=")


def decode_cursor(cursor: str) -> tuple[datetime, str]:
    """Position a cursor stands for; raises `InvalidRecordError` for one that was never given."""
    try:
        padded = cursor + "=" * (-len(cursor) % 4)
        moment, identifier = json.loads(base64.b64decode(padded, altchars=b"-_", validate=True))
        position = datetime.fromisoformat(moment), str(identifier)
        if position[0].tzinfo is None or not position[1].replace("-", "").isalnum():
            raise ValueError("not a position")
    except (ValueError, TypeError, binascii.Error) as error:
        refused = FieldError("cursor", cursor, "`next` of an earlier page", "not a cursor")
        raise InvalidRecordError([refused]) from error
    return position
