"""Requests whose body is too large are answered, not cut off."""

import contextlib
from collections.abc import Mapping

from fastapi_problem.error import Problem
from starlette.datastructures import Headers
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import problem
from app.landings.field_errors import FieldError


def body_too_large(limit: int, size: int) -> Problem:
    allowed = f"at most {limit} bytes"
    return problem(
        413,
        "body-too-large",
        "The body is too large",
        f"the body has {size} bytes; allowed: {allowed}",
        errors=[FieldError("body", size, allowed, "too large")],
    )


class _BodyTooLargeError(Exception):
    """Ends the reading of a body."""


class BodyLimit:
    """Refuse bodies above a limit with 413.

    The rest of such a body is read and thrown away before the answer is sent (up to a second,
    larger limit): a server that closes while its client still sends gives that client a reset
    connection in place of the reason.
    """

    def __init__(
        self, app: ASGIApp, limit: int, discard: int, streams: Mapping[str, int] | None = None
    ) -> None:
        self.app = app
        self.limit = limit
        self.discard = discard
        self.streams = streams or {}  #: limits of paths that count what they read by themselves

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        announced = Headers(scope=scope).get("content-length", "0")
        size = int(announced) if announced.isdecimal() else 0
        limit = self.streams.get(scope["path"], self.limit)
        if size > limit:
            await self._refuse(limit, size, 0, False, scope, receive, send)
            return
        if scope["path"] in self.streams:
            await self.app(scope, receive, send)
            return
        taken, is_complete = 0, False

        async def counted() -> Message:
            nonlocal taken, is_complete
            message = await receive()
            is_complete = not message.get("more_body", False)
            taken += len(message.get("body", b""))
            if taken > self.limit:
                raise _BodyTooLargeError
            return message

        async def unless_too_large(message: Message) -> None:
            # Whoever caught the error above may have made an answer of its own out of it.
            if taken <= self.limit:
                await send(message)

        with contextlib.suppress(_BodyTooLargeError):
            await self.app(scope, counted, unless_too_large)
        if taken > self.limit:
            await self._refuse(self.limit, taken, taken, is_complete, scope, receive, send)

    async def _refuse(
        self,
        limit: int,
        size: int,
        taken: int,
        is_complete: bool,
        scope: Scope,
        receive: Receive,
        send: Send,
    ) -> None:
        while not is_complete and taken <= self.discard:
            message = await receive()
            taken += len(message.get("body", b""))
            is_complete = not message.get("more_body", False)
        refusal = body_too_large(limit, max(size, taken))
        response = JSONResponse(
            refusal.marshal(), status_code=413, media_type="application/problem+json",
            headers={"connection": "close"},
        )  # fmt: skip
        await response(scope, receive, send)
