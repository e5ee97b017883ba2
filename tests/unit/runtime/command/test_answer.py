"""The verb `answer`: the session in the guide, questions that make no sense, and no waiting."""

import re
import subprocess
import sys
from collections.abc import Iterator

import pytest
from framewire.command.usage_error import UsageError

from tests.commands import run
from tests.documents import ROOT
from tests.handed import answers_of
from tests.in_turn import in_turn

answer = answers_of("busservo")
GUIDE = (ROOT / "docs" / "command.md").read_text(encoding="utf-8")
SESSION = re.findall(r"^```text\n\$ busservo answer\n(.*?)^```$", GUIDE, re.MULTILINE | re.DOTALL)


def exchanges() -> Iterator[tuple[str, list[str]]]:
    """Yield each question of the session in the guide, and its answer."""
    (session,) = SESSION
    for exchange in re.findall(r"(.*?)^end\n", session, re.MULTILINE | re.DOTALL):
        question, *answers = [line.strip() for line in exchange.splitlines()]
        yield question, answers


@in_turn("question, answers", exchanges)
def test_it_answers_as_the_guide_says(question: str, answers: list[str]) -> None:
    assert answer(question) == answers


def test_the_guide_asks_for_everything() -> None:
    verbs = {question.split()[0] for question, _ in exchanges()}
    said = {line.split()[0] for _, answers in exchanges() for line in answers}
    assert verbs == {"decode", "encode", "stream"}
    assert said == {"message", "refused", "frame", "noise", "quiet"}


HOST = "host_to_controller"


@in_turn(
    "question, expected",
    lambda: [
        ("tell me", "ask `decode WAY HEX`, `encode NAME FIELDS` or `stream WAY LARGEST PARTS`"),
        ("decode", "ask `decode WAY HEX`, "),
        (f"stream {HOST}", "ask `decode WAY HEX`, "),
        ("decode up 55", "there is no way 'up'; there are host_to_controller and controller_to_"),
        (f"decode {HOST} 5x", "is no hex digit"),
        (f"stream {HOST} 257 55 silence", "is no hex digit"),
        (f"stream {HOST} many 55", "many: 'many' is no whole number: write it like 12"),
        (f"stream {HOST} 3 55", "3: max_frame is 3, and the smallest frame has 4 bytes"),
        ("encode ServoMov", "there is no message 'ServoMov'; did you mean ServoMove?"),
        ("encode ServoUnload", "ServoUnload needs servo_ids; it is written ServoUnload servo_ids="),
        ("encode ServoUnload servo_ids=one", "servo_ids[0]: 'one' is no number"),
    ],
)
def test_a_malformed_question_is_refused_with_the_reason(question: str, expected: str) -> None:
    with pytest.raises(UsageError, match=re.escape(expected)):
        answer(question)


def test_a_malformed_question_does_not_end_the_session() -> None:
    status, output, errors = run(
        "answer", given=b"decode \x1b\xff 55\n\n  \nencode ActionGroupStop\n"
    )
    first, *rest = output.splitlines()
    assert first.startswith(r"error there is no way '\x1b")
    assert (status, rest, errors) == (2, ["end", "frame 55550207", "end"], "")


def test_an_unknown_frame_and_a_bound_for_frames() -> None:
    line = "555502ff55550514020102"
    assert answer(f"stream {HOST} 6 {line} quiet") == [
        "unknown 555502ff",
        "noise length-mismatch 55550514020102",
        "quiet",
    ]
    assert answer(f"stream {HOST} 7 {line}") == [
        "unknown 555502ff",
        "message ServoUnload 55550514020102 servo_ids=1,2",
    ]


def test_each_question_is_answered_before_the_next_arrives() -> None:
    words, pipe = [sys.executable, "-m", "busservo", "answer"], subprocess.PIPE
    with subprocess.Popen(words, stdin=pipe, stdout=pipe, encoding="utf-8") as process:
        assert process.stdin is not None
        assert process.stdout is not None
        for question in ("encode ActionGroupStop", "encode BatteryVoltageRead"):
            process.stdin.write(f"{question}\n")
            process.stdin.flush()
            # The next question is sent only when this one is answered: else both would wait.
            assert process.stdout.readline().startswith("frame 5555")
            assert process.stdout.readline() == "end\n"
        process.stdin.close()
        assert process.wait() == 0
