"""Lets pydantic read the small notations of `values`, and tells editors what they look like."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic_core import PydanticCustomError, core_schema

if TYPE_CHECKING:
    from collections.abc import Callable

    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue


@dataclass(frozen=True, slots=True)
class Notation:
    """Goes into `Annotated`: text read by `parse`; a bare number by `number`, where it is given."""

    what: str
    example: str
    parse: Callable[[str], Any]
    number: Callable[[int], Any] | None = None

    def __get_pydantic_core_schema__(
        self, _type: object, _handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self._read)

    def __get_pydantic_json_schema__(
        self, _schema: core_schema.CoreSchema, _handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        kind = "string" if self.number is None else ["string", "integer"]
        return {"type": kind, "examples": [self.example]}

    def _read(self, value: object) -> Any:
        if self.number is not None and isinstance(value, int) and not isinstance(value, bool):
            return self.number(value)
        if not isinstance(value, str):
            raise PydanticCustomError(
                "notation",
                "{what} is written as text, like `{example}`",
                {"what": self.what, "example": self.example},
            )
        try:
            return self.parse(value)
        except ValueError as error:
            raise PydanticCustomError("notation", "{message}", {"message": str(error)}) from None
