"""Specs with one change, or with odd text in every place: `check` may accept only good ones."""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

from tests.factories import BUSSERVO, DEMO, Data, Steps, data_of, kiln
from tests.mutations.kinds import anything
from tests.mutations.odd_text import TEXTS
from tests.mutations.places import at, differs, dotted, nodes, renamed, swaps, texts, with_
from tests.mutations.prose import HARMLESS, with_prose


@dataclass(frozen=True)
class Change:
    """One change: where, and from what to what."""

    path: str
    old: str
    new: str

    def __str__(self) -> str:
        return f"{self.path}: {self.old} -> {self.new}"


@dataclass(frozen=True)
class Mutant:
    """A spec of those at hand, with a change."""

    spec: str
    changes: tuple[Change, ...]
    make: Callable[[], Data]

    @property
    def data(self) -> Data:
        return self.make()

    def __str__(self) -> str:
        first = str(self.changes[0])
        more = len(self.changes) - 1
        return f"{self.spec}: {first}" + (f" and {more} more" if more else "")


@cache
def specs() -> dict[str, Data]:
    return {"greenhouse": data_of(DEMO), "kiln": kiln(), "busservo": data_of(BUSSERVO)}


# ------------------------------------------------------------------ text


@cache
def _places(spec: str) -> tuple[Data, tuple[Steps, ...]]:
    """Return a spec with harmless text wherever any may stand, and where that is."""
    data = with_prose(specs()[spec], HARMLESS)
    return data, tuple(path for path, text in texts(data) if HARMLESS in text)


def rotations() -> int:
    return len(TEXTS)


def with_odd_text(spec: str, rotation: int) -> Mutant:
    """Return a spec with an odd text in every place, a different one in each."""
    labels = list(TEXTS)
    _, places = _places(spec)
    given = {place: labels[(at + rotation) % len(labels)] for at, place in enumerate(places)}
    return with_texts(spec, given)


def with_texts(spec: str, given: dict[Steps, str]) -> Mutant:
    """Return a spec with the texts of these labels in these places."""

    def make() -> Data:
        data = _places(spec)[0]
        for path, label in given.items():
            data = with_(data, *path, at(data, path).replace(HARMLESS, TEXTS[label]))
        return data

    changes = [Change(dotted(path), "plain words", label) for path, label in given.items()]
    return Mutant(spec, tuple(changes), make)


def singly(mutant: Mutant) -> list[Mutant]:
    _, places = _places(mutant.spec)
    by_path = {dotted(path): path for path in places}
    return [with_texts(mutant.spec, {by_path[each.path]: each.new}) for each in mutant.changes]


# ------------------------------------------------------------------ everything else


def structures(spec: str) -> Iterator[Mutant]:
    """Yield every scalar and every key of a spec changed by itself, in each way that there is."""
    data = specs()[spec]
    for path, value in nodes(data):
        for new in anything(path, value):
            if differs(new, value):
                yield _mutated(spec, path, value, new)
    yield from _orders(spec)
    yield from _renamings(spec)
    yield from _relations(spec)
    yield from _crowds(spec)


def _orders(spec: str) -> Iterator[Mutant]:
    """Yield neighbours of each mapping swapped, and each key moved to the front."""
    for path, value in nodes(specs()[spec]):
        if isinstance(value, dict) and path[-1] in ("messages", "fields", "endpoints", "frame"):
            keys = [*value]
            for at, swapped in enumerate(swaps(keys), 1):
                for order in (swapped, [keys[at], *keys[:at], *keys[at + 1 :]]):
                    yield _mutated(spec, path, keys, {key: value[key] for key in order})


# Names of every length and shape, and some that a language or a system has taken.
_NAMES = (
    *("z", "z9", "x_1", "a_b_c_d_e_f_g", "q" * 20, "q" * 30, "q" * 40, "_".join(["word"] * 12)),
    *("q" * 61, "w_" * 99, "class", "type", "l", "id", "self", "len", "match", "async", "columns"),
    *("encode", "absent", "frame", "values", "targets", "struct", "serial", "typing", "test"),
)
_CLASSES = (
    *("Z", "Z9", "X10", "ABCDef", "AbCdEf", "Q" * 40, "Word" * 9, "Qq" * 20, "Q" * 300, "I", "O"),
    *("Con", "Nul", "None", "ValueError", "Any", "Message", "Noise", "Client", "Device", "Column"),
    *("Items", "Sent", "Run", "Lookalike", "Messages", "Test", "Import", "Send", "Close"),
)


# Below these, keys are names.
_NAMING = ("fields", "values", "endpoints", "frame", "sources", "lookalikes", "messages")


def _renamings(spec: str) -> Iterator[Mutant]:
    """Yield every name replaced by another, wherever it stands."""
    data = specs()[spec]
    for path, value in nodes(data):
        parent = path[-2] if len(path) > 1 else ""
        found = ""
        if parent in _NAMING:
            found = "" if "examples" in path else str(path[-1])
        elif path[-1] == "element" or path == ("protocol", "name"):
            found = str(value)
        if found:
            for name in _CLASSES if found[0].isupper() else _NAMES:
                change = Change(dotted(path), found, name)
                yield Mutant(spec, (change,), partial(renamed, data, found, name))


def stretched(spec: str, length: int) -> Mutant:
    """Return a spec whose names all have one length, if allowed: lines that just fit, or not."""
    messages = specs()[spec]["messages"]
    several = [message.get("fields", {}) for message in messages.values()]
    lists = [field for each in several for field in each.values() if "element" in field]
    fields = {name for each in several + [each["fields"] for each in lists] for name in each}
    # What is a key of the language as well would be renamed there, too.
    fields -= specs()[spec].get("pose", {}).keys()
    classes = [*messages, *(field["element"] for field in lists)]
    new = {name: _long(f"f{at}_", length) for at, name in enumerate(sorted(fields))}
    new |= {name: _long(f"C{at}x", length * 2 // 3) for at, name in enumerate(classes)}
    ends = enumerate(specs()[spec]["endpoints"])
    new |= {name: _long(f"e{at}x", length // 3) for at, name in ends}

    def make() -> Data:
        data = specs()[spec]
        for name, longer in new.items():
            data = renamed(data, name, longer)
        return data

    return Mutant(spec, (Change("all names", "as they are", f"{length} long"),), make)


def _long(name: str, length: int) -> str:
    return name + "x" * (length - len(name))


def _relations(spec: str) -> Iterator[Mutant]:
    """Yield each message related to each other, in each way that messages can be."""
    messages = specs()[spec]["messages"]
    for name in messages:
        here: Steps = ("messages", name)
        for other in messages:
            yield _mutated(spec, (*here, "reply"), None, other)
            yield _mutated(spec, (*here, "reports"), None, [other])
            kept = {key: messages[name][key] for key in messages[name].keys() - {"reply", "lasts"}}
            taken = kept | {"reports": [other], "acknowledged": other}
            yield _mutated(spec, here, name, taken, f"{name} acknowledged by {other}")
        for field in messages[name].get("fields", {}):
            yield _mutated(spec, (*here, "lasts"), None, field)
        yield _mutated(spec, (*here, "method"), None, f"go({', '.join(_given(messages[name]))})")


def _given(message: Data) -> list[str]:
    fields = message.get("fields", {})
    counts = {field.get("counted_by") for field in fields.values()}
    return [name for name in fields if name not in counts][::-1]


_ABSENT = {"about": "None.", "absent": True}


def _crowds(spec: str) -> Iterator[Mutant]:
    """Yield specs with more of everything: fields, named values, messages, notes."""
    data = specs()[spec]
    for path, value in nodes(data):
        if path[-1] == "fields":
            for many in (13, 40):
                more = {f"more_{at}": {"type": "u8", "about": "More."} for at in range(many)}
                yield _mutated(spec, path, "fields", more | value, f"{many} more")
        if isinstance(value, dict) and "type" in value and "about" in value and "fields" in path:
            values = {f"name_{at}": {"value": at, "about": "So."} for at in range(100)}
            yield _mutated(spec, (*path, "values"), None, values, "100 values")
            for key, new in (
                ("signed_as", "i8"),
                ("signed_as", "i16"),
                ("unit", "degrees"),
                ("limits", {"usual": "0..1", "others": {'Other\'s "boards"' * 9: "0..9"}}),
                ("values", {"none": {"value": 255, **_ABSENT}}),
                ("values", {f"n{n}": {"value": n, **_ABSENT} for n in range(40)}),
            ):
                yield _mutated(spec, (*path, key), value.get(key), new)
    for name, message in data["messages"].items():
        copies = {f"More{at}": {**message, "id": 100 + at} for at in range(100)}
        all_of_them = data["messages"] | copies
        yield _mutated(spec, ("messages",), name, all_of_them, f"100 messages like {name}")


def _mutated(spec: str, path: Steps, old: Any, new: Any, shown: str = "") -> Mutant:
    change = Change(dotted(path), _short(old), shown or _short(new))
    return Mutant(spec, (change,), lambda: with_(specs()[spec], *path, new))


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=True)
    return text if len(text) <= 60 else f"{text[:57]}..."
