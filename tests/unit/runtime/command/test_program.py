"""What a library hands to its command, and that nothing else in it is of one protocol."""

from importlib import import_module

import pytest
from framewire.command.own_verbs import EXAMPLES, FIRST, OTHERS
from framewire.command.program import Program


@pytest.mark.parametrize("package", ["busservo", "lxservo"])
def test_a_command_is_called_as_its_library_is(package: str) -> None:
    program = import_module(f"{package}._command").PROGRAM
    assert program.library is import_module(f"{package}._library").LIBRARY
    assert (program.name, program.package) == (package, package)
    assert program.settings_file == f"{package}.toml"
    assert program.port_variable == f"{package.upper()}_PORT"
    assert program.simulator == f"{package}_simulator"
    assert {*program.examples} == {*program.verbs}
    assert {*program.methods, *program.pose_methods, *program.long.values()} <= {*program.verbs}
    assert f"{program!r}" == f"<the command {package} of the library {package}>"


def lamp(*has: str, **in_examples: str) -> Program:
    """Return the command of a library with a chosen verb and one that is named after a method."""
    frame = {"frame": "A5 01 5A", "sender": "remote", "end": "lamp", "message": "A", "word": "a"}
    return Program(
        "lamp",
        "lamp",
        summary="Send, read and replay frames of: A lamp.",
        has=has,
        verbs={"light": ("Light it.", "1")},
        method_verbs={"dim-slowly": ("Dim it.", "")},
        methods={"light": "Light", "dim-slowly": "DimSlowly"},
        pose_methods={},
        long={},
        stop_message="",
        stop_summary="",
        in_examples={**frame, **in_examples},
        examples={"encode": [("Light on=1", "Light it.")]},
    )


ALWAYS = ["monitor", "decode", "explain", "docs", "encode", "stats", "simulate", "answer"]


def test_verbs_of_messages_stand_behind_the_first_ones_or_last() -> None:
    assert [*lamp().verbs] == ["ports", "doctor", "light", *ALWAYS, "dim-slowly"]


def test_a_command_has_the_verbs_that_its_protocol_has_a_use_for() -> None:
    for has, verbs in {
        "poses": {"stop", "hold", "teach", "play"},
        "requests": {"send", "replay"},
        "queries": {"send", "bench-line"},
    }.items():
        assert {*lamp(has).verbs} - {*lamp().verbs} == verbs
    assert lamp("requests").verbs["send"] == "Send a message to a port."
    both = lamp("requests", "queries").verbs
    assert both["send"] == "Send a message to a port, and print the reply."


def test_examples_hold_what_the_library_gives() -> None:
    examples = lamp().examples
    assert examples["explain"] == (
        ("lamp explain A5 01 5A", "each byte, and what it says"),
        ("lamp explain A5015A --direction remote", "as sent by the remote alone"),
        ("lamp explain A5 01", "where and why it is no frame"),
    )
    given = ("lamp decode --direction lamp -", "what arrives on standard input")
    assert given in examples["decode"]
    assert examples["light"] == (("lamp light 1", "Light it."),)
    assert examples["dim-slowly"] == (("lamp dim-slowly", "Dim it."),)
    assert examples["encode"] == (("lamp encode Light on=1", "Light it."),)


def test_the_example_of_a_number_is_there_where_messages_have_one() -> None:
    line = ("lamp docs 0x01", "the messages with this command")
    assert line in lamp(number="0x01", part="command").examples["docs"]
    assert len(lamp().examples["docs"]) == 5


def test_every_row_needs_what_a_protocol_can_have() -> None:
    needs = {row[1] for row in (*FIRST, *OTHERS, *EXAMPLES)}
    assert needs == {"", "poses", "requests", "queries", "number"}
