"""What a page sends is what the Python client sends, and it refuses the rest in the same words."""

import copy
import importlib
import random
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import busservo
import pytest
from framegen.language.spec import Spec
from framegen.model.codec import encode
from framegen.model.model import Model, derive
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.line_data import line_data
from framegen.site.scripts.protocol_data import protocol_data
from framewire.client.session import Session
from hypothesis import settings

from tests.factories import compiled_of, data_of, library, library_files
from tests.in_turn import in_turn
from tests.protocols.specs import model_of
from tests.unit.site.reference import NODE, ROOT, reference
from tests.unit.site.scripts import SESSION, run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

ANY = None
# What the client adds for whoever has Python at hand.
TARGETS = "{}() makes targets of what was read; "

PROGRAM = """
const protocol = asked.protocol, codec = makeCodec(protocol), answers = { said: [] };
answers.choices = makeLimits(protocol.line).choices.map(({ bounds, text }) => [
  bounds && bounds.map(Number), text]);
for (const [frame, bounds] of asked.frames) {
  const shown = [];
  const session = makeSession({ codec, protocol, direction: null, baud: 9600, timeout: 250,
    show: ({ event }) => shown.push(...event.bytes), answered() {}, unanswered() {} });
  try {
    const chosen = bounds === "usual" ? [] : [bounds && bounds.map(BigInt)];
    session.sent(frame, 0, ...chosen);
    answers.said.push(String(shown) === String(frame) ? null : "another frame is shown");
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    answers.said.push(shown.length || session.counts.sent ? "shown all the same" : error.message);
  }
}
"""


def asked_of_the_page(model: Model, frames: list[tuple[bytes, Any]]) -> Any:
    """Return what a session of the page says of frames that it shall send, None for nothing."""
    data = {**protocol_data(model), "line": line_data(model)}
    scripts = [*codec_scripts(model), *SESSION]
    return run_script(scripts, PROGRAM, {"protocol": data, "frames": frames})


def said_by_the_client(made: ModuleType, frame: bytes, bounds: Any) -> str | None:
    """Return why the client does not send a frame, None if it does."""
    parts = importlib.import_module(f"{made.__name__}._exchanges")
    library_, limits = importlib.import_module(f"{made.__name__}._library").LIBRARY, parts.LIMITS
    chosen = limits.usual if bounds == "usual" else bounds
    session = Session(library_, baud=9600, reply_timeout=1.0, report_limit=1, limits=chosen)
    message = made.decode(frame, next(iter(parts.EXCHANGES)).DIRECTION)
    try:
        session.submit(message)
    except made.EncodeError as error:
        return str(error).replace(TARGETS.format(limits.targets), "")
    return None


def moved(*positions: int) -> bytes:
    return busservo.ServoMove(100, [*enumerate(positions, 1)]).encode()


PWM = (500, 2500)
# Frames with the limits that were chosen: those that are sent, and what is said of others.
SENT = [
    *((moved(0, 1000), "usual"), (moved(500, 2500), PWM), (moved(0xFFFF), ANY)),
    *((busservo.ServoUnload([1]).encode(), PWM), (busservo.ServoPositionsRead([1]).encode(), ANY)),
]
REFUSED = {
    (moved(5000), "usual"): "[0].position: 5000 is outside the limits 0..1000; limits=None sends "
    "anything",
    (moved(500, 1001), "usual"): "[1].position: 1001 is outside the limits 0..1000; "
    "limits=(500, 2500) is for PWM servo boards, limits=None for any",
    (moved(2500, 499), PWM): "[1].position: 499 is outside the limits 500..2500; "
    "limits=(0, 1000) is for what is usual, limits=None for any",
}


def test_the_page_refuses_what_the_client_refuses() -> None:
    cases = [*SENT, *REFUSED]
    expected = [None] * len(SENT) + [f"targets{said}" for said in REFUSED.values()]
    assert [said_by_the_client(busservo, *case) for case in cases] == expected
    assert asked_of_the_page(reference("busservo").model, cases)["said"] == expected


def test_there_is_the_same_choice_as_the_client_has() -> None:
    found = asked_of_the_page(reference("busservo").model, [])
    usual, pwm = "(0, 1000): what is usual", "(500, 2500): PWM servo boards"
    assert found["choices"] == [[[0, 1000], usual], [[500, 2500], pwm], [None, "None: anything"]]
    assert asked_of_the_page(reference("greenhouse").model, [])["choices"] == []


LIMITS = {"usual": "0..300", "others": {"tall blinds": "5..900", "7": "0..60000"}}
LEVEL = {"type": "u16", "about": "A level.", "limits": LIMITS}
PAIR = {"blind_id": {"type": "u8", "about": "The blind."}, "height": LEVEL}
COUNT = {"type": "u8", "about": "How many there are."}
MANY = {"counted_by": "many", "count": "1..", "about": "Levels."}
ITEMS = {"about": "Some.", "fields": PAIR}
# Limits wherever a number can stand: its message, with values of it.
PLACES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "One": ({"length": 2, "fields": {"level": LEVEL}}, {"level": 1}),
    "Wide": ({"length": 8, "fields": {"level": {**LEVEL, "type": "u64"}}}, {"level": 1}),
    "Maybe": (
        {"length": [0, 2], "fields": {"level": {**LEVEL, "optional": True}}},
        {"level": None},
    ),
    "Bare": (
        {"length": "2 * many + 1", "fields": {"many": COUNT, "levels": {**LEVEL, **MANY}}},
        {"levels": [1]},
    ),
    "Three": ({"length": 6, "fields": {"levels": {**LEVEL, "count": 3}}}, {"levels": [1, 1, 1]}),
    "Two": (
        {"length": 6, "fields": {"items": {"element": "Of", "count": 2, **ITEMS}}},
        {"items": 2 * [{"blind_id": 1, "height": 1}]},
    ),
    "Listed": (
        {
            "length": "3 * many + 3",
            "fields": {
                "many": COUNT,
                "level": LEVEL,
                "items": {"element": "Item", **MANY, **ITEMS},
            },
        },
        {"level": 1, "items": [{"blind_id": 1, "height": 1}]},
    ),
}
CHOSEN = ["usual", ANY, (0, 300), (5, 900), (0, 60000), (200, 200), (301, 1 << 60)]
NEAR = [0, 4, 5, 200, 300, 301, 900, 901, 60000, 60001, 0xFFFF]


@pytest.fixture(scope="module")
def blinds() -> Iterator[tuple[Model, ModuleType]]:
    """Return a protocol with limits in all those places, and its library."""
    data = copy.deepcopy(data_of(ROOT / "tests" / "specs" / "blinds.yaml"))
    for number, (name, (message, values)) in enumerate(PLACES.items(), 10):
        words = {"id": number, "direction": "hub -> motor", "summary": "Set it.", "cite": "leaflet"}
        data["messages"][name] = {**words, **message}
        layout = derive(Spec.model_validate(data)).messages[name]
        example = {"title": "One", "values": values, "constructed": "By the reference."}
        data["messages"][name]["examples"] = [{**example, "hex": encode(layout, values).hex(" ")}]
    compiled = compiled_of(data)
    with library(library_files(compiled)) as made:
        yield compiled.model, made


def near(chance: random.Random, name: str, slot: str, value: Any) -> Any:
    """Return a value of a field near to the limits, and beyond what a browser has digits for."""
    if isinstance(value, list):
        many = len(value) if name in ("Two", "Three") else chance.randint(1, 3)
        return [near(chance, name, slot, value[0]) for _ in range(many)]
    if isinstance(value, dict):
        return {key: near(chance, name, key, each) for key, each in value.items()}
    others: dict[str, list[int | None]] = {"Maybe": [None]}
    others["Wide"] = [(1 << 53) + 1, 1 << 60, (1 << 64) - 1]
    return chance.choice([7] if slot == "blind_id" else [*NEAR, *others.get(name, [])])


def test_any_field_with_limits_is_kept_within_them(blinds: tuple[Model, ModuleType]) -> None:
    model, made = blinds
    chance = random.Random(5)  # noqa: S311 - to be repeated
    frames: list[tuple[bytes, Any]] = []
    for name, (_, first) in PLACES.items():
        for _ in range(2 * settings().max_examples):
            frame = encode(model.messages[name], near(chance, name, "", first))
            frames.append((frame, chance.choice(CHOSEN)))
    # JSON has limits of any size as texts.
    asked = [(frame, [*map(str, b)] if isinstance(b, tuple) else b) for frame, b in frames]
    found = asked_of_the_page(model, asked)["said"]
    assert found == [said_by_the_client(made, frame, bounds) for frame, bounds in frames]
    assert {None} < {*found}


def test_a_question_that_no_reply_can_hold_is_not_sent(
    blinds: tuple[Model, ModuleType],
) -> None:
    model, made = blinds
    ask = model.messages["BlindsRead"]
    asked = [encode(ask, {"blind_ids": [*range(size)]}) for size in (1, 84, 85, 200)]
    frames = [(frame, bounds) for frame in asked for bounds in ("usual", ANY)]
    found = asked_of_the_page(model, frames)["said"]
    assert found == [said_by_the_client(made, frame, bounds) for frame, bounds in frames]
    assert found[-1] == ("blind_ids: 200 items are requested at once, and a reply has room for 84")


# The message that the encoder begins with: it asks, and with as little as possible.
FIRST = {
    "busservo": "BatteryVoltageRead",
    "lxservo": "MoveRead",
    "dynamixel1": "Ping",
    "modbus": "CoilsRead",
    "ubx": "NavPvtPoll",
    "sbus": "Channels",
}


@in_turn("name", lambda: FIRST)
def test_the_encoder_begins_with_a_query(name: str) -> None:
    model = reference("busservo").model if name == "busservo" else model_of(name)
    assert line_data(model)["first"] == FIRST[name]
