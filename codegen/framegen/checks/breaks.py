"""Rule: what a version breaks on purpose is named by its path, with the reason."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.paths import NoPath, expect_place, read_path
from framegen.reading.findings import did_you_mean, slip_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath

_EXAMPLE = "write it as findings have it, such as `messages.NAME.fields.NAME`"
_ONE_OF_ALL = "name one, such as `messages.NAME`"


def whats_wrong(text: str) -> NoPath | None:
    """Return why nothing can break at a path, whatever a spec holds; None where something can."""
    try:
        path = read_path(text)
        expect_place(path)
    except NoPath as error:
        return error
    if path == ("messages",):
        return NoPath("`messages` would accept whatever breaks in any of them")
    return None


def _look(spec: Spec) -> Iterator[Problem]:
    for index, release in enumerate(spec.history):
        for text, reason in release.breaks.items():
            here = ("history", index, "breaks", text)
            yield from _path(here, text)
            if release.version == spec.protocol.version:
                yield from _message(here, text, spec)
            if not reason.strip():
                what = f"nothing says why `{text}` breaks"
                yield Problem(here, what, "write the reason, for those whose program it breaks")


def _path(here: KeyPath, text: str) -> Iterator[Problem]:
    error = whats_wrong(text)
    if error is not None:
        example = _ONE_OF_ALL if text == "messages" else _EXAMPLE
        hint = did_you_mean(error.step, error.known) if error.known else example
        yield Problem(here, str(error), hint, on_key=True)


def _message(here: KeyPath, text: str, spec: Spec) -> Iterator[Problem]:
    """Yield a problem where the name of a message seems to be misspelt.

    Another name may be that of a message that was removed, of which a spec need not know. Older
    versions may name what is forgotten since.
    """
    name = named_message(text)
    known = known_messages(spec)
    if name is None or name in known:
        return
    near = slip_of(name, known)
    if near:
        gone = f"if it was removed, reserve it: `reserved: [{{name: {name}, why: ...}}]`"
        hint = f"did you mean `{near}`? {gone}"
        yield Problem(here, missing(name), hint, on_key=True)


def missing(name: str) -> str:
    """Return what is wrong with naming a message of which a spec knows nothing."""
    return f"there is no message `{name}`, and none of that name is reserved"


def named_message(text: str) -> str | None:
    """Return the message in which a path is; None where it is in none."""
    if whats_wrong(text) is not None:
        return None
    path = read_path(text)
    return str(path[1]) if path[0] == "messages" else None


def known_messages(spec: Spec) -> dict[str, None]:
    """Return the names of messages that a spec knows: here, of old, or reserved."""
    names = dict.fromkeys(spec.messages)
    names |= dict.fromkeys(name for each in spec.messages.values() for name in each.was)
    return names | dict.fromkeys(each.name for each in spec.reserved if each.name is not None)


RULE = StructureRule(
    id="breaks",
    title="What a version breaks on purpose is named by its path, with the reason",
    why="`framegen diff` accepts a break at that path and below it; a path that leads nowhere "
    "accepts nothing, and a break without a reason looks like a mistake.",
    bad='history: [{version: "2.0.0", breaks: {LampFade: ""}, ...}]',
    good='history: [{version: "2.0.0", breaks: {messages.LampFade: No board has it.}, ...}]',
    look=_look,
)
