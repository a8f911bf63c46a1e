"""Requests whose body is too large are answered, not cut off."""

from starlette.datastructures import Headers
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import problem
from app.landings.field_errors import FieldError


class _BodyTooLargeError(Exception):
    def __init__(self, size: int) -> None:
        self.size = size


class BodyLimit:
    """Refuse bodies above a limit with 413.

    The rest of such a body is read and thrown away before the answer is sent (up to a second,
    larger limit): a server that closes while its client still sends gives that client a reset
    connection in place of the reason.
    """

    def __init__(self, app: ASGIApp, limit: int, discard: int) -> None:
        self.app = app
        self.limit = limit
        self.discard = discard

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        announced = Headers(scope=scope).get("content-length", "0")
        size = int(announced) if announced.isdecimal() else 0
        if size > self.limit:
            await self._refuse(size, 0, scope, receive, send)
            return
        taken = 0

        async def counted() -> Message:
            nonlocal taken
            message = await receive()
            taken += len(message.get("body", b""))
            if taken > self.limit:
                raise _BodyTooLargeError(taken)
            return message

        try:
            await self.app(scope, counted, send)
        except _BodyTooLargeError as error:
            await self._refuse(error.size, taken, scope, receive, send)

    async def _refuse(
        self, size: int, taken: int, scope: Scope, receive: Receive, send: Send
    ) -> None:
        while taken <= self.discard:
            message = await receive()
            taken += len(message.get("body", b""))
            if message["type"] != "http.request" or not message.get("more_body", False):
                break
        allowed = f"at most {self.limit} bytes"
        refusal = problem(
            413,
            "body-too-large",
            "The body is too large",
            f"the body has {max(size, taken)} bytes; allowed: {allowed}",
            errors=[FieldError("body", max(size, taken), allowed, "too large")],
        )
        response = JSONResponse(
            refusal.marshal(), status_code=413, media_type="application/problem+json",
            headers={"connection": "close"},
        )  # fmt: skip
        await response(scope, receive, send)
