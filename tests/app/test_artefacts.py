"""Arrays in one run of bytes."""

import numpy as np
import pytest

from app.artefacts.container import MAGIC, NamedArray, compress, decompress, pack, unpack


def test_what_goes_in_comes_out() -> None:
    arrays = [
        NamedArray("a", np.arange(5, dtype=np.int16)),
        NamedArray("b", np.linspace(0, 1, 12, dtype=np.float32).reshape(3, 4), "Pa"),
        NamedArray("empty", np.zeros((0, 3), dtype=np.int32)),
    ]
    found = unpack(decompress(compress(pack(arrays, {"x": 1}))))
    assert found.meta == {"x": 1}
    for given, got in zip(arrays, found.arrays, strict=True):
        assert (given.name, given.unit) == (got.name, got.unit)
        assert given.values.dtype == got.values.dtype
        np.testing.assert_array_equal(given.values, got.values)


def test_a_browser_can_map_every_array_in_place() -> None:
    data = pack([NamedArray("odd", np.zeros(3, dtype=np.int8)), NamedArray("f", np.ones(2))])
    assert data[:4] == MAGIC
    header = int.from_bytes(data[4:8], "little")
    assert (8 + header) % 8 == 0
    assert len(data) == 8 + header + 8 + 16


def test_big_endian_arrays_are_turned() -> None:
    found = unpack(pack([NamedArray("a", np.array([1, 2], dtype=">i4"))]))
    assert found.arrays[0].values.dtype == np.dtype("<i4")
    np.testing.assert_array_equal(found["a"], [1, 2])


def test_other_bytes_are_refused() -> None:
    with pytest.raises(ValueError, match="not a container"):
        unpack(b"PNG......")
