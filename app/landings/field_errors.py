"""What is wrong with a field, in the words of its sender: name, value, allowed range."""

import difflib
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, get_args

from pydantic import BaseModel


@dataclass(frozen=True, slots=True)
class FieldError:
    """One refused field."""

    field: str
    value: Any
    allowed: str
    message: str

    def __str__(self) -> str:
        return f"{self.field}: {self.message} (got {self.value}; allowed: {self.allowed})"


class InvalidRecordError(Exception):
    """A record that cannot be taken in, with every fault found."""

    def __init__(self, errors: Sequence[FieldError]) -> None:
        super().__init__("\n".join(str(error) for error in errors))
        self.errors = tuple(errors)


_LONGEST_ECHO = 200


def echo(value: Any) -> Any:
    """A refused value as JSON can carry it: finite, short, and free of half characters."""
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, int):
        return value if abs(value) < 2**53 else f"{str(value)[:30]}..."
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if isinstance(value, dict) and set(value) >= {"value", "unit"}:
        return f"{echo(value['value'])} {echo(value['unit'])}"
    text = value if isinstance(value, str) else repr(value)
    text = text[:_LONGEST_ECHO] + ("..." if len(text) > _LONGEST_ECHO else "")
    return text.encode("utf-8", "backslashreplace").decode("utf-8").replace("\0", "\\0")


def field_errors(
    errors: Iterable[Any], model: type[BaseModel] | None = None
) -> tuple[FieldError, ...]:
    """Translate pydantic's error list; ``model`` tells which fields there are."""
    return tuple(_field_error(error, model) for error in errors)


def _field_error(error: Any, model: type[BaseModel] | None) -> FieldError:
    context = error.get("ctx", {})
    location = [part for part in error["loc"] if part not in ("body", "query", "header", "path")]
    if isinstance(context.get("field"), str):
        location.append(context["field"])
    kind = error["type"]
    message = str(error["msg"])
    value = context.get("value", error.get("input"))
    if kind == "extra_forbidden":
        known = _fields_at(model, error["loc"])
        near = difflib.get_close_matches(str(location[-1]), known, n=1)
        message = "unknown field" + (f"; did you mean {near[0]}?" if near else "")
        allowed = ", ".join(known) or "no further field"
    elif kind == "missing" and "allowed" not in context:
        message, value, allowed = "required field is missing", None, "required"
    else:
        allowed = str(context.get("allowed") or _allowed(kind, context, message))
    name = _path(location) or "body"
    return FieldError(
        field=str(echo(name)), value=echo(value), allowed=str(echo(allowed)), message=message
    )


def _path(location: Sequence[Any]) -> str:
    """``contacts[0].pitch`` from ``("contacts", 0, "pitch")``."""
    path = ""
    for part in location:
        if isinstance(part, int):
            path += f"[{part}]"
        elif path:
            path += f".{part}"
        else:
            path = str(part)
    return path


_BOUNDS = {
    "gt": "more than",
    "ge": "at least",
    "lt": "less than",
    "le": "at most",
    "min_length": "length at least",
    "max_length": "length at most",
    "pattern": "text matching",
    "expected": "",
}


def _allowed(kind: str, context: dict[str, Any], message: str) -> str:
    if kind == "finite_number":
        return "a finite number"
    bounds = [f"{words} {context[key]}".strip() for key, words in _BOUNDS.items() if key in context]
    return " and ".join(bounds) or message


def _fields_at(model: type[BaseModel] | None, location: Sequence[Any]) -> list[str]:
    """Names a model knows at the place where an unknown one was found."""
    for part in location[:-1]:
        if model is None:
            return []
        if isinstance(part, str) and (field := _field(model, part)) is not None:
            model = _model_within(field.annotation)
    return [field.alias or name for name, field in model.model_fields.items()] if model else []


def _field(model: type[BaseModel], name: str) -> Any:
    return next(
        (field for key, field in model.model_fields.items() if name in (key, field.alias)), None
    )


def _model_within(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next(
        (found for part in get_args(annotation) if (found := _model_within(part)) is not None),
        None,
    )
