"""Where no header begins a frame, the bytes that its first part may begin with."""

from functools import partial, reduce
from operator import xor
from typing import Any

from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.model import derive
from framegen.model.stream import ReferenceDecoder

from tests.factories import Data, files_of, library, small_spec
from tests.in_turn import in_turn

NAMED = {"all": {"value": 0xFF00}}
# An address in front, and the bytes that can begin it, by hand: 300 is 01 2C, 1000 is 03 E8.
FRONTS: list[tuple[dict[str, Any], set[int]]] = [
    ({"type": "u8", "range": [3, 5]}, {3, 4, 5}),
    ({"type": "u16", "byte_order": "big", "range": [300, 1000]}, {1, 2, 3}),
    ({"type": "u16", "byte_order": "little", "range": [300, 303]}, {0x2C, 0x2D, 0x2E, 0x2F}),
    ({"type": "u16", "byte_order": "little", "range": [254, 257]}, {0xFE, 0xFF, 0, 1}),
    ({"type": "u16", "byte_order": "little", "range": [300, 1000]}, set(range(256))),
    ({"type": "u32", "byte_order": "big", "range": [0x01FFFFFF, 0x02000000]}, {1, 2}),
    ({"type": "u16", "byte_order": "big", "range": [256, 511], "values": NAMED}, {1, 0xFF}),
]


def spec_of(front: dict[str, Any]) -> Data:
    """Return a spec whose frames begin with such an address."""
    low, high = front["range"]
    named = {name: {"silent": True, **said} for name, said in front.get("values", {}).items()}
    station = {**front, "is": "address", "range": f"{low}..{high}", "values": named}
    size = int(front["type"][1:]) // 8
    sent = low.to_bytes(size, front.get("byte_order", "little")) + b"\7"
    sent += bytes([reduce(xor, sent)])
    covers = ["station", "kind", "body"]
    frame = {
        "station": station,
        "kind": {"is": "id", "type": "u8"},
        "body": {"is": "body"},
        "check": {"is": "checksum", "type": "u8", "method": "xor", "covers": covers},
    }
    shown = {"title": "It", "hex": sent.hex(" "), "values": {"station": low}, "cite": "manual"}
    ping = {"id": 7, "direction": "host -> station", "summary": "Ask.", "cite": "manual"}
    ping |= {"length": size + 2, "fields": {}, "examples": [shown]}
    return small_spec("stations", frame, {"Ping": ping}, ends="host station")


@in_turn("front, begins", lambda: FRONTS)
def test_a_frame_begins_with_its_address(front: dict[str, Any], begins: set[int]) -> None:
    data = spec_of(front)
    model = derive(Spec.model_validate(data))
    assert model.first_bytes == begins
    # And so, of all bytes alone, only these may become a frame.
    line = ReferenceDecoder(model, [Direction("host", "station")])
    assert {byte for byte in range(256) if not line.decode_so_far(bytes([byte]))} == begins
    with library(files_of(data)) as made:
        decoder = partial(made.StreamDecoder, made.Direction.HOST_TO_STATION)
        assert {byte for byte in range(256) if not decoder().feed(bytes([byte]))} == begins
