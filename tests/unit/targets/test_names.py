"""A word that Python or the library has taken is a good name: the library bends it."""

import ast
import builtins
import json
import keyword
import re
import sys
from collections.abc import Iterator
from functools import cache, partial
from importlib import import_module
from pathlib import Path
from typing import Any

import busservo
import pytest
from framegen.cli import main
from framegen.compile import Compiled
from framegen.language.package_names import BUILTINS, DEVICES, KEYWORDS, why_taken
from framegen.render import render, render_target, snippets
from framegen.site.project import Project
from framegen.site.site import render_site
from framegen.targets.docs import TARGET as DOCS
from framegen.targets.filenames import file_stem
from framegen.targets.python import reserved
from framegen.targets.python.names import names_of
from framegen.targets.table import TARGETS
from framewire.client.async_client import AsyncClient
from framewire.client.client import Client
from framewire.frame.element import Element

from tests.commands import called
from tests.crowd import Crowd, taken, taken_elements, taken_names, taken_pose
from tests.factories import (
    BUSSERVO,
    DEMO,
    compiled_file,
    compiled_of,
    data_of,
    layout_of,
    library,
    library_files,
    vectors_of,
    write_files,
)
from tests.in_turn import in_turn
from tests.lines.timed_line import client_of
from tests.mutations.places import renamed
from tests.names_at_work import at_work
from tests.rows import some
from tests.side_by_side import library_of, linted

PACKAGE = Path(busservo.__file__).parent
# Those that import the messages by name; in two, texts have their names.
TEXTS = {"_command.py", "tables.py"}
MINE = {kind.__name__ for kind in busservo.MESSAGES}
MINE |= {
    items.element.__name__
    for kind in busservo.MESSAGES
    if (items := kind.SHAPE.items) is not None and items.element is not None
}
MINE |= {"HostMessage", "ControllerMessage"}
MODULES = sorted(
    path.relative_to(PACKAGE).as_posix()
    for path in PACKAGE.rglob("*.py")
    if path.name not in TEXTS and MINE & {*re.findall(r"\w+", path.read_text(encoding="utf-8"))}
)
CROWDS = {"names": taken_names, "elements": taken_elements, "pose": taken_pose}


@cache
def compiled_crowd(name: str) -> Compiled:
    """Compile one of CROWDS, which are large."""
    return compiled_of(CROWDS[name]())


@cache
def files_of_crowd(name: str) -> dict[str, str]:
    return library_files(compiled_crowd(name))


# ------------------------------------------------------------------ the lists have it all


def statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements of a module, those below an `if` included."""
    for node in body:
        yield node
        if isinstance(node, ast.If):
            yield from statements([*node.body, *node.orelse])


def names_in(module: str) -> set[str]:
    """Return the names that a module imports and defines at its top, also for typing alone."""
    found: set[str] = set()
    for node in statements(ast.parse((PACKAGE / module).read_text(encoding="utf-8")).body):
        if isinstance(node, ast.Import | ast.ImportFrom):
            found |= {each.asname or each.name for each in node.names}
        elif isinstance(node, ast.ClassDef):
            found.add(node.name)
        elif isinstance(node, ast.AnnAssign | ast.Assign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            found |= {each.id for each in targets if isinstance(each, ast.Name)}
    # A message begins with a capital letter: no other name can be taken for one.
    return {name for name in found if name[0].isupper()}


def variables_in(module: str) -> set[str]:
    """Return the variables of a module's methods, and their arguments that no message gives."""
    tree = ast.parse((PACKAGE / module).read_text(encoding="utf-8"))
    functions = [
        node
        for node in ast.walk(tree)
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.name != "__init__"
    ]
    stored = {
        node.id
        for function in functions
        for node in ast.walk(function)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    return stored | {each.arg for function in functions for each in function.args.kwonlyargs}


def test_what_the_constructors_of_messages_need_is_reserved() -> None:
    # What counts a list is a field itself, and has a name of its own among them.
    counts = {kind.SHAPE.items.count.name for kind in busservo.MESSAGES if kind.SHAPE.items}
    assert variables_in("messages.py") - counts - {"numbers"} == reserved.CONSTRUCTOR


def public(kind: type) -> set[str]:
    return {name for name in dir(kind) if not name.startswith("_")}


def test_the_modules_that_know_messages_are_known() -> None:
    assert {"device.py", "_exchanges.py", "_controller.py", "messages.py"} <= set(MODULES)


@in_turn("module", lambda: MODULES)
def test_what_a_module_needs_is_reserved(module: str) -> None:
    # Nor has the name of a message a line below it.
    needed = {name for name in names_in(module) - MINE if "_" not in name}
    assert needed - {*taken("message")} == needed - {*taken("element")} == set()


@pytest.mark.parametrize("module", ["_controller.py", "_async_controller.py"])
def test_what_a_method_needs_is_reserved(module: str) -> None:
    # Comprehensions have a scope of their own; busservo's `targets` and `servo_ids` are fields.
    needed = variables_in(module) - {"_", "each", "targets", "servo_ids"}
    assert {"reply", "replies", "latest", "exchanged"} <= needed
    assert needed - {*taken("field")} == set()


def test_what_a_class_of_the_library_has_is_reserved() -> None:
    element = type("Made", (Element, tuple), {"__slots__": ()})
    # No field is in capitals.
    assert public(Client) | public(AsyncClient) <= {*taken("method")}
    capitals = {"CONSTANTS", "DEFAULTS", "DEPRECATED", "VENDOR_NAME"}
    assert public(busservo.Message) <= {*taken("field")} | capitals
    assert public(element) <= {*taken("field of an element"), "FIELDS"}
    assert not any(name.startswith("on_") for name in public(busservo.Device) - HANDLERS)


HANDLERS = {name for name in vars(busservo.Device) if name.startswith("on_")}


def test_every_word_of_this_python_is_reserved() -> None:
    """Whichever it is: the lists hold the words of all versions."""
    words = {*keyword.kwlist, *keyword.softkwlist} - {"_", "None", "True", "False"}
    assert words <= KEYWORDS
    present = {name for name in dir(builtins) if not name.startswith("_")}
    assert {name for name in present if name.islower()} <= BUILTINS | KEYWORDS
    assert {name for name in present if name[0].isupper()} <= {*taken("message")}
    modules = {name for name in sys.stdlib_module_names if not name.startswith("_")}
    # Names of packages are in lower case.
    assert [name for name in modules if name.islower() and not why_taken(name)] == []


def test_no_suffix_makes_another_reserved_word() -> None:
    """Or else two names might be bent to the same."""
    for row in reserved.RESERVED:
        words = taken(row.kind)
        assert [word + row.suffix for word in words if word + row.suffix in words] == []


# ------------------------------------------------------------------ what becomes of a name


# By the kind of a name and the one in the demo spec: what it is called now, and what that becomes.
BENT = {
    "endpoint station": "any any_, noise noise_, class class",
    "message StationRead": "Controller ControllerMessage, ValueError ValueErrorMessage, "
    "Event EventMessage, None NoneMessage, I IMessage, Con Con, Nul Nul, Decode Decode, "
    "StationMessage StationMessageMessage",
    "element Vent": "Number NumberElement, GatewayMessage GatewayMessageElement, O OElement",
    "field ramp_s": "class class_, match match_, id id_, l l_, encode encode_, self self_, "
    "timeout timeout_, count count",
    "field vent_count": "type type_",
    "field vents": "list list_",
    "field of an element angle": "count count_, encode encode",
    "method vents_open": "close close_, import import_, open open",
}


@in_turn(
    "kind, old, name, bent",
    lambda: [
        (*place.rsplit(" ", 1), *row.split())
        for place, rows in BENT.items()
        for row in rows.split(", ")
    ],
)
def test_a_name_is_bent_only_where_it_is_taken(kind: str, old: str, name: str, bent: str) -> None:
    data = data_of(DEMO)
    if kind == "method":
        data["messages"]["VentsOpen"]["method"] = "vents_open(vents, ramp_s)"
    names = names_of(layout_of(renamed(data, old, name)))
    assert names.of(kind, name) == bent
    assert {(each.name, each.bent) for each in names.bent} == ({(name, bent)} - {(name, name)})


def test_a_bent_name_keeps_clear_of_the_names_that_are_there() -> None:
    data = renamed(data_of(DEMO), "StationRead", "Noise")
    data = renamed(renamed(data, "VentJammed", "NoiseMessage"), "Vent", "Noisemessagemessage")
    names = names_of(layout_of(data))
    assert names.of("message", "Noise") == "NoiseMessageMessageMessage"
    assert {each.bent for each in names.bent} == {"NoiseMessageMessageMessage"}


def test_what_is_read_as_signed_keeps_its_name() -> None:
    crowd = Crowd("made", "host", "device")
    crowd.command("LevelSet", ["level", "signed_level"], signed="level")
    crowd.command("LevelPut", ["signed_level"])
    names = names_of(layout_of(crowd.data))
    assert {(each.name, each.bent) for each in names.bent} == {("signed_level", "signed_level_")}


@pytest.mark.parametrize("file", [BUSSERVO, DEMO], ids=lambda file: file.stem)
def test_where_nothing_is_bent_the_library_is_made_of_the_model_itself(file: Path) -> None:
    model = compiled_file(file).model
    assert names_of(model).library is model


@pytest.mark.parametrize("name", some(CROWDS, lambda name: name != "elements"))
def test_the_vectors_and_the_reference_keep_the_names_of_the_author(name: str) -> None:
    data, compiled = CROWDS[name](), compiled_crowd(name)
    shown = vectors_of(compiled)
    assert shown["protocol"] == data["protocol"]["name"]
    assert {each["message"]: each["direction"] for each in shown["valid"]} == {
        message: said["direction"].replace(" -> ", "_to_")
        for message, said in data["messages"].items()
    }
    pages = render_target(DOCS, compiled)
    for message in data["messages"]:
        page = f"docs/reference/{file_stem(shown['protocol'])}/messages/{file_stem(message)}.md"
        assert f"# {message}\n" in pages[page]


# ------------------------------------------------------------------ the libraries of such names


@pytest.mark.parametrize("name", CROWDS)
def test_a_library_of_such_names_works(name: str) -> None:
    at_work(compiled_crowd(name))


def test_a_pose_is_read_and_held_under_bent_names() -> None:
    with library(files_of_crowd("pose")) as lib:
        device = lib.Device()
        there = lib.Places([(1, 7), (2, 8)])
        moved: list[Any] = []
        device.on_places_read = lambda _message: there
        device.on_move = moved.append
        with client_of(device) as controller:
            assert controller.int_(targets_=[1, 2]) == (1, 2)
            controller.close_([1, 2], reply_=3)
            assert moved == [lib.Move(reply_=3, goals=[(1, 7), (2, 8)])]
            assert controller.lambda_(there.found) == [(1, 7), (2, 8)]


def test_linters_have_nothing_to_say(tmp_path: Path) -> None:
    for name in CROWDS:
        library_of(name, files_of_crowd(name)).write(tmp_path)
    assert linted(tmp_path) == {}


# ------------------------------------------------------------------ the command of such a library


def test_the_command_says_the_names_that_the_library_has(
    capsys: pytest.CaptureFixture[str],
) -> None:
    def said(*words: str) -> str:
        command(words)
        out, err = capsys.readouterr()
        return out or err

    with library(files_of_crowd("names")) as made:
        command = import_module(f"{made.__name__}.__main__").main
        words = ["Ask0", "class_=7"]
        frame = said("encode", *words).strip()
        shown = said("decode", "--direction", "any_", frame)
        assert shown.split()[1:4] == ["any_", "Ask0", "class_=7"]
        shown = said("decode", "--json", "--direction", "any_", frame)
        assert json.loads(shown)["fields"] == {"class_": 7}
        assert "class_: 700 is outside 0..255" in said("encode", "Ask0", "class_=700")
        assert "class_=CLASS_" in said("encode", "Ask0")


# ------------------------------------------------------------------ what framegen says of them


framegen = partial(called, main)


def test_the_reference_shows_the_bent_name_in_code() -> None:
    model = layout_of(renamed(renamed(data_of(DEMO), "TextShow", "Reason"), "number", "class"))
    message = model.messages["Reason"]
    (codec,) = snippets()["python"](model, message, message.message.examples[0])
    assert "from greenhouse import Direction, ReasonMessage, StreamDecoder" in codec.code
    assert "print(event.class_)  # -2" in codec.code


@in_turn(
    "name, stem",
    lambda: [
        *(("Con", "Con_"), ("NUL", "NUL_"), ("com1", "com1_"), ("Lpt9", "Lpt9_")),
        *(("Console", "Console"), ("ServoMove", "ServoMove"), ("com", "com"), ("com10", "com10")),
    ],
)
def test_a_file_has_a_name_that_windows_takes(name: str, stem: str) -> None:
    assert file_stem(name) == stem
    assert file_stem(name).lower() not in DEVICES


def test_every_file_can_be_checked_out_on_windows() -> None:
    crowd = Crowd("devices", "host", "device")
    for name in ["Con", "Nul", "Aux", "Prn", "Com1", "Lpt9"]:
        crowd.command(name, ["level"])
    spec = compiled_of(crowd.data)
    output = render(spec)
    paths = [*output.files, output.manifest, *render_site(Project([spec]), snippets())]
    assert {"docs/reference/devices/messages/Nul_.md", "reference/devices/messages/Nul_.html"} <= {
        *paths
    }
    stems = {part.partition(".")[0].lower() for path in paths for part in path.split("/")}
    assert stems & DEVICES == set()
    assert len({path.lower() for path in paths}) == len(paths)


def test_the_pages_of_odd_names_are_linked_to(tmp_path: Path) -> None:
    crowd = Crowd("devices", "host", "device")
    crowd.report("Nul", ["level"])
    crowd.command("Con", ["level"], reply="Nul")
    spec = compiled_of(crowd.data)
    files = {**render(spec).files, **render_site(Project([spec]), snippets())}
    write_files(files, tmp_path)
    links = 0
    for page in tmp_path.rglob("*"):
        linking = page.suffix in (".md", ".html")
        text = page.read_text(encoding="utf-8").partition("<script")[0] if linking else ""
        found = re.findall(r'href="([^"#:?]+)["#?]|\]\(([^)#:?]+)', text)
        for link in (one or other for one, other in found):
            assert (page.parent / link).exists(), (page, link)
            links += link.endswith(("Con_.html", "Con_.md", "Nul_.html", "Nul_.md"))
    assert links > 20


def test_check_notes_each_bent_name_once_and_finds_nothing(tmp_path: Path) -> None:
    text = DEMO.read_text(encoding="utf-8").replace("vent_id", "id").replace("ramp_s", "class")
    spec = tmp_path / "made.yaml"
    spec.write_text(text, encoding="utf-8")
    line = text[: text.index("      class:")].count("\n") + 1
    for options in ([], ["--json"]):
        code, out, err = framegen("check", str(spec), *options)
        assert (code, out) == (0, "")
        note = "note: python writes the field `class` as `class_`: it is a word of Python itself"
        assert f"made.yaml:{line}:7: {note}\n" in err
        assert err.count("`id` as `id_`") == 1
        assert "`id` as `id_` (and so in 1 place more): it would hide what Python has" in err
        assert err.endswith("nothing found\n")


def test_targets_lists_what_there_is_and_prints_what_becomes_of_a_word() -> None:
    code, out, _ = framegen("targets")
    assert code == 0
    assert [line.split()[0] for line in out.splitlines() if line[0] != " "] == [
        target.name for target in TARGETS
    ]
    assert "generated/busservo/" in out
    code, out, _ = framegen("targets", "python")
    assert code == 0
    assert "message: NAME becomes NAMEMessage where it is a class of every library" in out
    assert {word for row in reserved.RESERVED for word in row.words} <= {*out.split()}
    assert framegen("targets", "vectors").out.endswith("every name stays as it is.\n")
    code, _, err = framegen("targets", "pyhton")
    assert code == 2
    assert "did you mean `python`?" in err


def test_what_stands_around_the_fields_is_renamed_as_they_are() -> None:
    compiled = compiled_file(DEMO.with_name("taken_names.yaml"))
    bent = names_of(compiled.model)
    with library(library_files(compiled)) as made:
        for layout in compiled.model.messages.values():
            kind = getattr(made, bent.message(layout.name).name)
            for example in layout.message.examples:
                values = bent.values(layout.name, example.values)
                assert kind.from_dict(values).encode() == example.hex
                assert kind.decode(example.hex).to_dict() == values
        text = made.TextMessage
        names = "id_ error err_voltage absent_ type_ flat_ hash_"
        assert text.__match_args__ == tuple(names.split())
        assert (text.DIRECTION_, text.FRAME_, text.IDS, text.ID_ALL) == (1, 2, (1, 2), 255)
        assert text.DIRECTION is made.Direction.ASKER_TO_TELLER
