"""What `explain` says of frames, of bytes that are none, and of frames of look-alikes."""

import json
import shutil
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.explain import explain
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model import codec
from framegen.model.model import Model, derive
from framewire.explain import refusals
from framewire.explain.explanation import Explanation, Reading, Refusal, Row
from framewire.explain.lookalikes import recognise
from framewire.explain.text import as_json, as_text
from hypothesis import given
from hypothesis import strategies as st

from tests.commands import run
from tests.factories import BUSSERVO, DEMO, ROOT, compiled_file, data_of
from tests.in_turn import in_turn
from tests.strategies import damaged_frames

LAYOUT, GREENHOUSE = (compiled_file(file).model for file in (BUSSERVO, DEMO))
HOST, CONTROLLER = LAYOUT.directions


def explained(hex_text: str, model: Model = LAYOUT) -> Explanation:
    return explain(model, bytes.fromhex(hex_text), model.directions)


def hints(hex_text: str, model: Model = LAYOUT) -> list[str]:
    return [hint.text for hint in explained(hex_text, model).hints]


# ---------------------------------------------------------------------------- whole pages
MOVE = "55 55 08 03 01 E8 03 01 20 03"
MOVE_PAGE = """\
ServoMove, host -> controller
Turn one or more servos to positions, all of them in the same time.

  byte  hex    part                 value    meaning
     0  55 55  header                        Two bytes that announce a frame
     2  08     length               8        3 * servo_count + 5
     3  03     command              3        ServoMove, CMD_SERVO_MOVE to the vendor
     4  01     servo_count          1        How many servos are listed
     5  E8 03  time_ms              1000 ms  How long the motion takes
     7  01     targets[0].servo_id  1        The servo to turn
     8  20 03  targets[0].position  800      Where to turn it

  reply:   none is due
  example: Servo 1 to position 800 in 1000 ms (vendor, section 1.1, example 1)
  source:  vendor, section 1.1 (Bus Servo Controller Communication Protocol)
"""
BATTERY = "55 55 04 0F 4C 1D"
# As the guide shows it, up to the next command.
GUIDE = (ROOT / "docs" / "command.md").read_text("utf-8")
BATTERY_PAGE = GUIDE.partition(f"$ busservo explain {BATTERY}\n")[2].partition("$ ")[0]
# What is explained, the status, and the page.
PAGES = {
    "a command": (MOVE, 0, MOVE_PAGE),
    "a reply with a scale": (BATTERY, 0, BATTERY_PAGE),
    "a length that is off by one": (
        "55 55 09 03 01 E8 03 01 20 03",
        1,
        """\
These 10 bytes are no frame of the Hiwonder bus servo controller.

  55 55 09 03 01 E8 03 01 20 03
        ^^ byte 2
  host -> controller: length mismatch: ServoMove has a length of 8, 11, 14 .. 254, not 9

  right up to there:
  byte  hex    part    value  meaning
     0  55 55  header         Two bytes that announce a frame

  55 55 09 03 01 E8 03 01 20 03
           ^^ byte 3
  controller -> host: unknown command: no message controller -> host has the command 3

hint: 10 bytes have a length of 8; with that they are ServoMove (host -> controller)
      55 55 08 03 01 E8 03 01 20 03
""",
    ),
    "a frame of a look-alike": (
        "55 55 01 07 01 20 03 E8 03 E8",
        1,
        """\
These 10 bytes are no frame of the Hiwonder bus servo controller.

  55 55 01 07 01 20 03 E8 03 E8
        ^^ byte 2
  host -> controller: length mismatch: ActionGroupStop has a length of 2, not 1
  controller -> host: length mismatch: ActionGroupStopped has a length of 2, not 1

  right up to there:
  byte  hex    part    value  meaning
     0  55 55  header         Two bytes that announce a frame

hint: this looks like a frame of the LX-16A bus servo protocol. Spoken behind the controller, at
      115200 baud, between the board and each servo. The same two header bytes, but a servo
      number comes before the length, and a checksum ends the frame. Public write-ups mix the
      two up. For servos without the controller there is lxservo, from the same house, whose
      command reads these frames.
""",
    ),
    "a frame that is legal in both directions": (
        "55 55 05 06 02 00 00",
        0,
        """\
ActionGroupRun, host -> controller
Run an action group stored on the controller, a number of times or for ever.

  byte  hex    part     value          meaning
     0  55 55  header                  Two bytes that announce a frame
     2  05     length   5              always 5
     3  06     command  6              ActionGroupRun, CMD_ACTION_GROUP_RUN to the vendor
     4  02     group    2              The number of the action group
     5  00 00  times    0 (unlimited)  Run until it is stopped

  reply:       none is due
  reported by: ActionGroupStarted, ActionGroupCompleted
  example:     Run action group 2 until it is stopped (vendor, section 1.2, example 2)
  source:      vendor, section 1.2 (Bus Servo Controller Communication Protocol)

ActionGroupStarted, controller -> host
An action group has started to run.

  byte  hex    part     value          meaning
     0  55 55  header                  Two bytes that announce a frame
     2  05     length   5              always 5
     3  06     command  6              ActionGroupStarted, CMD_ACTION_GROUP_RUN to the vendor
     4  02     group    2              The number of the action group
     5  00 00  times    0 (unlimited)  It runs until it is stopped

  reports on: ActionGroupRun
  example:    Action group 2 has started, to run until it is stopped
  source:     vendor, section 2.1 (Bus Servo Controller Communication Protocol)
""",
    ),
    "a frame after noise": (
        "00 FF 55 55 55 02 0F",
        1,
        """\
These 7 bytes are no frame of the Hiwonder bus servo controller.

  00 FF 55 55 55 02 0F
  ^^ byte 0
  in every direction: bad header: a frame begins 55 55

hint: a frame begins at byte 3: BatteryVoltageRead (host -> controller)
      55 55 02 0F
""",
    ),
}
WAYS = (", host -> controller", ", controller -> host")


@pytest.mark.parametrize(("hex_text", "code", "page"), PAGES.values(), ids=PAGES)
def test_a_page_explains_a_frame_and_json_as_well(hex_text: str, code: int, page: str) -> None:
    assert run("explain", BUSSERVO, *hex_text.split(), main=main) == (code, page, "")
    status, output, _ = run("explain", BUSSERVO, "--json", hex_text, main=main)
    printed = json.loads(output)
    assert (status, printed) == (code, as_json(explained(hex_text)))
    assert (printed["hex"], printed["frame"]) == (hex_text, code == 0)
    said = [line.split(",")[0] for line in page.splitlines() if code == 0 and line.endswith(WAYS)]
    assert [reading["message"] for reading in printed["readings"]] == said


@in_turn(
    "words, code, line",
    lambda: [
        (["55 55 02 07"], 0, "ActionGroupStop, host -> controller"),
        (["55 55 01 03 1C DF"], 0, "PositionRead, host -> servo"),
        (["55 55 01 03 1C DE"], 1, "These 6 bytes are no frame of the LX-16A servo bus."),
        (["busservo", "55 55 01 03 1C DF"], 1, "no frame of the Hiwonder bus servo controller."),
        (["55 55 01 03 1C DF", "--direction", "controller"], 1, "servo controller."),
    ],
)
def test_bytes_are_explained_by_the_protocol_that_they_come_closest_to(
    words: list[str], code: int, line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    status, output, _ = run("explain", *words, main=main)
    assert (status, output.partition("\n")[0].endswith(line)) == (code, True)


def test_more_bytes_than_a_line_holds_are_shown_on_several() -> None:
    page = as_text(explained("55 55 15 15 07" + 18 * " 01"))
    assert page.splitlines()[2:6] == [
        "  55 55 15 15 07 01 01 01 01 01 01 01 01 01 01 01",
        "              ^^ byte 4",
        "  01 01 01 01 01 01 01",
        "  host -> controller: count mismatch: a length of 21 makes servo_count 18, not 7",
    ]


def test_of_a_long_paste_the_bytes_around_the_place_are_shown() -> None:
    frame = codec.encode(LAYOUT.messages["ServoUnload"], {"servo_ids": [17] * 60})
    page = as_text(explain(LAYOUT, frame + bytes(60), [HOST]))
    assert page.splitlines()[2:10] == [
        "  ... 32 bytes before",
        f"  {(16 * ' 11').strip()}",
        f"  {(16 * ' 11').strip()}",
        "  11 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00",
        "     ^^ byte 65",
        f"  {(16 * ' 00').strip()}",
        f"  {(16 * ' 00').strip()}",
        "  ... 13 bytes after",
    ]


# ---------------------------------------------------------------------------- frames
def rows_cover(rows: tuple[Row, ...], data: bytes) -> bool:
    """Return whether the rows, in order, are the first bytes of `data`, none left out."""
    shown = b"".join(row.data for row in rows)
    ends = [0, *(row.end for row in rows)]
    return data.startswith(shown) and [row.offset for row in rows] == ends[:-1]


EXAMPLES = [
    pytest.param(layout, message.name, example.hex, id=f"{message.name}: {example.title}")
    for layout in (LAYOUT, GREENHOUSE)
    for message in layout.messages.values()
    for example in message.message.examples
]


@in_turn("model, name, data", lambda: EXAMPLES)
def test_each_byte_and_value_of_an_example_is_explained(
    model: Model, name: str, data: bytes
) -> None:
    message = model.messages[name]
    found = explain(model, data, model.directions)
    (reading,) = (each for each in found.readings if each.message == name)
    assert rows_cover(reading.rows, data)
    assert reading.rows[-1].end == len(data)
    assert ("example" in dict(reading.facts), found.hints) == (True, ())
    shown = {row.path: row.value for row in reading.rows}
    values = codec.decode(model, message.direction, data).values
    assert {path: shown[path] for path in flat("", values)} == flat("", values)


def flat(path: str, value: object) -> dict[str, object]:
    """Return the values within a value, by their paths."""
    if isinstance(value, dict):
        inner = ((f"{path}.{name}".removeprefix("."), each) for name, each in value.items())
    elif isinstance(value, list):
        inner = ((f"{path}[{index}]", each) for index, each in enumerate(value))
    else:
        return {path: value}
    return {name: leaf for each in inner for name, leaf in flat(*each).items()}


@in_turn("model, name, data", lambda: EXAMPLES)
def test_a_frame_cut_short_is_explained_up_to_the_cut(model: Model, name: str, data: bytes) -> None:
    direction = model.messages[name].direction
    (whole,) = explain(model, data, [direction]).readings
    for size in range(len(data)):
        (refusal,) = explain(model, data[:size], [direction]).refusals
        assert (refusal.reason, refusal.offset) == (refusals.TOO_SHORT, size)
        paths = [row.path for row in refusal.rows]
        assert paths == [row.path for row in whole.rows if row.end <= size]


def test_a_signed_number_is_shown_with_its_sign_and_in_its_unit() -> None:
    (reading,) = explained("C3 5A A5 11 00 09 00 01 51 80 02 FF 6A 00 C8", GREENHOUSE).readings
    assert [row.text for row in reading.rows[-2:]] == ["-150 cK = -1.50 K", "200 cK = 2.00 K"]


def test_a_deprecated_message_says_so_first() -> None:
    (reading,) = explained("C3 5A A5 10 00 04 FF FF FF FE", GREENHOUSE).readings
    assert reading.facts[0] == ("deprecated", "The display reads the bus by itself since 2024.")


# ---------------------------------------------------------------------------- no frames

# What is wrong: hex, direction, reason, offset, how many rows are right.
REFUSALS = [
    ("12", HOST, refusals.BAD_HEADER, 0, 0),
    ("55", HOST, refusals.TOO_SHORT, 1, 0),
    ("55 54 02 07", HOST, refusals.BAD_HEADER, 1, 0),
    ("55 55", HOST, refusals.TOO_SHORT, 2, 1),
    ("55 55 02", HOST, refusals.TOO_SHORT, 3, 2),
    ("55 55 02 08", HOST, refusals.UNKNOWN_COMMAND, 3, 2),
    ("55 55 02 08", CONTROLLER, refusals.LENGTH_MISMATCH, 2, 1),
    ("55 55 05 06 08", HOST, refusals.TOO_SHORT, 5, 4),
    ("55 55 05 06 08 01", HOST, refusals.TOO_SHORT, 6, 4),
    ("55 55 02 07 00", HOST, refusals.TRAILING_BYTES, 4, 3),
    ("55 55 08 03 02 E8 03 01 20 03", HOST, refusals.COUNT_MISMATCH, 4, 3),
    # Short, and its count wrong before that shows.
    ("55 55 09 15 06 01 02 03", CONTROLLER, refusals.COUNT_MISMATCH, 4, 3),
]


@in_turn("hex_text, direction, reason, offset, right", lambda: REFUSALS)
def test_a_refusal_has_its_reason_and_offset(
    hex_text: str, direction: Direction, reason: str, offset: int, right: int
) -> None:
    data = bytes.fromhex(hex_text)
    (refusal,) = explain(LAYOUT, data, [direction]).refusals
    assert (refusal.reason, refusal.offset, len(refusal.rows)) == (reason, offset, right)
    assert rows_cover(refusal.rows, data[:offset])


def test_the_direction_that_came_closest_is_shown_first() -> None:
    refused = explained("55 55 09 15 06 01 02 03 04 05").refusals
    found = [(refusal.direction, len(refusal.rows)) for refusal in refused]
    assert found == [(str(HOST), 9), (str(CONTROLLER), 3)]
    reasons = [refusal.reason for refusal in explained("55 55 02 08").refusals]
    assert reasons == [refusals.LENGTH_MISMATCH, refusals.UNKNOWN_COMMAND]


# ---------------------------------------------------------------------------- hints
DIALECT = "in the dialect of LeArm and uHand boards,"
READ = "BatteryVoltageRead (host -> controller)"
STOP = "ActionGroupStop (host -> controller) or ActionGroupStopped (controller -> host)"


@in_turn(
    "hex_text, expected",
    lambda: [
        ("55 55 02 0D", [f"{DIALECT} 13 reads the positions of all six servos"]),
        ("55 55 02 08", [f"{DIALECT} 8 erases action groups"]),
        ("55 55 02 63", []),
        ("12 34", []),
        (
            "55 55 02 0F 55 55 02 07",
            [f"a frame begins at byte 0: {READ}", f"a frame begins at byte 4: {STOP}"],
        ),
        # A frame inside a frame's bytes is shown once, and what follows it is looked at again.
        ("55 55 55 02 0F 55 02", [f"a frame begins at byte 1: {READ}"]),
        (
            "55 55 02 0F " * 10,
            [
                *(f"a frame begins at byte {at}: {READ}" for at in range(0, 32, 4)),
                "more frames follow, from byte 32 on",
            ],
        ),
    ],
)
def test_a_refused_frame_gets_hints(hex_text: str, expected: list[str]) -> None:
    assert hints(hex_text) == expected


def test_a_frame_of_the_other_end_is_recognised() -> None:
    found = explain(LAYOUT, bytes.fromhex(BATTERY), [HOST])
    hint = "sent the other way, they are BatteryVoltage (controller -> host)"
    assert (found.readings, [each.text for each in found.hints]) == ((), [hint])


def test_a_reserved_command_is_recognised_and_a_corrected_length_is_proposed() -> None:
    reserved = "19 is reserved: It was VentsOpen with angles of zero until 1.0.0."
    assert hints("C3 5A A5 13 00 00", GREENHOUSE) == [reserved]
    # Whatever the length counts.
    (hint,) = explained("C3 5A A5 11 00 08 00 01 51 80 02 FF 6A 00 C8", GREENHOUSE).hints
    assert hint.text == (
        "15 bytes have a size of 9; with that they are StationState (station -> gateway)"
    )
    assert hint.frame == bytes.fromhex("C3 5A A5 11 00 09 00 01 51 80 02 FF 6A 00 C8")


# ---------------------------------------------------------------------------- look-alikes
@in_turn(
    "hex_, name, command, meaning",
    lambda: [
        ("C3 5A A5 04 02 20 01 D8", "orchard", 0x20, ""),
        ("C3 5A A5 04 01 20 DA", "orchard", 0x20, ""),
        ("C3 5A A5 04 02 20 02 D7", "orchard", 0x20, ""),
        ("C3 5A A5 21 00 00", "old_stations", 0x21, "asks for the firmware"),
        ("C3 5A A5 22 00 00", None, None, None),  # no code of theirs
        ("C3 5A A5 04 02 20 01 D9", None, None, None),  # a wrong checksum
        ("C3 5A A5 04 03 20 01 D7", None, None, None),  # a wrong length
        ("C3 5A A5 04 02 20 01 D8 00", None, None, None),  # a byte too many
        ("C3 5A A6 04 02 20 01 D8", None, None, None),  # a wrong preamble
        ("C3 5A", None, None, None),  # too short for any frame
        ("", None, None, None),
    ],
)
def test_a_lookalike_is_recognised(
    hex_: str, name: str | None, command: int | None, meaning: str | None
) -> None:
    found = recognise(GREENHOUSE.protocol, bytes.fromhex(hex_))
    row = (None, None, None) if found is None else (found.name, found.command, found.meaning)
    assert row == (name, command, meaning)


# ---------------------------------------------------------------------------- the command
def test_hex_longer_than_any_path_is_hex(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # With two specs, the first word would have to name one.
    shutil.copytree(ROOT / "spec", tmp_path / "spec", ignore=shutil.ignore_patterns("lx*"))
    monkeypatch.chdir(tmp_path)
    frame = codec.encode(LAYOUT.messages["ServoUnload"], {"servo_ids": list(range(252))})
    status, output, _ = run("explain", frame.hex(), main=main)
    assert (status, "\n   255  FA     servo_ids[250]  250\n" in output) == (0, True)
    status, output, _ = run("explain", 20 * frame.hex(), main=main)
    assert (status, "hint: more frames follow, from byte 2056 on\n" in output) == (1, True)


NOTHING = ("there are no bytes to explain", "give them in hex, like 55 55 02 07")
WRITE = "write two digits a byte, like 0A 1B FF"
LONG = 40 * "55"


@in_turn(
    "words, problem, hint",
    lambda: [
        (
            ["--direction", "hots", "55"],
            "no endpoint 'hots' sends anything",
            "did you mean `host`?",
        ),
        ([""], *NOTHING),
        ([" , "], *NOTHING),
        (["55 5 02"], "`5` is half a byte\n  55 5 02\n     ^", "did you mean 05?"),
        (
            ["55 555"],
            "`555` is 3 digits, which is no whole number of bytes\n  55 555\n     ^^^",
            "look for a digit that was lost or added",
        ),
        (["0x55,0xO2"], "`O` is no hex digit\n  0x55,0xO2\n         ^", WRITE),
        (["55 \u0665\u0665"], "`\u0665` is no hex digit\n  55 \u0665\u0665\n     ^", WRITE),
        (["0x"], "`0x` has no digits after it\n  0x\n  ^^", "write the byte whole, like 0x1B"),
        (["55\x1b[2J"], "`\ufffd` is no hex digit\n  55\ufffd[2J\n    ^", WRITE),
        (
            [f"{LONG}!{LONG}"],
            f"`!` is no hex digit\n  {15 * '55'}!{'55' * 14}5\n{' ' * 32}^",
            WRITE,
        ),
    ],
)
def test_what_is_not_explained_is_shown_in_place(words: list[str], problem: str, hint: str) -> None:
    said = f"framegen: error: {problem}\n  hint: {hint}\n"
    assert run("explain", BUSSERVO, *words, main=main) == (2, "", said)


# ---------------------------------------------------------------------------- any bytes
@given(model=st.sampled_from([LAYOUT, GREENHOUSE]), data=st.binary(min_size=1) | damaged_frames())
def test_any_bytes_are_explained(model: Model, data: bytes) -> None:
    explanation = explain(model, data, model.directions)
    page, values = as_text(explanation), as_json(explanation)
    results: list[Reading | Refusal] = [*explanation.readings, *explanation.refusals]
    assert {result.direction for result in results} == set(map(str, model.directions))
    assert all(rows_cover(result.rows, data) for result in results)
    assert all(
        row.end <= refusal.offset for refusal in explanation.refusals for row in refusal.rows
    )
    for hint in explanation.hints:
        assert not hint.frame or explain(model, hint.frame, model.directions).readings
    assert json.loads(json.dumps(values)) == values
    assert bool(explanation.readings) != page.startswith(("These ", "This "))
    assert bool(explanation.readings) == any(legal(model, data, way) for way in model.directions)


def legal(model: Model, data: bytes, direction: Direction) -> bool:
    try:
        codec.decode(model, direction, data)
    except codec.NotAFrame:
        return False
    return True


def test_a_checksum_that_another_one_covers_is_mended_first() -> None:
    data = data_of(BUSSERVO)
    data["frame"] = {
        "header": {"is": "constant", "bytes": "55 55"},
        "sum": {"is": "checksum", "type": "u8", "method": "sum", "covers": ["command", "check"]},
        "length": {"is": "length", "type": "u8", "counts": ["length", "command", "parameters"]},
        "command": {"is": "id", "type": "u8"},
        "parameters": {"is": "body"},
        "check": {"is": "checksum", "type": "u8", "method": "xor", "covers": ["parameters"]},
    }
    model = derive(Spec.model_validate(data))
    message = model.messages["ActionGroupRun"]
    frame = codec.encode(message, message.message.examples[0].values)
    damaged = frame[:2] + b"\0" + frame[3:-1] + b"\0"
    found = explain(model, damaged, [message.direction])
    assert frame in [hint.frame for hint in found.hints]
