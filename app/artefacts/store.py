"""Where artefacts live; in the database, so that they come and go with their verdict."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Protocol

from sqlalchemy import select
from sqlalchemy.orm import Session

from app.artefacts.container import decompress
from app.artefacts.models import Artefact
from app.rows import insert_rows


@dataclass(frozen=True, slots=True)
class KeptArtefact:
    """A packed set of arrays, compressed, on its way into a store."""

    assessment_id: str
    kind: str
    body: bytes


class ArtefactStore(Protocol):
    """Two methods, so that an object store can take over where terabytes gather."""

    def put(self, artefacts: Sequence[KeptArtefact]) -> None:
        """Keep artefacts."""

    def get(self, assessment_id: str, kind: str) -> bytes | None:
        """The artefact, unpacked from its compression, or None if it was not kept."""


class DatabaseStore:
    """Artefacts as compressed blobs, written in the session's own transaction."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def put(self, artefacts: Sequence[KeptArtefact]) -> None:
        insert_rows(self._session, Artefact, [asdict(kept) for kept in artefacts])

    def get(self, assessment_id: str, kind: str) -> bytes | None:
        body = self._session.scalar(
            select(Artefact.body).where(
                Artefact.assessment_id == assessment_id, Artefact.kind == kind
            )
        )
        return None if body is None else decompress(body)
