"""What is written by hand beside a spec, from the sources alone, and what of it is missing.

Whatever is generated repeats a slip of the spec. A witness does not: a table of frames that were
typed in from the document, a second codec. `tests/witnesses.yaml` declares them, by the name of the
protocol: what each of them shows of a spec, in which file, and as what it stands there.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.checks.fields import numbers_of
from framegen.checks.frames import envelopes
from framegen.language.load import read_source
from framegen.language.spec import AddressPart
from framegen.model.exchanges import snake_case
from framegen.reading.findings import did_you_mean
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable, dotted, read_tree

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.findings import Finding
    from framegen.reading.yamltree import KeyPath, Tree

DECLARATION = "tests/witnesses.yaml"
HOW_TO_DECLARE = f"{DECLARATION} declares them, by the name of the protocol: `NAME: {{}}` for none"


@dataclass(frozen=True, slots=True)
class Subject:
    """Something of a spec that a witness shows, with the words for it that a pattern may use."""

    message: str
    path: KeyPath
    words: dict[str, str]

    @property
    def name(self) -> str:
        """The name as people say it: `BuzzerBeep`, `BuzzerBeep.times`, `BuzzerBeep.times.once`."""
        # Of several kinds of frames, each has a name, and a part stands right below it.
        steps = self.path[2:] if self.path[0] == "frames" else self.path[1:]
        return ".".join(map(str, steps[::2]))


@dataclass(frozen=True, slots=True)
class Witness:
    """One kind of thing that is written by hand: of what, in which file, and as what."""

    kind: str
    of: str
    file: str
    text: str
    write: str
    why: str

    def subjects(self, model: Model) -> Iterator[Subject]:
        """List what it has to show of a spec."""
        return _SUBJECTS[self.of](model)

    def shows(self, subject: Subject, text: str) -> bool:
        """Tell whether the text of its file shows a subject."""
        return re.search(_regex(self.text, subject.words), text) is not None

    def to_write(self, subject: Subject) -> str:
        """Say what to write so that it shows a subject."""
        return _PLACEHOLDER.sub(lambda found: subject.words[found[1]], self.write)


@dataclass(frozen=True, slots=True)
class Missing:
    """Something of a spec that a witness does not show."""

    witness: Witness
    subject: Subject


def read_witnesses(root: Path, protocol: str) -> list[Witness] | None:
    """Read what the project at `root` declares for a protocol; None where it declares nothing.

    Raises Unusable, with the place, for a declaration that cannot be followed.
    """
    file = root / DECLARATION
    if not file.exists():
        return None
    source = Source(DECLARATION, read_source(file).text)
    try:
        tree, findings = read_tree(source)
    except Unusable as error:
        raise _unreadable(source, error.finding) from None
    if findings:
        raise _unreadable(source, findings[0])
    if protocol not in tree.data:
        return None
    kinds = _mapping(tree, tree.data, (protocol,))
    return [_witness(tree, kinds, (protocol, kind)) for kind in kinds]


def find_missing(model: Model, witnesses: Sequence[Witness], root: Path) -> list[Missing]:
    """List what the witnesses do not show of a spec, file by file.

    Of a message that is missing as a whole, its fields are not listed as well. Raises Unusable
    where a file cannot be read.
    """
    texts = {file: _text_of(root, file) for file in dict.fromkeys(each.file for each in witnesses)}
    found = [
        Missing(witness, subject)
        for witness in witnesses
        for subject in witness.subjects(model)
        if not witness.shows(subject, texts[witness.file])
    ]
    whole = {
        (each.witness.file, each.subject.message)
        for each in found
        if each.witness.of in ("messages", "requests", "queries")
    }
    reported = [
        each
        for each in found
        if each.witness.of != "fields" or (each.witness.file, each.subject.message) not in whole
    ]
    return sorted(reported, key=lambda each: [*texts].index(each.witness.file))


# ------------------------------------------------------------------ what a spec has to be shown


def _messages(model: Model) -> Iterator[Subject]:
    for name, layout in model.messages.items():
        yield Subject(name, ("messages", name), _words(layout))


def _requests(model: Model) -> Iterator[Subject]:
    for exchange in model.exchanges:
        name = exchange.request.name
        words = _words(exchange.request, method=exchange.method.name)
        yield Subject(name, ("messages", name), words)


def _queries(model: Model) -> Iterator[Subject]:
    queries = {exchange.request.name for exchange in model.exchanges if exchange.reply is not None}
    return (subject for subject in _requests(model) if subject.message in queries)


def _fields(model: Model) -> Iterator[Subject]:
    for name, layout in model.messages.items():
        # What every frame has is no field of any message.
        for field in (slot for slot in layout.arguments if slot not in layout.frame.given):
            path: KeyPath = ("messages", name, "fields", field.name)
            yield Subject(name, path, _words(layout, field=field.name))


def _values(model: Model) -> Iterator[Subject]:
    for name, layout in model.messages.items():
        for path, field in numbers_of(("messages", name), layout.message):
            for value in field.values:
                words = _words(layout, field=str(path[-1]), value=value)
                yield Subject(name, (*path, "values", value), words)


def _bits(model: Model) -> Iterator[Subject]:
    for name, layout in model.messages.items():
        for path, field in numbers_of(("messages", name), layout.message):
            for bit in field.bits:
                words = _words(layout, field=str(path[-1]), bit=bit)
                yield Subject(name, (*path, "bits", bit), words)


def _addresses(model: Model) -> Iterator[Subject]:
    for path, parts in envelopes(model.spec):
        for name, part in parts.items():
            for value in part.values if isinstance(part, AddressPart) else ():
                words = _in_capitals({"address": name, "value": value})
                yield Subject("", (*path, name, "values", value), words)


def _words(layout: MessageLayout, **others: str) -> dict[str, str]:
    """Say what the placeholders stand for: `{sender}` for `host`, `{SENDER}` for `HOST`.

    `{snake}` stands for the message as a function would be called after it, `servo_move`.
    """
    words = {
        "message": layout.name,
        "snake": snake_case(layout.name),
        "sender": layout.direction.sender,
        "receiver": layout.direction.receiver,
        "fields": ", ".join(f"{field.name}=..." for field in layout.arguments),
        **others,
    }
    return _in_capitals(words)


def _in_capitals(words: dict[str, str]) -> dict[str, str]:
    """Add each word in capitals, under its key in capitals."""
    return words | {key.upper(): snake_case(word).upper() for key, word in words.items()}


_SUBJECTS: dict[str, Callable[[Model], Iterator[Subject]]] = {
    "messages": _messages,
    "requests": _requests,
    "queries": _queries,
    "fields": _fields,
    "values": _values,
    "bits": _bits,
    "addresses": _addresses,
}
_ALWAYS = ("message", "snake", "sender", "receiver", "fields")
_PLACEHOLDERS: dict[str, tuple[str, ...]] = {
    "messages": _ALWAYS,
    "requests": (*_ALWAYS, "method"),
    "queries": (*_ALWAYS, "method"),
    "fields": (*_ALWAYS, "field"),
    "values": (*_ALWAYS, "field", "value"),
    "bits": (*_ALWAYS, "field", "bit"),
    "addresses": ("address", "value"),
}


# ------------------------------------------------------------------ how it stands in a file

_PLACEHOLDER = re.compile(r"\{(\w+)\}", re.ASCII)
_TOKEN = re.compile(r"(?P<gap>\s+)|(?P<any>\.\.\.)|(?P<word>(?:\w|\{\w+\})+)|(?P<mark>.)", re.ASCII)


def _regex(text: str, words: dict[str, str]) -> str:
    """Write a pattern of a declaration as a regular expression.

    Blanks and line breaks do not count; a word is found as a whole; `...` is anything up to where
    what stands in front of the first placeholder comes again.
    """
    begin = _regex(text.partition("{")[0], {}) if "..." in text else ""
    parts: list[str] = []
    after_word, gap = False, False
    for token in _TOKEN.finditer(text.strip()):
        gap = gap or token.lastgroup == "gap"
        if token.lastgroup == "gap":
            continue
        if parts:
            parts.append(r"\s+" if gap and after_word and token["word"] else r"\s*")
        if token["word"]:
            whole = _PLACEHOLDER.sub(lambda found: words[found[1]], token["word"])
            parts.append(rf"(?<!\w){re.escape(whole)}(?!\w)")
        else:
            parts.append(rf"(?:(?!{begin})[\s\S])*?" if token["any"] else re.escape(token[0]))
        after_word, gap = bool(token["word"]), False
    return "".join(parts)


def _text_of(root: Path, file: str) -> str:
    try:
        return (root / file).read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
        raise Unusable(
            f"{file}, which {DECLARATION} names, cannot be read: {reason}",
            hint="mend the path, which counts from the folder that holds spec/",
        ) from None


# ------------------------------------------------------------------ how it is declared

_KEYS = {
    "of": f"what of the spec is shown: one of {', '.join(_SUBJECTS)}",
    "file": "the file that shows it, from the folder that holds spec/",
    "text": "what stands there for each, such as `Case({message}(`",
    "write": "what to write where one is missing",
    "why": "what it is good for",
}


def _witness(tree: Tree, kinds: dict[str, Any], path: KeyPath) -> Witness:
    given = _mapping(tree, kinds, path)
    for key in [*given, *_KEYS]:
        here = (*path, key)
        if key not in _KEYS:
            raise _wrong(tree, here, "no such key", did_you_mean(key, _KEYS))
        if not isinstance(given.get(key), str):
            what = "is no text" if key in given else "is missing"
            raise _wrong(tree, here, what, f"write {_KEYS[key]}")
    witness = Witness(str(path[-1]), **given)
    if witness.of not in _SUBJECTS:
        hint = did_you_mean(witness.of, _SUBJECTS)
        raise _wrong(tree, (*path, "of"), f"nothing of a spec is `{witness.of}`", hint)
    words = [*_PLACEHOLDERS[witness.of], *map(str.upper, _PLACEHOLDERS[witness.of])]
    for key in ("text", "write"):
        for word in _PLACEHOLDER.findall(given[key]):
            if word not in words:
                hint = did_you_mean(word, words)
                raise _wrong(tree, (*path, key), f"nothing is put for `{{{word}}}`", hint)
    if not _PLACEHOLDER.search(witness.text) or witness.text.startswith(("{", "...")):
        hint = "begin with what stands in front of each, and name it: `Case({message}(`"
        raise _wrong(tree, (*path, "text"), "this is no pattern", hint)
    return witness


def _mapping(tree: Tree, around: dict[str, Any], path: KeyPath) -> dict[str, Any]:
    value = around[str(path[-1])]
    if not isinstance(value, dict):
        raise _wrong(tree, path, "no mapping", "")
    return value


def _wrong(tree: Tree, path: KeyPath, what: str, hint: str) -> Unusable:
    place = tree.key_at(path)
    at = f"{DECLARATION}:{place.line}:{place.column}"
    return Unusable(f"{at}: {dotted(path)}: {what}", hint=hint)


def _unreadable(source: Source, finding: Finding | None) -> Unusable:
    shown = "" if finding is None else f"\n{finding.render(source)}"
    return Unusable(f"{DECLARATION} is no mapping of protocols to witnesses{shown}")
