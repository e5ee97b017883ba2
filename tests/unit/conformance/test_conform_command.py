"""`framegen conform`, as it is used: what it prints, with which status, and what it refuses."""

import json
import re
import sys
from collections.abc import Iterator
from functools import cache, partial
from itertools import islice
from pathlib import Path
from typing import Any
from unittest import mock
from xml.etree import ElementTree as ET

import pytest
from framegen import cli
from framegen.conformance.language import Question
from framegen.conformance.questions import questions
from framegen.model.model import Model

from tests.commands import Ended, called
from tests.contract.conformance.c_codecs import WRONG, compile_codec, needs_compiler
from tests.factories import BUSSERVO, DEMO, ROOT, data_of, first_edition
from tests.in_turn import in_turn

SPEC = str(BUSSERVO)
EDITION = f"busservo {data_of(BUSSERVO)['protocol']['version']}"
LIBRARY = [sys.executable, "-m", "busservo", "answer"]
# Answers everything alike, which is right for bytes that have only begun to be a frame.
STUBBORN = """
import sys
for line in sys.stdin:
    print("refused too-short 3", "end", sep="\\n", flush=True)
"""
# Cannot decode lines, and encodes nothing; for all else it asks the library.
LIMITED = """
import sys
from framewire.command.answer import Answerer
from busservo._library import LIBRARY
answer = Answerer(LIBRARY).answer
for line in sys.stdin:
    said = ["unsupported"] if line.startswith("stream") else answer(line)
    print(*said, "end", sep="\\n", flush=True)
"""
conform = partial(called, cli.main, "conform")


def python(source: str) -> list[str]:
    return ["--", sys.executable, "-c", source]


def some_questions(model: Model) -> Iterator[tuple[str, Question]]:
    """Yield a part of the questions, for tests of what becomes of the answers."""
    return islice(questions(model), 0, None, 7)


@cache
def tried(source: str, *words: str) -> Ended:
    """Return what comes of a program in Python that is asked some of the questions."""
    with mock.patch("framegen.conformance.questions.questions", some_questions):
        return conform(SPEC, *words, *python(source))


AS_JSON = ["--format", "json", "--more", "5", "--seed", "7"]


def test_our_own_library_conforms() -> None:
    status, out, err = conform(SPEC, "--more", "300", "--seed", "1", "--", *LIBRARY)
    assert (status, err) == (0, "the same questions again: --more 300 --seed 1\n")
    name = re.escape(" ".join(LIBRARY))
    assert re.fullmatch(
        rf"{name}: conforms to {re.escape(EDITION)}: \d{{3,}} answers as the reference's\n", out
    )


@in_turn("spec", lambda: [BUSSERVO, DEMO])
def test_the_reference_itself_answers_by_hand(spec: Path) -> None:
    status, asked, _ = conform(str(spec), "--questions", "--more", "20", "--seed", "1")
    assert status == 0
    status, answers, errors = conform(str(spec), "--answers", given=asked)
    assert (status, errors) == (0, "")
    assert answers.splitlines().count("end") == asked.count("\n") > 100
    assert not re.search("^error", answers, flags=re.MULTILINE)


def test_a_malformed_question_is_answered_by_an_error_and_the_next_one_is_read() -> None:
    asked = "decode host_to_controller 55\n\n  \nwhat?\ndecode host_to_controller 31\n"
    expected = (
        "refused too-short 1\nend\n"
        "error there is no question `what?`: choose one of `decode`, `encode`, `stream`\nend\n"
        "refused bad-header 0\nend\n"
    )
    assert conform(SPEC, "--answers", given=asked) == (2, expected, "")


def test_without_a_seed_every_run_asks_something_else() -> None:
    first, second = (conform(SPEC, "--questions", "--more", "20").out for _ in range(2))
    assert first != second


def test_a_difference_is_shown_byte_by_byte() -> None:
    status, out, err = tried(STUBBORN)
    assert (status, err) == (1, "")
    head, strip, answers, rows, kinds, verdict = out.split("\n\n")
    assert re.fullmatch(
        r"the first difference: ServoMove: .+\n"
        r"  shrunk in \d+ tries\n"
        r"  question: decode host_to_controller 55550207",
        head,
    )
    assert strip == "  byte   0   1   2   3\n        55  55  02  07"
    assert answers == (
        "  reference     0  message ActionGroupStop 55550207\n"
        "  program          refused too-short 3"
    )
    assert rows == (
        "  byte  hex    part     value  meaning\n"
        "     0  55 55  header          Two bytes that announce a frame\n"
        "     2  02     length   2      always 2\n"
        "     3  07     command  7      ActionGroupStop, CMD_ACTION_GROUP_STOP to the vendor"
    )
    assert re.match(
        r"\d+ answers differ, \d+ of them in a message; by what the reference says there:\n"
        r" +\d+  stream  ",
        kinds,
    )
    assert re.search(rf": differs from {re.escape(EDITION)} in \d+ of \d+ answers\n$", verdict)


def test_it_is_in_colour_on_a_terminal_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    plain = tried(STUBBORN).out
    with mock.patch("framegen.conformance.questions.questions", some_questions):
        status, shown, _ = conform(SPEC, *python(STUBBORN), screen="xterm")
    assert status == 1
    assert "\x1b" not in plain
    assert "\x1b[32m  reference     0  message ActionGroupStop 55550207\x1b[0m\n" in shown
    assert "\x1b[31m  program          refused too-short 3\x1b[0m\n" in shown
    assert re.sub(r"\x1b\[\d+m", "", shown) == plain


def test_what_a_program_prints_does_not_command_the_terminal() -> None:
    rude = "import sys\nfor line in sys.stdin: print('\\x1b[2J', 'end', sep='\\n', flush=True)"
    status, out, _ = tried(rude)
    assert status == 1
    assert "\x1b" not in out
    assert "  program          \\x1b[2J\n" in out
    assert "  `\\x1b[2J` is no line of an answer\n" in out


def test_json_holds_everything() -> None:
    status, out, _ = tried(STUBBORN, *AS_JSON)
    report: dict[str, Any] = json.loads(out)
    assert status == 1
    assert {**report, "smallest": None, "differences": []} == {
        "protocol": "busservo",
        "version": EDITION.split()[1],
        "program": python(STUBBORN)[1:],
        "conforms": False,
        "questions": report["agreed"] + report["differed"],
        "agreed": report["agreed"],
        "differed": len(report["differences"]),
        "unsupported": {"decode": 0, "encode": 0, "stream": 0},
        "seed": 7,
        "stopped": "",
        "smallest": None,
        "differences": [],
    }
    assert report["smallest"] == {
        "title": report["differences"][0]["title"],
        "verb": "decode",
        "about": "message ActionGroupStop",
        "question": "decode host_to_controller 55550207",
        "expected": ["message ActionGroupStop 55550207"],
        "answered": ["refused too-short 3"],
        "failure": "",
        "tries": report["smallest"]["tries"],
        "alone": True,
        "behind": "",
        "stderr": "",
    }
    assert {found["verb"] for found in report["differences"]} == {"decode", "encode", "stream"}
    assert report["agreed"] > 0


def test_what_is_unsupported_is_reported_and_no_difference() -> None:
    status, out, _ = tried(LIMITED)
    assert status == 0
    assert re.search(r"\n  not supported, and not counted as wrong: \d+ stream\n$", out)


SVG = "{http://www.w3.org/2000/svg}"


@in_turn(
    "source, status, text",
    lambda: [
        ("from busservo.__main__ import main; main(['answer'])", 0, "conforms"),
        (LIMITED, 0, r"conforms, \d+ stream not supported"),
        (STUBBORN, 1, r"\d+ of \d+"),
        ("raise SystemExit(1)", 1, "0 of 1"),
    ],
)
def test_a_badge_says_it_in_a_word(source: str, status: int, text: str) -> None:
    code, out, _ = tried(source, "--format", "badge")
    assert code == status
    picture = ET.fromstring(out)  # noqa: S314 - our own
    label, said = [element.text or "" for element in picture.iter(f"{SVG}text")]
    assert label == EDITION
    assert re.fullmatch(text, said)
    assert picture.findtext(f"{SVG}title") == picture.get("aria-label") == f"{label}: {said}"
    assert picture.get("role") == "img"
    # It asks nobody for anything: of addresses, it has the name of its language alone.
    assert re.findall(r"\w+://[^\"]*", out) == ["http://www.w3.org/2000/svg"]
    assert not re.search("href|@import|url", out)


UNUSABLE = {
    "no program": ([SPEC], "no program is named"),
    "nothing behind the dashes": ([SPEC, "--"], "no program is named"),
    "no such program": ([SPEC, "--", "no-such-codec"], "`no-such-codec` cannot be started: "),
    "a program that gets no question": (
        [SPEC, "--answers", "--", "codec"],
        "no program is tested with --answers",
    ),
    "questions and answers": ([SPEC, "--answers", "--questions"], "argument --questions: "),
    "no spec": (["no-such.yaml", "--", "codec"], "no-such.yaml does not exist"),
    "no number": ([SPEC, "--more", "many", "--", "codec"], "'many' is not a whole number from 0"),
    "no seed": ([SPEC, "--more", "1", "--seed", "-1", "--", "codec"], "argument --seed: "),
    "no time": ([SPEC, "--timeout", "0", "--", "codec"], "'0' is not a number of seconds, up to"),
    "no such time": ([SPEC, "--timeout", "nan", "--", "codec"], "'nan' is not a number of seconds"),
    "no format": ([SPEC, "--format", "png", "--", "codec"], "argument --format: invalid choice"),
}  # fmt: skip


@in_turn("words, error", lambda: [pytest.param(*row, id=name) for name, row in UNUSABLE.items()])
def test_unusable_arguments_are_refused_with_advice(words: list[str], error: str) -> None:
    status, out, err = conform(*words)
    assert (status, out) == (2, "")
    assert err.startswith("framegen: error: ")
    assert error in err.splitlines()[0]
    assert err.splitlines()[1].startswith("  hint: ")


def test_words_behind_the_dashes_belong_to_the_program() -> None:
    source = "import sys; print(sys.argv[1:], file=sys.stderr)"
    _, out, _ = conform(SPEC, *python(source), "--help", "--more", "1", "--", "x")
    assert "    ['--help', '--more', '1', '--', 'x']\n" in out


GUIDE = (ROOT / "docs" / "conformance.md").read_text(encoding="utf-8")


def shown(command: str) -> list[str]:
    """Return the output that the guide shows for a command, in pieces between omitted lines."""
    (block,) = re.findall(rf"```text\n\$ {re.escape(command)}\n(.*?)```", GUIDE, flags=re.DOTALL)
    return re.split(r"^\.\.\.\n", block, flags=re.MULTILINE)


@needs_compiler
def test_the_guide_shows_what_a_wrong_codec_gets(tmp_path: Path) -> None:
    wrong = WRONG["the count is not held against the length"]
    program = compile_codec(tmp_path, wrong.old, wrong.new)
    known = tmp_path / "busservo.yaml"
    known.write_text(json.dumps(first_edition()), encoding="utf-8")
    status, out, _ = conform(str(known), "--", program)
    assert status == 1
    pieces = shown("framegen conform busservo -- ./codec")
    assert re.fullmatch(r"(?:.*\n)*".join(map(re.escape, pieces)), out), out


def test_the_guide_shows_what_the_reference_answers() -> None:
    (block,) = shown("framegen conform busservo --answers")
    asked = re.findall(r"^(?:decode|encode|stream) .*\n", block, flags=re.MULTILINE)
    status, answers, _ = conform(SPEC, "--answers", given="".join(asked))
    session = zip(asked, re.findall(r"(?:.*\n)*?end\n", answers), strict=True)
    assert "".join(question + answer for question, answer in session) == block
    assert status == 0


def test_the_guide_names_every_key_of_the_report() -> None:
    _, out, _ = tried(STUBBORN, *AS_JSON)
    report: dict[str, Any] = json.loads(out)
    keys = {*report, *report["smallest"], *report["differences"][0]}
    assert sorted(key for key in keys if f"`{key}`" not in GUIDE) == []
