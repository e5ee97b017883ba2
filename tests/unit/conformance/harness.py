"""Hold a codec in any language to the published vectors, through the line protocol of `answer`.

It knows nothing of the generator but the file of vectors, as anybody else's harness would.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

from tests.programs import ran

# More than any frame has: the vector sets no bound.
NO_BOUND = 1 << 20


@dataclass(frozen=True)
class Case:
    """A question, and the right answer to it; noise is joined."""

    title: str
    question: str
    answer: list[str]

    def differs(self, answer: Sequence[str]) -> str:
        """Return what is wrong with an answer; empty for the right one."""
        shown = joined(answer)
        if _same(shown, self.answer):
            return ""
        return "\n".join([f"{self.title}: {self.question}", *self.answer, "but:", *shown])


def cases_of(document: dict[str, Any]) -> Iterator[Case]:
    """Yield every question that a file of vectors holds."""
    for vector in document["valid"]:
        name, way, frame = vector["message"], vector["direction"], _hex(vector["hex"])
        yield Case(vector["title"], f"decode {way} {frame}", [_message(vector)])
        fields = "".join(f" {field}" for field in _fields(vector["fields"]))
        yield Case(vector["title"], f"encode {name}{fields}", [f"frame {frame}"])
    for vector in document["unencodable"]:
        fields = "".join(f" {field}" for field in _fields(vector["fields"]))
        yield Case(vector["title"], f"encode {vector['message']}{fields}", ["refused"])
    for vector in document["invalid"]:
        answer = f"refused {_dashed(vector['reason'])} {vector['offset']}"
        question = f"decode {vector['direction']} {_hex(vector['hex'])}".rstrip()
        yield Case(vector["title"], question, [answer])
    for vector in document["streams"]:
        parts = [part if part == "quiet" else _hex(part) for part in vector["parts"]]
        largest = NO_BOUND if vector["max_frame"] is None else vector["max_frame"]
        question = " ".join(["stream", vector["direction"], str(largest), *parts])
        yield Case(vector["title"], question, [*map(_event, vector["events"])])


def differences(questions: Sequence[Case], answers: Sequence[Sequence[str]]) -> list[str]:
    """Return what is wrong with the answers to all questions, one text for each wrong one."""
    found = (each.differs(answer) for each, answer in zip(questions, answers, strict=True))
    return [each for each in found if each]


def run(command: Sequence[str], questions: Sequence[str]) -> list[list[str]]:
    """Run a program, and return the lines that it prints for this input, without each `end`."""
    done = ran(*command, input="".join(f"{question}\n" for question in questions))
    assert done.stderr == ""
    answers: list[list[str]] = [[]]
    for line in done.stdout.splitlines():
        if line == "end":
            answers.append([])
        else:
            answers[-1].append(line)
    assert answers.pop() == []
    return answers


def joined(lines: Sequence[str]) -> list[str]:
    """Return the lines of an answer, with adjacent noise of one reason joined."""
    found: list[str] = []
    for line in lines:
        noise, _, data = line.rpartition(" ")
        if noise.startswith("noise ") and found and found[-1].rpartition(" ")[0] == noise:
            found[-1] += data
        else:
            found.append(line)
    return found


def _event(event: dict[str, Any]) -> str:
    match event["event"]:
        case "message":
            return _message(event)
        case "unknown":
            return f"unknown {_hex(event['hex'])}"
        case "noise":
            return f"noise {_dashed(event['reason'])} {_hex(event['hex'])}"
        case other:
            assert other == "quiet"
            return "quiet"


def _message(vector: dict[str, Any]) -> str:
    fields = _fields(vector["fields"])
    return " ".join(["message", vector["message"], _hex(vector["hex"]), *fields])


def _same(lines: Sequence[str], others: Sequence[str]) -> bool:
    """Tell whether lines are the same, however a language prints a fraction."""
    pairs = zip_longest(*(re.split("([ =:,\n])", "\n".join(each)) for each in (lines, others)))
    return all(
        one == other or (_is_fraction(one, other) and float(one) == float(other))
        for one, other in pairs
    )


def _is_fraction(one: str | None, other: str | None) -> bool:
    """Tell whether two words are numbers, of which one is no whole one as the vectors have it."""
    words = [each for each in (one, other) if each is not None and _NUMBER.fullmatch(each)]
    return len(words) == 2 and any(not each.removeprefix("-").isdecimal() for each in words)


_NUMBER = re.compile(r"-?([0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?|inf|Infinity)")


def _fields(fields: dict[str, Any]) -> list[str]:
    return [f"{name}={_value(value)}" for name, value in fields.items() if value is not None]


def _value(value: Any) -> str:
    if isinstance(value, list):
        return ",".join(_item(each) for each in value)
    return _word(value)


def _item(item: Any) -> str:
    parts = item.values() if isinstance(item, dict) else [item]
    return ":".join(_word(each) or "%00" for each in parts)


def _word(value: Any) -> str:
    """Write a number, or a text without anything that ends it or is not seen."""
    if not isinstance(value, str):
        return str(value)
    return "".join(f"%{ord(each):02X}" if _is_special(each) else each for each in value)


def _is_special(character: str) -> bool:
    return not "!" <= character <= "~" or character in "%,:"


def _hex(digits: str) -> str:
    return digits.replace(" ", "").lower()


def _dashed(reason: str) -> str:
    return reason.replace(" ", "-")
