"""TOML files that people write, checked against their form before anything is made of them."""

import tomllib
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from solver.errors import ModelError

Form = TypeVar("Form", bound=BaseModel)


def read_document(path: Path | Traversable, form: type[Form]) -> Form:
    """Read a file and check it against its form.

    Raises
    ------
    ModelError
        The file is missing or not TOML, or a key is unknown, missing or outside its range; each is
        named with its value and range.
    """
    try:
        document = tomllib.loads(path.read_bytes().decode())
    except OSError as error:
        raise ModelError(f"{path}: cannot be read: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ModelError(f"{path}: not valid TOML: {error}") from error
    try:
        return form.model_validate(document)
    except ValidationError as error:
        raise ModelError(f"{path}: " + "; ".join(_problems(error))) from error


def _problems(error: ValidationError) -> list[str]:
    """One line for each finding: the key, what is allowed and what stands there."""
    lines = []
    for finding in error.errors(include_url=False):
        key = ""
        for part in finding["loc"]:
            key += f"[{part}]" if isinstance(part, int) else f".{part}"
        value = "" if isinstance(finding["input"], dict) else f", got {finding['input']!r}"
        lines.append(f"{key.lstrip('.') or 'file'}: {finding['msg']}{value}")
    return lines
