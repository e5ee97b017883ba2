"""Search for messages: by name, by number, or by any word in what is written of them."""

from __future__ import annotations

from difflib import get_close_matches

from ..protocol.form import message_data

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from ..protocol.message import Message
    from ..protocol.protocol import Protocol

# So much alike are a word and what was meant by it; of other words, many are half alike.
_MUCH_ALIKE = 0.75


def find(model: Protocol, words: str) -> list[Message]:
    """Return the messages that `words` name; else those that have the words in what is written.

    Those that have them in their names come first. Without any words, it is every message.
    """
    messages = [*model.messages.values()]
    named = [each for each in messages if folded(words) in _names(each)]
    if named or not words.split():
        return named or messages
    numbers = _numbers(words)
    numbered = [each for each in messages if set(numbers).intersection(each.ids)]
    if numbered:
        return numbered
    sought = [folded(word) for word in words.split()]
    if not all(sought):
        return []
    in_names, in_texts = [], []
    for each in messages:
        names = " ".join(_names(each))
        words_in = (word for text in _written(model, each) for word in text.split())
        text = "".join(f" {folded(word)}" for word in words_in)
        if all(word in names for word in sought):
            in_names.append(each)
        elif all(word in names or f" {word}" in text for word in sought):
            in_texts.append(each)
    return in_names + in_texts


def near(model: Protocol, words: str) -> list[str]:
    """Return the names of messages that are much like `words`; else words of what is written."""
    messages = model.messages.values()
    names = {name: each.name for each in messages for name in _names(each)}
    texts = (text for each in messages for text in _written(model, each))
    written = {folded(word) for text in texts for word in text.split() if word.isalpha()}
    found = [names[name] for name in get_close_matches(folded(words), names)]
    return list(dict.fromkeys(found)) or get_close_matches(
        folded(words), sorted(written), cutoff=_MUCH_ALIKE
    )


def folded(word: str) -> str:
    """Return a word, however its parts are joined and written."""
    return "".join(character for character in word.casefold() if character.isalnum())


def _names(message: Message) -> list[str]:
    names = [message.name, message.class_name, message.vendor_name]
    return [folded(name) for name in names if name]


def _numbers(words: str) -> list[int]:
    """Return the numbers that `words` may be: in decimal, or else in hex with or without 0x."""
    if words.isascii() and words.isdigit():
        return [int(words)] if len(words) < 20 else []
    digits = words.casefold().removeprefix("0x")
    is_hex = digits and all(character in "0123456789abcdef" for character in digits)
    return [int(digits, 16)] if is_hex and len(digits) < 20 else []


def _written(model: Protocol, message: Message) -> Iterator[str]:
    return _texts(message_data(message, model.byte_order))


def _texts(said: Any) -> Iterator[str]:
    """Yield every text below, and the names of values."""
    if isinstance(said, str):
        yield said
    elif isinstance(said, dict):
        for name, each in said.items():
            if name not in ("client", "python", "shell", "hex", "cite"):
                yield from _texts(each)
        yield from map(str, said.get("values", {}))
    elif isinstance(said, list):
        for each in said:
            yield from _texts(each)
