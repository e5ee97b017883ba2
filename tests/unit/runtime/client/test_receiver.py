"""The client of a receiver: long replies, and what comes both asked for and by itself."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.codec import encode
from framewire.client.session import Session

from tests.factories import Data, data_of, files_of, layout_of, library
from tests.mutations.places import having
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from collections.abc import Iterator


def data() -> Data:
    """Return a spec in which a reply is as long as its length can say."""
    # What comes again and again once it is switched on, and is asked for as well.
    reports = {"messages.CfgMsgRateSet.reports": ["NavPvt"]}
    return having(
        data_of(FILES["ubx"]), {"messages.MonVer.fields.extensions.count": "0..", **reports}
    )


@pytest.fixture(scope="module", autouse=True)
def receiver() -> Iterator[None]:
    """Return the library of a protocol whose length counts to 65535, under its own name."""
    with library(files_of(data())):
        yield


def session() -> tuple[Any, Any]:
    kinds = importlib.import_module("ubx.messages")
    ours = importlib.import_module("ubx._library").LIBRARY
    made = Session(ours, baud=9600, reply_timeout=0.25, report_limit=16, settle=0)
    request = made.submit(kinds.MonVerPoll(), question=True)
    made.outgoing(0.0)
    made.written(request, 0.0)
    return made, request


def test_what_is_asked_for_and_reported_as_well_is_both() -> None:
    kinds = importlib.import_module("ubx.messages")
    line, _ = session()
    [example] = data()["messages"]["NavPvt"]["examples"][:1]
    frame = bytes.fromhex(example["hex"])
    line.receive(frame, 0.01)
    assert line.reports.take() == kinds.NavPvt.decode(frame)
    assert line.counters.unsolicited == 0
    line.tick(2.0)  # what was asked first is given up
    request = line.submit(kinds.NavPvtPoll(), question=True)
    line.outgoing(3.0)
    line.written(request, 3.0)
    line.receive(frame, 3.2)
    assert request.reply == kinds.NavPvt.decode(frame)


def test_nobody_is_waited_for_as_long_as_the_longest_reply_would_take() -> None:
    line, request = session()
    line.tick(2.0)
    assert request.error is not None
    assert "no MonVer came" in str(request.error)


def test_a_long_reply_may_take_as_long_as_it_goes_on_arriving() -> None:
    line, request = session()
    extensions = [{"text": f"extension {number}"} for number in range(200)]
    values = {"software": "1", "hardware": "2", "extensions": extensions}
    reply = encode(layout_of(data()).messages["MonVer"], values)
    assert len(reply) > 5000
    for at in range(0, len(reply), 96):
        line.receive(reply[at : at + 96], 0.1 + at / 960)
        line.tick(0.1 + at / 960 + 0.001)
    assert request.error is None
    assert len(request.reply.extensions) == 200
