"""Where artefacts live; in the database, so that they come and go with their verdict."""

from typing import Protocol

from sqlalchemy import select
from sqlalchemy.orm import Session

from app.artefacts.container import compress, decompress
from app.artefacts.models import Artefact


class ArtefactStore(Protocol):
    """Two methods, so that an object store can take over where terabytes gather."""

    def put(self, assessment_id: str, kind: str, data: bytes) -> None:
        """Keep an artefact."""

    def get(self, assessment_id: str, kind: str) -> bytes | None:
        """The artefact, or None if it was not kept."""


class DatabaseStore:
    """Artefacts as compressed blobs, written in the session's own transaction."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def put(self, assessment_id: str, kind: str, data: bytes) -> None:
        self._session.add(Artefact(assessment_id=assessment_id, kind=kind, body=compress(data)))

    def get(self, assessment_id: str, kind: str) -> bytes | None:
        body = self._session.scalar(
            select(Artefact.body).where(
                Artefact.assessment_id == assessment_id, Artefact.kind == kind
            )
        )
        return None if body is None else decompress(body)
