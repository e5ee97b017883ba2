"""A device of any protocol passes where it is right, and each of its mutants is found."""

import importlib
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from itertools import chain, cycle
from pathlib import Path
from typing import Any

import pytest
from busservo_simulator import VirtualClock
from framegen.conformance.device.permission import Permission, permit
from framegen.conformance.device.queries import requests
from framegen.model.codec import decode, encode, values_of
from framegen.model.exchanges import Exchange
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh
from framegen.reading.yamltree import Unusable
from hypothesis import assume, given
from hypothesis import strategies as st
from lxservo_simulator import VirtualBus

from tests.factories import (
    Data,
    compiled_file,
    compiled_of,
    data_of,
    layout_of,
    library,
    library_files,
)
from tests.in_turn import in_turn
from tests.lines.at_board import end_of
from tests.lines.devices import Answer, answers_to, by_the_reference, is_divided
from tests.lines.timed_line import TimedLine
from tests.protocols.libraries import made_of, values_in
from tests.protocols.specs import FILES
from tests.random_specs import WAYS, specs, with_examples
from tests.rows import each_protocol
from tests.unit.conformance.device.runs import Run, model_of, run

PUMPS = Path(__file__).with_name("pumps_of_two_kinds.yaml")
SPECS = {**FILES, "pumps": PUMPS}
# Whose devices are asked, and whose only report.
ASKED = [name for name in SPECS if Permission(model_of(SPECS[name])).queries]
LISTENS = "what comes within 3 s"
REPORTING = ["sbus", "tfmini", "crsf", "mavlink1"]


def allowing(model: Model) -> list[str]:
    """Return the options that allow everything with an answer."""
    names = (each.request.name for each in model.exchanges if each.reply is not None)
    told = set(names) - set(Permission(model).queries)
    return [*chain(*(("--allow", name) for name in sorted(told)))]


def on(name: str, answer: Answer, *options: str) -> Run:
    """Return a run on a device of a protocol."""
    return run(model_of(SPECS[name]), TimedLine(answer), *options)


@pytest.mark.parametrize(
    "name", each_protocol([name for name in SPECS if allowing(model_of(SPECS[name]))])
)
def test_a_device_by_the_reference_passes_with_all_that_it_answers(name: str) -> None:
    model = model_of(SPECS[name])
    done = on(name, by_the_reference(model), *allowing(model))
    assert [each for each in done.faults if each[0] != LISTENS] == []
    assert [each["not_sent"] for each in done.report["steps"] if each["not_sent"]] == []


@pytest.mark.parametrize("name", each_protocol(ASKED))
def test_a_device_by_the_reference_passes_with_malformed_frames(name: str) -> None:
    done = on(name, by_the_reference(model_of(SPECS[name])), "--malformed")
    assert (done.code, done.faults) == (0, [])
    assert sum(step["malformed"] for step in done.report["steps"]) >= 3
    assert [each["not_sent"] for each in done.report["steps"] if each["not_sent"]] == []


@in_turn("name", lambda: ["lxservo", "modbus", "pumps"])
@in_turn("extra", lambda: [b"", b"\0"])
def test_an_echo_is_left_out_and_another_is_seen(name: str, extra: bytes) -> None:
    data = data_of(SPECS[name])
    data["link"] = {**data.get("link", {}), "local_echo": True}
    model = layout_of(data)
    answer = by_the_reference(model)

    def echoed(data: bytes) -> list[tuple[float, bytes]]:
        return [(0.0, extra + data), *answer(data)]

    done = run(model, TimedLine(echoed))
    what = {each["what"].partition(" ")[0] for each in received(done)}
    replies = {each.reply.name for each in model.exchanges if each.reply is not None}
    assert (what <= replies and done.code == 0) == (not extra)


def received(done: Run) -> list[dict[str, Any]]:
    """Return all that was received."""
    bursts = [burst for step in done.report["steps"] for burst in step["bursts"]]
    return [each for burst in bursts for each in burst["received"]]


@given(specs(), st.booleans())
def test_a_device_of_any_spec_passes_by_what_it_may_be_sent(spec: Data, everything: bool) -> None:
    ways = {
        way: [name for name, each in spec["messages"].items() if each["direction"] == way]
        for way in WAYS
    }
    asked, answers = ways.values()
    assume(asked and answers)
    for name, reply in zip(asked, cycle(answers)):
        spec["messages"][name]["reply"] = reply
    compiled = compiled_of(with_examples(spec))
    assume(not compiled.findings)
    model = compiled.model
    queries = Permission(model).queries
    assume(queries)
    commands = [name for name in asked if name not in queries] if everything else []
    allowed = chain(*(("--allow", name) for name in commands))
    done = run(model, TimedLine(by_the_reference(model)), "--malformed", *allowed)
    # What holds the beginning of a frame that is not allowed is not sent; passed is what was tried.
    tried = [step for step in done.report["steps"] if not step["not_sent"]]
    assert (done.code, done.faults) == (0 if tried else 1, [])
    sent = {model.roles.sent, *(way for way in model.directions if way != model.roles.received)}
    found = ReferenceDecoder(model, [*sent]).decode(b"".join(done.written))
    assert {each.message.name for each in found if each.message} <= {*queries, *commands}


# --- What is generated ---------------------------------------------------------------------------


def generated(name: str, until: ExitStack, *addresses: int) -> Answer:
    """Return the device end of a library, which says what the examples say."""
    compiled = compiled_file(SPECS[name])
    made = until.enter_context(library(library_files(compiled)))
    module = importlib.import_module(f"{made.__name__}.device")
    device = module.Device(*addresses)
    for exchange in compiled.model.exchanges:
        if exchange.reply is not None:
            handler = dict(module.Device._handlers)[getattr(made, exchange.request.name)]
            setattr(device, handler, _saying(made, exchange))
    divided = is_divided(compiled.model)

    def answer(data: bytes) -> list[tuple[float, bytes]]:
        replies = device.receive(data)
        if divided:
            device.quiet()
        return [(0.001, replies + b"".join(each.encode() for each in device.take()))]

    return answer


def _saying(made: Any, exchange: Exchange) -> Callable[[Any], Any]:
    reply = exchange.reply
    assert reply is not None

    def handle(message: Any) -> Any:
        asked = values_in(exchange.request, message)
        return made_of(made, reply, answers_to(exchange, reply, asked))

    return handle


@pytest.mark.parametrize("name", each_protocol(ASKED))
def test_the_generated_device_passes(name: str) -> None:
    with ExitStack() as until:
        done = on(name, generated(name, until), "--malformed")
    assert (done.code, done.faults) == (0, [])


@pytest.mark.parametrize("echo", [False, True])
def test_the_simulator_of_servos_passes(echo: bool) -> None:
    model = model_of(SPECS["lxservo"])
    clock = VirtualClock(follow_reads=True)
    with VirtualBus(servos=[5, 6], baud=115200, clock=clock, local_echo=echo) as bus:
        options = ["--local-echo"] if echo else []
        done = run(model, end_of(bus), "--malformed", "--address", "5", *options)
    assert (done.code, done.faults) == (0, [])
    assert sum(step["malformed"] for step in done.report["steps"]) == 6


# --- Mutants of a device -------------------------------------------------------------------------

Mutant = Callable[["Model", "Answer"], "Answer"]


def replies_changed(change: Callable[[Model, bytes], bytes]) -> Mutant:
    """Return a device whose replies are changed."""

    def mutant(model: Model, answer: Answer) -> Answer:
        return lambda data: [(delay, change(model, reply)) for delay, reply in answer(data)]

    return mutant


def _flipped(_model: Model, reply: bytes) -> bytes:
    return reply[:-1] + bytes([reply[-1] ^ 1])


def _from_another(model: Model, reply: bytes) -> bytes:
    for message in model.sent(model.roles.received):
        part = message.frame.address
        if part is not None and message.frame.least <= len(reply):
            try:
                values = values_of(message, reply)
                if encode(message, values) == reply:
                    values[part.name] += -1 if values[part.name] > part.low else 1
                    return encode(message, values)
            except ValueError:
                continue
    return reply


def deaf_to_checksums(model: Model, answer: Answer) -> Answer:
    """Return a device that takes a frame whose checksum is wrong."""
    way = model.roles.sent
    shapes = [
        (message, size)
        for message in model.sent(way)
        for size in {message.size_at(count) for count in message.counts[:9]}
    ]

    def repaired(data: bytes) -> bytes:
        sealed = (message.sealed(data[:size]) for message, size in shapes if size <= len(data))
        return next((each for each in sealed if weigh(model, [way], each).message), b"")

    def careless(data: bytes) -> list[tuple[float, bytes]]:
        read = b""
        while data:
            size = weigh(model, [way], data).frame_size or len(repaired(data)) or 1
            read += repaired(data) or data[:size]
            data = data[size:]
        return answer(read)

    return careless


def deaf_behind_malformed(model: Model, answer: Answer) -> Answer:
    """Return a device that drops all that comes at once where it does not begin with a frame."""
    return lambda data: answer(data) if weigh(model, [model.roles.sent], data).message else []


def silent(_model: Model, _answer: Answer) -> Answer:
    return lambda _: []


def twice(_model: Model, answer: Answer) -> Answer:
    return lambda data: [each for each in answer(data) for _ in range(2)]


def late(_model: Model, answer: Answer) -> Answer:
    return lambda data: [(delay + 0.6, reply) for delay, reply in answer(data)]


CHECKED = ["dynamixel1", "mhz19", "modbus", "msp", "lxservo", "pumps"]
ADDRESSED = ["dynamixel1", "modbus", "lxservo", "pumps"]
# Without a checksum, on a bus, with one, and with frames of two kinds.
FEW = ["lxservo", "msp", "pumps"]
MUTANTS: list[tuple[str, Mutant, list[str], str]] = [
    ("its replies have a wrong end", replies_changed(_flipped), CHECKED, "no frame"),
    ("it says another address", replies_changed(_from_another), ADDRESSED, "wrong reply"),
    ("it tests no checksum", deaf_to_checksums, CHECKED, "unsolicited reply"),
    ("it is silent", silent, FEW, "silence"),
    ("it answers twice", twice, FEW, "unsolicited reply"),
    ("it is late", late, FEW, "late reply"),
]
CASES = [
    pytest.param(mutant, name, kind, id=f"{name}: {about}")
    for about, mutant, names, kind in MUTANTS
    for name in names
]


@in_turn("mutant, name, kind", lambda: CASES)
def test_a_mutant_is_found_and_called_by_its_name(mutant: Mutant, name: str, kind: str) -> None:
    model = model_of(SPECS[name])
    done = on(name, mutant(model, by_the_reference(model)), "--malformed")
    assert done.code == 1
    assert kind in {found for _, found in done.faults}


@in_turn("name", lambda: [name for name in CHECKED if name != "modbus"])
def test_a_device_that_loses_what_follows_malformed_bytes_is_found(name: str) -> None:
    model = model_of(SPECS[name])
    done = on(name, deaf_behind_malformed(model, by_the_reference(model)), "--malformed")
    lost = {step["title"] for step in done.report["steps"] if step["malformed"]}
    assert lost
    assert {title for title, _ in done.faults} == lost


# --- Addresses -----------------------------------------------------------------------------------


@in_turn("name", lambda: ADDRESSED)
def test_the_device_of_another_address_is_asked_by_it(name: str) -> None:
    model = model_of(SPECS[name])
    done = on(name, by_the_reference(model, 7), "--malformed", "--address", "7")
    assert (done.code, done.faults) == (0, [])
    asked = permit(model, [], 7)
    assert {each.values[asked.address.name] for each in requests(asked)} == {7}  # type: ignore[union-attr]


def test_a_device_that_is_not_there_may_have_another_address() -> None:
    done = on("lxservo", by_the_reference(model_of(SPECS["lxservo"]), 7))
    assert done.code == 1
    assert done.report["stopped"].endswith("If it has another servo_id, name it by --address")


def test_what_nobody_answers_is_not_asked() -> None:
    permission = permit(model_of(SPECS["lxservo"]), [])
    asked = {(each.message.name, each.values["servo_id"]) for each in requests(permission)}
    assert ("ServoIdRead", 1) in asked
    assert 254 not in {address for _, address in asked}


@in_turn(
    "name, address, problem, hint",
    lambda: [
        ("ubx", "1", "devices of ubx have no address", "leave --address out"),
        ("pumps", "33", "no device of two_kinds has the address 33", "write one of 1..32"),
        ("pumps", "0", "0 is no device's own address: nobody answers what is sent there", "at the"),
    ],
)
def test_an_address_of_no_device_is_refused(
    name: str, address: str, problem: str, hint: str
) -> None:
    with pytest.raises(Unusable) as caught:
        on(name, silent(model_of(SPECS[name]), lambda _: []), "--address", address)
    assert str(caught.value) == problem
    assert hint in caught.value.hint


# --- One thing at a time, refusals, several kinds of frames --------------------------------------


@in_turn(
    "name, at_once", lambda: [("ubx", True), ("msp", True), ("modbus", False), ("lxservo", False)]
)
def test_nothing_is_sent_into_a_reply_on_a_shared_line(name: str, at_once: bool) -> None:
    model = model_of(SPECS[name])
    written: list[bytes] = on(name, by_the_reference(model)).written
    frames = {each.frame for each in requests(permit(model, []))}
    assert any(each not in frames for each in written) == at_once


def test_malformed_bytes_are_a_frame_of_their_own_where_silence_divides_frames() -> None:
    model = model_of(SPECS["modbus"])
    done = on("modbus", by_the_reference(model), "--malformed")
    steps = [step for step in done.report["steps"] if step["malformed"]]
    assert [len(step["bursts"]) for step in steps] == [2] * len(steps)
    assert "a checksum that is wrong, then CoilsRead" in [step["title"] for step in steps]


def test_a_refusal_is_an_answer_and_is_noted() -> None:
    model = model_of(SPECS["pumps"])

    def refusing(data: bytes) -> list[tuple[float, bytes]]:
        replies = by_the_reference(model)(data)
        flow = model.messages["Flow"].ids
        refusal = encode(model.messages["Refused"], {"pump": 3, "why": 2})
        return [(at, refusal if reply[2:3] == bytes(flow) else reply) for at, reply in replies]

    done = on("pumps", refusing)
    assert (done.code, done.faults) == (0, [])
    notes = done.step("FlowRead, example 1")["notes"]
    assert notes == ["FlowRead is refused: Refused pump=3 why=2"]


def test_a_failure_is_noted() -> None:
    model = model_of(SPECS["dynamixel1"])
    status = model.messages["Status"]

    def failing(data: bytes) -> list[tuple[float, bytes]]:
        replies = by_the_reference(model)(data)
        return [
            (at, encode(status, {**values_of(status, reply), "error": 8})) for at, reply in replies
        ]

    done = on("dynamixel1", failing)
    assert (done.code, done.faults) == (0, [])
    assert "Read failed: error 8" in done.report["steps"][0]["notes"]


def test_frames_are_numbered_in_turn() -> None:
    model = model_of(SPECS["everything"])
    done = on("everything", lambda _: [], "--allow", "Numbers", "--allow", "Lists")
    sent = [decode(model, model.roles.sent, data).values["sequence"] for data in done.written]
    assert len(sent) > 1
    assert sent == [*range(len(sent))]


# What is refused of frames of two kinds, one of which only its size tells.
OBJECTIONS = [
    ("3F 03 01 04 0D", ""),
    ("21 21 03 01 91", ""),
    ("21 21 03 E8 03 FF", "it holds a frame of SpeedSet"),
    ("21 21 03 E8 00 03 FF", "it holds a frame of SpeedSet if the 00 behind 21 21 03 E8 is lost"),
    # With another checksum, it is no frame, and nothing else tells that it is one.
    ("21 21 03 E8 03 FE", ""),
]


@in_turn("data, why", lambda: OBJECTIONS)
def test_what_only_its_size_tells_is_refused_as_a_whole(data: str, why: str) -> None:
    permission = permit(model_of(PUMPS), [])
    assert permission.objection(bytes.fromhex(data)) == why


# --- Devices that only report --------------------------------------------------------------------


def reports(name: str) -> Iterator[bytes]:
    model = model_of(SPECS[name])
    for message in model.sent(model.roles.received):
        if model.kind(message.name) == "report":
            yield from (example.hex for example in message.message.examples)


def listening(name: str, frames: list[bytes]) -> Run:
    """Return a run on a device that sends these every 20 ms, without end."""
    line = TimedLine()
    for number in range(200):
        line.say(frames[number % len(frames)], 0.02 * number)
    return run(model_of(SPECS[name]), line)


@in_turn("name", lambda: REPORTING)
def test_a_device_that_only_reports_is_listened_to_and_what_is_no_report_found(
    name: str,
) -> None:
    done = listening(name, [*reports(name)])
    assert (done.code, done.faults, done.written) == (0, [], [])
    [step] = done.report["steps"]
    assert step["title"] == LISTENS
    assert all(" came " in note for note in step["notes"])
    good = next(reports(name))
    bad = good[: len(good) // 2] + good[len(good) // 2 + 1 :]
    done = listening(name, [good, good, bad])
    assert done.code == 1
    assert {kind for _, kind in done.faults} == {"no frame"}


def test_a_beginning_that_was_missed_is_no_fault() -> None:
    good = next(reports("tfmini"))
    line = TimedLine()
    for number, data in enumerate([good[4:], good, good, good[:5]]):
        line.say(data, 0.02 * number)
    done = run(model_of(SPECS["tfmini"]), line)
    assert (done.code, done.faults) == (0, [])
    assert done.report["steps"][0]["notes"][0].startswith("before the first frame: 5 bytes, ")


def test_a_device_that_reports_nothing_is_silent() -> None:
    done = run(model_of(SPECS["sbus"]), TimedLine())
    assert done.faults == [(LISTENS, "silence")]
