"""Answers are compared with the reference's; the first wrong one is shrunk, and all are counted."""

import json
from collections.abc import Callable
from itertools import islice
from pathlib import Path
from typing import TypeAlias
from unittest import mock

import pytest
from framegen.conformance import report
from framegen.conformance import trial as trials
from framegen.conformance.comparison import compare
from framegen.conformance.further import further
from framegen.conformance.language import Decode, Encode, Question, Stream, answer
from framegen.conformance.program import Program, Reply
from framegen.conformance.question_reader import NotAQuestion, read_question
from framegen.conformance.questions import questions
from framegen.conformance.strip import strip
from framegen.conformance.trial import Trial, hold
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, compiled_file, first_model
from tests.in_turn import in_turn
from tests.rows import Rows

# What a program makes of a question that the reference answers so, after that many questions.
Change: TypeAlias = Callable[[Question, list[str], int], list[str] | Reply]

# Which of them has every kind of part and field, and the others.
SPECS = [BUSSERVO, DEMO.with_name("everything.yaml")]
OTHERS = sorted({*DEMO.parent.glob("*.yaml")} - {*SPECS})
MODEL = first_model()


class Fake(Program):
    """A program in this process."""

    def __init__(self, change: Change) -> None:
        super().__init__(["fake"], timeout=10)
        self.change = change
        self.count = 0
        self.timeouts: list[float | None] = []

    def ask(self, question: str, timeout: float | None = None) -> Reply:
        self.count += 1
        self.timeouts.append(timeout)
        read = read_question(MODEL, question)
        said = self.change(read, answer(MODEL, read), self.count)
        if isinstance(said, Reply):
            self.close()
            return said
        return Reply(tuple(said))

    def close(self) -> None:
        self.count = 0


def held(change: Change, *requests: Question) -> Trial:
    return hold(MODEL, Fake(change), [(f"case {at}", each) for at, each in enumerate(requests, 1)])


def read(line: str) -> Question:
    return read_question(MODEL, line)


STOP = read("decode host_to_controller 55550207")
CUT = read("decode host_to_controller 555502")
LINE = read("stream host_to_controller 64 00 5555 0207 quiet 31")
ENCODE = read("encode ServoMove time_ms=700 targets=1:500,2:600,3:700")


# -- What agrees ---------------------------------------------------------------------------------


@pytest.mark.parametrize("spec", Rows(SPECS, OTHERS))
def test_the_reference_conforms_over_the_line_language(spec: Path) -> None:
    model = compiled_file(spec).model
    cases = [*questions(model), *islice(further(model, seed=5), 200)]
    assert len(cases) > 200
    for title, question in cases:
        again = read_question(model, question.line)
        assert again.line == question.line
        assert compare(model, title, question, Reply(tuple(answer(model, again)))) is None


HOST = "stream host_to_controller 257"
SAID = {
    "noise in pieces": (
        f"{HOST} 000131 quiet",
        ["noise bad-header 00", "noise bad-header 01", "noise bad-header 31", "quiet"],
    ),
    "capitals, blanks and tabs": (
        f"{HOST} 55550207 AA quiet",
        ["message  ActionGroupStop\t55550207 ", "noise bad-header AA", "quiet"],
    ),
    "noise that is still held": (f"{HOST} 000131", []),
    "some of the noise that is still held": (f"{HOST} 000131", ["noise bad-header 00"]),
}


@pytest.mark.parametrize(("question", "said"), SAID.values(), ids=list(SAID))
def test_equivalent_spellings_of_an_answer_agree(question: str, said: list[str]) -> None:
    assert compare(MODEL, "", read(question), Reply(tuple(said))) is None


CUT_SHORT = "decode host_to_controller 55"
VOLTAGE = "message BatteryVoltage 5555040f0100 voltage_mv=256"
# A question, a wrong answer, and the line in which it differs.
DIFFER = {
    "another reason": (CUT_SHORT, ["refused bad-header 1"], 0),
    "another place": (CUT_SHORT, ["refused too-short 2"], 0),
    "a blank line": (CUT_SHORT, ["", "refused too-short 1"], 0),
    "nothing": (CUT_SHORT, [], 0),
    "a line too many": (CUT_SHORT, ["refused too-short 1", "refused too-short 1"], 1),
    "another field": (
        "decode controller_to_host 5555040f0100",
        ["message BatteryVoltage 5555040f0100 volts=1"],
        0,
    ),
    "another value": ("decode controller_to_host 5555040f0100", [VOLTAGE], 0),
    "a message that is held": (f"{HOST} 0055550207", ["noise bad-header 00"], 1),
    "noise that no quiet lets go": (
        f"{HOST} 00 quiet 01 quiet",
        ["quiet", "noise bad-header 0001", "quiet"],
        0,
    ),
    "a quiet that is not reported": (f"{HOST} 00 quiet", ["noise bad-header 00"], 1),
    "some of an unknown frame": (f"{HOST} 55550242", ["unknown 5555"], 0),
    "noise that is not there": (f"{HOST} 0031", ["noise bad-header 0032"], 0),
    "unsupported, and yet answered": (f"{HOST} 00 quiet", ["unsupported", "quiet"], 0),
}


@in_turn(
    "question, said, at", lambda: [pytest.param(*row, id=name) for name, row in DIFFER.items()]
)
def test_a_difference_is_found_where_it_is(question: str, said: list[str], at: int) -> None:
    found = compare(MODEL, "a title", read(question), Reply(tuple(said)))
    assert found is not None
    assert (found.title, found.question, found.at) == ("a title", read(question), at)


# -- What is counted -----------------------------------------------------------------------------


def test_a_program_that_answers_rightly_conforms() -> None:
    trial = held(lambda _question, right, _count: right, STOP, CUT, LINE, ENCODE)
    assert trial.conforms
    assert (trial.questions, trial.agreed, trial.differences, trial.smallest) == (4, 4, [], None)


def test_what_is_unsupported_is_counted_and_no_difference() -> None:
    def change(question: Question, right: list[str], _count: int) -> list[str]:
        return ["unsupported"] if isinstance(question, Stream) else right

    trial = held(change, STOP, LINE, LINE)
    assert trial.conforms
    assert (trial.questions, trial.agreed, dict(trial.unsupported)) == (3, 1, {"stream": 2})
    # It is said alone, and who supports nothing does not conform.
    trial = held(lambda *_: ["unsupported", "quiet"], LINE)
    assert (len(trial.differences), trial.unsupported.total()) == (1, 0)
    trial = held(lambda *_: ["unsupported"], STOP, LINE)
    assert (trial.conforms, trial.differences, trial.unsupported.total()) == (False, [], 2)


def test_every_difference_is_kept_with_what_the_reference_says_there() -> None:
    trial = held(lambda *_: ["refused"], STOP, CUT, LINE, ENCODE)
    assert [(found.question.verb, found.about) for found in trial.differences] == [
        ("decode", "message ActionGroupStop"),
        ("decode", "refused too-short"),
        ("stream", "noise bad-header"),
        ("encode", "ServoMove"),
    ]
    assert [found.of_messages for found in trial.differences] == [True, False, True, True]
    # What is no line of the language is named.
    trial = held(lambda _question, right, _count: ["ready.", *right], STOP)
    assert trial.differences[0].rubbish == "ready."


# -- What fails ----------------------------------------------------------------------------------


def test_a_program_that_ends_now_and_then_gets_the_remaining_questions() -> None:
    def change(question: Question, right: list[str], _count: int) -> list[str] | Reply:
        return Reply((), "it ended") if question == CUT else right

    trial = held(change, STOP, CUT, STOP, CUT, LINE)
    assert (trial.questions, trial.agreed, trial.stopped) == (5, 3, "")
    assert [found.failure for found in trial.differences] == ["it ended"] * 2


@pytest.mark.parametrize(
    ("hangs", "count", "why"),
    [(False, 32, "it ended 30 times"), (True, 5, "it did not answer in time 3 times")],
)
def test_a_program_that_always_fails_ends_the_trial(hangs: bool, count: int, why: str) -> None:
    def change(question: Question, right: list[str], _count: int) -> list[str] | Reply:
        return right if question == STOP else Reply((), "it fails", hangs)

    trial = held(change, STOP, STOP, *[LINE] * 100)
    assert (trial.questions, trial.stopped) == (count, why)


def test_a_program_that_never_answered_ends_the_trial_at_once() -> None:
    trial = held(lambda *_: Reply((), "it ended with status 1 before it printed a line"), STOP, CUT)
    assert (trial.questions, trial.stopped, trial.conforms) == (1, "it never answered", False)


def test_what_hangs_is_given_less_time_while_it_is_shrunk() -> None:
    def change(question: Question, right: list[str], _count: int) -> list[str] | Reply:
        return Reply((), "it hangs", hangs=True) if "31" in question.line else right

    program = Fake(change)
    trial = hold(MODEL, program, [("", STOP), ("", LINE)])
    assert smallest_of(trial) == "stream host_to_controller 257 31"
    assert set(program.timeouts) == {None, 1.0}
    assert program.timeouts[-1] is None
    assert program.timeouts.count(1.0) <= 40


# -- What is shrunk ------------------------------------------------------------------------------


def smallest_of(trial: Trial) -> str:
    assert trial.smallest is not None
    assert trial.smallest.alone
    return trial.smallest.difference.question.line


def with_31(question: Question, right: list[str], _count: int) -> list[str]:
    return [*right, "quiet"] if "31" in question.line else right


def behind_a_cut(question: Question, right: list[str], _count: int) -> list[str]:
    """Lose messages in a line that is cut behind a 55."""
    assert isinstance(question, Stream)
    loses = any(part and part.endswith(b"\x55") for part in question.parts[:-1])
    return [line for line in right if not (loses and line.startswith("message"))]


def in_a_small_buffer(question: Question, right: list[str], _count: int) -> list[str]:
    assert isinstance(question, Stream)
    return right if question.max_frame > 64 else [*right, "quiet"]


def without_messages(_question: Question, right: list[str], _count: int) -> list[str]:
    return [line for line in right if not line.startswith("message")]


def uncounted(question: Question, right: list[str], _count: int) -> list[str]:
    """Take a whole frame with another count for a message."""
    assert isinstance(question, Decode)
    whole = len(question.data) > 4 and len(question.data) == question.data[2] + 2
    return ["message"] if whole and right == ["refused count-mismatch 4"] else right


def too_high(question: Question, right: list[str], _count: int) -> list[str]:
    assert isinstance(question, Encode)
    high = any(target["position"] > 550 for target in question.values["targets"])
    return ["refused"] if high else right


def never(_question: Question, _right: list[str], _count: int) -> list[str]:
    return ["refused"]


# What a program makes of questions, one that it answers wrongly, and the smallest such.
SHRUNK: list[tuple[Change, str, str]] = [
    (
        with_31,
        "stream host_to_controller 64 00 5555 0207 quiet 013177 55550207 quiet quiet",
        f"{HOST} 31",
    ),
    (behind_a_cut, f"{HOST} 0055 550207 55550207 quiet", f"{HOST} 55 550207"),
    (in_a_small_buffer, LINE.line, "stream host_to_controller 64"),
    (without_messages, f"{HOST} 5555080301e803012003 quiet", f"{HOST} 55550207"),
    # A length is lowered with what it counts.
    (
        uncounted,
        "decode host_to_controller 55550e0302e803012003022003032003",
        "decode host_to_controller 55550803000000000000",
    ),
    (never, ENCODE.line, "encode ServoMove time_ms=0 targets=0:0"),
    (too_high, ENCODE.line, "encode ServoMove time_ms=0 targets=0:551"),
]


@in_turn("change, line, smallest", lambda: SHRUNK)
def test_a_question_is_shrunk_to_what_matters(change: Change, line: str, smallest: str) -> None:
    assert smallest_of(held(change, read(line))) == smallest


def test_what_is_shrunk_stays_a_difference_of_its_kind() -> None:
    """A codec that also words its refusals otherwise is shown the message that it does not know."""

    assert smallest_of(held(lambda *_: ["refused bad-header 0"], STOP)) == STOP.line
    assert (
        smallest_of(held(lambda *_: ["refused bad-header 0"], CUT)) == "decode host_to_controller"
    )


def test_a_program_that_remembers_is_shown_as_it_was_found() -> None:
    def change(_question: Question, right: list[str], count: int) -> list[str]:
        return right if count < 3 else ["refused"]

    trial = held(change, STOP, CUT, LINE, STOP)
    assert trial.smallest is not None
    assert not trial.smallest.alone
    assert (trial.smallest.difference, trial.smallest.tries) == (trial.differences[0], 0)
    assert trial.smallest.difference.question == LINE
    assert trial.smallest.behind == CUT.line


def test_a_smaller_case_that_a_fresh_program_gets_right_is_not_shown() -> None:
    def change(question: Question, right: list[str], count: int) -> list[str]:
        return right if count < 3 and question != LINE else ["refused"]

    trial = held(change, LINE)
    assert trial.smallest is not None
    assert trial.smallest.difference.question == LINE


# -- Further questions ---------------------------------------------------------------------------


def test_a_seed_always_asks_the_same_and_another_does_not() -> None:
    first, again, other = (
        [question.line for _, question in islice(further(MODEL, seed), 50)] for seed in (1, 1, 2)
    )
    assert first == again
    assert first != other
    # On any Python.
    assert first[:2] == [
        "decode controller_to_host b83a",
        "stream host_to_controller 31 8e a42f quiet",
    ]


def test_further_questions_reach_every_answer_there_is() -> None:
    printed = set()
    for _, question in islice(further(MODEL, seed=4), 500):
        for line in answer(MODEL, question):
            printed.add(" ".join(line.split()[: 2 if line.startswith(("noise", "refused")) else 1]))
    reasons = ["too-short", "bad-header", "length-mismatch", "count-mismatch", "unknown-command"]
    assert printed == {
        *("message", "frame", "unknown", "quiet", "refused", "refused trailing-bytes"),
        *(f"noise {reason}" for reason in reasons),
        *(f"refused {reason}" for reason in reasons),
    }


NO_QUESTIONS = {
    "": "there is no question ``: choose one of `decode`, `encode`, `stream`",
    "decoed host_to_controller 55": "there is no question `decoed`: did you mean `decode`?",
    "decode": "too short: write `decode WAY HEX`",
    "decode host_to_board 55": "there is no way `host_to_board`: "
    "did you mean `host_to_controller`?",
    "decode host_to_controller 5": "`5` is no hex: write two digits a byte",
    "encode": "too short: write `encode NAME FIELDS...`",
    "encode Servomove": "there is no message `Servomove`: did you mean `ServoMove`?",
    "encode ActionGroupRun group=1": "ActionGroupRun lacks `times=`",
    "encode ActionGroupStop group=1": "ActionGroupStop has no `group` to be given",
    "encode ActionGroupRun group=x times=1": "`x` is no group of ActionGroupRun: write a number",
    "encode ServoUnload servo_ids=1:2": "`1:2` is no servo_ids of ServoUnload: "
    "write a list, servo_ids,servo_ids",
    "stream host_to_controller": "too short: write `stream WAY LARGEST PARTS...`",
    "stream host_to_controller x": "`x` is no size of a frame: write a number of bytes",
    "stream host_to_controller 64 quite": "`quite` is no hex: write two digits a byte",
}


@in_turn("line, error", NO_QUESTIONS.items)
def test_a_malformed_question_is_refused_with_the_reason(line: str, error: str) -> None:
    with pytest.raises(NotAQuestion) as caught:
        read(line)
    assert str(caught.value) == error


# -- The report ----------------------------------------------------------------------------------

WORDS = ["message", "noise", "refused", "frame", "unknown", "quiet", "ActionGroupStop"]
LINES_SAID = st.lists(
    st.lists(
        st.one_of(
            st.sampled_from([*WORDS, "bad-header", "55", "555", "55550207"]), st.text(max_size=4)
        )
    )
    .map(" ".join)
    .filter(lambda line: "\n" not in line)
)


@given(said=LINES_SAID, question=st.sampled_from([STOP, CUT, LINE, ENCODE]))
def test_any_answer_of_a_program_can_be_reported(said: list[str], question: Question) -> None:
    # How small a case becomes says nothing of how it is shown.
    with mock.patch.object(trials, "_TRIES", 50):
        trial = held(lambda *_: said, question)
    text = list(report.as_text(MODEL, trial, ["./codec"]))
    assert text[-1].startswith("./codec: ")
    assert all("\n" not in line for line in text)
    assert json.loads(json.dumps(report.as_json(MODEL, trial, ["./codec"], None)))["questions"] == 1


@in_turn(
    "said",
    lambda: [
        ["noise bad-header 0031", "noise length-mismatch 55550207", "quiet"],
        ["noise bad-header 003155550207", "quiet"],
    ],
)
def test_what_is_taken_apart_begins_where_the_answers_part(said: list[str]) -> None:
    question = read("stream host_to_controller 257 31 quiet 0031 5555 0207 quiet")
    found = compare(MODEL, "", question, Reply(("noise bad-header 31", "quiet", *said)))
    assert found is not None
    lines = list(strip(MODEL, found))
    assert lines[:2] == ["  byte   0   1   2   3   4   5   6", "        31  00  31  55  55  02  07"]
    assert "     3  55 55  header          Two bytes that announce a frame" in lines


def test_what_is_refused_within_a_line_is_shown_in_its_place() -> None:
    question = read("stream host_to_controller 257 55550207 5555 0163 quiet")
    first, *_ = answer(MODEL, question)
    found = compare(MODEL, "", question, Reply((first, "noise unknown-command 55550163", "quiet")))
    assert found is not None
    lines = list(strip(MODEL, found))
    assert lines[:3] == [
        "  byte   0   1   2   3   4   5   6   7",
        "        55  55  02  07  55  55  01  63",
        "                                ^^",
    ]
    assert lines[-1] == "  length mismatch at byte 6: the length of a frame is 2..255, not 1"


def test_a_long_answer_is_shown_where_it_differs() -> None:
    question = read("stream host_to_controller 257 " + "55550207" * 300 + " quiet")
    right = answer(MODEL, question)
    wrong = [*right[:200], "quiet", *right[200:]]
    found = compare(MODEL, "", question, Reply(tuple(wrong)))
    assert found is not None
    lines = list(strip(MODEL, found))
    assert "  ... 190 lines before, in which they agree" in lines
    assert "  program          quiet" in lines
    assert "  ... and more" in lines


def test_where_the_reference_says_nothing_more_or_nothing_that_is_shown() -> None:
    none = read("stream host_to_controller 257")
    trial = held(lambda _question, right, _count: [*right, "quiet"], LINE, none)
    assert [found.about for found in trial.differences] == ["nothing more"] * 2
    one, other = (list(strip(MODEL, found)) for found in trial.differences)
    assert "  program          quiet" in one
    assert "  reference        nothing" in other


def test_the_report_of_a_long_wrong_answer_is_short() -> None:
    trial = held(lambda *_: ["what?"] * 1_000, STOP)
    assert len(list(report.as_text(MODEL, trial, ["./codec"]))) < 80
