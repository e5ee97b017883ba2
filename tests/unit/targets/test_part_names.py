"""A field may be called like a part of its frame: whoever looks one up finds the right one.

What is said of a spec must be said of the same spec with its fields renamed, in the other names.
"""

import re
from collections.abc import Iterator
from functools import cache
from itertools import zip_longest
from typing import Any, NamedTuple

import pytest
from framegen.audit.misfits import outside
from framegen.compile import Compiled
from framegen.explain import explain
from framegen.language.spec import Example
from framegen.model.codec import encode, values_of
from framegen.model.layout import MessageLayout
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data
from framegen.targets.docs.strip import pattern_strip
from framegen.targets.python.names import names_of

from tests.factories import DEMO, Data, compiled_of, data_of, library, library_files
from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script

EVERYTHING = DEMO.with_name("everything.yaml")
# What a user gives with every message cannot be the name of a field, too: `part-name` says so.
_GIVEN = ("address", "counter")
# The fields take turns in the names of the parts.
TURNS = range(7)
_PROGRAM = """
const answers = asked.map(({ protocol, questions }) => {
  const codec = makeCodec(protocol);
  return questions.map(([way, bytes]) => {
    const event = codec.decodeFrame(bytes, way);
    const rows = event.rows.map(({ path, text }) => [path, text]);
    return [event.fields, rows, Array.from(codec.encode(event.message, event.fields))];
  });
});
"""


class Pair(NamedTuple):
    """An example of a message whose fields are called like parts, and the same as it was."""

    message: MessageLayout
    example: Example
    before: MessageLayout
    was: Example
    names: dict[str, str]

    def renamed(self, names: list[str]) -> list[str]:
        """Return the names that the parts and fields of a frame have now, by those they had."""
        head, tail = len(self.before.frame.head), len(self.before.frame.tail)
        end = len(names) - tail
        body = [re.sub(r"^\w+", self._now, name) for name in names[head:end]]
        return [*names[:head], *body, *names[end:]]

    def _now(self, found: re.Match[str]) -> str:
        return self.names.get(found[0], found[0])


def _names(data: Data, message: Data, turn: int) -> dict[str, str]:
    """Return the fields of a message that get other names, and these."""
    sized = any("sized_by" in field for field in message["fields"].values())
    parts = [
        name
        for name, part in data["frames"][message["frame"]].items()
        if part["is"] not in _GIVEN and not (sized and part["is"] == "length")
    ]
    fields, at = [*message["fields"]], turn % len(parts)
    turned = [*fields[turn % len(fields) :], *fields[: turn % len(fields)]]
    names = dict(zip(turned, [*parts[at:], *parts[:at]], strict=False))
    # A field may have the name of a part already; no other can have it then.
    return {old: new for old, new in names.items() if new not in fields or new in names}


def _renamed(message: Data, names: dict[str, str]) -> Data:
    def now(named: Data) -> Data:
        return {names.get(name, name): each for name, each in named.items()}

    counters = ("counted_by", "sized_by")
    fields = {
        name: {
            key: names.get(each, each) if key in counters else each for key, each in said.items()
        }
        for name, said in message["fields"].items()
    }
    length = message["length"]
    if isinstance(length, str):
        length = re.sub(r"[a-z_]\w*", lambda found: names.get(found[0], found[0]), length)
    examples = [{**each, "values": now(each["values"])} for each in message["examples"]]
    return {**message, "fields": now(fields), "length": length, "examples": examples}


@cache
def turned(turn: int) -> tuple[Compiled, dict[str, dict[str, str]]]:
    """Return a spec with every kind of field, and its fields called like parts."""
    data = data_of(EVERYTHING)
    names = {name: _names(data, message, turn) for name, message in data["messages"].items()}
    data["messages"] = {
        name: _renamed(message, names[name]) for name, message in data["messages"].items()
    }
    compiled = compiled_of(data)
    assert [finding.message for finding in compiled.findings] == []
    return compiled, names


@cache
def _plain() -> Compiled:
    return compiled_of(data_of(EVERYTHING))


def pairs(turn: int) -> Iterator[Pair]:
    compiled, names = turned(turn)
    for message in compiled.model.messages.values():
        before = _plain().model.messages[message.name]
        for example, was in zip(message.message.examples, before.message.examples, strict=True):
            yield Pair(message, example, before, was, names[message.name])


def test_every_part_and_every_field_has_its_turn() -> None:
    names = [turned(turn)[1]["Flags"] for turn in TURNS]
    frames, messages = data_of(EVERYTHING)["frames"], data_of(EVERYTHING)["messages"]
    assert {new for each in names for new in each.values()} == {*frames["tell"]}
    assert {old for each in names for old in each} == {*messages["Flags"]["fields"]}


@pytest.mark.parametrize("turn", TURNS)
def test_the_reference_reads_and_writes_the_same_values(turn: int) -> None:
    for pair in pairs(turn):
        message, example = pair.message, pair.example
        assert encode(message, example.values, example.hex) == example.hex
        values = values_of(message, example.hex)
        before = values_of(pair.before, pair.was.hex)
        assert [*values.values()] == [*before.values()]
        wrong, was = (
            outside(each, each, it) for each, it in ((message, values), (pair.before, before))
        )
        assert [why for _, why in wrong] == [why for _, why in was]


@pytest.mark.parametrize("turn", TURNS)
def test_an_explanation_and_a_drawing_show_the_same_parts(turn: int) -> None:
    for pair in pairs(turn):
        rows, before = (
            explain(compiled.model, example.hex, [message.direction]).readings[0].rows
            for compiled, message, example in (
                (turned(turn)[0], pair.message, pair.example),
                (_plain(), pair.before, pair.was),
            )
        )
        assert [row.path for row in rows] == pair.renamed([row.path for row in before])
        assert [(row.data, row.text) for row in rows] == [(row.data, row.text) for row in before]
        plain, was = turned(turn)[0].model.protocol.messages, _plain().model.protocol.messages
        cells = pattern_strip(plain[pair.message.name])
        drawn = pattern_strip(was[pair.before.name])
        assert [cell.name for cell in cells] == pair.renamed([cell.name for cell in drawn])
        assert [cell.role for cell in cells] == [cell.role for cell in drawn]


def cells_of(message: Any) -> list[list[str]]:
    """Return the cells of the table that a notebook shows: bytes, name, what it says."""
    rows = re.findall(r"<tr>(.*?)</tr>", message._repr_html_())
    names, data, says = (re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows)
    return [[*each] for each in zip_longest(data, names, says, fillvalue="")]


@pytest.mark.parametrize("turn", TURNS)
def test_a_notebook_shows_the_same_cells(turn: int) -> None:
    with library(library_files(_plain())) as made:
        before = {
            pair.message.name: cells_of(made.decode(pair.was.hex, _way(made, pair)))
            for pair in pairs(turn)
        }
    with library(library_files(turned(turn)[0])) as made:
        for pair in pairs(turn):
            shown, was = (
                cells_of(made.decode(pair.example.hex, _way(made, pair))),
                before[pair.message.name],
            )
            names = names_of(turned(turn)[0].model)
            now = [names.of("field", name) for name in pair.names.values()]
            bent = pair._replace(names=dict(zip(pair.names, now, strict=True)))
            assert [name for _, name, _ in shown] == bent.renamed([name for _, name, _ in was])
            assert [(data, says) for data, _, says in shown] == [
                (data, says) for data, _, says in was
            ]


def _way(made: Any, pair: Pair) -> Any:
    return made.Direction(pair.message.direction.key)


@pytest.mark.skipif(NODE is None, reason="node is not installed")
def test_the_pages_read_write_and_explain_the_same() -> None:
    asked = [
        {
            "protocol": protocol_data(turned(turn)[0].model),
            "questions": [(each.message.direction.key, each.example.hex) for each in pairs(turn)],
        }
        for turn in TURNS
    ]
    scripts = codec_scripts(turned(0)[0].model)
    for turn, answers in zip(TURNS, run_script(scripts, _PROGRAM, asked), strict=True):
        model = turned(turn)[0].model
        assert codec_scripts(model) == scripts
        for pair, (fields, rows, frame) in zip(pairs(turn), answers, strict=True):
            said = explain(model, pair.example.hex, [pair.message.direction]).readings[0].rows
            assert fields == values_of(pair.message, pair.example.hex)
            assert rows == [[row.path, row.text] for row in said]
            assert bytes(frame) == encode(pair.message, values_of(pair.message, pair.example.hex))
