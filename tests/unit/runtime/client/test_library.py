"""What a library hands to the runtime is what it exports itself."""

from importlib import import_module
from typing import Any

import busservo
import lxservo
import pytest


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
