"""The code on the pages of messages: all of it runs, and does what it is shown for."""

import contextlib
import io
import shlex
from types import ModuleType
from typing import Any
from unittest import mock

import busservo
import busservo.__main__
import pytest
from busservo_simulator import VirtualController
from framegen.model.codec import encode, values_of
from framegen.model.exchanges import Exchange
from framegen.model.model import Model
from framegen.model.verdict import weigh_whole
from framegen.render import snippets
from framegen.targets.target import Snippet

from tests.factories import compiled_file, compiled_of, data_of, library, library_files, library_of
from tests.handed import handed_by
from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.devices import answers_to
from tests.lines.timed_line import ScriptedLine, client_on
from tests.mutations.places import having
from tests.protocols.specs import FILES
from tests.rows import some
from tests.unit.site.reference import SPECS, reference

OTHERS = {**FILES, "greenhouse": SPECS["greenhouse"]}
SERVO = reference("busservo").model
NAMES = ("Client", "Codec", "Shell")
# One with addresses and refusals, one without anything special, and one without lengths.
QUICK = {"modbus", "greenhouse", "gauges"}


def shown(model: Model, name: str) -> dict[str, Snippet]:
    """Return the snippets of a message by name."""
    message = model.messages[name]
    if not message.message.examples:
        return {}
    found = snippets()["python"](model, message, message.message.examples[0])
    return {each.name: each for each in found}


def ran(made: ModuleType, source: str, client: Any, opener: str = "open_controller") -> str:
    """Run a program with a client behind whatever port it opens; return what it prints."""
    output = io.StringIO()
    with mock.patch.object(made, opener, return_value=client), contextlib.redirect_stdout(output):
        exec(source, {})  # noqa: S102 - our own pages
    return output.getvalue()


def answering(model: Model, wanted: str) -> ScriptedLine:
    """Return a line with a device that answers each request by examples, `wanted` if it can."""
    by_name = {each.request.name: each for each in model.exchanges}

    def answer(frame: bytes) -> bytes:
        request = weigh_whole(model, [model.roles.sent], frame).message
        assert request is not None, frame
        values = values_of(request, frame)
        return b"".join(_answers(model, by_name[request.name], values, wanted))

    line = ScriptedLine(answer)
    report = model.messages[wanted]
    follows = model.answers.get(wanted) or model.refuses.get(wanted) or model.reports_on.get(wanted)
    if report.direction == model.roles.received and not follows:
        # It comes by itself, whenever one listens.
        line.come(encode(report, report.message.examples[0].values))
    return line


def _answers(model: Model, exchange: Exchange, asked: dict[str, Any], wanted: str) -> list[bytes]:
    reports = [model.messages[name] for name in exchange.reports]
    replies = [each for each in exchange.answers if each.name == wanted]
    chosen = [*(replies or exchange.answers[:1]), *reports]
    return [encode(each, answers_to(exchange, each, asked)) for each in chosen]


# A library is made for each, which takes a while.
@pytest.mark.parametrize("name", some(OTHERS, lambda name: name in QUICK))
def test_every_snippet_of_a_protocol_runs(name: str) -> None:
    with library(library_of(OTHERS[name])) as made:
        snippets_run(made, compiled_file(OTHERS[name]).model, "open_controller")


def test_every_snippet_of_a_client_with_a_name_of_its_own_runs() -> None:
    data = having(data_of(OTHERS["modbus"]), {"protocol.client": "Bus"})
    compiled = compiled_of(data)
    with library(library_files(compiled)) as made:
        snippets_run(made, compiled.model, "open_bus")


def snippets_run(made: ModuleType, model: Model, opener: str) -> None:
    """Run every snippet of a library, in which one function opens a client for threads."""
    silent = {each.request.name for each in model.exchanges if not each.answers}
    for message in model.messages:
        found = shown(model, message)
        assert not found or "Codec" in found
        for kind, snippet in found.items():
            assert snippet.language == ("sh" if kind == "Shell" else "python")
            if kind == "Client":
                line = answering(model, message)
                client = client_on(line, handed_by(made.__name__).client, local_echo=False)
                printed = ran(made, snippet.code, client, opener)
                assert printed or message in silent, message
                assert line.written or line.unasked, message
            elif kind == "Codec":
                received = model.messages[message].direction != model.roles.sent
                assert bool(ran(made, snippet.code, None, opener)) == received, message


@in_turn("message", lambda: SERVO.messages)
def test_every_snippet_of_the_board_runs_against_a_virtual_one(message: str) -> None:
    found = shown(SERVO, message)
    assert tuple(found) == NAMES
    with virtual_board() as board:
        if message == "ActionGroupStopped":
            board.press_button(8)
        client = client_at(board, busservo.Controller)
        printed = ran(busservo, found["Client"].code, client)
    assert bool(printed) == (SERVO.kind(message) != "command")
    assert f"{message}(" in printed or SERVO.kind(message) in ("command", "query", "reply")
    ran(busservo, found["Codec"].code, None)


@in_turn("message", lambda: SERVO.messages)
def test_the_command_of_a_message_is_taken(
    message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    program, verb, *words = shlex.split(shown(SERVO, message)["Shell"].code)
    assert (program, words[:2]) == ("busservo", ["--port", "COM5"])
    if verb == "monitor":
        assert words[2:] == ["--only", message]
        return
    with VirtualController(via="tcp") as board:
        assert busservo.__main__.main([verb, "--port", board.port, *words[2:]]) == 0
    asks = SERVO.kind(message) in ("query", "reply")
    assert bool(capsys.readouterr().out) == asks


@in_turn("message", lambda: SERVO.messages)
def test_the_page_shows_them_in_order_and_so_does_its_markdown(message: str) -> None:
    site = reference("busservo")
    page = site.pages[f"messages/{message}.html"]
    tabs = [given["data-tab"] for _, given in page.tags if "data-tab" in given]
    assert tuple(tabs) == NAMES
    markdown = site.files[f"messages/{message}.md"]
    for snippet in shown(SERVO, message).values():
        assert " ".join(snippet.code.split()) in " ".join(page.words.split())
        assert f"```{snippet.language}\n{snippet.code}```" in markdown
