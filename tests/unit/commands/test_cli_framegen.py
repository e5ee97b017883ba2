"""The framegen command: its verbs, its exit codes, and plain words instead of tracebacks."""

import io
import json
import sys
from functools import partial
from pathlib import Path

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
from tests.commands import called
from tests.factories import BUSSERVO, DEMO, ROOT, compiled_of, data_of, write_files
from tests.in_turn import in_turn
from tests.mutations.spec_edits import edited
from tests.programs import ran

TEXT = BUSSERVO.read_text(encoding="utf-8")
STOP = "55 55 02 07"
framegen = partial(called, main)


@pytest.fixture(autouse=True)
def _in_the_project(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


def spec_in(folder: Path, text: str) -> Path:
    """Write a spec, and return its file."""
    (folder / "made_up.yaml").write_text(text, encoding="utf-8")
    return folder / "made_up.yaml"


@pytest.fixture
def misspelt(tmp_path: Path) -> Path:
    """Return a spec with one type that does not exist, on a known line."""
    return spec_in(tmp_path, TEXT.replace("type: u16\n", "type: v16\n", 1))


def line_of(file: Path, text: str) -> int:
    """Return the number of the first line that holds `text`."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return next(number for number, line in enumerate(lines, 1) if text in line)


def process(*words: str, **environment: str) -> tuple[int, str, str]:
    """Return the exit code and both outputs of a real process."""
    done = ran(sys.executable, *words, status=None, environment=environment)
    return done.returncode, done.stdout, done.stderr


# ---------------------------------------------------------------------------- exit codes

EXIT_CODES = {
    0: "--version|--help|check spec/busservo.yaml|check --help|check --json|rules|schema"
    f"|rules unknown-type|explain --help|explain busservo {STOP}|explain --json busservo {STOP}",
    1: "explain busservo 55 55 02 08|explain --json busservo 55 55 02 08",
    2: "chekc|--nonsense|check --nonsense|check missing.yaml|check spec|check |check a\0b|explain"
    "|explain |explain 5|explain spec/busservo.yaml|explain missing.yaml 55 55 02 07|guess"
    f"|explain busservo --direction nobody {STOP}|guess missing.bin|guess spec"
    "|release missing.yaml|release busservo --version one|rules no-such-rule|rules two rules"
    "|schema superfluous",
}


@in_turn(
    "line, code",
    lambda: [(line, at) for at, lines in EXIT_CODES.items() for line in lines.split("|")],
)
def test_exit_code(line: str, code: int) -> None:
    status, out, err = framegen(*line.split(" "))
    assert status == code
    assert "Traceback" not in err
    if code == 2:
        assert err.startswith("framegen: error: ")
        assert out == ""


ERRORS = [
    ("expalin 55", "there is no verb `expalin`", "did you mean `explain`?"),
    ("rules unknown-tpye", "there is no rule 'unknown-tpye'", "did you mean `unknown-type`?"),
    (
        "check missing.yaml",
        "missing.yaml does not exist",
        "name a spec file, or run this where spec/*.yaml is",
    ),
]


@in_turn("line, error, hint", lambda: ERRORS)
def test_an_error_says_what_to_do(line: str, error: str, hint: str) -> None:
    said = f"framegen: error: {error}\n  hint: {hint}\n"
    assert framegen(*line.split()) == (2, "", said)


def test_main_reads_the_command_line_of_the_process() -> None:
    said = f"framegen {__version__}\n"
    assert process("-m", "framegen", "--version") == (0, said, "")


# ---------------------------------------------------------------------------- help


def test_help_lists_every_verb_and_an_example_of_each() -> None:
    shown = framegen("--help").out
    listed = shown.split("\nverbs:\n")[1].split("\n\n")[0].splitlines()
    assert [line.split()[0] for line in listed] == list(VERBS)
    for verb in VERBS:
        assert f"\n  framegen {verb}" in shown
    # Without a verb it is an error.
    assert framegen() == (2, "", shown)


@in_turn("verb", lambda: VERBS)
def test_help_of_a_verb_teaches_by_example(verb: str) -> None:
    status, shown, _ = framegen(verb, "--help")
    assert (status, shown.startswith(f"usage: framegen {verb} ")) == (0, True)
    assert f"\nexamples:\n  framegen {verb}" in shown


@in_turn("words", lambda: [["--help"], ["generate", "--help"]])
def test_help_says_what_is_written_where(words: list[str]) -> None:
    table = framegen(*words).out.partition("`framegen generate` writes:\n")[2]
    listed = [line.split()[0] for line in table.partition("\n\n")[0].splitlines()]
    compiled = compiled_of(data_of(DEMO))
    for output in (render(compiled), render_shared(compiled)):
        for path in (output.manifest, *output.files):
            place = path.replace("greenhouse", "NAME")
            assert any(place.startswith(each) for each in [*listed, "spec/framegen.manifest"]), path
    assert "folder that holds spec/, or for a spec that lies elsewhere below its own\n" in table


# ---------------------------------------------------------------------------- check


def test_check_says_what_it_looked_at() -> None:
    data = data_of(BUSSERVO)
    messages, errata = len(data["messages"]), len(data["errata"])
    examples = sum(len(message["examples"]) for message in data["messages"].values())
    counted = f"{messages} messages, {examples} examples, {errata} errata"
    said = f"spec/busservo.yaml: {counted} checked: nothing found\n"
    said += "spec/lxservo.yaml: 42 messages, 70 examples, 0 errata checked: nothing found\n"
    assert framegen("check") == (0, "", said)


def test_check_shows_a_finding_at_its_place(misspelt: Path) -> None:
    line = line_of(misspelt, "v16")
    left = " " * len(str(line))
    shown = (
        f"{misspelt.as_posix()}:{line}:15: unknown-type: unknown type `v16`\n"
        f"{line} |         type: v16\n"
        f"{left} |               ^^^\n"
        f"{left} = at: messages.ServoMove.fields.time_ms.type\n"
        f"{left} = hint: did you mean `u16`?\n\n"
    )
    found = f"1 finding in {misspelt.as_posix()}\n"
    assert framegen("check", str(misspelt)) == (1, shown, found)
    # What another spec has is not taken for it.
    status, out, err = framegen("check", "spec/lxservo.yaml", str(misspelt))
    assert (status, out) == (1, shown)
    assert err.startswith("spec/lxservo.yaml: 42 messages, ")
    assert err.endswith(f" checked: nothing found\n{found}")


def test_check_gives_findings_as_lines_of_json(misspelt: Path) -> None:
    status, out, _ = framegen("check", "--json", str(misspelt))
    assert (status, [json.loads(line) for line in out.splitlines()]) == (
        1,
        [
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
        ],
    )


SLOW = "bytes that only look like the beginning of Note can hold back 51 bytes behind them"


def test_check_shows_remarks_that_are_no_findings(tmp_path: Path) -> None:
    file = spec_in(tmp_path, bad_spec("long-wait-of-text").source.text)
    place = f"{file.as_posix()}:{line_of(file, 'words:')}:7"
    said = (
        f"{place}: note: long-wait: {SLOW}, 1.7 s at 300 baud\n"
        "  = hint: if there are never so many, bound them, such as by `count: 0..19`\n"
        f"{file.as_posix()}: 5 messages, 5 examples, 0 errata checked: nothing found\n"
    )
    assert framegen("check", str(file)) == (0, "", said)
    status, out, _ = framegen("check", "--json", str(file))
    [line] = map(json.loads, out.splitlines())
    assert (status, line["severity"], line["rule"]) == (0, "note", "long-wait")


def test_check_shows_few_remarks_of_one_rule(tmp_path: Path) -> None:
    text = bad_spec("unshown-value-name").source.text
    values = ", ".join(f"lit_{value}: {{value: {value}, about: Lit.}}" for value in range(1, 6))
    file = spec_in(tmp_path, text.replace("values: {dark", f"values: {{{values}, dark"))
    status, _, err = framegen("check", str(file))
    assert (status, err.count(": note: unshown-value: ")) == (0, 3)
    assert err.splitlines()[-2] == (
        "  = and 3 more of `unshown-value`: `framegen check --json` lists them all"
    )


def test_check_says_when_it_did_not_get_past_the_shape(tmp_path: Path) -> None:
    file = spec_in(tmp_path, edited(TEXT, ("link:\n", "lnik:\n")))
    status, _, err = framegen("check", str(file))
    again = "check again once its shape is mended, for what it says was not looked at"
    assert (status, err) == (1, f"2 findings in {file.as_posix()}; {again}\n")


def test_what_is_not_yaml_is_shown_at_its_place(tmp_path: Path) -> None:
    file = spec_in(tmp_path, "framegen: [1\nprotocol: 2\n")
    status, _, err = framegen("check", str(file))
    first, second, excerpt, caret, *_ = err.splitlines()
    assert (status, first) == (2, f"framegen: error: {file.as_posix()}: the file is not YAML")
    assert second.startswith(f"{file.as_posix()}:2:9: yaml-syntax: a comma or `]` is")
    assert (excerpt, caret) == ("2 | protocol: 2", "  |         ^")


def test_an_empty_spec_gets_a_hint(tmp_path: Path) -> None:
    file = spec_in(tmp_path, "")
    status, _, err = framegen("check", str(file))
    empty = f"{file.as_posix()}: the file is empty, but a spec is a mapping of keys"
    begin = "  hint: begin with `framegen: 2`"
    assert (status, err.startswith(f"framegen: error: {empty}\n{begin}")) == (2, True)


def test_a_spec_with_findings_explains_nothing(misspelt: Path) -> None:
    status, _, err = framegen("explain", str(misspelt), STOP)
    lines, name = err.splitlines(), misspelt.as_posix()
    assert (status, lines[0]) == (2, f"framegen: error: {name} has 1 finding; the first is")
    assert lines[1].endswith("unknown-type: unknown type `v16`")
    assert lines[-1] == f"  hint: `framegen check {name}` shows them all"


# ---------------------------------------------------------------------------- rules


def test_rules_lists_every_rule() -> None:
    status, out, err = framegen("rules")
    listed = [line.split(maxsplit=1) for line in out.splitlines()]
    assert (status, listed) == (0, [[rule.id, rule.title] for rule in RULES])
    assert err.startswith("`framegen rules --changes` lists the kinds of changes")


@in_turn("rule", lambda: RULES)
def test_every_rule_can_be_looked_up(rule: AnyRule) -> None:
    """To the letter: CONTRIBUTING.md shows one, and its commands are run."""
    status, shown, _ = framegen("rules", rule.id)
    why = f"{rule.id}: {rule.title}\n\n{rule.why.splitlines()[0]}\n"
    assert (status, shown.startswith(why)) == (0, True)
    assert rule.bad.splitlines()[0] in shown
    assert rule.good.splitlines()[0] in shown


# ---------------------------------------------------------------------------- the project


def project(folder: Path, *specs: str) -> Path:
    """Make a project with these specs, empty."""
    write_files({f"spec/{name}": "" for name in specs}, folder)
    return folder


@in_turn(
    "here, found",
    lambda: [
        ("outer", "spec/outer.yaml"),
        ("outer/docs/guides", "../../spec/outer.yaml"),
        ("outer/inner", "spec/inner.yaml"),
    ],
)
def test_the_default_spec_is_the_only_one_of_the_nearest_project(
    here: str, found: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project(project(tmp_path / "outer", "outer.yaml") / "inner", "inner.yaml")
    (tmp_path / here).mkdir(parents=True, exist_ok=True)
    monkeypatch.chdir(tmp_path / here)
    assert default_spec() == Path(found)


def test_a_spec_of_several_is_found_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(project(tmp_path, "b.yaml", "a.yaml"))
    choice = "there are 2 specs to choose from: a.yaml, b.yaml"
    said = f"framegen: error: {choice}\n  hint: name the one you mean, such as `a`\n"
    assert framegen("conform", "--", "codec") == (2, "", said)
    for name, spec in (("a", BUSSERVO), ("b", DEMO)):
        Path(f"spec/{name}.yaml").write_bytes(spec.read_bytes())
    assert framegen("explain", "a", STOP).out.startswith("ActionGroupStop, host -> controller\n")
    status, _, err = framegen("diff", "a", "b")
    assert status == 2
    assert "spec/a.yaml is `busservo` and spec/b.yaml is `greenhouse`" in err
    status, _, err = framegen("diff", "a", "c")
    assert (status, err.startswith("framegen: error: `c` is no file and no released ")) == (2, True)


def test_without_a_spec_anywhere_the_error_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(Unusable, match=r"no spec is named, .* has spec/\*\.yaml") as caught:
        default_spec()
    assert caught.value.hint == "name a spec file, or run this where the project is"


@in_turn(
    "here, spec, root",
    lambda: [
        (".", "here/spec/one.yaml", "here"),
        (".", "here/one.yaml", "here"),
        (".", "one.yaml", "."),
        (".", "spec/one.yaml", "."),
        (".", "here/../spec/one.yaml", "."),
        ("here/spec", "one.yaml", "here"),
    ],
)
def test_the_project_root_is_above_the_spec_folder(
    here: str, spec: str, root: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here" / "spec").mkdir(parents=True, exist_ok=True)
    monkeypatch.chdir(tmp_path / here)
    assert project_root(Path(spec)) == (tmp_path / root).resolve()


# ---------------------------------------------------------------------------- what goes wrong


def test_control_c_is_quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_arguments: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("framegen.commands.rules.run", interrupted)
    assert framegen("rules") == (INTERRUPTED, "", "")


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
    problem = f"the generator needs `{name}`, which is not installed"
    cure = "in a clone of its repository: pip install . ./codegen"
    assert process("-c", script) == (2, "", f"framegen: error: {problem}\n  hint: {cure}\n")


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


# Nothing that writes files, and nothing that ends in .yaml and might be there.
WORDS = st.one_of(
    st.text(max_size=8),
    st.sampled_from(["--json", "--help", "-h", "--", "--direction", "host", "55", "0x", "."]),
)


@given(
    st.sampled_from(["check", "explain", "rules", "schema"]),
    st.lists(WORDS, min_size=1, max_size=4),
)
def test_no_command_line_ends_in_a_traceback(verb: str, words: list[str]) -> None:
    status, _, err = framegen(verb, *words)
    assert status in (0, 1, 2)
    assert status != 2 or err.startswith("framegen: error: ")


@given(st.lists(st.text(), min_size=1, max_size=3))
def test_no_wrong_verb_ends_in_a_traceback(words: list[str]) -> None:
    status, out, err = framegen(*words)
    assert status == 2 or {"-h", "--help", "--version"} & set(words)
    assert out or err


def test_a_python_without_docstrings_is_refused_before_it_drops_descriptions(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As it is with -OO, which tests/world/test_new_project.py starts."""
    monkeypatch.setattr(Spec, "__doc__", None)
    problem = "Python was started with -OO, and has no descriptions for the schema"
    for words in (["schema"], ["generate", "--check"]):
        expected = f"framegen: error: {problem}\n  hint: start it without -OO\n"
        assert framegen(*words) == (2, "", expected)


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
def test_a_folder_that_is_gone_has_no_spec(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    said = "framegen: error: the current folder is gone\n  hint: name the spec in full\n"
    assert framegen("check") == (2, "", said)
