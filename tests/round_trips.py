"""A proxy before Postgres that counts how often a client waited for the server."""

import contextlib
import socket
import struct
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from urllib.parse import urlsplit, urlunsplit

#: ReadyForQuery, once for each statement or for several sent together, and leave to begin a COPY.
WAITED_FOR = (b"Z", b"G")


@dataclass
class RoundTrips:
    """Answers that a client waited for before it could go on."""

    url: str
    count: int = 0
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def add(self) -> None:
        with self._lock:
            self.count += 1

    @contextlib.contextmanager
    def of(self) -> Iterator[list[int]]:
        """The number within a block, in a list that is filled at its end."""
        before, found = self.count, []
        yield found
        found.append(self.count - before)


@contextlib.contextmanager
def counted(url: str) -> Iterator[RoundTrips]:
    """A proxy to the database at ``url``."""
    parts = urlsplit(url)
    assert parts.hostname is not None
    upstream = (parts.hostname, parts.port or 5432)
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
        user = f"{parts.username}@" if parts.username else ""
        trips = RoundTrips(urlunsplit(parts._replace(netloc=f"{user}127.0.0.1:{port}")))
        thread = threading.Thread(target=_accept, args=(listener, upstream, trips), daemon=True)
        thread.start()
        yield trips
        listener.shutdown(socket.SHUT_RDWR)
    thread.join()


def _accept(listener: socket.socket, upstream: tuple[str, int], trips: RoundTrips) -> None:
    while True:
        try:
            client, _ = listener.accept()
        except OSError:
            return
        server = socket.create_connection(upstream)
        for source, target, found in ((client, server, None), (server, client, trips)):
            threading.Thread(target=_pass_on, args=(source, target, found), daemon=True).start()


def _pass_on(source: socket.socket, target: socket.socket, found: RoundTrips | None) -> None:
    """Copy bytes; from the server each message is a letter, its length and a body."""
    pending = b""
    is_plain = found is None
    with contextlib.suppress(OSError), source, target:
        while data := source.recv(65536):
            if not is_plain:
                pending += data
                if pending in (b"N", b"S"):  # the answer to a request for encryption
                    pending = b""
                while len(pending) >= 5:
                    (length,) = struct.unpack_from("!I", pending, 1)
                    if len(pending) < 1 + length:
                        break
                    if pending[:1] in WAITED_FOR and found is not None:
                        found.add()
                    pending = pending[1 + length :]
            target.sendall(data)
        with contextlib.suppress(OSError):
            target.shutdown(socket.SHUT_WR)
