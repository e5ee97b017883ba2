"""A client with a name of its own: whatever is called after a client is called after that."""

import ast
import re
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from busservo_simulator import VirtualClock
from framegen.checks import client_name
from framegen.comparison import surface
from framegen.compile import Compiled
from framegen.language.spec import Spec
from framegen.render import render, snippets
from framegen.site.project import Project
from framegen.site.site import render_site
from framewire.simulator.virtual_loop import run_virtual

from tests.factories import (
    BUSSERVO,
    DEMO,
    ROOT,
    compiled_of,
    data_of,
    layout_of,
    library,
    library_files,
)
from tests.handed import handed_by
from tests.in_turn import in_turn
from tests.lines.timed_line import DeviceLine, client_on
from tests.mutations.places import having, renamed
from tests.names_at_work import at_work
from tests.side_by_side import library_of, linted

# One with poses, and one whose devices have addresses.
FILES = {"busservo": BUSSERVO, "lxservo": ROOT / "spec" / "lxservo.yaml"}
NAMES = {"Arm", "AsyncArm", "open_arm", "open_async_arm"}
USUAL = {"Controller", "AsyncController", "open_controller", "open_async_controller"}
# The usual names as programs say them: in prose, a controller is what a vendor calls a board.
SAID = re.compile(
    r"\b(?:Async)?Controller\b(?!\s+Comm)|open_(?:async_)?controller|\bcontroller\.\w+\("
)


@cache
def compiled(name: str) -> Compiled:
    return compiled_of(having(data_of(FILES[name]), {"protocol.client": "Arm"}))


@cache
def files_of(name: str) -> dict[str, str]:
    return library_files(compiled(name))


@pytest.mark.parametrize("name", FILES)
def test_a_library_has_these_names_and_not_the_usual_ones(name: str) -> None:
    with library(files_of(name)) as made:
        assert {*dir(made)} & (NAMES | USUAL) == NAMES
        handed = handed_by(made.__name__)
        assert (handed.client, handed.async_client) == (made.Arm, made.AsyncArm)
        assert (made.open_arm, made.open_async_arm) == (made.Arm.at_port, made.AsyncArm.at_port)
    stub = {path.rpartition("/")[2]: text for path, text in files_of(name).items()}
    assert {*surface._exported(stub["__init__.pyi"])} & (NAMES | USUAL) == NAMES


def test_such_a_library_works() -> None:
    at_work(compiled("busservo"))


def test_linters_have_nothing_to_say(tmp_path: Path) -> None:
    for name in FILES:
        library_of(name, files_of(name)).write(tmp_path)
    assert linted(tmp_path) == {}


def test_devices_and_asyncio_work_as_ever() -> None:
    with library(files_of("lxservo")) as made:

        class Servo(made.Device):  # type: ignore[misc, name-defined]
            def on_position_read(self, message: Any) -> Any:
                return made.Position(servo_id=message.servo_id, position=640)

        async def work() -> tuple[int, int]:
            async with client_on(DeviceLine(Servo()), made.AsyncArm) as arm:
                assert repr(arm.device(7)).startswith("<AsyncOneDevice 7 of <AsyncArm on ")
                return await arm.read_position(3), await arm.device(7).read_position()

        assert run_virtual(work(), VirtualClock()) == (640, 640)
        with client_on(DeviceLine(Servo()), made.Arm) as arm:
            assert arm.device(7).read_position() == 640
            assert repr(arm) == "<Arm on line, open>"


def test_what_the_runtime_says_names_no_client_of_another_name() -> None:
    with library(files_of("busservo")) as made:
        opening: Any = made.open_async_arm("no-such-port")
        with pytest.raises(AttributeError) as unopened:
            opening.send(None)
        with (
            client_on(DeviceLine(made.Device()), made.Arm) as arm,
            pytest.raises(ValueError, match="ids") as unknown,
        ):
            arm.read_servo_positions()
        said = [str(unopened.value), str(unknown.value)]
    assert [SAID.findall(each) for each in said] == [[], []]


def test_nothing_that_is_made_says_the_usual_names() -> None:
    for name in FILES:
        output = render(compiled(name)).files
        pages = render_site(Project([compiled(name)]), snippets())
        told = {path: text for path, text in {**output, **pages}.items() if isinstance(text, str)}
        assert any("with open_arm(" in text and " as arm:" in text for text in told.values())
        # The schema is that of every spec.
        found = {
            path: SAID.findall(text)
            for path, text in told.items()
            if not path.endswith("framegen.schema.json")
        }
        assert {path: words for path, words in found.items() if words} == {}


def test_the_command_shows_how_a_message_is_sent(capsys: pytest.CaptureFixture[str]) -> None:
    with library(files_of("busservo")) as made:
        main = import_module(f"{made.__name__}.__main__").main
        assert main(["docs", "ServoMove"]) == 0
    shown = capsys.readouterr().out
    assert 'with open_arm("COM5") as arm:' in shown
    assert "arm.move_servos(" in shown


BENT = [("", "Controller", "ControllerMessage"), ("", "Arm", "Arm"), ("Arm", *["Controller"] * 2)]


@in_turn("client, name, bent", lambda: BENT)
def test_a_message_is_bent_where_it_is_called_like_the_client(
    client: str, name: str, bent: str
) -> None:
    data = renamed(data_of(DEMO), "TextShow", name)
    spec = compiled_of(having(data, {"protocol.client": client} if client else {}))
    with library(library_files(spec)) as made:
        assert getattr(made, bent) in made.MESSAGES
        assert handed_by(made.__name__).client.__name__ == (client or "Controller")


def test_several_words_become_several() -> None:
    model = layout_of(having(data_of(DEMO), {"protocol.client": "GreenHouse"}))
    message = model.messages["StationRead"]
    client = snippets()["python"](model, message, message.message.examples[0])[0]
    assert 'with open_green_house("COM5") as green_house:' in client.code
    assert "green_house." in client.code


def test_no_client_hides_what_a_library_has() -> None:
    spec = layout_of(data_of(FILES["lxservo"])).spec
    files = files_of("lxservo")
    there = {name for name in bound_in(files) if name[0].isupper() and name.isalnum()} - NAMES
    assert {"OneDevice", "NoReplyError", "Position", "HostMessage", "Sent", "Client"} <= there
    assert {name for name in there if not refused(spec, name)} == set()
    # These begin as a class of Python's own, or end as one of the library's, and are neither.
    for name in ("Arm", "Bus", "AsynchronousMotor", "Clients", "ARM", "Controller", "Lxservo"):
        assert not refused(spec, name), name


def bound_in(files: dict[str, str]) -> set[str]:
    """Return the names that the modules of clients import or define, or the package exports."""
    modules = ("_controller.py", "_async_controller.py", "_devices.py", "__init__.pyi")
    return {
        (each.asname or each.name) if isinstance(each, ast.alias) else each.name
        for path, text in files.items()
        if path.endswith(modules)
        for each in ast.walk(ast.parse(text))
        if isinstance(each, ast.alias | ast.ClassDef)
    }


def refused(spec: Spec, name: str) -> bool:
    protocol = spec.protocol.model_copy(update={"client": name})
    return [*client_name.RULE.look(spec.model_copy(update={"protocol": protocol}))] != []
