"""Identity of what a stored result rests on, and locks for chapters that run at once."""

import fcntl
import hashlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from enum import Enum
from pathlib import Path

import numpy as np

#: Hexadecimal digits of a digest.
LENGTH = 16


def digest_of(value: object) -> str:
    """Digest of a value; equal values give equal digests, in every process.

    Raises
    ------
    TypeError
        The value is, or holds, something other than numbers, texts, enumerations, arrays,
        dataclasses, mappings and sequences.
    """
    digest = hashlib.sha256()
    for part in _parts(value):
        # The length keeps neighbours apart: "ab", "c" is not "a", "bc".
        digest.update(f"{len(part)}:".encode())
        digest.update(part)
    return digest.hexdigest()[:LENGTH]


def digest_of_sources(root: Path, sources: Sequence[str]) -> str:
    """Digest of the text of modules and packages below ``root``.

    Raises
    ------
    FileNotFoundError
        There is no such module or package.
    """
    parts: list[str] = []
    for source in sources:
        path = root / source
        if not path.exists():
            raise FileNotFoundError(f"{source} is neither a module nor a package")
        files = sorted(path.rglob("*.py")) if path.is_dir() else [path]
        for file in files:
            parts += [file.relative_to(root).as_posix(), file.read_text()]
    return digest_of(parts)


def _parts(value: object) -> Iterator[bytes]:
    if isinstance(value, np.ndarray):
        yield f"{value.dtype.str} {value.shape}".encode()
        yield np.ascontiguousarray(value).tobytes()
    elif isinstance(value, Enum):
        yield f"{type(value).__name__}.{value.name}".encode()
    elif value is None or isinstance(value, bool | int | float | str | np.generic):
        yield f"{type(value).__name__} {value!r}".encode()
    elif is_dataclass(value) and not isinstance(value, type):
        yield f"{type(value).__qualname__} {len(fields(value))}".encode()
        for field in fields(value):
            yield field.name.encode()
            yield from _parts(getattr(value, field.name))
    elif isinstance(value, Mapping):
        yield f"mapping {len(value)}".encode()
        for key in sorted(value, key=repr):
            yield from _parts(key)
            yield from _parts(value[key])
    elif isinstance(value, list | tuple):
        yield f"sequence {len(value)}".encode()
        for item in value:
            yield from _parts(item)
    else:
        raise TypeError(f"{type(value).__name__} has no digest: name its numbers instead")


@contextmanager
def exclusive(lock: Path) -> Iterator[None]:
    """Let one process at a time pass; the lock goes with the process that held it."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("w") as stream:
        fcntl.flock(stream, fcntl.LOCK_EX)
        yield
