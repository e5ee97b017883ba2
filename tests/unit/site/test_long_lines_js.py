"""Lines of more bytes than the page's codec holds at once: decoded as by the library."""

from __future__ import annotations

import random
from importlib import import_module
from typing import Any

import pytest
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data

from tests.factories import compiled_file
from tests.in_turn import in_turn
from tests.unit.site.peers import joined, noisy_lines
from tests.unit.site.reference import NODE, ROOT
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

# More than two of the blocks that the codec copies into, and of the windows that it looks at.
SIZE = 150_000
PROGRAM = """
const codec = makeCodec(asked.protocol), line = Uint8Array.from(asked.line);
function decoded(cuts) {
  const stream = codec.makeStream({ direction: asked.direction }), events = [], held = [];
  let start = 0;
  for (const end of [...cuts, line.length]) {
    const chunk = line.slice(start, end);
    events.push(...stream.feed(chunk));
    // What was fed is the caller's, who may use it again.
    chunk.fill(0);
    held.push([stream.pending, stream.position]);
    start = end;
  }
  events.push(...stream.flush());
  held.push([stream.pending, stream.position]);
  return [events.map(({ type, at, size, bytes, message, reason }) => (
    [type, at, size, Buffer.from(bytes).toString("hex"), message || reason])), held];
}
const answers = asked.cuts.map(decoded);
"""


def cuts(chance: random.Random, most: int) -> list[int]:
    """Return where a line is cut, into chunks of up to so many bytes."""
    found = [0]
    while found[-1] < SIZE:
        found.append(found[-1] + chance.randint(1, most))
    return found[1:-1]


@in_turn("name", lambda: ["busservo", "lxservo"])
def test_a_long_line_is_decoded_as_by_the_library_however_it_is_cut(name: str) -> None:
    model = compiled_file(ROOT / "spec" / f"{name}.yaml").model
    chance = random.Random(name)  # noqa: S311 - the same line in every run
    line = b""
    while len(line) < SIZE:
        line += b"".join(noisy_lines(model, len(line), 100))
        # Noise that is longer than a block has an event that is.
        line += bytes(chance.choice([0, 0, 70_000 if len(line) > SIZE // 2 else 0]))
    line = line[:SIZE]
    way = model.directions[0]
    library = import_module(name)
    decoder = library.StreamDecoder(library.Direction(way.key))
    expected = [*decoder.feed(line), *decoder.flush()]
    asked = {
        "protocol": protocol_data(model),
        "line": line,
        "direction": way.key,
        "cuts": [[], cuts(chance, 50), cuts(chance, 100_000)],
    }
    for events, held in run_script(codec_scripts(model), PROGRAM, asked):
        said = [[kind, hex_, what] for kind, _, _, hex_, what in events]
        assert joined(said) == joined(_events(expected))
        assert [(at, size) for _, at, size, _, _ in events] == _places(events)
        assert held[-1] == [0, SIZE]
        largest = model.largest([way])
        assert [pending for pending, _ in held if pending > largest] == []


def _places(events: list[Any]) -> list[tuple[int, int]]:
    """Return where events begin that follow each other, and how many bytes they have."""
    sizes = [len(event[3]) // 2 for event in events]
    starts = [0]
    for size in sizes[:-1]:
        starts.append(starts[-1] + size)
    return [*zip(starts, sizes, strict=True)]


def _events(events: list[Any]) -> list[Any]:
    """Return the library's events as the page gives them."""
    said = []
    for event in events:
        kind = {"Noise": "noise", "UnknownFrame": "unknown"}.get(type(event).__name__, "message")
        data = event.encode() if kind == "message" else event.data
        what = type(event).__name__ if kind == "message" else "unknown command"
        said.append([kind, data.hex(), event.reason.value if kind == "noise" else what])
    return said
