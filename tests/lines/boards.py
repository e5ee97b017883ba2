"""What holds for tests that start boards: no board refuses anything that it receives.

A conftest.py of a folder with such tests imports both names.
"""

from collections.abc import Generator, Iterator

import pytest
from busservo import Noise
from busservo._envelopes import HEADS
from busservo_simulator import VirtualController
from framewire.codec.rejects import Rejects

_PASSED = pytest.StashKey[bool]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Record whether the test itself has passed: a skipped one proves nothing."""
    report = yield
    if call.when == "call":
        item.stash[_PASSED] = report.passed
    return report


@pytest.fixture(autouse=True)
def no_board_refuses_anything(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> Iterator[None]:
    """Fail a test in which a board refuses what it receives.

    A test marked `garbage` sends what is no frame on purpose, and fails if no board refuses it.
    """
    refused: list[Noise] = []
    add = Rejects.add

    def recorded(self: Rejects, noise: Noise) -> bool:
        counted = add(self, noise)
        # Devices of other protocols count what they refuse, too.
        if counted and self._begins == HEADS.begins:
            refused.append(noise)
        return counted

    close = VirtualController.close

    def closed(self: VirtualController) -> None:
        close(self)
        if not self._line.in_transit:  # it was not unplugged in the middle of a frame
            self.board.quiet()  # half a frame is refused as well

    monkeypatch.setattr(Rejects, "add", recorded)
    monkeypatch.setattr(VirtualController, "close", closed)
    yield
    if not request.node.get_closest_marker("garbage"):
        assert refused == []
    elif request.node.stash.get(_PASSED, False):
        assert refused, "no board has refused anything: the mark is for tests that send garbage"
