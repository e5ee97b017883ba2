"""The verbs `explain` and `docs`: what a library says of its protocol by itself."""

from __future__ import annotations

import json
import re
from importlib import import_module
from typing import TYPE_CHECKING, Any

import pytest
from busservo.__main__ import main
from framegen.cases.invalid import invalid_frames
from framegen.cases.valid import valid_frames
from framegen.cli import main as framegen_main
from framegen.explain import explain
from framegen.model.protocol import protocol_of
from framewire.explain.text import as_json, as_text
from framewire.protocol import form
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import (
    BUSSERVO,
    DEMO,
    Data,
    compiled_file,
    data_of,
    files_of,
    layout_of,
    library,
    library_of,
)
from tests.handed import explanations_of
from tests.in_turn import in_turn
from tests.mutations.places import renamed

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from types import ModuleType

    from framegen.model.model import Model

    # The text and the JSON of an explanation.
    Explain = Callable[[bytes], tuple[str, dict[str, Any]]]

Capture = pytest.CaptureFixture[str]
SERVO, HOUSE = (compiled_file(spec).model for spec in (BUSSERVO, DEMO))


def carried_by(package: str) -> Explain:
    """Return what explains bytes by the library of that name, and by nothing of framegen."""
    text, explain = import_module("framewire.explain.text"), explanations_of(package)

    def explained(frame: bytes) -> tuple[str, dict[str, Any]]:
        found = explain(frame)
        return text.as_text(found), text.as_json(found)

    return explained


def by_reference(model: Model, frame: bytes) -> tuple[str, dict[str, Any]]:
    found = explain(model, frame, model.directions)
    return as_text(found), as_json(found)


def bent_names() -> Data:
    """Return a spec with an endpoint and a message whose names the library has taken."""
    made: Data = renamed(renamed(data_of(DEMO), "gateway", "either"), "VentsOpen", "Exception")
    assert made["endpoints"].keys() >= {"either"}
    assert "Exception" in made["messages"]
    return made


OTHERS = {"greenhouse": data_of(DEMO), "bent": bent_names()}
OTHERS |= {name: data_of(DEMO.with_name(f"{name}.yaml")) for name in ("blinds", "weather", "lamp")}


@pytest.fixture(scope="module", params=OTHERS)
def other(request: pytest.FixtureRequest) -> Iterator[tuple[Data, ModuleType]]:
    """Yield a spec, and its library."""
    data = OTHERS[request.param]
    with library(files_of(data)) as made:
        yield data, made


@pytest.fixture(scope="module")
def house() -> Iterator[Explain]:
    with library(library_of(DEMO)) as made:
        yield carried_by(made.__name__)


@pytest.fixture(scope="module")
def servo() -> Explain:
    return carried_by("busservo")


# ---------------------------------------------------------------------------- one explanation


def frames_of(data: Data) -> list[bytes]:
    """Return every single frame of the test vectors, legal or not, and those of look-alikes."""
    model = layout_of(data)
    given = [each.data for frames in (valid_frames, invalid_frames) for each in frames(model)]
    others = [each.hex for other in model.spec.lookalikes.values() for each in other.examples]
    return [*given, *others, given[0] + given[1], b"\x00" + given[0]]


@in_turn("frame", lambda: frames_of(data_of(BUSSERVO)), ids=lambda frame: frame[:12].hex())
def test_both_commands_explain_alike(servo: Explain, frame: bytes) -> None:
    assert servo(frame) == by_reference(SERVO, frame)


def test_any_library_explains_as_framegen_does(other: tuple[Data, ModuleType]) -> None:
    data, made = other
    explained, model = carried_by(made.__name__), layout_of(data)
    frames = frames_of(data)
    assert [explained(frame) for frame in frames] == [
        by_reference(model, frame) for frame in frames
    ]


@st.composite
def damaged(draw: st.DrawFn, model: Model) -> bytes:
    """Return a frame with a byte changed, cut, or led in by noise: what people really paste."""
    messages = model.messages.values()
    examples = [example.hex for message in messages for example in message.message.examples]
    data = bytearray(draw(st.sampled_from(examples)))
    if draw(st.booleans()):
        data[draw(st.integers(0, len(data) - 1))] = draw(st.integers(0, 255))
    cut = draw(st.integers(1, len(data)))
    return draw(st.binary(max_size=4)) + bytes(data[:cut]) + draw(st.binary(max_size=4))


@given(frame=damaged(SERVO) | st.binary(max_size=12))
def test_both_commands_explain_any_bytes_alike(servo: Explain, frame: bytes) -> None:
    assert servo(frame) == by_reference(SERVO, frame)


@given(frame=damaged(HOUSE) | st.binary(max_size=12))
def test_any_library_explains_any_bytes_as_framegen_does(house: Explain, frame: bytes) -> None:
    assert house(frame) == by_reference(HOUSE, frame)


@in_turn(
    "words",
    lambda: [
        "55 55 08 03 01 E8 03 01 20 03",
        "5555040F4C1D",
        "5555040F4C1D --direction controller",
        "5555040F4C1D --direction host",
        "55 55 05 06 02 00 00 --json",
        "0x55,0x55,0x09,0x03,0x01,0xE8",
        "55 55 01 07 01 20 03 E8 03 E8",
        "55 55 02 08 --json",
        "00",
    ],
)
def test_both_commands_print_the_same(words: str, capsys: Capture) -> None:
    ended = framegen_main(["explain", str(BUSSERVO), *words.split()])
    result = capsys.readouterr()
    assert (main(["explain", *words.split()]), capsys.readouterr()) == (ended, result)
    assert result.err == ""
    assert "55 55" in result.out


# ---------------------------------------------------------------------------- the model as data


@pytest.mark.parametrize(("spec", "model"), [(BUSSERVO, SERVO), (DEMO, HOUSE)])
def test_a_library_carries_the_model_that_framegen_explains_by(spec: Path, model: Model) -> None:
    (carried,) = (
        json.loads(text)
        for path, text in library_of(spec).items()
        if path.endswith("/protocol.json")
    )
    usage = ("client", "python", "shell", "method", "class")
    carried["messages"] = {
        name: {key: value for key, value in said.items() if key not in usage}
        for name, said in carried["messages"].items()
    }
    added = ("comment", "form", "members")
    assert {key: value for key, value in carried.items() if key not in added} == form.data_of(
        protocol_of(model)
    )


# ---------------------------------------------------------------------------- docs


def printed(capsys: Capture, *words: str) -> str:
    assert main(["docs", *words]) == 0
    output, errors = capsys.readouterr()
    assert errors == ""
    return output


def test_all_messages_are_listed_in_a_line_each(capsys: Capture) -> None:
    shown = printed(capsys)
    rows = re.findall(r"^ +(\d+)  (0x\w\w)  (\w+) +(.*)", shown, flags=re.MULTILINE)
    assert {name: (int(number), int(hexed, 16)) for number, hexed, name, _ in rows} == {
        name: (layout.id, layout.id) for name, layout in SERVO.messages.items()
    }
    for name, begun in ((name, begun) for _, _, name, begun in rows):
        message = SERVO.messages[name].message
        deprecated = "Deprecated. " if message.deprecated else ""
        assert f"{deprecated}{message.summary}".startswith(begun)
    headings = [line for line in shown.split("\n") if re.fullmatch(r"\w+ -> \w+", line)]
    assert headings == [str(way) for way in SERVO.directions]


@in_turn(
    "words, names",
    lambda: [
        ("battery", ["BatteryVoltageRead", "BatteryVoltage"]),
        ("0x0F", ["BatteryVoltageRead", "BatteryVoltage"]),
        ("15", ["BatteryVoltageRead", "BatteryVoltage"]),
        ("0f", ["BatteryVoltageRead", "BatteryVoltage"]),
        # By the vendor's name for them, which one has for both.
        ("CMD_GET_BATTERY_VOLTAGE", ["BatteryVoltageRead", "BatteryVoltage"]),
        ("servo-move", ["ServoMove"]),
        ("servo_move", ["ServoMove"]),
        ("BATTERYVOLTAGE", ["BatteryVoltage"]),
        ("limp", ["ServoUnload"]),
        ("action percent", ["ActionGroupSpeed"]),
        # In the name before in the text.
        ("unload", ["ServoUnload"]),
    ],
)
def test_a_message_is_found(words: str, names: list[str], capsys: Capture) -> None:
    found = [json.loads(line) for line in printed(capsys, *words.split(), "--json").splitlines()]
    assert [each["name"] for each in found][: len(names)] == names
    if words != "unload":
        assert len(found) == len(names)


@pytest.mark.parametrize(
    ("word", "hint"),
    [
        ("ServMove", "similar: ServoMove"),
        ("CMD_MULT_SERVO_UNLAOD", "similar: ServoUnload, ServoPositions"),
        ("baterry", "similar: battery"),
        ("xyzzy", "`busservo docs` lists all messages"),
        ("200", "`busservo docs` lists all messages"),
        ("9" * 9999, "`busservo docs` lists all messages"),
        ("-", "`busservo docs` lists all messages"),
    ],
)
def test_an_unknown_topic_is_reported_with_a_similar_one(
    word: str, hint: str, capsys: Capture
) -> None:
    assert main(["docs", word]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors == (
        f"busservo: error: no message is called {word[:40]!r} or mentions it; {hint}\n"
    )


@in_turn("name", lambda: SERVO.messages)
def test_a_page_shows_all_that_is_written_of_a_message(name: str, capsys: Capture) -> None:
    page = " ".join(printed(capsys, name).split())
    layout = SERVO.messages[name]
    said = layout.message
    facts = [
        said.summary,
        said.description,
        said.vendor_name,
        str(layout.formula),
        said.reply or "",
    ]
    facts += [*said.reports, *SERVO.answers.get(name, []), *SERVO.reports_on.get(name, [])]
    for path, number in layout.numbers_by_path.items():
        facts += [path.replace(".", "[i]."), number.number_type.name, number.field.about]
        if number.role != "count":
            facts.append(f"{number.low}..{number.high}")
        facts += [value.about for value in number.field.values.values()]
        facts += [f"{each.value} is {key}" for key, each in number.field.values.items()]
        facts += [note.text for note in number.field.notes]
    for example in said.examples:
        facts += [example.title, example.hex.hex(" ").upper()]
    for slip in SERVO.spec.errata:
        if slip.concerns.message == name:
            facts += [slip.title, slip.here, slip.why]
    facts += [each.what for each in SERVO.spec.unknowns if each.concerns.message == name]
    assert [fact for fact in facts if " ".join(fact.split()) not in page] == []


@pytest.mark.filterwarnings("ignore:.* is deprecated:DeprecationWarning")
def test_any_library_has_its_pages(other: tuple[Data, ModuleType], capsys: Capture) -> None:
    data, made = other
    command = import_module(f"{made.__name__}.__main__").main
    for words in ([], ["errata"], ["lookalikes"], *([name] for name in data["messages"])):
        assert command(["docs", *words]) == 0
        page, errors = capsys.readouterr()
        assert errors == ""
        assert page.startswith(words[0] if words and words[0] in data["messages"] else "")
    # By the name that the class has, too, where the spec's was taken.
    for name in [*data["messages"], *(kind.__name__ for kind in made.MESSAGES)]:
        assert command(["docs", name, "--json"]) == 0
        said = json.loads(capsys.readouterr().out)
        assert command(said["shell"][0].split()[1:]) == 0
        assert capsys.readouterr().out.strip() == said["examples"][0]["hex"]


def test_each_byte_of_an_example_is_shown(capsys: Capture) -> None:
    page = printed(capsys, "BatteryVoltage")
    assert "       4  4C 1D  voltage_mv  7500 mV = 7.500 V, low byte first\n" in page


@in_turn("name", lambda: SERVO.messages)
def test_what_a_page_says_to_type_can_be_typed(name: str, capsys: Capture) -> None:
    (said,) = [json.loads(printed(capsys, name, "--json"))]
    program, verb, *words = said["shell"][0].split()
    assert (program, verb) == ("busservo", "encode")
    assert main([verb, *words]) == 0
    assert capsys.readouterr().out.strip() == said["examples"][0]["hex"]
    code = compile("\n".join(said["python"]), name, "exec")
    exec(code, {})  # noqa: S102 - what the page shows


def test_errata_and_unknowns_are_a_page(capsys: Capture) -> None:
    page = " ".join(printed(capsys, "errata").split())
    for slip in SERVO.spec.errata:
        for text in (slip.title, slip.here, slip.why):
            assert " ".join(text.split()) in page
    for unknown in SERVO.spec.unknowns:
        assert " ".join(unknown.what.split()) in page


def test_look_alikes_are_a_page(capsys: Capture) -> None:
    page = " ".join(printed(capsys, "look-alikes").split())
    for other in SERVO.spec.lookalikes.values():
        assert other.title in page
        assert " ".join(other.about.split()) in page
        for meaning in other.commands.values():
            assert meaning in page
        for example in other.examples:
            assert example.hex.hex(" ").upper() in page
    assert "host -> controller: length mismatch: ActionGroupStop has a length of 2, not 1" in page


@pytest.mark.parametrize("topic", ["errata", "lookalikes"])
def test_a_topic_is_json_too(topic: str, capsys: Capture) -> None:
    titles = [json.loads(line)["title"] for line in printed(capsys, topic, "--json").splitlines()]
    spec = SERVO.spec
    given = spec.errata if topic == "errata" else [*spec.lookalikes.values()]
    assert titles == [each.title for each in given]


def test_no_line_is_too_wide_or_empty_without_need(capsys: Capture) -> None:
    for name in SERVO.messages:
        prose = printed(capsys, name).partition("\nIn Python\n")[0]
        assert [
            line for line in prose.split("\n") if len(line) > 100 or line != line.rstrip()
        ] == []
        assert "\n\n\n" not in prose
