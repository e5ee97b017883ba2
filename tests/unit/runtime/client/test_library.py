"""What a library hands to the runtime, what its clients say of themselves, and its own device."""

import ast
import doctest
import importlib
import inspect
import re
import sys
from pathlib import Path
from types import FrameType
from typing import Any

import busservo
import framewire
import lxservo
import pytest
from busservo import AsyncController, Controller, open_controller
from busservo._exchanges import EXCHANGES
from busservo_simulator import VirtualController
from framegen.targets.python.names import names_of
from framewire.client.exchange import Exchange
from framewire.client.library import Library
from framewire.edition import EDITION, OLDEST
from framewire.line.link import Link

from tests.factories import compiled_file, library, library_of
from tests.handed import handed_by
from tests.in_turn import in_turn
from tests.lines.every_method import converse_alone
from tests.lines.live_line import LiveLine, in_a_loop
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.protocols.specs import FILES
from tests.rows import each_protocol
from tests.timeouts import LIVE


@in_turn("package", lambda: [busservo, lxservo])
def test_a_library_hands_over_what_it_exports(package: Any) -> None:
    library = handed_by(package.__name__)
    codec = library.codec
    assert (library.package, codec.package) == (package.__name__, package.__name__)
    assert library.protocol_version == package.PROTOCOL_VERSION
    assert library.version == package.__version__
    assert (codec.directions, codec.decode) == (package.Direction, package.decode)
    assert (codec.messages, codec.decoder) == (package.MESSAGES, package.StreamDecoder)
    assert codec.careful_decoder(codec.received).doubted is None
    assert (library.client, library.async_client) == (package.Controller, package.AsyncController)
    sent = {kind for kind in package.MESSAGES if kind.DIRECTION is not codec.received}
    assert {*library.exchanges} == sent
    assert library.log().name == package.__name__
    version = f"of protocol version {package.PROTOCOL_VERSION}"
    assert repr(library) == f"<the library {package.__name__} {version}>"
    assert {*library.protocol().messages} >= {kind.__name__ for kind in package.MESSAGES}


@in_turn(
    "form, bits",
    lambda: [
        ({}, 10),
        ({"parity": "even"}, 11),
        ({"data_bits": 7, "parity": "odd", "stop_bits": 2}, 11),
    ],
)
def test_a_byte_takes_all_its_bits(form: dict[str, Any], bits: int) -> None:
    assert Link(baud=9600, **form).bits_per_byte == bits


def made_for(edition: int) -> Library:
    """Return a library that was generated for an edition of the runtime."""
    link, codec = handed_by("lxservo").link, handed_by("lxservo").codec
    return Library("lxservo", edition=edition, protocol_version="1.0.0", link=link, codec=codec)


def test_a_library_of_another_edition_is_refused_with_the_way_out() -> None:
    for edition in range(OLDEST, EDITION + 1):
        assert made_for(edition).package == "lxservo"
    with pytest.raises(ImportError, match="edition 2 of framewire, and this is 1: install a newer"):
        made_for(EDITION + 1)
    with pytest.raises(ImportError, match="this serves 1 to 1: generate it again"):
        made_for(OLDEST - 1)


def test_what_is_of_another_protocol_is_never_sent() -> None:
    move = lxservo.Move(servo_id=1, position=500, time_ms=100)
    line = VirtualLine()
    with client_on(line, Controller) as controller:
        for send in (controller.send, controller.send_latest, controller.request):
            with pytest.raises(TypeError, match="it is of lxservo, and this a client of busservo"):
                send(move)
    device = busservo.Device()
    with pytest.raises(TypeError, match=r"Voltage is a message of lxservo\.messages, another"):
        device.send(lxservo.Voltage(servo_id=1, voltage_mv=7500))  # type: ignore[arg-type]
    assert (line.received, device.take()) == ([], [])


# ------------------------------------------------------------------ its own device


# The library of one is installed.
@pytest.mark.parametrize("name", each_protocol([name for name in FILES if name != "lxservo"]))
def test_each_method_is_answered_by_the_device_of_the_same_library(name: str) -> None:
    with library(library_of(FILES[name])) as made:
        answered(made, name)


def test_each_method_of_the_servo_bus_is_answered_by_its_device() -> None:
    answered(lxservo, "lxservo")


def answered(made: Any, name: str) -> None:
    for module in ("device", "_library"):
        importlib.import_module(f"{made.__name__}.{module}")
    converse_alone(made, names_of(compiled_file(FILES[name]).model).library)


# ------------------------------------------------------------------ the docstrings of its clients

METHODS = [pytest.param(each, id=each.method) for each in EXCHANGES.values()]


def examples(client: type, exchange: Exchange) -> list[doctest.Example]:
    method = getattr(client, exchange.method)
    found = doctest.DocTestParser().get_examples(inspect.getdoc(method) or "")
    assert found, f"{exchange.method} shows no example"
    return found


@in_turn("exchange", lambda: METHODS)
def test_the_examples_of_the_client_for_threads(exchange: Exchange) -> None:
    with Controller(LiveLine(), **LIVE) as controller:
        names: dict[str, Any] = {"controller": controller}
        for example in examples(Controller, exchange):
            if example.want:
                assert f"{eval(example.source, names)!r}\n" == example.want  # noqa: S307 - our own
            else:
                exec(example.source, names)  # noqa: S102 - our own


@in_turn("exchange", lambda: METHODS)
@in_a_loop
async def test_the_examples_of_the_client_for_asyncio(exchange: Exchange) -> None:
    async with AsyncController(LiveLine(), **LIVE) as controller:
        names: dict[str, Any] = {"controller": controller}
        for example in examples(AsyncController, exchange):
            mode = "eval" if example.want else "exec"
            flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
            code = compile(example.source.strip(), "example", mode, flags)
            result = eval(code, names)  # noqa: S307 - our own
            value = await result if inspect.isawaitable(result) else result
            if example.want:
                assert f"{value!r}\n" == example.want


@in_turn("exchange", lambda: METHODS)
def test_both_clients_take_the_same_arguments(exchange: Exchange) -> None:
    one, other = (
        inspect.signature(getattr(kind, exchange.method)).parameters
        for kind in (Controller, AsyncController)
    )
    assert one == other
    latest = () if exchange.lasts is None else ("latest",)
    assert tuple(one)[1:] == (*exchange.arguments, *latest)


# ------------------------------------------------------------------ what a request crosses

PACKAGES = [Path(str(each.__file__)).parent for each in (busservo, framewire)]
DESIGN = Path(__file__).parents[4] / "docs" / "design.md"
PARAGRAPH = re.compile(r"\*\*A request crosses six modules.*?\n\n", re.DOTALL)


def module_of(frame: FrameType) -> str:
    file = Path(frame.f_code.co_filename)
    return file.stem.lstrip("_") if any(map(file.is_relative_to, PACKAGES)) else ""


def test_a_request_crosses_the_modules_that_the_design_names() -> None:
    entered: set[str] = set()
    at_the_port: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        if event != "call" or not module_of(frame):
            return
        entered.add(module_of(frame))
        if (module_of(frame), frame.f_code.co_name) == ("serial_port", "write"):
            caller: FrameType | None = frame
            while caller is not None:
                at_the_port.insert(0, module_of(caller))
                caller = caller.f_back

    with VirtualController("tcp") as board, open_controller(board.port, **LIVE) as controller:
        sys.setprofile(note)
        try:
            assert controller.read_battery_voltage() == 7500
        finally:
            sys.setprofile(None)
    # From the caller to the port.
    [paragraph] = PARAGRAPH.findall(DESIGN.read_text(encoding="utf-8"))
    named = re.findall(r"`(\w+)`", paragraph.partition("In asyncio")[0])
    assert len(named) == 6
    assert set(named) <= entered
    crossed = [*dict.fromkeys(filter(None, at_the_port))]
    # The steps of the call, and the session, are called and return: they wait for no port.
    assert crossed == [each for each in named if each not in ("base_client", "session")]
