"""The spec language as JSON Schema, for completion and help in editors.

Only the keywords listed here are passed on, in this order: what pydantic adds for other readers is
left out, and every version of it gives the same text.
"""

from __future__ import annotations

import json
from functools import cache
from typing import TYPE_CHECKING, Any

from framegen.language.number_types import ALL_TYPES, NUMBER_TYPES
from framegen.language.site_settings import SiteSettings
from framegen.language.spec import Spec
from framegen.model.checksums import CHECKSUMS
from framegen.output import banner
from framegen.reading.yamltree import Unusable
from framegen.targets.target import Target

if TYPE_CHECKING:
    from collections.abc import Callable

    from framegen.compile import Compiled
    from framegen.targets.target import Snippets

_KEYWORDS = (
    "$schema",
    "$comment",
    "title",
    "$ref",
    "description",
    "type",
    "const",
    "enum",
    "pattern",
    "minimum",
    "exclusiveMinimum",
    "maximum",
    "default",
    "examples",
    "items",
    "required",
    "properties",
    "additionalProperties",
    "anyOf",
    "oneOf",
    "$defs",
)


def render(_compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """Render the schema, by path below the project's root: beside the spec, where editors look."""
    return {"spec/framegen.schema.json": schema_text()}


def schema_text() -> str:
    """Return the schema as JSON text, with a final newline: the same for the same language.

    Raises Unusable where Python was told to drop docstrings, which the descriptions are.
    """
    if Spec.__doc__ is None:
        raise Unusable(
            "Python was started with -OO, and has no descriptions for the schema",
            hint="start it without -OO",
        )
    return _schema_text()


@cache
def site_schema_text() -> str:
    """Return the schema of docs/site.yaml, likewise."""
    return _written(_tidied(SiteSettings.model_json_schema()), "framegen site")


@cache
def _schema_text() -> str:
    schema = _tidied(Spec.model_json_schema(by_alias=True, mode="validation"))
    whole = [each for each in NUMBER_TYPES.values() if not each.is_float]
    for model in schema["$defs"].values():
        if "is" in model["properties"] and "type" in model["properties"]:
            unsigned = [each.name for each in whole if each.low == 0]
            model["properties"]["type"]["enum"] = unsigned
        elif "type" in model["properties"]:
            model["properties"]["type"]["enum"] = list(ALL_TYPES)
        if "signed_as" in model["properties"]:
            signed = [each.name for each in whole if each.low < 0]
            model["properties"]["signed_as"]["anyOf"][0]["enum"] = signed
        if "method" in model["properties"] and "covers" in model["properties"]:
            model["properties"]["method"]["enum"] = list(CHECKSUMS)
    return _written(schema, "framegen spec")


def _written(schema: dict[str, Any], title: str) -> str:
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["$comment"] = banner("")
    schema["title"] = title
    return json.dumps(_ordered(schema), indent=2, ensure_ascii=False) + "\n"


def _tidied(schema: dict[str, Any]) -> dict[str, Any]:
    """Remove what repeats the key (`title`) or says nothing (an empty default)."""
    return {
        keyword: _mapped(keyword, value, _tidied)
        for keyword, value in schema.items()
        if keyword in _KEYWORDS
        and keyword != "title"
        and not (keyword == "default" and not value)
        and not (keyword == "additionalProperties" and value is True)
    }


def _ordered(schema: dict[str, Any]) -> dict[str, Any]:
    by_place = sorted(schema.items(), key=lambda item: _KEYWORDS.index(item[0]))
    return {keyword: _mapped(keyword, value, _ordered) for keyword, value in by_place}


def _mapped(keyword: str, value: Any, change: Callable[[dict[str, Any]], dict[str, Any]]) -> Any:
    """Return the value of a keyword, with `change` made to every schema in it."""
    if keyword == "properties":
        return {name: change(schema) for name, schema in value.items()}
    if keyword == "$defs":
        return {name: change(value[name]) for name in sorted(value)}
    if keyword in ("anyOf", "oneOf"):
        return [change(schema) for schema in value]
    if keyword in ("items", "additionalProperties") and isinstance(value, dict):
        return change(value)
    return value


TARGET = Target(
    name="schema",
    about="The spec language as JSON Schema, for editors.",
    render=render,
    shared=True,
)
