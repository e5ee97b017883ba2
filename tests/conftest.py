"""Fixtures for every test: a client sends no malformed frame; and how long Hypothesis searches.

Its profiles are `ci`, the same examples in every run; `quick`, fewer of them; and `fuzz`, a long
search for others. One is chosen by HYPOTHESIS_PROFILE or --hypothesis-profile. No test sets
max_examples of its own: that would limit the search.
"""

from __future__ import annotations

import os
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from busservo._codec.rejects import Rejects
from busservo_simulator import VirtualController
from hypothesis import HealthCheck, settings
from serial.urlhandler import protocol_socket

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

    from busservo import Noise

# How long something takes to draw says more about the machine than about the test.
TIMELESS = [HealthCheck.too_slow]
settings.register_profile(
    "ci", derandomize=True, deadline=None, max_examples=100, suppress_health_check=TIMELESS
)
settings.register_profile(
    "quick", derandomize=True, deadline=None, max_examples=20, suppress_health_check=TIMELESS
)
settings.register_profile(
    "fuzz",
    deadline=None,
    max_examples=5_000,
    print_blob=True,
    # What is rare is what is searched for here, and rare things are slow to draw.
    suppress_health_check=[*TIMELESS, HealthCheck.data_too_large],
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


# pyserial sleeps for 0.3 s behind each socket that it has closed, for servers that are slow to take
# the next caller. Our boards are not, so that no test waits for it.
_sockets: Any = protocol_socket
_sockets.time = SimpleNamespace(sleep=lambda _seconds: None)


_PASSED = pytest.StashKey[bool]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Note whether the test itself has passed: one that was skipped is not checked further."""
    report = yield
    if call.when == "call":
        item.stash[_PASSED] = report.passed
    return report


@pytest.fixture(autouse=True)
def no_board_refuses_anything(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> Iterator[None]:
    """Check that every board that a test starts understands all that it receives.

    Save in a test marked `garbage`, which sends what is no frame on purpose, and then must.
    """
    refused: list[Noise] = []
    add = Rejects.add

    def noted(self: Rejects, noise: Noise) -> bool:
        counted = add(self, noise)
        if counted:
            refused.append(noise)
        return counted

    close = VirtualController.close

    def closed(self: VirtualController) -> None:
        close(self)
        if not self._line.unheard:  # it was not unplugged in the middle of a frame
            self.board.quiet()  # half a frame is refused as well

    monkeypatch.setattr(Rejects, "add", noted)
    monkeypatch.setattr(VirtualController, "close", closed)
    yield
    if not request.node.get_closest_marker("garbage"):
        assert refused == []
    elif request.node.stash.get(_PASSED, False):
        assert refused, "no board has refused anything: the mark is for tests that send garbage"
