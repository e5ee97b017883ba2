"""A new request in the spec is a new method, verb, handler and page, with no hand-written line."""

import os
import sys
from pathlib import Path

import pytest
from framegen.cli import main

from tests.factories import write_files
from tests.programs import ran

ROOT = Path(__file__).parents[3]

NEW = """
  LampSet:
    id: 99
    direction: host -> controller
    summary: Switch lamps.
    cite: vendor, section 1.1
    lasts: fade_s
    length: 2 * lamp_count + 4
    fields:
      fade_s: {type: u8, unit: s, about: How long it takes.}
      lamp_count: {type: u8, about: How many lamps.}
      lamps:
        element: Lamp
        counted_by: lamp_count
        count: 1..
        about: The lamps.
        fields:
          lamp_id: {type: u8, about: The lamp.}
          level: {type: u8, about: How bright.}
    examples:
      - title: Lamp 7 at level 9 at once
        hex: 55 55 06 63 00 01 07 09
        values: {fade_s: 0, lamps: [{lamp_id: 7, level: 9}]}
        constructed: For this test.

  LampBlink:
    id: 101
    direction: host -> controller
    reports: [LampBlinking]
    acknowledged: LampBlinking
    summary: Have a lamp blink.
    cite: vendor, section 1.1
    length: 4
    fields:
      lamp_id: {type: u8, about: The lamp.}
      times: {type: u8, about: How often.}
    examples:
      - title: Lamp 7 once
        hex: 55 55 04 65 07 01
        values: {lamp_id: 7, times: 1}
        constructed: For this test.

  LampBlinking:
    id: 101
    direction: controller -> host
    summary: A lamp begins to blink.
    cite: vendor, section 1.1
    length: 3
    fields:
      lamp_id: {type: u8, about: The lamp.}
    examples:
      - title: Lamp 7
        hex: 55 55 03 65 07
        values: {lamp_id: 7}
        constructed: For this test.

  LampsRead:
    id: 100
    direction: host -> controller
    reply: LampsState
    method: read_lamps(lamp_ids) -> lamps
    echoed: {lamp_ids: lamps.lamp_id}
    summary: Ask how bright lamps are.
    cite: vendor, section 1.1
    length: lamp_count + 3
    fields:
      lamp_count: {type: u8, about: How many lamps.}
      lamp_ids: {type: u8, counted_by: lamp_count, count: 1.., about: The lamps.}
    examples:
      - title: Lamp 7
        hex: 55 55 04 64 01 07
        values: {lamp_ids: [7]}
        constructed: For this test.

  LampsState:
    id: 100
    direction: controller -> host
    summary: How bright lamps are.
    cite: vendor, section 1.1
    length: 2 * lamp_count + 3
    fields:
      lamp_count: {type: u8, about: How many lamps.}
      lamps:
        element: LampLevel
        counted_by: lamp_count
        about: The lamps.
        fields:
          lamp_id: {type: u8, about: The lamp.}
          level: {type: u8, about: How bright.}
    examples:
      - title: Lamp 7 at level 9
        hex: 55 55 05 64 01 07 09
        values: {lamps: [{lamp_id: 7, level: 9}]}
        constructed: For this test.

  ServoUnload:"""

BOARD = """
import asyncio, math, socket, threading, types
import busservo
from busservo import LampBlinking, LampsState
from busservo.device import Device
from serial.urlhandler import protocol_socket

# As in tests/conftest.py: nobody waits behind a socket that is closed.
protocol_socket.time = types.SimpleNamespace(sleep=lambda seconds: None)
# The board is quick, on a line that takes no time.
LIVE = {"reply_timeout": 60, "baud": math.inf, "settle": 0}

class Board(Device):
    levels = {1: 0, 2: 0, 7: 0}

    def on_lamp_set(self, message):
        self.levels = self.levels | {lamp.lamp_id: lamp.level for lamp in message.lamps}

    def on_lamp_blink(self, message):
        self.send(LampBlinking(message.lamp_id))

    def on_lamps_read(self, message):
        known = [number for number in message.lamp_ids if number in self.levels]
        return LampsState([(number, self.levels[number]) for number in known])

def serve(listener, board):
    while True:
        guest, _ = listener.accept()
        while data := guest.recv(99):
            guest.sendall(board.receive(data))
        guest.close()

board, listener = Board(), socket.create_server(("127.0.0.1", 0))
threading.Thread(target=serve, args=(listener, board), daemon=True).start()
port = f"socket://127.0.0.1:{listener.getsockname()[1]}"
"""

PROGRAM = """
with busservo.open_controller(port, **LIVE) as controller:
    set_ = controller.lamp_set([(7, 9), (1, 3)], 0)
    print(set_.lasts, set_.wait())
    print(controller.lamp_set([(7, 9)], fade_s=2, latest=True).lasts)
    blink = controller.lamp_blink(7, times=3)
    print(controller.wait_for(LampBlinking, lamp_id=7, timeout=60), blink.started)
    print(controller.read_lamps([7, 1]))
    print(len(controller.read_lamps([1, 2, 7] * 20)))
    try:
        controller.read_lamps([1, 5])
    except busservo.IncompleteReplyError as error:
        print(error)

async def work():
    async with busservo.open_async_controller(port, **LIVE) as controller:
        await (await controller.lamp_set([(2, 200)], 0)).wait()
        print(await controller.read_lamps([2]))

asyncio.run(work())
print(board.rejects)
from busservo.__main__ import main
assert main(["send", "--port", port, "--baud", "inf", "LampSet", "fade_s=0", "lamps=7:9"]) == 0
assert main(["send", "--port", port, "--baud", "inf", "LampsRead", "lamp_ids=7"]) == 0
assert main(["encode", "LampSet", "fade_s=0", "lamps=7:9"]) == 0
"""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a project of the spec with one more command, one more question and its reply."""
    folder = tmp_path_factory.mktemp("lamps")
    text = (ROOT / "spec" / "busservo.yaml").read_text(encoding="utf-8")
    write_files({"spec/busservo.yaml": text.replace("\n  ServoUnload:", NEW, 1)}, folder)
    assert main(["generate", str(folder / "spec" / "busservo.yaml")]) == 0
    return folder


def script(project: Path, text: str) -> str:
    """Return the output of a program that uses the library of `project`."""
    search = os.pathsep.join([str(project / "generated"), *sys.path])
    path = {"PYTHONPATH": search}
    return ran(sys.executable, "-W", "error", "-c", text, environment=path).stdout


def test_it_is_a_method_of_both_clients_a_handler_of_the_device_and_a_verb(project: Path) -> None:
    *methods, read, shown = script(project, BOARD + PROGRAM).splitlines()
    assert methods == [
        "0.0 True",
        "2.0",
        "LampBlinking(lamp_id=7) True",
        "(LampLevel(lamp_id=7, level=9), LampLevel(lamp_id=1, level=3))",
        "60",
        "nothing was reported of lamp_ids 5; 1 did arrive",
        "(LampLevel(lamp_id=2, level=200),)",
        "Rejects(0)",
    ]
    assert "LampsState" in read
    assert "7:9" in read
    assert shown == "55 55 06 63 00 01 07 09"


def test_it_is_in_the_reference_and_in_the_vectors(project: Path) -> None:
    reference = project / "docs" / "reference" / "busservo"
    for name in ("LampSet", "LampsRead", "LampsState"):
        assert name in (reference / "README.md").read_text(encoding="utf-8")
        assert name in (reference / "messages" / f"{name}.md").read_text(encoding="utf-8")
    vectors = (project / "generated" / "busservo" / "vectors.json").read_text(encoding="utf-8")
    assert '"LampsState"' in vectors
