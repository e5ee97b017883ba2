"""Types that pydantic does not have: the notations of `values`, and exact numbers."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Any, get_args

from pydantic_core import PydanticCustomError, PydanticKnownError, core_schema

if TYPE_CHECKING:
    from collections.abc import Callable

    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue


@dataclass(frozen=True, slots=True)
class Notation:
    """A type for `Annotated`: text read by `parse`; a number or a list by its own, if given.

    With `fractions`, plain numbers are read by `parse` as well.
    """

    what: str
    example: str
    parse: Callable[[str], Any]
    number: Callable[[int], Any] | None = None
    listed: Callable[[list[object]], Any] | None = None
    fractions: bool = False

    def __get_pydantic_core_schema__(
        self, _type: object, _handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self._read)

    def __get_pydantic_json_schema__(
        self, _schema: core_schema.CoreSchema, _handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        kinds = ["string"] + ["integer"] * (self.number is not None)
        kinds += ["number"] * self.fractions + ["array"] * (self.listed is not None)
        return {"type": kinds if len(kinds) > 1 else "string", "examples": [self.example]}

    def _read(self, value: object) -> Any:
        if self.number is not None and isinstance(value, int) and not isinstance(value, bool):
            return self.number(value)
        if self.fractions and isinstance(value, int | float) and not isinstance(value, bool):
            value = f"{Decimal(str(value)):f}"
        is_listed = self.listed is not None and isinstance(value, list)
        if not isinstance(value, str) and not is_listed:
            raise PydanticCustomError(
                "notation_type",
                "{what} is written as text, like `{example}`",
                {"what": self.what, "example": self.example},
            )
        try:
            if self.listed is not None and isinstance(value, list):
                return self.listed(value)
            return self.parse(str(value))
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


@dataclass(frozen=True, slots=True)
class Ids:
    """The ids of a message: one number, or one for each id part of its frame by name."""

    one: int | None
    by_part: tuple[tuple[str, int], ...] = ()

    def __str__(self) -> str:
        if self.one is not None:
            return str(self.one)
        return ", ".join(f"{name} {number}" for name, number in self.by_part)

    @classmethod
    def __get_pydantic_core_schema__(
        cls, _source: object, _handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(cls._read)

    @classmethod
    def __get_pydantic_json_schema__(
        cls, _schema: core_schema.CoreSchema, _handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        number = {"type": "integer", "minimum": 0}
        return {"anyOf": [number, {"type": "object", "additionalProperties": number}]}

    @classmethod
    def _read(cls, value: object) -> Ids:
        if isinstance(value, dict):
            return cls(None, tuple((str(name), _natural(each)) for name, each in value.items()))
        return cls(_natural(value))


def _natural(value: object) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise PydanticKnownError("int_type")
    if value < 0:
        raise PydanticKnownError("greater_than_equal", {"ge": 0})
    return value
