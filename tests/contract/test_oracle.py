"""The library and the oracle, which share no code, agree on any bytes and on any stream.

The frames in the table of truth were typed from the protocol document or from the notes on the
controller family: what the oracle makes of them is what they say.
"""

import ast
from pathlib import Path

import pytest
from busservo import DecodeError, Direction, Message, decode, strategies
from hypothesis import example, given
from hypothesis import strategies as st

from tests import oracle
from tests.captures import make_noisy_line
from tests.cases import BAD_FRAMES, CASES, BadFrame, Case, each_bad_frame, each_case
from tests.strategies import (
    DIRECTIONS,
    HEADS,
    damaged_frames,
    directions,
    lines,
    messages_in,
    oracles,
    pieces,
    read,
    said,
    scanned,
    single_bytes,
    unknown_frames,
)

CAPTURES = Path(__file__).parents[1] / "captures"
# Those that somebody has published: of the others, the document has the rule alone.
DOCUMENTED = [case for case in CASES if case.source[0].isdigit()]
# Those of them that stand in the document of today: a later edition may have others.
SECTIONS = {*(f"1.{number}" for number in range(1, 8)), *(f"2.{number}" for number in range(1, 4))}
OF_TODAY = [case for case in DOCUMENTED if case.source.partition(" ")[0] in SECTIONS]

each_direction = pytest.mark.parametrize("direction", DIRECTIONS, ids=str)


def verdict(frame: bytes, direction: Direction | None) -> object:
    """Return the library's decoding of a frame: the message as the oracle writes it, or None."""
    try:
        return said(decode(frame, direction))
    except DecodeError:
        return None


def oracles_verdict(frame: bytes, direction: Direction | None) -> object:
    """Return the oracle's decoding of it."""
    try:
        return oracle.parse(frame, oracles(direction))
    except oracle.OracleError:
        return None


def test_the_document_has_fourteen_examples() -> None:
    assert len(OF_TODAY) == 14


@each_case
def test_they_agree_on_the_table_of_truth(case: Case) -> None:
    assert oracle.build(*said(case.message)) == case.frame
    assert oracle.parse(case.frame, case.direction.value) == said(case.message)
    # Any other byte for the length is no frame.
    for length in {*range(256)} - {case.frame[2]}:
        wrong = case.frame[:2] + bytes([length]) + case.frame[3:]
        assert oracles_verdict(wrong, case.direction) is None
    for direction in DIRECTIONS:
        assert verdict(case.frame, direction) == oracles_verdict(case.frame, direction)


@each_bad_frame
def test_they_agree_on_bad_frames(bad: BadFrame) -> None:
    assert oracles_verdict(bad.frame, bad.direction) is None


@given(strategies.messages())
def test_they_write_the_same_frames(message: Message) -> None:
    assert message.encode() == oracle.build(*said(message))
    assert oracle.parse(message.encode(), message.DIRECTION.value) == said(message)


@given(
    st.one_of(
        st.binary(max_size=20),
        st.binary(max_size=12).map(lambda rest: b"\x55\x55" + rest),
        st.sampled_from(HEADS).flatmap(lambda head: st.binary(max_size=8).map(head.__add__)),
        damaged_frames(),
        unknown_frames(),
        strategies.messages().map(Message.encode),
    ),
    directions,
)
def test_they_agree_on_any_bytes(frame: bytes, direction: Direction | None) -> None:
    assert verdict(frame, direction) == oracles_verdict(frame, direction)


@each_direction
def test_they_agree_on_every_length_and_command(direction: Direction | None) -> None:
    # With the count that suits a move, and with the one that suits a request and a reply.
    for command in (*range(23), 0x55, 0xFF):
        for length in (*range(24), 84, 85, 86, 253, 254, 255):
            for count in {0, (length - 5) // 3 % 256, (length - 3) % 256, (length - 3) // 3 % 256}:
                body = bytes([length, command, count, *range(1, 254)])
                frame = b"\x55\x55" + body[: max(length, 2)]
                assert verdict(frame, direction) == oracles_verdict(frame, direction), frame.hex()


@given(lines, directions, st.data())
@example(make_noisy_line.recording(), None, None)
def test_they_find_the_same_in_any_stream(
    line: bytes, direction: Direction | None, data: st.DataObject | None
) -> None:
    chunks = [line] if data is None else data.draw(pieces(line))

    assert scanned(read(direction, chunks)) == oracle.scan(line, oracles(direction))


@given(lines, directions, st.data())
@example(make_noisy_line.recording(), None, None)
def test_they_have_found_the_same_before_the_line_goes_quiet(
    line: bytes, direction: Direction | None, data: st.DataObject | None
) -> None:
    chunks = single_bytes(line) if data is None else data.draw(pieces(line))
    found = read(direction, chunks, quiet=False)
    early = oracle.scan(line, oracles(direction), quiet=False)

    assert [said(message) for message in messages_in(found)] == [
        event for event in early if not isinstance(event, bytes)
    ]


@each_direction
def test_they_agree_on_all_tables_in_one_line(direction: Direction | None) -> None:
    line = b"".join(case.frame + bad.frame for case in CASES for bad in BAD_FRAMES[::7])

    assert scanned(read(direction, [line])) == oracle.scan(line, oracles(direction))


def test_the_noisy_line_is_what_its_script_writes() -> None:
    assert (CAPTURES / "noisy_line.bin").read_bytes() == make_noisy_line.recording()
    assert (CAPTURES / "noisy_line.md").read_text(encoding="utf-8") == make_noisy_line.description()


def test_the_noisy_line_holds_every_published_frame() -> None:
    seen = {(event.sender, event.data) for event in make_noisy_line.EVENTS}
    assert {(case.direction.sender, case.frame) for case in OF_TODAY} <= seen


def test_the_noisy_line_reads_as_its_script_says() -> None:
    # One (number of the scanned event, its name) for each byte of the recording.
    owners: list[tuple[int, str]] = []
    for number, found in enumerate(oracle.scan(make_noisy_line.recording(), None)):
        data = found if isinstance(found, bytes) else oracle.build(*found)
        name = "noise" if isinstance(found, bytes) else found[0]
        owners += [(number, name)] * len(data)

    offset = 0
    for event in make_noisy_line.EVENTS:
        names = dict(owners[offset : offset + len(event.data)]).values()
        assert (offset, event.hex, ", ".join(names)) == (offset, event.hex, event.reads_as)
        offset += len(event.data)
    assert len(owners) == offset


def test_the_oracle_imports_nothing_but_construct_and_the_standard_library() -> None:
    tree = ast.parse(Path(oracle.__file__).read_text(encoding="utf-8"))
    found = [node for node in ast.walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]
    imported = {
        name
        for node in found
        for name in (
            [a.name for a in node.names] if isinstance(node, ast.Import) else [node.module]
        )
    }

    assert imported == {"collections.abc", "construct", "functools", "operator", "typing"}
