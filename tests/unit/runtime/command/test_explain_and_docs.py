"""The verbs `explain` and `docs`: what a library says of its protocol by itself."""

import json
import re
from collections.abc import Callable, Iterable, Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

import pytest
from framegen.cases.invalid import invalid_frames
from framegen.cases.valid import valid_frames
from framegen.explain import explain
from framegen.model.model import Model
from framegen.model.protocol import protocol_of
from framewire.explain.text import as_json, as_text
from framewire.protocol import form

from tests.commands import records, run
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

# The text and the JSON of an explanation.
Explain: TypeAlias = Callable[[bytes], tuple[str, dict[str, Any]]]
SERVO, HOUSE = (compiled_file(spec).model for spec in (BUSSERVO, DEMO))


def carried_by(package: str) -> Explain:
    """Return what explains bytes by the library of that name, and by nothing of framegen."""
    explain = explanations_of(package)
    return lambda frame: (as_text(explain(frame)), as_json(explain(frame)))


def by_reference(model: Model) -> Explain:
    def explained(frame: bytes) -> tuple[str, dict[str, Any]]:
        found = explain(model, frame, model.directions)
        return as_text(found), as_json(found)

    return explained


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


# ---------------------------------------------------------------------------- one explanation
def frames_of(model: Model) -> list[bytes]:
    """Return every single frame of the test vectors, legal or not, and those of look-alikes."""
    given = [each.data for frames in (valid_frames, invalid_frames) for each in frames(model)]
    others = [each.hex for other in model.spec.lookalikes.values() for each in other.examples]
    return [*given, *others, given[0] + given[1], b"\x00" + given[0]]


@in_turn("frame", lambda: frames_of(SERVO), ids=lambda frame: frame[:12].hex())
def test_both_commands_explain_alike(frame: bytes) -> None:
    assert carried_by("busservo")(frame) == by_reference(SERVO)(frame)


def test_any_library_explains_as_framegen_does(other: tuple[Data, ModuleType]) -> None:
    data, made = other
    model = layout_of(data)
    frames = frames_of(model)
    explained, expected = carried_by(made.__name__), by_reference(model)
    assert [*map(explained, frames)] == [*map(expected, frames)]


# ---------------------------------------------------------------------------- the model as data
@pytest.mark.parametrize(("spec", "model"), [(BUSSERVO, SERVO), (DEMO, HOUSE)])
def test_a_library_carries_the_model_that_framegen_explains_by(spec: Path, model: Model) -> None:
    (text,) = (text for path, text in library_of(spec).items() if path.endswith("/protocol.json"))
    carried = json.loads(text)
    usage = ("client", "python", "shell", "method", "class")
    carried["messages"] = {
        name: {key: value for key, value in said.items() if key not in usage}
        for name, said in carried["messages"].items()
    }
    added = ("comment", "form", "members")
    kept = {key: value for key, value in carried.items() if key not in added}
    assert kept == form.data_of(protocol_of(model))


# ---------------------------------------------------------------------------- docs
def printed(*words: str) -> str:
    status, output, errors = run("docs", *words)
    assert (status, errors) == (0, "")
    return output


def flowing(text: str) -> str:
    """Return a text as one line."""
    return " ".join(text.split())


def missing(page: str, facts: Iterable[str]) -> list[str]:
    """Return what a page does not say, however it breaks its lines."""
    return [fact for fact in facts if flowing(fact) not in flowing(page)]


def test_all_messages_are_listed_in_a_line_each() -> None:
    shown = printed()
    rows = re.findall(r"^ +(\d+)  (0x\w\w)  (\w+) +(.*)", shown, flags=re.MULTILINE)
    assert {name: (int(number), int(hexed, 16)) for number, hexed, name, _ in rows} == {
        name: (layout.id, layout.id) for name, layout in SERVO.messages.items()
    }
    for _, _, name, begun in rows:
        message = SERVO.messages[name].message
        deprecated = "Deprecated. " if message.deprecated else ""
        assert f"{deprecated}{message.summary}".startswith(begun)
    headings = [line for line in shown.split("\n") if re.fullmatch(r"\w+ -> \w+", line)]
    assert headings == [str(way) for way in SERVO.directions]


BATTERY = ["BatteryVoltageRead", "BatteryVoltage"]
FOUND = [
    *((words, BATTERY) for words in ("battery", "0x0F", "15", "0f")),
    ("CMD_GET_BATTERY_VOLTAGE", BATTERY),  # by the vendor's name for them, which is one for both
    *(("servo-move", ["ServoMove"]), ("servo_move", ["ServoMove"])),
    *(("BATTERYVOLTAGE", ["BatteryVoltage"]), ("limp", ["ServoUnload"])),
    ("action percent", ["ActionGroupSpeed"]),
]


@in_turn("words, names", lambda: FOUND)
def test_a_message_is_found(words: str, names: list[str]) -> None:
    assert [each["name"] for each in records("docs", *words.split(), "--json")] == names


@in_turn(
    "word, hint",
    lambda: [
        ("ActionGrupStop", "similar: ActionGroupStop, ActionGroupStopped"),
        ("CMD_MULT_SERVO_UNLAOD", "similar: ServoUnload, ServoPositions"),
        ("baterry", "similar: battery"),
        *(
            (word, "`busservo docs` lists all messages")
            for word in ("xyzzy", "200", "9" * 9999, "-")
        ),
    ],
)
def test_an_unknown_topic_is_reported_with_a_similar_one(word: str, hint: str) -> None:
    problem = f"no message is called {word[:40]!r} or mentions it; {hint}"
    assert run("docs", word) == (2, "", f"busservo: error: {problem}\n")


@in_turn("name", lambda: SERVO.messages)
def test_a_page_shows_all_that_is_written_of_a_message(name: str) -> None:
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
    page = printed(name)
    assert missing(page, facts) == []
    # No line is too wide, or empty without need.
    prose = page.partition("\nIn Python\n")[0]
    assert [each for each in prose.split("\n") if len(each) > 100 or each != each.rstrip()] == []
    assert "\n\n\n" not in prose


@pytest.mark.filterwarnings("ignore:.* is deprecated:DeprecationWarning")
def test_any_library_has_its_pages(other: tuple[Data, ModuleType]) -> None:
    data, made = other
    command = import_module(f"{made.__name__}.__main__").main
    for words in ([], ["errata"], ["lookalikes"], *([name] for name in data["messages"])):
        status, page, errors = run("docs", *words, main=command)
        assert (status, errors) == (0, "")
        assert page.startswith(words[0] if words and words[0] in data["messages"] else "")
    # By the name that the class has, too, where the spec's was taken.
    for name in [*data["messages"], *(kind.__name__ for kind in made.MESSAGES)]:
        (said,) = records("docs", name, "--json", main=command)
        encoded = run(*said["shell"][0].split()[1:], main=command)
        assert (encoded.status, encoded.out) == (0, f"{said['examples'][0]['hex']}\n")


@in_turn("name", lambda: SERVO.messages)
def test_what_a_page_says_to_type_can_be_typed(name: str) -> None:
    (said,) = records("docs", name, "--json")
    program, verb, *words = said["shell"][0].split()
    assert (program, verb) == ("busservo", "encode")
    assert run(verb, *words) == (0, f"{said['examples'][0]['hex']}\n", "")
    code = compile("\n".join(said["python"]), name, "exec")
    exec(code, {})  # noqa: S102 - what the page shows


def test_errata_and_unknowns_are_a_page() -> None:
    facts = [text for each in SERVO.spec.errata for text in (each.title, each.here, each.why)]
    facts += [each.what for each in SERVO.spec.unknowns]
    assert missing(printed("errata"), facts) == []


def test_look_alikes_are_a_page() -> None:
    facts = ["host -> controller: length mismatch: ActionGroupStop has a length of 2, not 1"]
    for other in SERVO.spec.lookalikes.values():
        facts += [other.title, other.about, *other.commands.values()]
        facts += [each.hex.hex(" ").upper() for each in other.examples]
    assert missing(printed("look-alikes"), facts) == []


def test_errata_and_look_alikes_are_json_too() -> None:
    spec = SERVO.spec
    for topic, given in (("errata", spec.errata), ("lookalikes", spec.lookalikes.values())):
        titles = [each["title"] for each in records("docs", topic, "--json")]
        assert titles == [each.title for each in given]
