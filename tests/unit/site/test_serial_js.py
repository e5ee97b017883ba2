"""The scripts that talk over a line, under node: a port that comes and goes, echoes, recordings."""

import io
import random
from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any

import pytest
from busservo import (
    BatteryVoltage,
    BatteryVoltageRead,
    ServoPositions,
    ServoPositionsRead,
    StreamDecoder,
    recordings,
)
from busservo._library import CODEC
from framegen.model.codec import encode
from framegen.model.model import Model
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.line_data import line_data
from framegen.site.scripts.protocol_data import protocol_data
from framewire.client.base_client import REPLY_TIMEOUT
from framewire.client.local_echo import LocalEcho
from framewire.codec.gap import GAP

from tests.bad_specs import BASES
from tests.factories import compiled_file
from tests.in_turn import in_turn
from tests.unit.site.reference import NODE, reference
from tests.unit.site.scripts import SESSION, run_script
from tests.unit.site.serial_host import ADAPTER, FAKE_SERIAL

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")
MODEL = reference("busservo").model
_WAIT = "const wait = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });"


def answers(program: str, asked: object = None) -> Any:
    """Run the body of an async function behind the scripts of a line, and return its result."""
    fake, whole = FAKE_SERIAL.read_text("utf-8"), f"const answers = (async () => {{{program}}})();"
    return run_script([*codec_scripts(MODEL), *SESSION], whole, asked, fake, _WAIT)


# ---------------------------------------------------------------------------- the port

_PORT = """
const said = [], board = { refused: [], written: [], pieces: [], stuck: false, slow: 0 };
let number = 1;
const given = () => ({ id: `port ${number}`, info: asked.adapter });
const fake = makeFakeSerial({
  choose: async () => (board.nothing ? null : given()),
  open: async () => {
    await wait(board.slow);
    said.push("OPEN");
    return board.refused.shift() ?? false;
  },
  write: async (id, bytes) => {
    if (board.stuck) await new Promise(() => {});
    board.written.push(bytes);
    return board.wrong ?? "";
  },
  read: async () => board.pieces.splice(0),
  close: async () => { said.push("CLOSE"); },
}, wait);
const line = makeSerialLine({
  serial: fake, wait: (ms) => wait(ms / 10),
  received: (bytes) => said.push(`got ${[...bytes]}`),
  changed: (state, error) => {
    if (state !== said.at(-1)) said.push(error ? `${state}: ${error.name}` : state);
  },
  failed: (error) => said.push(`failed: ${error.name}`),
});
const settings = { baudRate: 9600, dataBits: 8, stopBits: 1, parity: "none", flowControl: "none" };
const open = () => line.choose(settings);
const unplug = () => fake.unplug(given().id);
const plugIn = () => { number += 1; fake.plugIn(given()); };
const told = (error) => { said.push(error.name); };
// Send a frame that is stuck on its way.
const stuck = () => {
  board.stuck = true;
  return line.write([1]).catch(() => said.push("not sent"));
};
"""

OPENED = "choosing | opening | OPEN | open"
UNREAD = '{error: "UnknownError", fatal: true}'
# What is done with a port, and what is said of it.
PORTS = {
    "opened, read and closed": (
        "await open(); board.pieces.push({bytes: [1, 2]}); await wait(20); await line.close();",
        f"{OPENED} | got 1,2 | closing | CLOSE | closed",
    ),
    "closed twice at once, and again": (
        "await open(); await Promise.all([line.close(), line.close()]); await line.close();",
        f"{OPENED} | closing | CLOSE | closed",
    ),
    "nothing was chosen": (
        "board.nothing = true; await open();",
        "choosing | closed: NotFoundError",
    ),
    "in use elsewhere, and then not": (
        "board.refused = [true]; await open(); await open();",
        f"choosing | opening | OPEN | closed: NetworkError | {OPENED}",
    ),
    "closed while it is being opened": (
        "board.slow = 20; const opened = open(); await wait(5); await line.close(); await opened;",
        "choosing | opening | closing | OPEN | CLOSE | closed",
    ),
    "opened twice at once": ("await Promise.all([open(), open()]);", OPENED),
    "errors of the line after which it goes on": (
        """await open();
        for (const error of ["FramingError", "BreakError"])
          board.pieces.push({ error }, { bytes: [7] });
        await wait(60);""",
        f"{OPENED} | failed: FramingError | got 7 | failed: BreakError | got 7",
    ),
    "an error after which nothing is read": (
        f"await open(); board.pieces.push({UNREAD}); await wait(20);",
        f"{OPENED} | lost: UnknownError | CLOSE",
    ),
    "unplugged and plugged in again": (
        """await open(); unplug(); await wait(20); plugIn(); await wait(20);
        board.pieces.push({bytes: [3]}); await wait(20);""",
        f"{OPENED} | lost | CLOSE | opening | OPEN | open | got 3",
    ),
    "back, and not to be opened at once": (
        "await open(); unplug(); await wait(9); board.refused = [true]; plugIn(); await wait(200);",
        f"{OPENED} | lost | CLOSE | opening | OPEN | lost: NetworkError | opening | OPEN | open",
    ),
    "given up while it is lost": (
        "await open(); unplug(); await wait(20); await line.close(); plugIn(); await wait(20);",
        f"{OPENED} | lost | CLOSE | closing | closed",
    ),
    "unplugged while a frame is being sent": (
        "await open(); const sent = stuck(); await wait(10); unplug(); await sent; await wait(20);",
        f"{OPENED} | lost | not sent | CLOSE",
    ),
    "closed while a frame is being sent": (
        "await open(); const sent = stuck(); await wait(10); await line.close(); await sent;",
        f"{OPENED} | closing | not sent | CLOSE | closed",
    ),
    "a write that fails, and the next": (
        """await open(); board.wrong = "UnknownError"; await line.write([1]).catch(told);
        board.wrong = ""; await line.write([2]); said.push("sent");""",
        f"{OPENED} | UnknownError | sent",
    ),
    "a write before it is open": ("await line.write([1]).catch(told);", "InvalidStateError"),
    "closed before it was opened": ("await line.close();", ""),
    "a choice that comes after it was closed": (
        "const opened = open(); await line.close(); await opened;",
        "choosing | closing | closed",
    ),
}


def test_the_line_is_what_has_happened_to_its_port() -> None:
    steps = {name: _PORT + steps for name, (steps, _) in PORTS.items()}
    program = """const found = {};
    for (const [name, steps] of Object.entries(asked.steps)) {
      found[name] = await eval(
        `(async () => {${steps} const was = [...said]; await line.close(); return was;})()`);
    }
    return found;"""
    found = answers(program, {"adapter": ADAPTER, "steps": steps})
    without_repeats = {name: " | ".join(each for each, _ in groupby(found[name])) for name in found}
    assert without_repeats == {name: expected for name, (_, expected) in PORTS.items()}


def test_frames_are_sent_whole_and_in_order() -> None:
    program = """await open();
    const frames = Array.from({ length: 50 }, (_, i) => [i, i + 1, i + 2]);
    await Promise.all(frames.map((frame) => line.write(frame)));
    await line.close();
    return board.written;"""
    assert answers(_PORT + program, {"adapter": ADAPTER}) == [[i, i + 1, i + 2] for i in range(50)]


# ---------------------------------------------------------------------------- what is said

_SESSION = """
const protocol = asked.protocol, codec = makeCodec(protocol), said = [];
const hex = (text) => text.match(/../g).map((digits) => parseInt(digits, 16));
const session = makeSession({
  codec, protocol, direction: protocol.line.received, baud: 9600, localEcho: asked.echo ?? false,
  show: ({ at, isSent, event, sender, names }) => said.push(
    [at, isSent ? ">" : "<", sender, names.join(" or ") || event.reason, toHex(event.bytes)]),
  answered: ({ question, event, took, late, missing }) => said.push(
    ["answer", question.event.message, event.message, took, late, missing]),
  unanswered: ({ event }) => said.push(["silence", event.message]),
});
for (const [at, what, bytes] of asked.steps) {
  if (what === "sent") session.sent(hex(bytes), at);
  else if (what === "received") session.received(hex(bytes), at);
  else if (what === "end") session.end();
  else if (session.tick(at)) said.push("quiet");
}
return { said, counts: session.counts, due: session.due };
"""


def talk(
    steps: Iterable[tuple[float, str, bytes]], model: Model = MODEL, **settings: object
) -> Any:
    """Return what a session says of these steps: a time in ms, what happens, and bytes."""
    data = {**protocol_data(model), "line": line_data(model)}
    asked = {"protocol": data, "steps": [(at, what, data.hex()) for at, what, data in steps]}
    return answers(_SESSION, {**asked, **settings})


ASK, VOLTAGE = BatteryVoltageRead().encode(), BatteryVoltage(7500).encode()
WHERE = ServoPositionsRead([1, 2, 9]).encode()
THERE = ServoPositions([(1, 500), (2, 400)]).encode()


def outcomes(found: dict[str, Any]) -> list[Any]:
    return [each for each in found["said"] if each[0] in ("answer", "silence")]


# What is sent (>) and received (<), at which ms, or that time passes; and what is said of it: of
# each answer how long it took, and whether it is late or what is missing in it.
PIECES = {"ask": ASK, "voltage": VOLTAGE, "where": WHERE, "there": THERE}
PIECES |= {"its first bytes": VOLTAGE[:3], "the rest": VOLTAGE[3:]}
PIECES |= {"another": ServoPositions([(3, 1)]).encode()}
ANSWERS = {
    "at once": ("0 > ask | 20 < voltage", "voltage after 20"),
    "incomplete": ("0 > where | 40 < there", "positions after 40 without servo_ids 9"),
    "what was not asked for is no answer": ("0 > where | 40 < another | 900 tick", "silence"),
    "twice": ("0 > ask | 20 < voltage | 30 < voltage", "voltage after 20"),
    "late": ("0 > ask | 300 tick | 700 < voltage", "silence | voltage after 700 late"),
    "late, and too soon for the next question": (
        "0 > ask | 300 tick | 400 > ask | 403 < voltage | 420 < voltage",
        "silence | voltage after 403 late | voltage after 20",
    ),
    "just in time": (
        "0 > ask | 255 < its first bytes | 262 tick | 270 < the rest",
        "voltage after 270",
    ),
    "the line is closed": ("0 > ask | 5 end", "silence"),
}


def steps_of(text: str) -> Iterator[tuple[float, str, bytes]]:
    for each in text.split(" | "):
        at, what, *piece = each.split(" ", 2)
        does = {">": "sent", "<": "received"}.get(what, what)
        yield float(at), does, PIECES[piece[0]] if piece else b""


def in_words(outcome: list[Any]) -> str:
    """Return what is said of a question, which is of the kind of its answer."""
    kind, question, *answer = outcome
    if kind == "silence":
        return "silence"
    name, took, late, missing = answer
    assert name == question.removesuffix("Read")
    short = {"BatteryVoltage": "voltage", "ServoPositions": "positions"}[name]
    end = " late" if late else f" without {', '.join(missing)}" if missing else ""
    return f"{short} after {took}{end}"


@in_turn("case", lambda: ANSWERS)
def test_a_reply_answers_what_was_asked(case: str) -> None:
    steps, expected = ANSWERS[case]
    assert " | ".join(map(in_words, outcomes(talk(steps_of(steps))))) == expected


@in_turn(
    "request_, asked, reply, held, fits",
    lambda: [
        ("BytesRead", {"start": 16, "count": 2}, "Bytes", {"stored": [1, 2]}, True),
        ("BytesRead", {"start": 16, "count": 1}, "Bytes", {"stored": [1, 2]}, False),
        ("SomeRead", {"addresses": [1, 2]}, "Some", {"status": 1, "found": [1, 2]}, True),
        ("SomeRead", {"addresses": [1, 2]}, "Some", {"status": 1, "found": [1]}, False),
        ("SomeRead", {"addresses": [1, 2]}, "Some", {"status": 0, "found": []}, True),
    ],
)
def test_a_reply_of_another_size_is_no_answer(
    request_: str, asked: dict[str, Any], reply: str, held: dict[str, Any], fits: bool
) -> None:
    model = compiled_file(BASES / "memory.yaml").model
    assert model is not None
    sent, received = encode(model.messages[request_], asked), encode(model.messages[reply], held)
    found = talk([(0, "sent", sent), (40, "received", received), (900, "tick", b"")], model)
    outcome = ["answer", request_, reply, 40, False, []] if fits else ["silence", request_]
    assert outcomes(found) == [outcome]


def test_what_cannot_be_sent_yet_waits_in_order() -> None:
    """A question waits for the reply to that before; what nothing answers waits behind it."""
    program = """
    const sent = [];
    let isWaiting = false;
    const hand = (each) => { sent.push(each); if (each.startsWith("ask")) isWaiting = true; };
    const queue = makeSendQueue((each) => isWaiting && each.startsWith("ask"), hand);
    const places = ["ask 1", "tell 2", "ask 3", "tell 4", "ask 5"].map(queue.add);
    isWaiting = false;
    queue.pump();
    const many = Array.from({ length: QUEUE_BOUND }, () => queue.add("ask 6"));
    return [places, sent, many.slice(-2), queue.clear().length, queue.clear().length];
    """
    sent = ["ask 1", "tell 2", "ask 3", "tell 4"]
    assert answers(program) == [[0, 0, 1, 2, 3], sent, [16, None], 16, 0]


def test_half_a_frame_does_not_grow_together_with_the_next() -> None:
    gap = GAP * 1000
    found = talk([(0, "received", VOLTAGE[:4]), (gap, "tick", b""), (gap + 1, "received", VOLTAGE)])
    said = [each[3] if each != "quiet" else each for each in found["said"]]
    assert said == ["too short", "quiet", "BatteryVoltage"]
    counts = {"bytes": 10, "frames": 1, "noise": 0, "errors": 0, "sent": 0, "echoes": 0}
    assert found["counts"] | {"noise": 0} == counts


def test_a_page_waits_as_long_as_the_client() -> None:
    assert answers("return [QUIET_MS, REPLY_TIMEOUT_MS];") == [1000 * GAP, 1000 * REPLY_TIMEOUT]


def test_ones_own_bytes_are_taken_out_of_what_comes_back() -> None:
    pieces = [(0, "sent", ASK), (4, "received", ASK[:2]), (6, "received", ASK[2:] + VOLTAGE)]
    found = talk(pieces, echo=True)
    said = [each[3] for each in found["said"] if each[0] != "answer"]
    assert said == ["BatteryVoltageRead", "BatteryVoltage"]
    assert (found["counts"]["echoes"], found["counts"]["noise"]) == (1, 0)


def test_echoes_are_taken_out_as_the_client_does() -> None:
    chance = random.Random(13)  # noqa: S311 - to be repeated

    def some(letters: bytes, least: int, most: int) -> bytes:
        return bytes(chance.choices(letters, k=chance.randint(least, most)))

    streams = []
    for _ in range(300):
        frames = [some(b"ab", 1, 4) for _ in range(3)]
        echoes = [chance.choice([frame, b"", frame[:-1]]) for frame in frames]
        stream = b"".join(echo + some(b"abc", 0, 2) for echo in echoes)
        size = chance.randint(1, 5)
        streams.append((frames, [stream[at : at + size] for at in range(0, len(stream), size)]))
    program = """return asked.map(([frames, chunks]) => {
      const echo = makeLocalEcho();
      for (const frame of frames) echo.sent(frame, 9);
      const taken = chunks.map((chunk) => echo.takeOut(chunk));
      const rest = echo.expire(9);
      const counted = taken.map(({ bytes, echoes, lost }) => [bytes, echoes, lost]);
      return [counted, rest.bytes, rest.lost];
    });"""
    assert answers(program, streams) == [by_the_client(*stream) for stream in streams]


def by_the_client(frames: list[bytes], chunks: list[bytes]) -> list[Any]:
    """Return what the Python client makes of echoes, in the form of the page."""
    echo = LocalEcho()
    for frame in frames:
        echo.sent(None, frame, 9.0)  # type: ignore[arg-type]  # the request is only handed back
    taken = []
    for chunk in chunks:
        before = len(echo._expected)
        pieces = [*echo.take_out(chunk)]
        lost = sum(len(each) for _, _, each in pieces)
        came = before - len(echo._expected) - lost
        taken.append([[*b"".join(others for others, _, _ in pieces)], came, lost])
    held, missing = echo.expire(9.0)
    return [taken, [*held], len(missing)]


# ---------------------------------------------------------------------------- the recording

_RECORDED = """
const recording = makeRecording(new Date(1767344947250), asked.bounds);
for (const [time, who, what, bytes] of asked.entries) recording.add({ time, who, what, bytes });
const text = [...recording.pieces("USB 1A86:7523")].join("");
return { text, size: recording.size, dropped: recording.dropped };
"""


def recorded(entries: list[Any], **bounds: int) -> tuple[list[recordings.Entry], dict[str, Any]]:
    """Return what Python reads in a recording of the page, and what that says of it."""
    made = answers(_RECORDED, {"entries": entries, "bounds": bounds})
    return [*recordings.read(io.BytesIO(made["text"].encode()))], made


def test_python_reads_a_recording_of_the_page() -> None:
    chance = random.Random(7)  # noqa: S311 - to be repeated
    pieces = [VOLTAGE, THERE, b"\x00\xff", b"\x55\x55\x02", b"\x55\x55\x03\x63\x01"]
    stream = b"".join(chance.choice(pieces) for _ in range(200))
    found = talk([(0, "received", stream), (100, "tick", b"")])
    said = [each for each in found["said"] if each != "quiet"]
    entries = [
        (number / 7, sender if what[0].isupper() else "noise", what, bytes.fromhex(data))
        for number, (_, _, sender, what, data) in enumerate(said)
    ]
    read, _ = recorded(entries)
    decoder = StreamDecoder(CODEC.received)
    events = [*decoder.feed(stream), *decoder.flush()]
    assert b"".join(data for *_, data in entries) == stream
    expected = [event for event in events if not hasattr(event, "data")]
    assert [each.event for each in read if not hasattr(each.event, "data")] == expected
    assert [entry.time for entry in read] == [round(time, 6) for time, *_ in entries]
    assert {entry.sender for entry in read} == {"controller"}
    assert read[0].began == 1767344947.25


def test_a_long_recording_drops_its_oldest_entries() -> None:
    entries = [(number, "controller", "BatteryVoltage", VOLTAGE) for number in range(2000)]
    read, made = recorded(entries, bound=4096, chunkSize=512)
    assert made["size"] <= 4096
    assert made["dropped"] == 2000 - len(read) > 1000
    assert [entry.time for entry in read] == [*map(float, range(made["dropped"], 2000))]
    assert f"# the {made['dropped']} oldest entries were dropped" in made["text"]


def test_noise_that_is_larger_than_a_chunk_is_recorded() -> None:
    noise = bytes(number % 256 for number in range(5000))
    [entry], _ = recorded([(1, "noise", "bad header", noise)], chunkSize=512)
    assert (entry.event.data, entry.event.reason.value) == (noise, "bad header")  # type: ignore[union-attr]


# ---------------------------------------------------------------------------- no port at all

WHERE_FROM = [
    (True, True, "file:", "null"),
    (True, False, "https:", "it has no Web Serial"),
    (False, False, "http:", "This page came over http://"),
]


@in_turn("is_secure, has_serial, protocol, why", lambda: WHERE_FROM)
def test_a_browser_without_ports_says_why(
    is_secure: bool, has_serial: bool, protocol: str, why: str
) -> None:
    asked = {"isSecure": is_secure, "hasSerial": has_serial, "protocol": protocol}
    found = answers("return String(whyNoSerial(asked));", asked)
    assert why in found
    assert (found == "null") == (why == "null")
