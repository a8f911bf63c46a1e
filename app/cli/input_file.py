"""Read a command's JSON input; say what is wrong with it and leave with code 2."""

from pathlib import Path
from typing import NoReturn, TypeVar

import typer
from pydantic import BaseModel, ValidationError

from app.cli.progress import STANDARD_ERROR
from app.landings.field_errors import field_errors

Model = TypeVar("Model", bound=BaseModel)


def read_input(path: Path, model: type[Model]) -> Model:
    """Validated content of a JSON file."""
    try:
        return model.model_validate_json(path.read_bytes())
    except OSError as error:
        refuse(f"{path}: {error.strerror}", error)
    except ValidationError as error:
        faults = field_errors(error.errors(include_url=False), model)
        refuse("\n".join(f"{path}: {fault}" for fault in faults), error)


def refuse(message: str, cause: Exception, code: int = 2) -> NoReturn:
    """Print why and leave."""
    STANDARD_ERROR.print(message, style="red", markup=False, highlight=False, soft_wrap=True)
    raise typer.Exit(code) from cause
