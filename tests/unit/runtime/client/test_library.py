"""What a library hands to the runtime is what it exports itself."""

from importlib import import_module
from typing import Any

import busservo
import lxservo
import pytest
from framewire.client.library import Library
from framewire.edition import EDITION, OLDEST

from tests.handed import handed_by
from tests.lines.virtual_line import VirtualLine


@pytest.mark.parametrize("package", [busservo, lxservo])
def test_a_library_hands_over_what_it_exports(package: Any) -> None:
    library = import_module(f"{package.__name__}._library").LIBRARY
    codec = library.codec
    assert (library.package, codec.package) == (package.__name__, package.__name__)
    assert library.protocol_version == package.PROTOCOL_VERSION
    assert library.version == package.__version__
    assert (codec.directions, codec.decode) == (package.Direction, package.decode)
    assert (codec.messages, codec.decoder) == (package.MESSAGES, package.StreamDecoder)
    assert codec.careful_decoder(codec.received).doubted is None
    assert (library.client, library.async_client) == (package.Controller, package.AsyncController)
    assert {*library.exchanges} == {
        kind for kind in package.MESSAGES if kind.DIRECTION is not codec.received
    }
    assert library.log().name == package.__name__
    assert f"{library!r}" == (
        f"<the library {package.__name__} of protocol version {package.PROTOCOL_VERSION}>"
    )
    assert {*library.protocol().messages} >= {kind.__name__ for kind in package.MESSAGES}


@pytest.mark.parametrize(
    ("form", "bits"),
    [({}, 10), ({"parity": "even"}, 11), ({"data_bits": 7, "parity": "odd", "stop_bits": 2}, 11)],
)
def test_a_byte_takes_all_its_bits(form: dict[str, Any], bits: int) -> None:
    link = import_module("framewire.line.link").Link
    assert link(baud=9600, **form).bits_per_byte == bits


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
    with busservo.Controller(line, background=False, clock=line.clock) as controller:
        for send in (controller.send, controller.send_latest, controller.request):
            with pytest.raises(TypeError, match="it is of lxservo, and this a client of busservo"):
                send(move)
    device = busservo.Device()
    with pytest.raises(TypeError, match=r"Voltage is a message of lxservo\.messages, another"):
        device.send(lxservo.Voltage(servo_id=1, voltage_mv=7500))  # type: ignore[arg-type]
    assert (line.received, device.take()) == ([], [])
