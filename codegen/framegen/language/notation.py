"""Types that pydantic does not have: the notations of `values`, and exact numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

from pydantic_core import PydanticCustomError, PydanticKnownError, core_schema

if TYPE_CHECKING:
    from collections.abc import Callable

    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue


@dataclass(frozen=True, slots=True)
class Notation:
    """A type for `Annotated`: text read by `parse`; a bare number by `number`, if given."""

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
                "notation_type",
                "{what} is written as text, like `{example}`",
                {"what": self.what, "example": self.example},
            )
        try:
            return self.parse(value)
        except ValueError as error:
            context = {"message": str(error), "part": getattr(error, "part", "")}
            raise PydanticCustomError("notation", "{message}", context) from None


class OneOf:
    """A type for `Annotated` beside a Literal of numbers: one of them, and never a truth value.

    Of itself, pydantic takes `true` for 1.
    """

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        choices: tuple[int, ...] = get_args(source)

        def read(value: object) -> object:
            if type(value) is not int or value not in choices:
                named = " or ".join(map(str, choices))
                raise PydanticKnownError("literal_error", {"expected": named})
            return value

        return core_schema.no_info_before_validator_function(read, handler(source))
