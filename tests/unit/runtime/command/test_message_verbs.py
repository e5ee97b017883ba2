"""The verbs that send one message, and those that stop and hold what moves."""

import argparse
import json
from collections.abc import Mapping

import busservo
import pytest
from busservo import ActionGroupRun, Message, ServoMove, ServoPositionsRead, ServoUnload
from busservo._command import PROGRAM
from busservo._exchanges import EXCHANGES
from busservo_simulator import VirtualController
from framegen.language.command_verbs import OF_POSES, VERBS
from framewire.command.verbs import verb_named

from tests.commands import Ended, run
from tests.crowd import Crowd
from tests.factories import BUSSERVO, Data, data_of, files_of, library
from tests.handed import program_of
from tests.in_turn import in_turn
from tests.lines.at_board import received_by
from tests.mutations.places import GONE, with_
from tests.timeouts import GENEROUS, await_that


def at(board: VirtualController, line: str) -> Ended:
    """Call a verb at a board, with words as they are typed."""
    return run(*line.split(), "--port", board.port, "--timeout", GENEROUS, "--baud", "inf")


def sent_by(*words: str) -> list[Message]:
    """Return what a verb makes of its words."""
    verb = verb_named(words[0], PROGRAM)
    parser = argparse.ArgumentParser()
    verb.add_arguments(parser, PROGRAM)
    messages: list[Message] = verb.messages(parser.parse_intermixed_args(words[1:]))
    return messages


@in_turn(
    "line, message",
    lambda: [
        ("move 1:500", ServoMove(time_ms=1000, targets=[(1, 500)])),
        ("move 1:500 2:300 --in 2s", ServoMove(time_ms=2000, targets=[(1, 500), (2, 300)])),
        ("move 1:500,2:300 --in 0.29", ServoMove(time_ms=290, targets=[(1, 500), (2, 300)])),
        ("move --in 500ms 0x01:500", ServoMove(time_ms=500, targets=[(1, 500)])),
        ("move 1:500 --in 0s 2:300", ServoMove(time_ms=0, targets=[(1, 500), (2, 300)])),
        ("move 1:500 --in 65535ms", ServoMove(time_ms=65535, targets=[(1, 500)])),
        ("run 8 1", ActionGroupRun(8, 1)),
        ("run 8 unlimited", ActionGroupRun(8, 0)),
        ("speed all 50", busservo.ActionGroupSpeed(255, 50)),
        ("unload 1 2", ServoUnload([1, 2])),
        ("unload 1,2 3", ServoUnload([1, 2, 3])),
        ("positions 1 2", ServoPositionsRead([1, 2])),
    ],
)
def test_words_are_the_values_in_the_order_of_the_method(line: str, message: Message) -> None:
    assert sent_by(*line.split()) == [message]


NEEDED = "the following arguments are required:"
NO_TIME = "is no time: write it like 1s or 500ms"


@in_turn(
    "line, problem",
    lambda: [
        ("move", f"{NEEDED} SERVO_ID:POSITION"),
        ("move 1", "targets[0]: '1' is not servo_id:position"),
        ("move 1:x", "targets[0].position: 'x' is no number: write it like 12 or 0x0C"),
        ("move 1:500 --in 65536ms", "argument --in: 65536ms is not in 0s..65.535s"),
        ("move 1:500 --in=-1s", "argument --in: -1s is not in 0s..65.535s"),
        ("move 1:500 --in soon", f"argument --in: 'soon' {NO_TIME}"),
        ("move 1:500 --in nan", f"argument --in: 'nan' {NO_TIME}"),
        ("move 1:1001", "targets[0].position: 1001 is outside the limits 0..1000; "),
        ("move 1:1 --in 0.1ms", "argument --in: 0.1ms is no whole number of ms"),
        ("run 8", f"{NEEDED} TIMES"),
        ("run 8 1 1", "unrecognized arguments: 1"),
        ("run 256 1", "group: 256 is outside 0..255"),
        ("unload", f"{NEEDED} SERVO_IDS"),
        ("hold 1-300", "argument ID: 1-300 is outside 0..255"),
        ("stop x", "argument ID: 'x' is neither a number nor a range like 1-6"),
    ],
)
def test_what_cannot_be_sent_is_refused_and_nothing_arrives(
    board: VirtualController, line: str, problem: str
) -> None:
    before = board.accepted
    status, _, errors = at(board, line)
    assert (status, f"busservo: error: {problem}" in errors) == (2, True)
    assert at(board, "battery").status == 0
    assert board.accepted == before + 1


def test_a_move_ends_when_the_motion_is_over_or_is_not_waited_for(board: VirtualController) -> None:
    assert at(board, "move 1:520 2:480 --in 200ms").status == 0
    assert (board.servos[1].position, board.servos[2].position) == (520, 480)
    assert at(board, "move 1:800 --in 60s --no-wait").status == 0
    await_that(lambda: board.servos[1].travelling)


def test_positions_of_all_that_answer(board: VirtualController) -> None:
    status, output, _ = at(board, "positions")
    assert (status, " ServoPositions positions=1:500,2:500,3:500 |" in output) == (0, True)
    fields = json.loads(at(board, "positions 2 --json").out)["fields"]
    assert fields == {"positions": [{"servo_id": 2, "position": 500}]}


def test_hold_holds_what_answers_and_names_the_rest(board: VirtualController) -> None:
    assert at(board, "unload 1 2 3").status == 0
    held = "servos 1, 2 held\nservo 9 not held: no answer\n"
    assert at(board, "hold 1 2 9") == (1, "", held)
    assert at(board, "battery").status == 0
    assert [board.servos[each].loaded for each in (1, 2, 3)] == [True, True, False]
    assert at(board, "hold") == (0, "", "servos 1, 2, 3 held\n")


def test_what_is_outside_the_limits_is_named_and_the_rest_is_held(board: VirtualController) -> None:
    assert at(board, "move 1:700 --limits 600..1000").status == 0
    not_held = "not held: 500 is outside the limits 600..1000\n"
    held = f"servo 1 held\nservo 2 {not_held}servo 3 {not_held}"
    assert at(board, "hold 1-3 --limits 600..1000") == (1, "", held)


def test_stop_ends_the_group_before_it_holds(board: VirtualController) -> None:
    received = received_by(board)
    assert at(board, "run 8 unlimited").status == 0
    assert at(board, "stop 1-2") == (0, "", "servos 1, 2 held\n")
    assert at(board, "battery").status == 0
    kinds = [type(message) for message in received]
    assert kinds[:4] == [ActionGroupRun, busservo.ActionGroupStop, ServoPositionsRead, ServoMove]


def test_nobody_to_hold_is_told() -> None:
    with VirtualController("tcp", servos=[]) as board:
        for verb, expected in (("hold", 1), ("positions", 2)):
            status, _, errors = at(board, verb)
            assert (status, "no servo is there" in errors) == (expected, True)


def test_every_message_of_this_end_has_a_verb_once() -> None:
    verbs = {**PROGRAM.methods, **PROGRAM.pose_methods}
    sent = [*verbs.values(), PROGRAM.stop_message]
    assert sorted(sent) == sorted(kind.__name__ for kind in EXCHANGES)
    assert not {*verbs} & {*VERBS}


def test_a_method_has_its_long_verb_as_well(board: VirtualController) -> None:
    verbs = {*PROGRAM.methods, *PROGRAM.pose_methods, "stop"}
    # A message without a verb of its own has no other.
    alone = {each.method.replace("_", "-") for each in EXCHANGES.values()}
    assert {*PROGRAM.long.values()} == verbs - alone
    status, output, _ = at(board, "read-battery-voltage")
    assert (status, " BatteryVoltage voltage_mv=7500 mV |" in output) == (0, True)


def verbs_of(data: Data) -> Mapping[str, str]:
    """Return the verbs of the library of a spec, each with what it is for."""
    with library(files_of(data)) as made:
        verbs: Mapping[str, str] = program_of(made.__name__).verbs
        return verbs


def test_where_nothing_has_a_pose_a_word_for_one_is_a_message_like_any() -> None:
    crowd = Crowd("fan", "host", "device")
    for word in sorted(OF_POSES):
        crowd.command(word.capitalize(), [], method=f"{word}()")
    found = [each for each in verbs_of(crowd.data).items() if each[0] in OF_POSES]
    assert found == [(word, "Say something.") for word in sorted(OF_POSES)]


@pytest.mark.parametrize("verb", ["stop", GONE], ids=["declared", "of the method"])
def test_a_pose_has_one_stop_that_says_what_it_sends_first(verb: object) -> None:
    stop = ("messages", "ActionGroupStop")
    data = with_(with_(data_of(BUSSERVO), *stop, "method", "stop()"), *stop, "verb", verb)
    summary = "Stop the action group that is running, then hold everything where it is."
    assert verbs_of(data)["stop"] == summary
