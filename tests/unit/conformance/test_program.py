"""A program under test: whatever it does instead of answering is reported, and blocks nothing."""

import os
import sys
import textwrap
import time
from contextlib import closing
from pathlib import Path

import pytest
from framegen.conformance import program as module
from framegen.conformance.program import Program, Reply
from framegen.reading.yamltree import Unusable

from tests.in_turn import in_turn
from tests.timeouts import GENEROUS, await_that

SOON = 0.3
SILENT = (
    "no `end` came within 0.1 s, before it printed a line; "
    "does it flush its output behind each `end`?"
)


def python(source: str, timeout: float = GENEROUS) -> Program:
    return Program([sys.executable, "-c", textwrap.dedent(source)], timeout)


def replies_to(source: str, *questions: str, timeout: float = GENEROUS) -> list[Reply]:
    with closing(python(source, timeout)) as program:
        return [program.ask(question) for question in questions]


def test_a_program_is_started_once_and_questioned_line_by_line() -> None:
    source = """
        import os, sys
        for line in sys.stdin:
            print(os.getpid(), line.strip(), "end", sep="\\n", flush=True)
    """
    one, other = replies_to(source, "decode a 55", "decode b 66")
    assert [one.lines[1], other.lines[1]] == ["decode a 55", "decode b 66"]
    assert one.lines[0] == other.lines[0]


@pytest.mark.parametrize(
    ("printed", "line"),
    [(r"frame 55\r\nend\r\n", "frame 55"), (r"\xff\x00end\nend\n", "\\xff\x00end")],
    ids=["lines end as on Windows", "bytes that are no text are escaped"],
)
def test_a_line_is_text(printed: str, line: str) -> None:
    source = f"""
        import sys
        for line in sys.stdin:
            sys.stdout.buffer.write(b"{printed}"); sys.stdout.flush()
    """
    assert replies_to(source, "encode A") == [Reply((line,))]


@in_turn(
    "source, failure",
    lambda: [
        ("", "it ended with status 0 before it printed a line"),
        ("raise SystemExit(3)", "it ended with status 3 before it printed a line"),
        ("input(); print('frame 55', flush=True)", "it ended with status 0 after 1 line"),
    ],
)
def test_a_program_that_ends_is_reported(source: str, failure: str) -> None:
    (reply,) = replies_to(source, "decode a 55")
    assert (reply.failure, reply.hangs) == (failure, False)


@pytest.mark.skipif(sys.platform == "win32", reason="there are no signals")
def test_a_program_that_a_signal_ends_is_reported() -> None:
    (reply,) = replies_to(
        "import os, signal; input(); os.kill(os.getpid(), signal.SIGSEGV)", "decode a"
    )
    assert reply.failure == "it was ended by SIGSEGV before it printed a line"


@pytest.mark.parametrize(
    ("line", "hangs", "failure"),
    [
        ("", "time.sleep(600)", SILENT),
        ("unknown 55", "time.sleep(600)", "no `end` came within 0.1 s, after 1 line"),
        ("", "while True: print(55, end='', flush=True); time.sleep(0.01)", SILENT),
    ],
    ids=["silent", "after a line", "a line that goes on"],
)
def test_a_program_that_hangs_is_reported(line: str, hangs: str, failure: str) -> None:
    # The line is there already when the second question is asked, on however slow a machine.
    source = f"""
        import time
        input(); print("end", *{line.splitlines()}, sep="\\n", flush=True)
        input()
        {hangs}
    """
    with closing(python(source)) as program:
        assert program.ask("decode a 55") == Reply(())
        reply = program.ask("decode a 55", timeout=0.1)
    assert (reply.failure, reply.hangs) == (failure, True)


@pytest.mark.parametrize("prints", ["unknown 55\\n", "55"], ids=["lines", "one line"])
def test_a_program_that_prints_without_end_is_reported(prints: str) -> None:
    source = f"import sys\nwhile True: sys.stdout.write('{prints}' * 1000)"
    (reply,) = replies_to(source, "decode a 55")
    assert reply.failure == "it prints on and on: 100660 bytes without an `end`"
    assert sum(map(len, reply.lines)) < 200_000


def test_a_program_that_floods_its_error_stream_still_gets_questions() -> None:
    source = """
        import sys
        for line in sys.stdin:
            sys.stderr.write("debug " * 100_000)
            print("refused", "end", sep="\\n", flush=True)
    """
    assert replies_to(source, "encode A", "encode B") == [Reply(("refused",))] * 2


def test_a_program_that_reads_nothing_holds_up_nobody() -> None:
    (reply,) = replies_to(
        "import time; time.sleep(600)", "decode a " + "55" * 500_000, timeout=SOON
    )
    assert reply.hangs


def test_a_long_question_and_a_long_answer_pass_each_other() -> None:
    source = """
        import sys
        for line in sys.stdin:
            for _ in range(100_000):
                print("noise bad-header 00")
            print("end", flush=True)
    """
    (reply,) = replies_to(source, "decode a " + "00" * 100_000)
    assert (len(reply.lines), reply.failure) == (100_000, "")


def test_a_program_that_failed_is_started_anew() -> None:
    source = "print(input(), 'end', sep='\\n', flush=True); input()"
    one, other, third = replies_to(source, "encode A", "encode B", "encode C")
    assert one == Reply(("encode A",))
    assert other.failure == "it ended with status 0 before it printed a line"
    assert third == Reply(("encode C",))


def test_the_end_of_the_error_stream_is_kept() -> None:
    with closing(python("import sys; sys.exit('no such ' + 'x' * 5000 + ' table')")) as program:
        program.ask("encode A")
        assert program.last_words.endswith("xxx table")
        assert len(program.last_words) <= 2_000


@pytest.mark.skipif(sys.platform == "win32", reason="asks by signal whether a process is there")
def test_the_children_of_a_program_end_with_it() -> None:
    source = """
        import subprocess, sys, time
        input()
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
        print(child.pid, "end", sep="\\n", flush=True)
        time.sleep(600)
    """
    with closing(python(source)) as program:
        (child,) = program.ask("encode A").lines
        assert program.ask("encode A", timeout=0.1).hangs
    await_that(lambda: not is_running(int(child)))


def is_running(process: int) -> bool:
    """Return whether there is such a process; one that has ended and was not waited for is none."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    status = Path(f"/proc/{process}/stat")
    return not (status.exists() and status.read_text().rpartition(")")[2].split()[0] == "Z")


def test_it_may_end_by_itself_when_no_question_comes_any_more(tmp_path: Path) -> None:
    note = tmp_path / "note"
    source = f"""
        import sys
        for line in sys.stdin:
            print("end", flush=True)
        open({str(note)!r}, "w").write("done")
    """
    assert replies_to(source, "encode A") == [Reply(())]
    assert note.read_text() == "done"


def test_a_program_that_does_not_end_is_killed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_ENDING", 0.1)
    source = """
        import sys, time
        for line in sys.stdin:
            print("end", flush=True)
        time.sleep(600)
    """
    before = time.monotonic()
    assert replies_to(source, "encode A") == [Reply(())]
    assert time.monotonic() - before < GENEROUS


@pytest.mark.parametrize("command", ["no-such-program", "", "a\0b", "."])
def test_a_program_that_cannot_be_started_is_a_usage_error(command: str) -> None:
    with pytest.raises(Unusable, match=f"`{command or ''}` cannot be started") as caught:
        Program([command], timeout=1).ask("encode A")
    assert caught.value.hint == "name a program that is on the path, or give its path, like ./codec"
