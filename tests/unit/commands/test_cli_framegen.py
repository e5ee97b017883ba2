"""The framegen command: its verbs, its exit codes, and plain words instead of tracebacks."""

import contextlib
import io
import json
import sys
from pathlib import Path
from typing import TypeAlias

import pytest
from framegen import __version__
from framegen.checks import RULES
from framegen.checks.rule import AnyRule
from framegen.cli import VERBS, main
from framegen.language.spec import Spec
from framegen.project import default_spec, project_root
from framegen.reading.yamltree import Unusable
from framegen.render import render, render_shared
from framewire.command.console import INTERRUPTED, READER_GONE
from hypothesis import given
from hypothesis import strategies as st

from tests.bad_specs import bad_spec
from tests.factories import BUSSERVO, DEMO, compiled_of, data_of, write_files
from tests.in_turn import in_turn
from tests.mutations.spec_edits import edited
from tests.programs import ran

Capture: TypeAlias = "pytest.CaptureFixture[str]"

ROOT = Path(__file__).parents[3]
SPEC = ROOT / "spec" / "busservo.yaml"
STOP = "55 55 02 07"


@pytest.fixture(autouse=True)
def _in_the_project(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@pytest.fixture
def misspelt(tmp_path: Path) -> Path:
    """Return a spec with one type that does not exist, on a known line."""
    file = tmp_path / "misspelt.yaml"
    text = SPEC.read_text(encoding="utf-8")
    file.write_text(text.replace("type: u16\n", "type: v16\n", 1), encoding="utf-8")
    return file


def line_of(file: Path, text: str) -> int:
    """Return the number of the first line that holds `text`."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return next(number for number, line in enumerate(lines, 1) if text in line)


def process(*words: str, **environment: str) -> tuple[int, str, str]:
    """Return the exit code and both outputs of a real process."""
    done = ran(sys.executable, *words, status=None, environment=environment)
    return done.returncode, done.stdout, done.stderr


# ---------------------------------------------------------------------------- exit codes

EXIT_CODES = [
    (["--version"], 0),
    (["--help"], 0),
    (["check", "spec/busservo.yaml"], 0),
    (["check", "--help"], 0),
    (["check", "--json"], 0),
    (["explain", "busservo", STOP], 0),
    (["explain", "--help"], 0),
    (["explain", "--json", "busservo", STOP], 0),
    (["rules"], 0),
    (["rules", "unknown-type"], 0),
    (["schema"], 0),
    (["explain", "busservo", "55 55 02 08"], 1),
    (["explain", "--json", "busservo", "55 55 02 08"], 1),
    ([], 2),
    (["chekc"], 2),
    (["--nonsense"], 2),
    (["check", "--nonsense"], 2),
    (["check", "missing.yaml"], 2),
    (["check", "spec"], 2),
    (["check", ""], 2),
    (["check", "a\0b"], 2),
    (["explain"], 2),
    (["explain", ""], 2),
    (["explain", "5"], 2),
    (["explain", "spec/busservo.yaml"], 2),
    (["explain", "missing.yaml", STOP], 2),
    (["explain", "busservo", "--direction", "nobody", STOP], 2),
    (["guess"], 2),
    (["guess", "missing.bin"], 2),
    (["guess", "spec"], 2),
    (["release", "missing.yaml"], 2),
    (["release", "busservo", "--version", "one"], 2),
    (["rules", "no-such-rule"], 2),
    (["rules", "two", "rules"], 2),
    (["schema", "superfluous"], 2),
]


@in_turn("words, code", lambda: EXIT_CODES)
def test_exit_code(words: list[str], code: int, capsys: Capture) -> None:
    assert main(words) == code
    printed = capsys.readouterr()
    assert "Traceback" not in printed.err
    if code == 2 and words:
        assert printed.err.startswith("framegen: error: ")
        assert printed.out == ""


def test_main_reads_the_command_line_of_the_process(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.setattr(sys, "argv", ["framegen", "--version"])
    assert main() == 0
    assert capsys.readouterr().out == f"framegen {__version__}\n"


# ---------------------------------------------------------------------------- help


def test_help_lists_every_verb_and_an_example_of_each(capsys: Capture) -> None:
    assert main(["--help"]) == 0
    shown = capsys.readouterr().out
    listed = shown.split("\nverbs:\n")[1].split("\n\n")[0].splitlines()
    assert [line.split()[0] for line in listed] == list(VERBS)
    for verb in VERBS:
        assert f"\n  framegen {verb}" in shown


def test_without_a_verb_the_help_goes_to_the_error_stream(capsys: Capture) -> None:
    assert main([]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "\nverbs:\n" in printed.err


@in_turn("verb", lambda: VERBS)
def test_help_of_a_verb_teaches_by_example(verb: str, capsys: Capture) -> None:
    assert main([verb, "--help"]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith(f"usage: framegen {verb} ")
    assert f"\nexamples:\n  framegen {verb}" in shown


@pytest.mark.parametrize("words", [["--help"], ["generate", "--help"]])
def test_help_says_what_is_written_where(words: list[str], capsys: Capture) -> None:
    assert main(words) == 0
    table = capsys.readouterr().out.partition("`framegen generate` writes:\n")[2]
    listed = [line.split()[0] for line in table.partition("\n\n")[0].splitlines()]
    compiled = compiled_of(data_of(DEMO))
    for output in (render(compiled), render_shared(compiled)):
        for path in (output.manifest, *output.files):
            place = path.replace("greenhouse", "NAME")
            assert any(place.startswith(each) for each in [*listed, "spec/framegen.manifest"]), path
    assert "folder that holds spec/, or for a spec that lies elsewhere below its own\n" in table


def test_a_mistyped_verb_gets_a_suggestion(capsys: Capture) -> None:
    assert main(["expalin", STOP]) == 2
    assert capsys.readouterr().err == (
        "framegen: error: there is no verb `expalin`\n  hint: did you mean `explain`?\n"
    )


# ---------------------------------------------------------------------------- check


def test_check_says_what_it_looked_at(capsys: Capture) -> None:
    assert main(["check"]) == 0
    printed = capsys.readouterr()
    assert printed.out == ""
    data = data_of(BUSSERVO)
    messages, errata = len(data["messages"]), len(data["errata"])
    examples = sum(len(message["examples"]) for message in data["messages"].values())
    assert printed.err == (
        f"spec/busservo.yaml: {messages} messages, {examples} examples, {errata} errata checked: "
        "nothing found\n"
        "spec/lxservo.yaml: 42 messages, 70 examples, 0 errata checked: nothing found\n"
    )


def test_check_shows_a_finding_at_its_place(misspelt: Path, capsys: Capture) -> None:
    assert main(["check", str(misspelt)]) == 1
    printed = capsys.readouterr()
    line = line_of(misspelt, "v16")
    assert printed.out == (
        f"{misspelt.as_posix()}:{line}:15: unknown-type: unknown type `v16`\n"
        f"{line} |         type: v16\n"
        f"{' ' * len(str(line))} |               ^^^\n"
        f"{' ' * len(str(line))} = at: messages.ServoMove.fields.time_ms.type\n"
        f"{' ' * len(str(line))} = hint: did you mean `u16`?\n\n"
    )
    assert printed.err == f"1 finding in {misspelt.as_posix()}\n"


def test_check_gives_findings_as_lines_of_json(misspelt: Path, capsys: Capture) -> None:
    assert main(["check", "--json", str(misspelt)]) == 1
    assert [json.loads(line) for line in capsys.readouterr().out.splitlines()] == [
        {
            "severity": "error",
            "rule": "unknown-type",
            "file": misspelt.as_posix(),
            "line": line_of(misspelt, "v16"),
            "column": 15,
            "path": "messages.ServoMove.fields.time_ms.type",
            "message": "unknown type `v16`",
            "hint": "did you mean `u16`?",
        }
    ]


SLOW = "bytes that only look like the beginning of Note can hold back 51 bytes behind them"


def remarked(tmp_path: Path) -> Path:
    """Return a spec without findings, of which there is a remark."""
    file = tmp_path / "slow.yaml"
    text = bad_spec("long-wait-of-text").source.text
    file.write_text(text, encoding="utf-8")
    return file


def test_check_shows_remarks_that_are_no_findings(tmp_path: Path, capsys: Capture) -> None:
    file = remarked(tmp_path)
    assert main(["check", str(file)]) == 0
    printed = capsys.readouterr()
    place = f"{file.as_posix()}:{line_of(file, 'words:')}:7"
    assert printed.out == ""
    assert printed.err.splitlines() == [
        f"{place}: note: long-wait: {SLOW}, 1.7 s at 300 baud",
        "  = hint: if there are never so many, bound them, such as by `count: 0..19`",
        f"{file.as_posix()}: 5 messages, 5 examples, 0 errata checked: nothing found",
    ]


def test_check_gives_remarks_as_lines_of_json(tmp_path: Path, capsys: Capture) -> None:
    assert main(["check", "--json", str(remarked(tmp_path))]) == 0
    [line] = map(json.loads, capsys.readouterr().out.splitlines())
    assert (line["severity"], line["rule"]) == ("note", "long-wait")


def test_check_shows_few_remarks_of_one_rule(tmp_path: Path, capsys: Capture) -> None:
    text = bad_spec("unshown-value-name").source.text
    values = ", ".join(f"lit_{value}: {{value: {value}, about: Lit.}}" for value in range(1, 6))
    file = tmp_path / "many.yaml"
    file.write_text(text.replace("values: {dark", f"values: {{{values}, dark"), encoding="utf-8")
    assert main(["check", str(file)]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert sum(": note: unshown-value: " in line for line in lines) == 3
    assert lines[-2] == (
        "  = and 3 more of `unshown-value`: `framegen check --json` lists them all"
    )


def test_check_says_when_it_did_not_get_past_the_shape(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "shapeless.yaml"
    file.write_text(edited(SPEC.read_text(encoding="utf-8"), ("link:\n", "lnik:\n")))
    assert main(["check", str(file)]) == 1
    assert capsys.readouterr().err == (
        f"2 findings in {file.as_posix()}; "
        "check again once its shape is mended, for what it says was not looked at\n"
    )


def test_check_takes_several_specs(misspelt: Path, capsys: Capture) -> None:
    assert main(["check", "spec/busservo.yaml", str(misspelt)]) == 1
    clean, found = capsys.readouterr().err.splitlines()
    assert clean.startswith("spec/busservo.yaml: ")
    assert clean.endswith(" checked: nothing found")
    assert found == f"1 finding in {misspelt.as_posix()}"


def test_what_is_not_yaml_is_shown_at_its_place(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "broken.yaml"
    file.write_text("framegen: [1\nprotocol: 2\n")
    assert main(["check", str(file)]) == 2
    first, second, excerpt, caret, *_ = capsys.readouterr().err.splitlines()
    assert first == f"framegen: error: {file.as_posix()}: the file is not YAML"
    assert second.startswith(f"{file.as_posix()}:2:9: yaml-syntax: a comma or `]` is")
    assert (excerpt, caret) == ("2 | protocol: 2", "  |         ^")


def test_an_empty_spec_gets_a_hint(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "empty.yaml"
    file.write_text("")
    assert main(["check", str(file)]) == 2
    error, hint = capsys.readouterr().err.splitlines()
    assert error == (
        f"framegen: error: {file.as_posix()}: the file is empty, but a spec is a mapping of keys"
    )
    assert hint.startswith("  hint: begin with `framegen: 2`")


def test_a_spec_with_findings_explains_nothing(misspelt: Path, capsys: Capture) -> None:
    assert main(["explain", str(misspelt), STOP]) == 2
    lines = capsys.readouterr().err.splitlines()
    name = misspelt.as_posix()
    assert lines[0] == f"framegen: error: {name} has 1 finding; the first is"
    assert lines[1].endswith("unknown-type: unknown type `v16`")
    assert lines[-1] == f"  hint: `framegen check {name}` shows them all"


# ---------------------------------------------------------------------------- rules


def test_rules_lists_every_rule(capsys: Capture) -> None:
    assert main(["rules"]) == 0
    printed = capsys.readouterr()
    listed = [line.split(maxsplit=1) for line in printed.out.splitlines()]
    assert listed == [[rule.id, rule.title] for rule in RULES]
    assert printed.err.startswith("`framegen rules --changes` lists the kinds of changes")


def test_a_rule_says_why_and_shows_both_sides(capsys: Capture) -> None:
    assert main(["rules", "unknown-type"]) == 0
    assert capsys.readouterr().out == (
        "unknown-type: Every type is one that the language has\n"
        "\n"
        "A type that does not exist has no size, so no later field would have a place.\n"
        "\n"
        "refused:\n"
        "  time_ms: {type: v16}\n"
        "\n"
        "accepted:\n"
        "  time_ms: {type: u16}\n"
    )


@in_turn("rule", lambda: RULES)
def test_every_rule_can_be_looked_up(rule: AnyRule, capsys: Capture) -> None:
    assert main(["rules", rule.id]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith(f"{rule.id}: {rule.title}\n\n{rule.why.splitlines()[0]}\n")
    assert rule.bad.splitlines()[0] in shown
    assert rule.good.splitlines()[0] in shown


def test_an_unknown_rule_gets_a_suggestion(capsys: Capture) -> None:
    assert main(["rules", "unknown-tpye"]) == 2
    assert capsys.readouterr().err == (
        "framegen: error: there is no rule 'unknown-tpye'\n  hint: did you mean `unknown-type`?\n"
    )


# ---------------------------------------------------------------------------- the project


def project(folder: Path, *specs: str) -> Path:
    """Make a project with these specs, empty."""
    write_files({f"spec/{name}": "" for name in specs}, folder)
    return folder


def test_the_default_spec_is_the_only_one_here(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(project(tmp_path / "here", "one.yaml"))
    assert default_spec() == Path("spec/one.yaml")


def test_the_default_spec_is_found_from_below(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    below = project(tmp_path / "here", "one.yaml") / "docs" / "guides"
    below.mkdir(parents=True)
    monkeypatch.chdir(below)
    assert default_spec() == Path("../../spec/one.yaml")


def test_the_nearest_project_wins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inner = project(project(tmp_path / "outer", "outer.yaml") / "inner", "inner.yaml")
    monkeypatch.chdir(inner)
    assert default_spec() == Path("spec/inner.yaml")


def test_two_specs_leave_a_choice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.chdir(project(tmp_path / "here", "b.yaml", "a.yaml"))
    assert main(["conform", "--", "codec"]) == 2
    assert capsys.readouterr().err == (
        "framegen: error: there are 2 specs to choose from: a.yaml, b.yaml\n"
        "  hint: name the one you mean, such as `a`\n"
    )


def test_a_spec_of_several_is_found_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    here = project(tmp_path / "here", "b.yaml", "a.yaml")
    for name, spec in (("a", BUSSERVO), ("b", DEMO)):
        (here / "spec" / f"{name}.yaml").write_bytes(spec.read_bytes())
    monkeypatch.chdir(here)
    assert main(["explain", "a", "55 55 02 07"]) == 0
    assert capsys.readouterr().out.startswith("ActionGroupStop, ")
    assert main(["diff", "a", "b"]) == 2
    assert "spec/a.yaml is `busservo` and spec/b.yaml is `greenhouse`" in capsys.readouterr().err
    assert main(["diff", "a", "c"]) == 2
    assert capsys.readouterr().err.startswith("framegen: error: `c` is no file and no released ")


def test_without_a_spec_anywhere_the_error_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(Unusable, match=r"no spec is named, .* has spec/\*\.yaml") as caught:
        default_spec()
    assert caught.value.hint == "name a spec file, or run this where the project is"


@pytest.mark.parametrize(
    ("spec", "root"),
    [
        ("here/spec/one.yaml", "here"),
        ("here/one.yaml", "here"),
        ("one.yaml", "."),
        ("spec/one.yaml", "."),
        ("here/../spec/one.yaml", "."),
    ],
)
def test_the_project_root_is_above_the_spec_folder(
    spec: str, root: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path)
    assert project_root(Path(spec)) == (tmp_path / root).resolve()


def test_the_project_root_is_found_from_within_the_spec_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(project(tmp_path / "here", "one.yaml") / "spec")
    assert project_root(Path("one.yaml")) == (tmp_path / "here").resolve()


# ---------------------------------------------------------------------------- what goes wrong


def test_control_c_is_quiet(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    def interrupted(_arguments: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("framegen.commands.rules.run", interrupted)
    assert main(["rules"]) == INTERRUPTED
    assert capsys.readouterr() == ("", "")


def test_characters_missing_in_the_terminal_are_escaped() -> None:
    script = "import sys; from framegen.cli import main; sys.exit(main(['expl\\u00e4in']))"
    code, _, errors = process("-c", script, PYTHONIOENCODING="ascii:strict")
    assert code == 2
    assert errors.startswith(r"framegen: error: there is no verb `expl\xe4in`")


@pytest.mark.parametrize("package", ["yaml", "framewire.command"])
def test_a_missing_package_is_named_with_its_cure(package: str) -> None:
    script = (
        f"import sys; sys.modules['{package}'] = None\n"
        "sys.argv[1:] = ['check']\n"
        "from framegen.__main__ import main; sys.exit(main())"
    )
    name = package.partition(".")[0]
    assert process("-c", script) == (
        2,
        "",
        (
            f"framegen: error: the generator needs `{name}`, which is not installed\n"
            "  hint: in a clone of its repository: pip install . ./codegen\n"
        ),
    )


def test_what_runs_no_verb_imports_nothing_heavy() -> None:
    script = (
        "import sys\n"
        "from framegen.cli import main\n"
        "for words in (['--version'], ['--help'], ['chekc']):\n"
        "    main(words)\n"
        "    heavy = {'yaml', 'pydantic', 'jinja2', 'framegen.language.spec'} & set(sys.modules)\n"
        "    if heavy: sys.exit(f'{words} imported {heavy}')\n"
    )
    code, _, errors = process("-c", script)
    assert (code, errors.partition("imported")[2]) == (0, "")


def test_a_real_process_finds_and_explains() -> None:
    code, out, err = process("-m", "framegen", "explain", "busservo", "55", "55", "02", "07")
    assert (code, err) == (0, "")
    assert out.startswith("ActionGroupStop, host -> controller\n")


def test_a_spec_that_is_not_there_is_an_error_with_a_way_out(capsys: Capture) -> None:
    assert main(["check", "missing.yaml"]) == 2
    assert capsys.readouterr() == (
        "",
        (
            "framegen: error: missing.yaml does not exist\n"
            "  hint: name a spec file, or run this where spec/*.yaml is\n"
        ),
    )


# Nothing that writes files, and nothing that ends in .yaml and might be there.
WORDS = st.one_of(
    st.text(max_size=8),
    st.sampled_from(["--json", "--help", "-h", "--", "--direction", "host", "55", "0x", "."]),
)


@given(
    verb=st.sampled_from(["check", "explain", "rules", "schema"]),
    words=st.lists(WORDS, min_size=1, max_size=4),
)
def test_no_command_line_ends_in_a_traceback(verb: str, words: list[str]) -> None:
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main([verb, *words])
    assert code in (0, 1, 2)
    assert code != 2 or err.getvalue().startswith("framegen: error: ")


@given(words=st.lists(st.text(), min_size=1, max_size=3))
def test_no_wrong_verb_ends_in_a_traceback(words: list[str]) -> None:
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(words)
    assert code == 2 or {"-h", "--help", "--version"} & set(words)
    assert out.getvalue() or err.getvalue()


def test_a_python_without_docstrings_is_refused_before_it_drops_descriptions(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As it is with -OO, which tests/world/test_new_project.py starts."""
    monkeypatch.setattr(Spec, "__doc__", None)
    problem = "Python was started with -OO, and has no descriptions for the schema"
    for words in (["schema"], ["generate", "--check"]):
        assert main(words) == 2
        expected = f"framegen: error: {problem}\n  hint: start it without -OO\n"
        assert capsys.readouterr() == ("", expected)


def test_a_missing_module_of_its_own_is_not_taken_for_a_package(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "framegen.commands.check", None)
    with pytest.raises(ModuleNotFoundError, match=r"framegen\.commands\.check"):
        main(["check"])


def test_an_output_that_is_no_file_may_end_early(monkeypatch: pytest.MonkeyPatch) -> None:
    class Closed(io.StringIO):
        def write(self, _text: str) -> int:
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", Closed())
    assert main(["rules"]) == READER_GONE


@pytest.mark.skipif(sys.platform == "win32", reason="nobody removes a folder there that is in use")
def test_a_folder_that_is_gone_has_no_spec(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert main(["check"]) == 2
    assert capsys.readouterr().err == (
        "framegen: error: the current folder is gone\n  hint: name the spec in full\n"
    )
