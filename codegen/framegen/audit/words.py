"""Values in words: `100..900 in 12 values`, and what of a documented range they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.audit.values import MOST

if TYPE_CHECKING:
    from framegen.audit.values import Values

# So many different values are listed one by one.
_FEW = 6


def described(values: Values) -> str:
    """Say which values were seen: `500, 800`, or `0..1000 in 17 values`."""
    if len(values.counts) <= _FEW:
        try:
            seen = sorted(values.counts)
        except TypeError:
            seen = [*values.counts]
        text = ", ".join(map(shown, seen))
    else:
        text = (
            f"{shown(values.lowest)}..{shown(values.highest)} in {_many(len(values.counts))} values"
        )
    return f"{text} {'element' if text == '1' else 'elements'}" if values.is_size else text


def _many(number: int) -> str:
    return f"{number} or more" if number >= MOST else str(number)


def documented(values: Values) -> str:
    """Say what is documented: `of 0..1`, `usual 0..1000`, `named off`, `never on`."""
    parts: list[str] = []
    if values.low is not None and values.high is not None:
        parts.append(f"of {shown(values.low)}..{shown(values.high)}")
    if values.limits is not None:
        low, high = values.limits
        parts.append(f"usual {low}..{'' if high is None else high}")
    if len(values.named) > _FEW:
        parts.append(f"{len(values.named_seen)} of {len(values.named)} named values")
    else:
        seen = values.named_seen
        never = [name for name in values.named if name not in seen]
        parts += [f"named {', '.join(seen)}"] * bool(seen)
        parts += [f"never {', '.join(never)}"] * bool(never)
    return "; ".join(parts)


def shown(value: Any) -> str:
    """Write a value: text in quotes, a number as short as it can be."""
    if isinstance(value, str):
        return repr(value if len(value) <= 24 else f"{value[:21]}...")
    return f"{value:g}" if isinstance(value, float) else str(value)
