"""Streams of JSON lines, in and out at once and in bounded memory."""

import asyncio
import tempfile
from collections.abc import AsyncIterator, Callable, Iterator
from dataclasses import dataclass
from email.message import Message as Headers
from typing import IO

from starlette.responses import Response
from starlette.types import Message, Receive, Scope, Send

NDJSON = "application/x-ndjson"
MULTIPART = "multipart/form-data"

#: What senders call a file of JSON lines.
LINE_TYPES = (
    NDJSON,
    "application/ndjson",
    "application/jsonl",
    "application/octet-stream",
    "text/plain",
)

#: Answers beyond this wait in a file until the other side reads them.
_SPOOL = 1024 * 1024
_PIECE = 64 * 1024


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a stream; ``text`` is None where it was too long to be held."""

    number: int  #: from 1
    text: bytes | None
    size: int


class LineCutter:
    """Cuts pieces of a body into lines and never holds more than one line."""

    def __init__(self, longest: int) -> None:
        self._longest = longest
        self._parts: list[bytes] = []  #: of the line that has begun
        self._size = 0
        self._number = 0

    def feed(self, piece: bytes) -> Iterator[Line]:
        """Lines that end within a piece."""
        *ended, begun = piece.split(b"\n")
        for part in ended:
            self._append(part)
            yield self._cut()
        self._append(begun)

    def end(self) -> Iterator[Line]:
        """The last line, if no line feed ended it."""
        if self._size:
            yield self._cut()

    def _append(self, part: bytes) -> None:
        self._size += len(part)
        if self._size > self._longest:
            self._parts.clear()
        elif part:
            self._parts.append(part)

    def _cut(self) -> Line:
        self._number += 1
        text = b"".join(self._parts) if self._size <= self._longest else None
        line = Line(self._number, text, self._size)
        self._parts, self._size = [], 0
        return line


class PartReader:
    """Takes the lines of uploaded files out of a multipart body.

    A boundary stands at the beginning of a line and JSON lines hold no line feed, so the body can
    be read line by line like any other.
    """

    def __init__(self, boundary: str) -> None:
        self._boundary = b"--" + boundary.encode("ascii", "replace")
        self._is_content = False
        self._number = 0

    def content(self, line: Line) -> Iterator[Line]:
        """The line itself if it belongs to a file."""
        if line.text is not None and line.text.startswith(self._boundary):
            self._is_content = False
        elif self._is_content:
            self._number += 1
            yield Line(self._number, line.text, line.size)
        elif line.text is not None and not line.text.strip():
            self._is_content = True  # a blank line ends the headers of a part


def content_type(value: str | None) -> tuple[str, str | None]:
    """Media type, and the boundary if it has one."""
    headers = Headers()
    headers["content-type"] = value or ""
    boundary = headers.get_boundary()
    return headers.get_content_type() if value else "", boundary


async def pieces(receive: Receive) -> AsyncIterator[bytes]:
    """A request's body as it comes in; ends early if the sender is gone."""
    while True:
        message = await receive()
        if message["type"] != "http.request":
            raise SenderGoneError
        if body := message.get("body", b""):
            yield body
        if not message.get("more_body", False):
            return


class SenderGoneError(Exception):
    """The connection broke before the body was complete."""


class Conversation(Response):
    """Answers line by line while the request is still coming in.

    Many senders read no answer before they have sent everything.  Answers therefore never hold up
    the reading: what the other side does not take now waits in a temporary file.
    """

    media_type = NDJSON

    def __init__(self, answers: Callable[[Receive], AsyncIterator[bytes]]) -> None:
        super().__init__()
        del self.headers["content-length"]
        self._answers = answers

    async def __call__(self, _scope: Scope, receive: Receive, send: Send) -> None:
        # With the first piece in hand: an answer before it would cancel "100 Continue".
        first: list[Message] = [await receive()]

        async def resumed() -> Message:
            return first.pop() if first else await receive()

        await send(
            {"type": "http.response.start", "status": self.status_code, "headers": self.raw_headers}
        )
        with tempfile.SpooledTemporaryFile(_SPOOL) as file:
            spool = _Spool(file)
            async with asyncio.TaskGroup() as tasks:
                tasks.create_task(spool.fill(self._answers(resumed)))
                async for piece in spool.pieces():
                    await send({"type": "http.response.body", "body": piece, "more_body": True})
        if spool.is_complete:
            await send({"type": "http.response.body", "body": b"", "more_body": False})


class _Spool:
    """Bytes on their way from a writer to a slower reader."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self._written = self._read = 0
        self._news = asyncio.Event()
        self._is_ended = False
        self.is_complete = False

    async def fill(self, answers: AsyncIterator[bytes]) -> None:
        try:
            async for answer in answers:
                self._file.seek(self._written)
                self._file.write(answer)
                self._written += len(answer)
                self._news.set()
            self.is_complete = True
        except SenderGoneError:
            pass  # nobody is left to answer
        finally:
            self._is_ended = True
            self._news.set()

    async def pieces(self) -> AsyncIterator[bytes]:
        while not (self._is_ended and self._read == self._written):
            if self._read == self._written:
                self._file.seek(0)
                self._file.truncate()
                self._written = self._read = 0
                self._news.clear()
                await self._news.wait()
                continue
            self._file.seek(self._read)
            piece = self._file.read(min(_PIECE, self._written - self._read))
            self._read += len(piece)
            yield piece
