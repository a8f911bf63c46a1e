"""What the interface description shows as an example is accepted as it stands."""

from app.landings.schemas import TouchdownRecordIn
from tests.conftest import Service


def test_the_example_record_is_accepted(service: Service) -> None:
    (example,) = TouchdownRecordIn.model_config["json_schema_extra"]["examples"]
    example = {**example, "aircraft": {**example["aircraft"], "model_id": "mini"}}
    assert service.post(example).status_code == 202
