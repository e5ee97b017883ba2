"""`framegen diff`: what it prints, and the exit code that it gives to what breaks."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest
from framegen.cli import main
from framegen.commands import diff
from framegen.comparison.report import FORMATS
from framegen.comparison.report.verdict import AXES, FAILURES, USUAL_FAILURES
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from tests.factories import DEMO, ROOT, Data, write_files, yaml_of
from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.mutations.edits import SPECS
from tests.mutations.places import renamed, with_
from tests.repository import commit, start

Capture: TypeAlias = pytest.CaptureFixture[str]
Writes: TypeAlias = Callable[..., list[str]]

LAMP = (ROOT / "tests" / "specs" / "lamp.yaml").read_text(encoding="utf-8")
HOUSE = SPECS["greenhouse"]
READ = ("messages", "StationRead")
# Without the examples, which show the frames of before.
BARE = with_(HOUSE, *READ, "examples", [])
NUMBERED = with_(BARE, *READ, "id", 0x20)
RENAMED = renamed(HOUSE, "VentJammed", "VentStuck")
TOLD = with_(RENAMED, "messages", "VentStuck", "was", "VentJammed")
WORDED = with_(HOUSE, "protocol", "summary", "Frames.")


def accepting(data: Data, version: str, **breaks: str) -> Data:
    """Return a spec of another version, whose history accepts breaks."""
    entry = {
        "version": version,
        "changes": ["It was changed."],
        "breaks": {path.replace("__", "."): reason for path, reason in breaks.items()},
    }
    changed = with_(data, "protocol", "version", version)
    return {**changed, "history": [entry, *data.get("history", [])]}


ACCEPTED = accepting(NUMBERED, "2.0.0", messages__StationRead="No station has it.")


@pytest.fixture
def written(tmp_path: Path) -> Writes:
    """Return a function that writes specs into files, and returns their names."""

    def write(*specs: Data) -> list[str]:
        texts = {f"{number}.yaml": yaml_of(data) for number, data in enumerate(specs)}
        write_files(texts, tmp_path)
        return [(tmp_path / name).as_posix() for name in texts]

    return write


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with two specs, which is the current folder, tagged v1."""
    start(tmp_path)
    commit(tmp_path, {"spec/a.yaml": yaml_of(BARE), "spec/b.yaml": LAMP}, "v1")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@in_turn(
    "old, new, fail_on, code",
    lambda: [
        (HOUSE, dict(HOUSE), [], 0),
        (BARE, NUMBERED, [], 1),
        (BARE, NUMBERED, ["uncertain", "wire"], 1),
        (BARE, NUMBERED, ["version"], 4),
        (BARE, NUMBERED, ["never"], 0),
        (BARE, ACCEPTED, ["wire,conversation,uncertain,version"], 0),
        (HOUSE, RENAMED, ["wire,uncertain"], 3),
        (HOUSE, TOLD, ["uncertain"], 0),
    ],
)
def test_the_exit_code_says_what_breaks(
    written: Writes, capsys: Capture, old: Data, new: Data, fail_on: list[str], code: int
) -> None:
    options = [f"--fail-on={word}" for word in fail_on]
    assert main(["diff", *written(old, new), *options]) == code
    assert capsys.readouterr().err == ""


@in_turn(
    "words, said",
    lambda: [
        (["--fail-on", "weather"], "'weather' is none of wire, conversation, programs, uncertain"),
        (["--fail-on", "wire,"], "'' is none of wire"),
        (["--fail-on", "never,wire"], "`--fail-on never` and wire exclude each other"),
        (["--format", "html"], "invalid choice: 'html'"),
        (["--json"], "unrecognized arguments: --json"),
    ],
)
def test_options_without_meaning_are_refused(words: list[str], said: str, capsys: Capture) -> None:
    assert main(["diff", DEMO.as_posix(), *words]) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert printed.out == ""


def test_the_command_knows_the_formats_and_the_axes_of_the_comparison() -> None:
    assert [*diff.FORMATS] == [*FORMATS]
    assert [*diff.FAILURES] == [*FAILURES]
    assert diff.FAILURES[: len(AXES)] == AXES
    assert {*diff.USUAL} == USUAL_FAILURES


def test_the_text_has_a_verdict_and_a_frame_of_each_break(written: Writes, capsys: Capture) -> None:
    old, new = written(BARE, NUMBERED)
    main(["diff", old, new, "--fail-on", "never"])
    shown = capsys.readouterr().out
    assert shown.startswith(f"greenhouse: {old} (1.1.0) -> {new} (1.1.0)\n")
    lines = [" ".join(line.split()) for line in shown.splitlines()]
    # That a message has no example is what rules dislike today.
    assert f"note: {old} has 1 finding by today's rules, and is compared all the same" in lines
    assert f"note: {new} is not right yet: `framegen check` shows 1 finding" in lines
    assert "wire old gateway with new station: breaks: 1 refused" in lines
    assert "new gateway with old station: breaks: 1 refused" in lines
    assert "upgrade both ends at once: each breaks with the old edition of the other" in lines
    assert (
        "version something breaks since 1.1.0, and the version is still that: 2.0.0 is due" in lines
    )
    at = lines.index("StationRead")
    (sent,) = (n for n, line in enumerate(lines) if "wire, old gateway -> new station" in line)
    assert at < sent
    assert lines[sent + 1 : sent + 3] == ["C3 5A A5 11 00 00", "StationRead()"]
    # The same frame shows what becomes of the conversation.
    assert lines.count("C3 5A A5 11 00 00") == 1


def test_what_is_accepted_is_shown_with_its_reason(written: Writes, capsys: Capture) -> None:
    wide = accepting(NUMBERED, "2.0.0", messages__StationRead="Gone.", messages__TextShow="Old.")
    main(["diff", *written(BARE, wide), "--fail-on", "never"])
    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert "wire old gateway with new station: breaks on purpose: 1" in lines
    assert lines.count("accepted: Gone.") >= 2
    assert "note: version 2.0.0 accepts what breaks nothing: messages.TextShow" in lines


def test_two_protocols_with_nothing_in_common_are_not_compared(capsys: Capture) -> None:
    lamp, blinds = (f"tests/specs/{name}.yaml" for name in ("lamp", "blinds"))
    assert main(["diff", str(ROOT / lamp), str(ROOT / blinds)]) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith("framegen: error: a comparison of nothing: ")
    assert "no message in common" in printed.err
    assert printed.out == ""


def test_every_spec_of_a_project_is_compared_and_the_worst_gives_the_exit_code(
    project: Path, capsys: Capture
) -> None:
    texts = {"spec/a.yaml": yaml_of(NUMBERED), "spec/c.yaml": yaml_of(SPECS["modbus"])}
    write_files(texts, project)
    assert main(["diff", "v1", "--format", "json"]) == 1
    printed = capsys.readouterr()
    reports = [json.loads(line) for line in printed.out.splitlines()]
    assert [each["protocol"] for each in reports] == ["greenhouse", "stage_lamp"]
    assert [bool(each["effects"]) for each in reports] == [True, False]
    assert reports[0]["old"]["edition"] == "v1:spec/a.yaml"
    assert printed.err == "not compared: spec/c.yaml is not in `v1`\n"


GONE = "spec/a.yaml is gone: everything of greenhouse breaks"


@in_turn(
    "form, said",
    lambda: [
        ("text", f"greenhouse: v1:spec/a.yaml (1.1.0) -> nothing\n\n  {GONE}\n"),
        ("markdown", f"**{GONE}**"),
        ("github", f"::error file=spec/a.yaml,title=greenhouse::{GONE}\n## greenhouse"),
        ("json", f'"text": "{GONE}"'),
    ],
)
def test_a_spec_that_is_gone_breaks_in_every_format(
    project: Path, capsys: Capture, form: str, said: str
) -> None:
    (project / "spec" / "a.yaml").unlink(missing_ok=True)
    codes = {"wire": 1, "programs,version": 1, "conversation,uncertain,version": 0, "never": 0}
    for fail_on, code in codes.items():
        assert main(["diff", "v1", f"--format={form}", "--fail-on", fail_on]) == code
        assert said in capsys.readouterr().out
    assert main(["diff"]) == 1


def test_json_of_what_is_gone_has_the_keys_of_every_report(project: Path, capsys: Capture) -> None:
    (project / "spec" / "a.yaml").unlink()
    (project / "spec" / "b.yaml").rename(project / "spec" / "c.yaml")
    main(["diff", "--format", "json"])
    kept, gone = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    assert gone.keys() == kept.keys()
    assert kept["old"]["edition"] == "HEAD:spec/b.yaml"
    assert gone["new"] is None
    assert gone["old"] == {"edition": "HEAD:spec/a.yaml", "version": "1.1.0", "findings": None}
    effects = [(each["axis"], each["standing"]) for each in gone["effects"]]
    assert effects == [("wire", "breaks"), ("programs", "breaks")]


def test_a_spec_that_contradicts_itself_much_is_an_error(written: Writes, capsys: Capture) -> None:
    old, new = written(HOUSE, with_(HOUSE, *READ, "reply", "Nobody"))
    assert main(["diff", old, new]) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith(f"framegen: error: {new} contradicts itself too much")
    assert "there is no message `Nobody`" in printed.err


TEXT = yaml_of(WORDED)


@st.composite
def damaged(draw: st.DrawFn) -> bytes:
    """Return a spec of which a piece is missing, doubled or another."""
    start = draw(st.integers(0, len(TEXT)))
    end = draw(st.integers(start, min(len(TEXT), start + 40)))
    piece = draw(st.sampled_from(["", TEXT[start:end] * 2, "0", "null", "99999999999", "[]", '"']))
    return f"{TEXT[:start]}{piece}{TEXT[end:]}".encode()


@given(st.one_of(st.binary(max_size=64), damaged()))
@example(b"")
@example(b"\x00")
@example(b"framegen: 2\n")
@example(b"framegen: 99\n")
@settings(few_each, suppress_health_check=[*HealthCheck])
def test_whatever_is_given_is_compared_or_refused_in_words(
    tmp_path_factory: pytest.TempPathFactory, capsys: Capture, data: bytes
) -> None:
    file = tmp_path_factory.getbasetemp() / "hostile.yaml"
    file.write_bytes(data)
    code = main(["diff", file.as_posix(), DEMO.as_posix()])
    printed = capsys.readouterr()
    assert "Traceback" not in printed.err
    if code == 2:
        assert printed.err.startswith("framegen: error: ")
        assert printed.out == ""
    else:
        assert code in {0, 1, 3}
        assert printed.out.startswith("greenhouse: ")
