"""Nothing is written to a port but what is allowed, whatever a device does and loses of it."""

from collections.abc import Callable
from functools import cache
from itertools import chain
from pathlib import Path

import pytest
from busservo import Direction, Message, StreamDecoder
from framegen.conformance.device.permission import permit
from framegen.model.model import Model
from framegen.reading.yamltree import Unusable
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.independent.firmware import Reader, well_formed
from tests.factories import BUSSERVO, compiled_file, data_of, layout_of
from tests.in_turn import in_turn
from tests.lines.devices import Answer, by_the_reference
from tests.lines.timed_line import TimedLine
from tests.protocols.specs import FILES
from tests.unit.conformance.device.runs import Run, model_of, run

MODEL = model_of()
COMMANDS = ["ServoMove", "ActionGroupRun", "ActionGroupStop", "ActionGroupSpeed", "ServoUnload"]
QUERIES = {"BatteryVoltageRead", "ServoPositionsRead"}
OPTIONS = [
    [],
    ["--malformed"],
    *(["--malformed", "--allow", name] for name in COMMANDS),
    ["--allow", "ServoMove", "--allow", "ServoUnload"],
]


def spurious(data: bytes) -> list[tuple[float, bytes]]:
    return [(0.01 * at, bytes.fromhex("55 55 15") + data) for at in range(9)]


DEVICES: dict[str, Callable[[], Answer]] = {
    "answers": lambda: by_the_reference(MODEL),
    "is silent": lambda: lambda _: [],
    "sends spurious bytes": lambda: spurious,
}


def begun(data: bytes) -> set[int]:
    """Return the commands that firmware starts if it looks at header and command alone."""
    return {data[at + 3] for at in range(len(data) - 3) if data[at : at + 2] == b"UU"}


def allowed_by(options: list[str]) -> set[str]:
    return QUERIES | {name for name in options if not name.startswith("-")}


def received(pieces: list[bytes], *, quiet: bool) -> set[str]:
    """Return the messages that the library's decoder finds in the written bytes."""
    decoder = StreamDecoder(Direction.HOST_TO_CONTROLLER)
    events = []
    for data in pieces:
        events += decoder.feed(data)
        if quiet:
            events += decoder.flush()
    events += decoder.flush()
    return {type(event).__name__ for event in events if isinstance(event, Message)}


def obeyed(data: bytes) -> set[int]:
    """Return the commands that the independent firmware finds, as it trusts every length."""
    reader = Reader()
    frames = [frame for byte in data if (frame := reader.take(byte))]
    return {frame[3] for frame in frames if well_formed(frame)}


@cache
def sent_to(device: str, *options: str) -> Run:
    """Return the run on one of DEVICES."""
    return run(MODEL, TimedLine(DEVICES[device]()), *options)


@in_turn(
    "device, options",
    lambda: [
        *(("answers", options) for options in OPTIONS),
        # What is allowed makes no difference to a device that does not answer.
        *((device, options) for device in DEVICES for options in (*OPTIONS[:2], OPTIONS[-1])),
    ],
)
def test_nothing_is_sent_but_what_is_allowed(options: list[str], device: str) -> None:
    allowed = allowed_by(options)
    done = sent_to(device, *options)
    assert received(done.written, quiet=True) | received(done.written, quiet=False) <= allowed
    codes = {MODEL.messages[name].id for name in {*COMMANDS} - allowed}
    assert not begun(b"".join(done.written)) & codes
    assert set(done.report["will_send"]) == allowed
    assert set(done.report["will_not_send"]) == {*COMMANDS} - allowed


@in_turn("options", lambda: OPTIONS)
def test_all_that_is_allowed_is_sent(options: list[str]) -> None:
    done = sent_to("answers", *options)
    assert received(done.written, quiet=True) == allowed_by(options)
    assert all(step["not_sent"] is None for step in done.report["steps"])


def test_only_examples_of_allowed_messages_are_sent() -> None:
    done = sent_to("answers", "--malformed", "--allow", "ServoMove")
    examples = [each.hex for each in MODEL.messages["ServoMove"].message.examples]
    moves = [data for data in done.written if data[3:4] == b"\3"]
    assert moves == examples


@pytest.mark.parametrize("device", DEVICES)
def test_nothing_else_is_obeyed_even_if_a_byte_is_lost(device: str) -> None:
    written = sent_to(device, "--malformed").written
    for at, data in enumerate(written):
        for lost in range(len(data)):
            left = data[:lost] + data[lost + 1 :]
            pieces = [*written[:at], left, *written[at + 1 :]]
            assert received([*pieces[max(0, at - 1) : at + 3]], quiet=False) <= QUERIES
            assert obeyed(b"".join(pieces)) <= {15, 21}


# As docs/conformance.md lists them.
MALFORMED = [
    "a query cut short in its fields: 55 55 09 15 (too short)",
    "a query cut short before its fields: 55 55 02 (too short)",
    "a length that is one too many: 55 55 03 0F (length mismatch)",
    "a length that is one too few: 55 55 01 0F (length mismatch)",
    "a count that is one too many: 55 55 09 15 07 01 02 03 04 05 06 (count mismatch)",
    "a count that is one too few: 55 55 09 15 05 01 02 03 04 05 06 (count mismatch)",
    "an id that nobody has: 55 55 02 FF (unknown command)",
]


def test_what_will_be_sent_is_said_before_anything_is() -> None:
    line = TimedLine()
    said: list[str] = []
    line.write = lambda data: said.append(data.hex())  # type: ignore[method-assign]
    for form in ("text", "json"):
        done = run(MODEL, line, "--malformed", "--allow", "ServoMove", form=form)
        first = done.out if form == "text" else done.err
        assert "will send: BatteryVoltageRead, ServoPositionsRead, ServoMove\n" in first
        assert "  ServoMove time_ms=1000 targets=1:800: 55 55 08 03 01 E8 03 01 20 03\n" in first
        assert all(f"\n  {each}\n" in first for each in MALFORMED)
        assert "will not send: ActionGroupRun, " in first
    assert said


# What is refused, and why.
OBJECTIONS = [
    ("55 55 02 0F", ""),
    ("55 55 09 15 06 01 02 03 04 05 06", ""),
    ("55 55 02 07", "it holds 55 55 02 07, which begins a frame of ActionGroupStop"),
    # Whatever its length says: a device may not look at it.
    ("55 55 FF 07", "it holds 55 55 FF 07, which begins a frame of ActionGroupStop"),
    ("55 55 07 15 04 55 55 02 07", "it holds 55 55 02 07, which begins a frame of ActionGroupStop"),
    ("55 55 02 08", "it holds 55 55 02 08, which begins a frame of the reserved id 8"),
    ("55 55 02 01", "it holds 55 55 02 01, which begins a frame of the reserved id 1"),
    (
        "55 55 08 15 05 55 00 55 02 07",
        "it holds a frame of ActionGroupStop if the 00 behind 08 15 05 55 is lost",
    ),
    # A beginning alone, which what follows makes a frame of.
    ("55 55 08 03", "it holds 55 55 08 03, which begins a frame of ServoMove"),
]


@in_turn("data, why", lambda: OBJECTIONS)
def test_bytes_that_could_be_taken_for_a_command_are_refused(data: str, why: str) -> None:
    objection = permit(MODEL, []).objection(bytes.fromhex(data))
    assert objection == why


@in_turn(
    "name, queries",
    lambda: [
        ("dynamixel1", ["Read"]),
        ("modbus", ["CoilsRead", "HoldingRead"]),
        ("ubx", ["NavPvtPoll", "CfgPrtPoll", "CfgMsgPoll", "CfgRatePoll", "MonVerPoll"]),
    ],
)
def test_what_is_only_acknowledged_is_a_command(name: str, queries: list[str]) -> None:
    permission = permit(compiled_file(FILES[name]).model, [])
    assert permission.queries == queries
    assert not set(queries) & set(permission.commands)


@given(st.lists(st.one_of(st.sampled_from([0x55, 2, 7]), st.integers(0, 255)), max_size=12))
def test_what_is_not_refused_holds_no_command_for_the_librarys_decoder(ids: list[int]) -> None:
    data = bytes([0x55, 0x55, len(ids) + 3, 21, len(ids), *ids])
    if not permit(MODEL, []).objection(data):
        losses = [data[:lost] + data[lost + 1 :] for lost in range(len(data))]
        assert set(chain(*(received([each], quiet=False) for each in [data, *losses]))) <= QUERIES


def with_example(ids: list[int], at: int) -> Model:
    """Return the spec with another example of ServoPositionsRead, at a place among them."""
    data = data_of(BUSSERVO)
    example = {
        "title": "Made up",
        "hex": bytes([0x55, 0x55, len(ids) + 3, 21, len(ids), *ids]).hex(" ").upper(),
        "values": {"servo_ids": ids},
        "constructed": "To look like something else.",
    }
    data["messages"]["ServoPositionsRead"]["examples"].insert(at, example)
    return layout_of(data)


LOOKING_LIKE = [
    ([85, 85, 2, 7], "it holds 55 55 02 07, which begins a frame of ActionGroupStop"),
    # Its last byte and the next header are another header.
    ([1, 85], "it holds 55 55 55 02, which begins a frame of the reserved id 2"),
]


@in_turn("ids, why", lambda: LOOKING_LIKE)
def test_a_query_that_holds_a_command_is_not_sent_and_others_are(ids: list[int], why: str) -> None:
    model = with_example(ids, at=1)
    done = run(model, TimedLine(by_the_reference(model)))
    assert why in done.step("ServoPositionsRead, example 2")["not_sent"]
    assert not any(bytes(ids) in data for data in done.written)
    assert [each["passed"] for each in done.report["steps"]].count(False) == 1
    assert done.code == 0


def test_malformed_frames_are_made_of_queries_that_hold_no_command() -> None:
    model = with_example([85, 85, 2, 7], at=0)
    done = run(model, TimedLine(by_the_reference(model)), "--malformed")
    sent = [step["not_sent"] for step in done.report["steps"] if step["malformed"]]
    assert sent == [None] * 7
    assert not any(b"UU\2\7" in data for data in done.written)


# What cannot be allowed, what is said of it, and what to do.
REPLY = "BatteryVoltage cannot be allowed: it goes controller -> host"
NAMES = [
    ("ServoMov", "there is no message `ServoMov` to be allowed", "did you mean `ServoMove`?"),
    ("x", "there is no message `x`", "choose one of `ServoMove`, `ActionGroupRun`, "),
    ("BatteryVoltage", REPLY, "choose one of `ServoMove`"),
]


@in_turn("name, problem, hint", lambda: NAMES)
def test_a_name_that_cannot_be_allowed_is_reported_with_those_that_can(
    name: str, problem: str, hint: str
) -> None:
    line = TimedLine()
    with pytest.raises(Unusable) as caught:
        run(MODEL, line, "--allow", name)
    assert problem in str(caught.value)
    assert hint in caught.value.hint
    assert line.written == []


SPECS = Path(__file__).parents[3] / "specs"


@pytest.mark.parametrize("file", [SPECS / "lamp.yaml", FILES["ibus"]], ids=lambda file: file.stem)
def test_a_protocol_without_queries_and_reports_is_refused(file: Path) -> None:
    with pytest.raises(Unusable, match="has no query") as caught:
        run(model_of(file), TimedLine())
    assert caught.value.hint.startswith("name what may be sent, as by --allow ")


def test_a_device_without_replies_is_sent_allowed_commands() -> None:
    model = model_of(SPECS / "lamp.yaml")
    (name, *_) = [each.request.name for each in model.exchanges]
    done = run(model, TimedLine(), "--allow", name)
    assert done.written == [each.hex for each in model.messages[name].message.examples]
