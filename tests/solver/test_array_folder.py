"""Folders of arrays: whole or not there, the first of equals kept."""

import numpy as np
import pytest

from solver.array_folder import map_array, read_head, write_array_folder


def inode(folder):
    return (folder / "values.npy").stat().st_ino


def test_what_was_written_is_mapped_read_only(tmp_path):
    values = np.arange(12.0).reshape(3, 4)
    write_array_folder(tmp_path / "new" / "here", {"format": 3}, {"values": values})
    assert read_head(tmp_path / "new" / "here") == {"format": 3}
    found = map_array(tmp_path / "new" / "here", "values")
    np.testing.assert_array_equal(found, values)
    assert type(found + 1.0) is np.ndarray
    with pytest.raises(ValueError, match="read-only"):
        found[0, 0] = 1.0


def test_no_folder_has_no_head(tmp_path):
    assert read_head(tmp_path / "nothing") is None


def test_the_first_of_two_equal_folders_is_kept(tmp_path):
    folder = tmp_path / "twice"
    write_array_folder(folder, {"key": "a"}, {"values": np.ones(3)})
    first = inode(folder)
    write_array_folder(folder, {"key": "a"}, {"values": np.ones(3)})
    assert inode(folder) == first
    assert [path.name for path in tmp_path.iterdir()] == ["twice"]


def test_a_folder_of_another_head_is_replaced(tmp_path):
    folder = tmp_path / "changed"
    write_array_folder(folder, {"key": "a"}, {"values": np.ones(3)})
    mapped = map_array(folder, "values")
    write_array_folder(folder, {"key": "b"}, {"values": np.zeros(3)})
    np.testing.assert_array_equal(map_array(folder, "values"), np.zeros(3))
    np.testing.assert_array_equal(mapped, np.ones(3))  # whoever had it keeps it


def test_a_failed_write_leaves_nothing(tmp_path):
    with pytest.raises(TypeError):
        write_array_folder(tmp_path / "bad", {"key": object()}, {"values": np.ones(3)})
    assert list(tmp_path.iterdir()) == []
