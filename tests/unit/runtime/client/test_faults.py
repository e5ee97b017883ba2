"""What lines may bring besides a reply: headers alone, floods of reports, and faults for long.

That no wrong value is returned, whatever happens: test_conversations.py, and the independent board.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStarted,
    ActionGroupStopped,
    BatteryVoltage,
    Controller,
    Message,
    NoReplyError,
)
from hypothesis import given
from hypothesis import strategies as st

from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine

if TYPE_CHECKING:
    from collections.abc import Iterator

REPLY_TIMEOUT = 0.25
REPORTS = [ActionGroupStarted(8, 1), ActionGroupStopped(), ActionGroupCompleted(8, 1)]


@given(
    st.lists(st.sampled_from([b"\x55", b"\x55\x55", b"\x55\x55\x15"]), max_size=40), st.booleans()
)
def test_a_board_that_sends_nothing_but_headers_ends_in_an_error(
    spurious: list[bytes], flood: bool
) -> None:
    line = VirtualLine()
    for at, data in enumerate(spurious):
        line.say(data * (40 if flood else 1), 0.02 * at)
    client = client_on(line, Controller, reply_timeout=REPLY_TIMEOUT, settle=None)
    with pytest.raises(NoReplyError) as caught:
        client.read_battery_voltage()
    assert caught.value.waited <= 1
    assert line.now <= 1
    client.close()


def test_a_flood_of_reports_hides_no_reply() -> None:
    def answer(message: Message) -> Iterator[tuple[float, bytes]]:
        for at in range(30):
            yield at * 0.007, REPORTS[2].encode()
            if at == 20:
                yield at * 0.007, BatteryVoltage(7500).encode()

    line = VirtualLine(answer)
    client = client_on(line, Controller, report_limit=16, settle=None)
    assert client.read_battery_voltage() == 7500
    kept = list(client.reports(timeout=1))
    # The queue holds 16; the oldest went, and were counted.
    assert len(kept) + client.counters.lost_reports == 30
    assert client.counters.lost_reports >= 21 - 16
    client.close()


def test_a_soak_with_faults() -> None:
    seen = 0

    def answer(message: Message) -> Iterator[tuple[float, bytes]]:
        nonlocal seen
        seen += 1
        if seen % 7 == 0:
            return
        if seen % 5 == 0:
            yield 0.0, b"\x55\x00" + REPORTS[seen % 3].encode()
        yield 0.3 if seen % 11 == 0 else 0.01, BatteryVoltage(seen % 65536).encode()

    line = VirtualLine(answer)
    client = client_on(line, Controller, baud=math.inf, settle=None)
    failed = reports = 0
    for _ in range(1000):
        before = seen
        try:
            value = client.read_battery_voltage()
        except NoReplyError:
            failed += 1
        else:
            assert value == seen == before + 1
    reports = len(list(client.reports(timeout=1)))
    assert reports + client.counters.lost_reports == sum(
        1 for n in range(1, seen + 1) if n % 5 == 0 and n % 7
    )
    assert (
        failed
        == client.counters.timeouts
        == sum(1 for n in range(1, seen + 1) if n % 7 == 0 or n % 11 == 0)
    )
    client.close()
