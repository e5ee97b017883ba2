"""Messages as plain data and back, copied with changes, and shown in a notebook."""

import copy
import json
import re
from html.parser import HTMLParser
from typing import Any

import busservo
import pytest
from busservo import ActionGroupRun, ActionGroupStop, EncodeError, Message, Noise, Reason, ServoMove
from framewire.command.values import fields_in_json

from tests.cases import Case, each_case
from tests.in_turn import in_turn


# ------------------------------------------------------------------ to_dict, from_dict
@each_case
def test_a_message_comes_back_from_plain_data_as_the_command_prints_it(case: Case) -> None:
    fields = case.message.to_dict()
    assert [*fields] == [*case.message.__match_args__]
    assert json.loads(json.dumps(fields)) == fields == json.loads(fields_in_json(case.message))
    assert type(case.message).from_dict(fields) == case.message


TARGET = {"servo_id": 1, "position": 800}
HIGH = {**TARGET, "position": 70000}
ABSENT, NONE = "it is missing;", "there is no such field;"
MOVE_HAS, TARGET_HAS = "ServoMove has time_ms, targets", "ServoTarget has servo_id, position"
FOLLOWS = "it follows from targets; leave it out"
# The fields of a move beside its time, and what is said of them.
NO_MOVES: list[tuple[dict[str, Any], str]] = [
    ({}, f"targets: {ABSENT} {MOVE_HAS}"),
    ({"targets": [TARGET], "speed": 2}, f"speed: {NONE} {MOVE_HAS}"),
    ({"targets": [TARGET], "servo_count": 1}, f"servo_count: 1 is not given: {FOLLOWS}"),
    ({"targets": [TARGET, {"servo_id": 1}]}, f"targets[1].position: {ABSENT} {TARGET_HAS}"),
    ({"targets": [{**TARGET, "speed": 3}]}, f"targets[0].speed: {NONE} {TARGET_HAS}"),
    ({"targets": [TARGET, HIGH]}, "targets[1].position: 70000 is outside 0..65535"),
    ({"targets": TARGET}, "targets[0].servo_id: 'servo_id' is not a whole number, but a str"),
]


@in_turn(
    "kind, fields, said",
    lambda: [
        *((ServoMove, {"time_ms": 1, **fields}, said) for fields, said in NO_MOVES),
        (
            busservo.ServoUnload,
            {"servo_ids": [{"id": 1}]},
            "servo_ids[0]: {'id': 1} is not a whole number",
        ),
        (ActionGroupStop, {"group": 1}, f"group: {NONE} ActionGroupStop has no"),
        (busservo.BatteryVoltage, {"voltage_mv": 7.5}, "voltage_mv: 7.5 is not a whole number"),
    ],
)
def test_what_is_no_message_is_refused_at_its_place(
    kind: type[Message], fields: dict[str, Any], said: str
) -> None:
    with pytest.raises(EncodeError, match=f"^{re.escape(said)}") as caught:
        kind.from_dict(fields)
    assert caught.value.path == said.partition(":")[0]


def test_what_is_no_mapping_is_no_message() -> None:
    fields: Any = [1, 2]
    with pytest.raises(TypeError, match=r"a mapping of fields expected, such as a dict, not \[1"):
        ServoMove.from_dict(fields)


# ------------------------------------------------------------------ copy.replace
def test_a_copy_may_have_other_fields() -> None:
    move = ServoMove(1000, [(1, 800)])
    replace = getattr(copy, "replace", lambda message, **changes: message.__replace__(**changes))
    assert replace(move, time_ms=5) == ServoMove(5, [(1, 800)])
    assert move == ServoMove(1000, [(1, 800)])
    with pytest.raises(EncodeError, match="time_ms: 70000 is outside"):
        replace(move, time_ms=70000)
    with pytest.raises(TypeError, match="speed"):
        replace(move, speed=1)


# ------------------------------------------------------------------ in a notebook
class Table(HTMLParser):
    """The cells of a table by row, and every tag and attribute that there is."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.text = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_data(self, data: str) -> None:
        self.text += data
        if self.rows:
            self.rows[-1][-1] += data


SHOWN: list[Message | Noise] = [
    ServoMove(1000, [(1, 800), (9, 200)]),
    Noise(b"\x00\xff", Reason.BAD_HEADER),
    busservo.UnknownFrame(bytes.fromhex("55 55 04 63 01 02"), Reason.UNKNOWN_COMMAND),
]


def test_a_strip_shows_fields_with_values_names_and_units() -> None:
    table = Table(ServoMove(1000, [(1, 800), (9, 200)])._repr_html_())
    assert table.text.startswith("ServoMove, host to controller, 13 bytes")
    names = ["header", "length", "command", "servo_count", "time_ms", "targets[0]", "targets[1]"]
    assert table.rows == [
        names,
        ["55 55", "0B", "03", "02", "E8 03", "01 20 03", "09 C8 00"],
        ["", "11", "3", "2", "1000 ms", "servo_id 1, position 800", "servo_id 9, position 200"],
    ]
    assert Table(ActionGroupRun(8, 0)._repr_html_()).rows[2][-1] == "0 (unlimited)"


def test_noise_is_shown_with_its_reason_and_an_unknown_frame_with_its_parts() -> None:
    noise, unknown = (Table(event._repr_html_()) for event in SHOWN[1:])
    assert noise.text.startswith("Noise: bad header, 2 bytes")
    assert noise.rows == [["00 FF"]]
    assert unknown.text.startswith("Unknown frame: command 99, 6 bytes")
    assert unknown.rows == [
        ["header", "length", "command", "parameters"],
        ["55 55", "04", "63", "01 02"],
        ["", "4", "99", ""],
    ]


def test_a_long_strip_is_cut_and_says_so() -> None:
    move = Table(ServoMove(1, [(1, 1)] * 83)._repr_html_())
    assert len(move.rows[0]) == 49
    assert move.rows[0][-1] == "and 120 bytes more"
    noise = Table(Noise(bytes(1000), Reason.BAD_HEADER)._repr_html_())
    assert noise.rows[0][0].endswith("00 00 and 936 bytes more")


@in_turn("event", lambda: SHOWN)
def test_a_strip_is_a_plain_table(event: Message | Noise) -> None:
    table = Table(event._repr_html_())
    head = set() if type(event) is Noise else {"th"}
    assert table.tags == {"div", "table", "tr", "td"} | head
    assert table.attributes == {"style"}
    # Its colours are those of the page, which may be light or dark.
    assert not re.search(r"color|background|#", event._repr_html_())
