"""YAML text of values, as people write it, and as the strict reader of specs takes it back."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any, TypeAlias

from framegen.reading.scalars import Ambiguous, resolve

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

Value: TypeAlias = "str | float | Sequence[Any] | Mapping[str, Any] | None"

# What YAML refuses in a text, takes for the end of a line, or does not show.
_HIDDEN = r"\x7f-\xa0\u2028\u2029\ud800-\udfff\ufeff\ufffe\uffff"
_UNSEEN = re.compile(f"[{_HIDDEN}]")
# Text that needs no quotes: it begins with a letter, and nothing in it means anything to YAML.
_PLAIN = re.compile(rf"[A-Za-z](?:[^\x00-\x1f{_HIDDEN}:#]|:(?=[^\s])|(?<=\S)#)*")
_WHOLE = re.compile(r"^(-?[0-9]+)e")
_IN_FLOW = frozenset(",[]{}")


def scalar(value: str | float | None, *, in_flow: bool = False) -> str:
    """Write a text or a number; a text in quotes where YAML would read something else."""
    if not isinstance(value, str):
        # An exponent is that of a number with a point.
        return _WHOLE.sub(r"\1.0e", json.dumps(value))
    if _is_plain(value) and not (in_flow and _IN_FLOW & set(value)):
        return value
    return _UNSEEN.sub(_escaped, json.dumps(value, ensure_ascii=False))


def flow(value: Value) -> str:
    """Write a value on one line: `{version: "1.0.0", changes: [Lamps.]}`."""
    if value is None or isinstance(value, str | int | float):
        return scalar(value, in_flow=True)
    if hasattr(value, "items"):
        entries = (f"{scalar(key, in_flow=True)}: {flow(each)}" for key, each in value.items())
        return f"{{{', '.join(entries)}}}"
    return f"[{', '.join(map(flow, value))}]"


def block(value: Mapping[str, Value] | Sequence[Value]) -> Iterator[str]:
    """Yield the lines of a mapping or a list, one entry a line; what is deeper is indented by 2."""
    if hasattr(value, "items"):
        for key, each in value.items():
            if isinstance(each, str | int | float) or not each:
                yield f"{scalar(key)}: {scalar(each) if isinstance(each, str) else flow(each)}"
            else:
                yield f"{scalar(key)}:"
                yield from (f"  {line}" for line in block(each))
        return
    for each in value:
        if isinstance(each, str | int | float) or not each:
            yield f"- {scalar(each) if isinstance(each, str) else flow(each)}"
            continue
        first, *others = block(each)
        yield f"- {first}"
        yield from (f"  {line}" for line in others)


def _escaped(found: re.Match[str]) -> str:
    return f"\\u{ord(found[0]):04x}"


def _is_plain(text: str) -> bool:
    if _PLAIN.fullmatch(text) is None or text.endswith((" ", ":")):
        return False
    try:
        return resolve(text) == text
    except Ambiguous:
        return False
