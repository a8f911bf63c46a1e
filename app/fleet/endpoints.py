"""Aircraft and models over HTTP."""

from typing import Annotated, Literal

from fastapi import APIRouter, Path, Query, Response

from app.context import Context
from app.errors import responses
from app.fleet import service
from app.fleet.schemas import AircraftList, MeshOut, ModelOut
from app.security import Reader

router = APIRouter(prefix="/v1", tags=["fleet"])

ModelHash = Annotated[str, Path(pattern=r"^[0-9a-f]{64}$")]

BINARY = "application/octet-stream"

#: A model's hash is its content, so its mesh can never change.
_FOR_EVER = {"Cache-Control": "private, max-age=31536000, immutable"}


@router.get("/aircraft", operation_id="list_aircraft", responses=responses(401, 403))
def list_aircraft(principal: Reader, context: Context) -> AircraftList:
    """Aircraft definitions that records may name."""
    return service.aircraft_list(context.engine, context.registry, principal)


@router.get(
    "/models/{model_hash}", operation_id="get_model", responses=responses(401, 403, 404, 422)
)
def get_model(model_hash: ModelHash, principal: Reader, context: Context) -> ModelOut:
    """An airframe model by its content hash."""
    del principal  # models are shared by all operators; the key only opens the door
    return service.model(context.engine, context.registry, model_hash)


@router.get(
    "/models/{model_hash}/mesh",
    operation_id="get_mesh",
    responses={
        200: {"content": {BINARY: {"schema": {"type": "string", "format": "binary"}}}},
        **responses(401, 403, 404, 422),
    },
    response_model=MeshOut,
)
def get_mesh(
    model_hash: ModelHash,
    principal: Reader,
    context: Context,
    response: Response,
    format: Annotated[Literal["json", "binary"], Query()] = "json",
) -> MeshOut | Response:
    """Nodes and elements for pictures."""
    del principal
    packed, mesh = service.mesh_of(context.registry, model_hash)
    if format == "binary":
        return Response(packed, media_type=BINARY, headers=_FOR_EVER)
    response.headers.update(_FOR_EVER)
    return MeshOut.model_validate(
        {
            "model_hash": model_hash,
            "zones": mesh.meta["zones"],
            **{array.name: array.values.tolist() for array in mesh.arrays},
        }
    )
