"""Every key of the language is used by a protocol that somebody has, or stands here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.language import spec
from pydantic import BaseModel

from tests.factories import BUSSERVO, compiled_file
from tests.protocols.specs import FILES, SPOKEN

if TYPE_CHECKING:
    from collections.abc import Iterator

# A part that is more than a byte or has notes, a citation, and what only a later version has.
UNUSED = {
    ("LengthPart", "byte_order"),
    ("IdPart", "byte_order"),
    ("AddressPart", "byte_order"),
    ("CounterPart", "byte_order"),
    *((kind, "notes") for kind in ("ConstantPart", "ReservedPart", "LengthPart", "IdPart")),
    *((kind, "notes") for kind in ("BodyPart", "AddressPart", "CounterPart", "ChecksumPart")),
    ("NamedAddress", "cite"),
    ("NumberField", "cite"),
    ("ListField", "cite"),
    ("Message", "since"),
    ("Message", "deprecated"),
    ("Reserved", "name"),
    # What earlier editions were like: tests/unit/comparison has editions that say so.
    *((kind, "was") for kind in ("Message", "NumberField", "ListField", "NamedValue", "Bits")),
    *((kind, "was") for kind in ("AddressPart", "CounterPart", "NamedAddress")),
    ("Release", "breaks"),
    # No protocol has a word of its own for whoever commands it: tests/unit/targets has one.
    ("Protocol", "client"),
}


def keys_in(value: Any) -> Iterator[tuple[str, str]]:
    """Yield the keys that a spec uses, each with the name of the mapping that has it."""
    if isinstance(value, BaseModel):
        for key in value.model_fields_set:
            yield type(value).__name__, key
            yield from keys_in(getattr(value, key))
    elif isinstance(value, dict):
        for item in value.values():
            yield from keys_in(item)
    elif isinstance(value, list):
        for item in value:
            yield from keys_in(item)


def test_every_key_of_the_language_is_used() -> None:
    parts = [
        kind
        for kind in vars(spec).values()
        if isinstance(kind, type) and issubclass(kind, spec.Part) and not kind.__subclasses__()
    ]
    keys = {(part.__name__, key) for part in parts for key in part.model_fields}
    files = [BUSSERVO, *(FILES[name] for name in SPOKEN)]
    used = {key for file in files for key in keys_in(compiled_file(file).spec)}
    assert keys - used <= UNUSED
