"""The codec as a JavaScript module for others to import, with its types for TypeScript.

It is the text of the codec that the pages have, the protocol as data, and an export.
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from framegen.model.slots import Items, Number, Packed, Text
from framegen.output import banner
from framegen.site.policy import script
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import REASONS, protocol_data
from framegen.site.scripts.slot_data import is_wide
from framegen.targets.filenames import file_stem
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from collections.abc import Iterable

    from jinja2 import Environment

    from framegen.model.model import Model
    from framegen.model.slots import Field

_HERE = Path(__file__).parent.parent
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def javascript_module(model: Model) -> dict[str, str]:
    """Return the module and its types, by file name: `NAME.mjs` and `NAME.d.mts`."""
    name = model.spec.protocol.name
    stem = file_stem(name)
    said = {
        "banner": banner(""),
        "model": model,
        "name": name,
        "protocol": model.spec.protocol,
        "reasons": [*REASONS.values()],
        "codec": script(*codec_scripts(model)).replace('"use strict";\n', ""),
        "data": _literal(protocol_data(model)),
        "messages": [*model.messages.values()],
    }
    return {
        f"{stem}.mjs": _environment().get_template("module.mjs.jinja").render(said),
        f"{stem}.d.mts": _environment().get_template("module.d.mts.jinja").render(said),
    }


def _literal(value: Any) -> str:
    """Return a value as the text of a script that JSON.parse reads: no key of it has a meaning."""
    return json.dumps(json.dumps(value, ensure_ascii=True, separators=(",", ":")))


def decoded_type(field: Field) -> str:
    """Return the type of a field as it is decoded."""
    return _type(field, given=False)


def given_type(field: Field) -> str:
    """Return the type of a field as `encode` takes it: numbers by their names, too."""
    return _type(field, given=True)


def _type(field: Field, *, given: bool) -> str:
    match field:
        case Text():
            return "string"
        case Packed():
            return "bigint[]" if is_wide(field) else "number[]"
        case Number():
            return _number(field, given=given)
        case Items():
            return _list(field, given=given)


def _number(number: Number, *, given: bool) -> str:
    kinds = ["bigint" if is_wide(number) else "number"]
    if given:
        kinds += ["number"] if is_wide(number) else []
        kinds += map(json.dumps, number.field.values)
    return " | ".join([*kinds, *(["null"] if number.optional else [])])


def _list(items: Items, *, given: bool) -> str:
    if items.text:
        return "string"
    if items.element is None:
        (field,) = items.fields
        return f"({_type(field, given=given)})[]"
    fields = "; ".join(f"{key(each.name)}: {_type(each, given=given)}" for each in items.fields)
    return f"{{ {fields} }}[]"


def about(field: Field) -> str:
    """Return what a field is, in a line."""
    said = field.field.about
    match field:
        case Number() if not field.is_float:
            names = "".join(
                f", {value.value} = {name}" for name, value in field.field.values.items()
            )
            unit = f" {field.field.unit}" if field.field.unit else ""
            return f"{said} {field.low}..{field.high}{unit}{names}."
        case Items():
            return f"{said} {field.low}..{field.high} of them."
        case _:
            return said


def key(name: str) -> str:
    """Return a name as a key of an object type."""
    return name if _NAME.fullmatch(name) else json.dumps(name)


def comment(text: str) -> str:
    """Return a text for a line of a comment, which nothing in it can end."""
    return " ".join(text.split()).replace("*/", "* /").replace("@", "&#64;")


def union(names: Iterable[str]) -> str:
    """Return a type of texts."""
    return " | ".join(map(json.dumps, names)) or "never"


@cache
def _environment() -> Environment:
    made = environment(_HERE / "templates", "module", autoescape=False)
    made.filters |= {
        "decoded_type": decoded_type,
        "given_type": given_type,
        "about": about,
        "key": key,
        "comment": comment,
        "union": union,
    }
    return made
