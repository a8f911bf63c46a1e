"""Named arrays in one run of bytes, for the database and for the browser alike.

Layout, little-endian: the four bytes ``HLA1``; the length of the header as an unsigned 32-bit
integer; the header, UTF-8 JSON padded with blanks so that the arrays start at a multiple of 8; then
each array in C order, also padded to a multiple of 8.  The header is ``{"arrays": [{"name",
"dtype" (NumPy's, e.g. "<f4"), "shape", "unit", "offset" (from the end of the header)}], "meta":
{...}}``.  A browser maps each array as a typed array without copying.
"""

import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import zstandard
from numpy.typing import NDArray

MAGIC = b"HLA1"
_ALIGNMENT = 8
_PREFIX = struct.Struct("<4sI")


@dataclass(frozen=True, slots=True)
class NamedArray:
    """An array with its name and unit."""

    name: str
    values: NDArray[Any]
    unit: str = "1"


@dataclass(frozen=True, slots=True)
class Container:
    """Arrays and what there is to say about all of them."""

    arrays: tuple[NamedArray, ...]
    meta: dict[str, Any]

    def __getitem__(self, name: str) -> NDArray[Any]:
        return next(array.values for array in self.arrays if array.name == name)


def pack(arrays: Sequence[NamedArray], meta: dict[str, Any] | None = None) -> bytes:
    entries: list[dict[str, Any]] = []
    body: list[bytes] = []
    offset = 0
    for array in arrays:
        values = np.ascontiguousarray(array.values)
        values = values.astype(values.dtype.newbyteorder("<"), copy=False)
        raw = _padded(values.tobytes(), b"\0")
        entries.append(
            {
                "name": array.name,
                "dtype": values.dtype.str,
                "shape": list(values.shape),
                "unit": array.unit,
                "offset": offset,
            }
        )
        body.append(raw)
        offset += len(raw)
    header = json.dumps({"arrays": entries, "meta": meta or {}}, allow_nan=False).encode()
    header += b" " * (-(len(header) + _PREFIX.size) % _ALIGNMENT)
    return b"".join([_PREFIX.pack(MAGIC, len(header)), header, *body])


def unpack(data: bytes) -> Container:
    magic, length = _PREFIX.unpack_from(data)
    if magic != MAGIC:
        raise ValueError(f"not a container of arrays: starts with {magic!r}")
    header = json.loads(data[_PREFIX.size : _PREFIX.size + length])
    start = _PREFIX.size + length
    arrays = tuple(
        NamedArray(
            entry["name"],
            np.frombuffer(
                data,
                dtype=entry["dtype"],
                count=int(np.prod(entry["shape"], dtype=np.int64)),
                offset=start + entry["offset"],
            ).reshape(entry["shape"]),
            entry["unit"],
        )
        for entry in header["arrays"]
    )
    return Container(arrays, header["meta"])


def compress(data: bytes) -> bytes:
    return zstandard.ZstdCompressor(level=3).compress(data)


def decompress(data: bytes) -> bytes:
    return zstandard.ZstdDecompressor().decompress(data)


def _padded(raw: bytes, filler: bytes) -> bytes:
    return raw + filler * (-len(raw) % _ALIGNMENT)
