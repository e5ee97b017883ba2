"""Specs in which every name that a library binds is the name of something: a spec for each kind."""

from collections.abc import Callable, Sequence
from itertools import count, groupby
from typing import TypeAlias

from tests.bound_names import pascal_names, snake_names
from tests.crowd import FIELDS, Crowd, in_parts
from tests.factories import Data

Makes: TypeAlias = Callable[[Crowd, Sequence[str]], None]
_LONGEST_END = 20
_LONGEST_CLASS = 40
# The bits of a number, as wide as it may be here.
_BITS = 32
# The parts of a frame that have names.
_PARTS = 9


def fields(crowd: Crowd, names: Sequence[str]) -> None:
    """Make every name a field, there and back, and one of an element."""
    for at, some in enumerate(in_parts(names, FIELDS)):
        crowd.command(f"Sent{at}", some)
        crowd.report(f"Received{at}", some)
        crowd.command(f"Put{at}", [], listed=f"list{at}", element=f"Each{at}", of=some)


def results(crowd: Crowd, names: Sequence[str]) -> None:
    """Make names what is asked for and returned, a list, and what counts one."""
    for at, (first, *others) in enumerate(in_parts(names, 3)):
        crowd.report(f"Answer{at}", [first])
        crowd.command(
            f"Ask{at}", [first], reply=f"Answer{at}", method=f"ask{at}({first}) -> {first}"
        )
        if len(others) == 2:
            crowd.command(f"Many{at}", [], listed=others[0], counter=others[1])


def functions(crowd: Crowd, names: Sequence[str]) -> None:
    """Make every name a message whose method, strategy and handler are called so."""
    # Those that differ only in capitals are refused.
    messages(crowd, [*{name.lower(): name for name in map(_as_class, names)}.values()])


def methods(crowd: Crowd, names: Sequence[str]) -> None:
    for at, name in enumerate(names):
        crowd.command(f"Call{at}", [], method=f"{name}()")


def values(crowd: Crowd, names: Sequence[str]) -> None:
    """Make every name a named value, and a bit."""
    for at, some in enumerate(in_parts(names, _BITS)):
        _named(crowd, at, {"level": some})


def halves(crowd: Crowd, names: Sequence[str]) -> None:
    """Make every name of several words what a field and its value, or its bit, become."""
    split: dict[str, list[str]] = {}
    for words in (name.split("_") for name in names):
        for at in range(1, len(words)):
            field, value = "_".join(words[:at]), "_".join(words[at:])
            if value[0].isalpha():
                split.setdefault(field, []).append(value)
    number = count()
    # Of one message no two make the same name, since each begins with as many words; and a field
    # has no more values there than bits.
    beginnings = sorted(split, key=lambda field: field.count("_"))
    for _, alike in groupby(beginnings, key=lambda field: field.count("_")):
        for some in in_parts([*alike], FIELDS):
            parted = {field: [*in_parts(split[field], _BITS)] for field in some}
            for turn in range(max(map(len, parted.values()))):
                _named(
                    crowd,
                    next(number),
                    {f: each[turn] for f, each in parted.items() if each[turn:]},
                )


def _named(crowd: Crowd, number: int, names: dict[str, list[str]]) -> None:
    """Add messages whose fields have such values, and such bits."""
    values: Data = {
        field: {"values": {name: {"value": at, "about": "It."} for at, name in enumerate(some)}}
        for field, some in names.items()
    }
    bits: Data = {
        field: {"type": "u32", "bits": {name: at for at, name in enumerate(some)}}
        for field, some in names.items()
    }
    crowd.report(f"Valued{number}", [*names], more_of=values)
    crowd.report(f"Flagged{number}", [*names], more_of=bits)


def ends(crowd: Crowd, names: Sequence[str]) -> None:
    """Make every name an end of the line, which may have more than two."""
    short = [name for name in names if len(name) <= _LONGEST_END]
    for at, (one, *other) in enumerate(in_parts(short, 2)):
        crowd.send(f"Said{at}", one, *(other or ["somebody"]))


def parts(crowd: Crowd, names: Sequence[str]) -> None:
    """Make every name a part of a frame, and some a kind of frame."""
    padded = [*names, *names[:_PARTS]]
    for at in range(0, len(names), _PARTS):
        some = padded[at : at + _PARTS]
        crowd.framed(f"Framed{at}", some[0], some)


def messages(crowd: Crowd, names: Sequence[str]) -> None:
    for at, name in enumerate(names):
        (crowd.report if at % 2 else crowd.command)(name, [])


def elements(crowd: Crowd, names: Sequence[str]) -> None:
    for at, name in enumerate(names):
        add = crowd.report if at % 2 else crowd.command
        add(f"Listed{at}", [], listed="items", element=name, of=["level"])


_OF_FIELDS: tuple[Makes, ...] = (fields, results, functions, methods, values, halves, ends, parts)
_OF_CLASSES = (messages, elements)
CROWDS = [each.__name__ for each in (*_OF_FIELDS, *_OF_CLASSES)]


def crowd_of(*kinds: str, plain: bool = True, everywhere: bool = False) -> Data:
    """Return a spec in which every name is something of each of these kinds.

    Of `messages` and `elements`, which are classes, it can have one.
    """
    crowd = Crowd("crowded", "host", "device")
    for makes, names in ((_OF_FIELDS, snake_names), (_OF_CLASSES, pascal_names)):
        for make in makes:
            if make.__name__ in kinds:
                make(crowd, names(everywhere=everywhere))
    # Frames of several kinds are no plain ones.
    if not plain and "frame" in crowd.data:
        crowd.odd()
    return crowd.data


def _as_class(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("_"))[:_LONGEST_CLASS]
