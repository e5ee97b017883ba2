"""`framegen generate`: the files that it writes and the text that it prints, for a real spec.

Most of the runtime is left out: it is copied as it is, and the writer takes one file like another.
That whole libraries are written is held by tests/unit/project/test_house.py and
tests/unit/skeleton/test_new_project.py.
"""

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import pytest
from framegen.cli import main
from framegen.compile import Compiled
from framegen.reading.source import Source
from framegen.render import render, render_shared
from framegen.targets.table import TARGETS
from framegen.writing import Change, write

from tests.documents import ROOT
from tests.in_turn import in_turn
from tests.repository import commit, git, start
from tests.rows import Rows
from tests.unit.writing.made_once import compiled_once, make_once, the_same_is_made_once
from tests.unit.writing.trees import Snapshot, put, snapshot, times

__all__ = ["the_same_is_made_once"]

Capture: TypeAlias = pytest.CaptureFixture[str]

DEMO = ROOT / "tests" / "specs" / "demo.yaml"
TEXT = DEMO.read_text(encoding="utf-8")
GIT = shutil.which("git")
LIBRARY = "generated/greenhouse"
CODEC = f"{LIBRARY}/_codec.py"
RUNTIME = f"{LIBRARY}/_runtime"
SCHEMA = "spec/framegen.schema.json"


def carrying(text: str) -> Compiled:
    """Compile a spec, as of a project that has no runtime to share."""
    return replace(compiled_once(Source("spec/demo.yaml", text)), carries_runtime=True)


with pytest.MonkeyPatch.context() as patch:
    make_once(patch)
    COMPILED = carrying(TEXT)
    OUTPUT, SHARED = render(COMPILED), render_shared(COMPILED)
FILES = {**OUTPUT.files, **SHARED.files}
MANIFESTS = {OUTPUT.manifest, SHARED.manifest}


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with a spec and its output, all of it up to date; tests run in it."""
    put(tmp_path, "spec/demo.yaml", TEXT)
    write(tmp_path, [OUTPUT, SHARED])
    monkeypatch.chdir(tmp_path)
    return tmp_path


def changed(before: str, after: str) -> str:
    """Return the spec with one thing changed."""
    assert before in TEXT
    return TEXT.replace(before, after)


# The messages of the spec that are named nowhere else but in their own entry and one other.
RENAMED = changed("TextShow", "TextDisplay")
GLASSHOUSE = changed("name: greenhouse", "name: glasshouse")


# ------------------------------------------------------------------ what is written


def test_everything_is_written_where_nothing_was(tmp_path: Path, capsys: Capture) -> None:
    put(tmp_path, "spec/demo.yaml", TEXT)
    assert main(["generate", str(tmp_path / "spec" / "demo.yaml")]) == 0
    found = {path: data for path, data in snapshot(tmp_path).items() if data is not None}
    del found["spec/demo.yaml"]
    assert set(found) == {*FILES, *MANIFESTS}
    assert {path: found[path] for path in FILES} == {p: t.encode() for p, t in FILES.items()}
    out, err = capsys.readouterr()
    brought = {path for path in found if path.startswith(f"{RUNTIME}/")}
    said = [*sorted(found.keys() - brought), f"{len(brought)} files of {RUNTIME}/"]
    assert out == "".join(f"wrote {each}\n" for each in said)
    assert f"{len(found)} files from" in err


def test_the_paths_of_the_output_are_those_of_the_house() -> None:
    assert OUTPUT.manifest == "generated/greenhouse.manifest"
    assert SHARED.manifest == "spec/framegen.manifest"
    assert list(SHARED.files) == [SCHEMA]
    assert list(OUTPUT.files) == sorted(OUTPUT.files)
    for path in OUTPUT.files:
        assert any(path.startswith(f"{folder}/") for folder in OUTPUT.folders)
    names = {"__init__.py", "py.typed", "vectors.json"}
    assert {f"{LIBRARY}/{name}" for name in names} <= set(OUTPUT.files)


def test_only_what_differs_is_touched(project: Path, capsys: Capture) -> None:
    before, at = snapshot(project), times(project)
    assert main(["generate"]) == 0
    assert main(["generate", "--check"]) == 0
    assert (snapshot(project), times(project)) == (before, at)
    files = len(FILES) + len(MANIFESTS)
    summary = f"{files} files from spec/demo.yaml: none"
    assert capsys.readouterr() == ("", f"{summary} changed\n{summary} would change\n")
    (project / CODEC).unlink()
    assert main(["generate"]) == 0
    after = times(project)
    assert {path for path in after if after[path] != at[path]} == {str(project / CODEC)}
    assert capsys.readouterr().out == f"wrote {CODEC}\n"


def test_where_output_goes_is_said_where_it_is_not_here(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.chdir(project / LIBRARY)
    assert main(["generate"]) == 0
    assert "files from ../../spec/demo.yaml below ../..: none changed" in capsys.readouterr().err
    monkeypatch.chdir(project / "spec")
    assert main(["generate", "demo.yaml"]) == 0
    assert "files from demo.yaml below ..: none changed" in capsys.readouterr().err
    assert main(["generate", "--help"]) == 0
    assert "that holds spec/" in " ".join(capsys.readouterr().out.split())


def test_a_spec_checked_out_with_crlf_gives_the_same_output(project: Path) -> None:
    before = snapshot(project)
    put(project, "spec/demo.yaml", TEXT.replace("\n", "\r\n"))
    assert main(["generate", "--check"]) == 0
    assert main(["generate"]) == 0
    put(project, "spec/demo.yaml", TEXT)
    assert snapshot(project) == before


def test_a_comment_in_a_spec_is_noted_in_the_manifest_alone(project: Path, capsys: Capture) -> None:
    put(project, "spec/demo.yaml", f"{TEXT}# a comment\n")
    assert main(["generate"]) == 0
    assert capsys.readouterr().out == f"wrote {OUTPUT.manifest}\n"


# ------------------------------------------------------------------ what differs, in words


# What becomes of a file, and what is said of it.
SPOILT: dict[str, tuple[Callable[[Path], object], str]] = {
    "gone": (Path.unlink, "missing"),
    "edited": (lambda file: file.write_bytes(file.read_bytes() + b"# mine\n"), "edited by hand"),
    "no text": (lambda file: file.write_bytes(b"\xff\xfe\0" + file.read_bytes()), "edited by hand"),
}


@pytest.mark.parametrize("path", [CODEC, f"{LIBRARY}/vectors.json", f"{LIBRARY}/py.typed", SCHEMA])
@pytest.mark.parametrize("how", SPOILT)
def test_differences_are_told_and_mended(
    project: Path, capsys: Capture, path: str, how: str
) -> None:
    before = snapshot(project)
    spoil, why = SPOILT[how]
    spoil(project / path)
    spoilt = snapshot(project)

    assert main(["generate", "--check"]) == 1
    out, err = capsys.readouterr()
    assert f"{why}: {path}\n" in err
    assert "1 would change" in err
    assert f"+++ b/{path}\n" in out
    assert main(["generate", "--diff"]) == 0
    assert capsys.readouterr() == (out, err)
    assert snapshot(project) == spoilt

    if why == "edited by hand":
        assert main(["generate"]) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("framegen: error: somebody's work would be lost, so nothing was")
        assert f"\n  edited by hand: {path}\n" in err
        assert err.endswith("keeps it beside its place, as NAME.mine\n")
        assert snapshot(project) == spoilt
    assert main(["generate", "--force"]) == 0
    out, err = capsys.readouterr()
    kept = f"kept {path} as {path}.mine\n" if why == "edited by hand" else ""
    assert out == f"{kept}wrote {path}\n"
    assert "1 changed" in err
    found = snapshot(project)
    assert found.pop(f"{path}.mine", spoilt.get(path)) == spoilt.get(path)
    assert found == before
    assert main(["generate", "--check"]) == 0


def test_a_foreign_file_is_reported_and_left_alone(project: Path, capsys: Capture) -> None:
    for name in ("a.md", "b.py", "c.bin", "deep/d.py", "e.md"):
        put(project, f"{LIBRARY}/{name}", "mine\n")
    before = snapshot(project)
    for words in ([], ["--check"], ["--diff"], ["--force"]):
        assert main(["generate", *words]) == 0
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith(f"left alone, because framegen did not write it: {LIBRARY}/a.md\n")
        assert "left alone, too: 2 more files\n" in err
        assert snapshot(project) == before


def test_a_lost_manifest_is_made_anew_with_a_notice(project: Path, capsys: Capture) -> None:
    before = snapshot(project)
    (project / OUTPUT.manifest).unlink()
    for words, status in ((["--check"], 1), ([], 0)):
        capsys.readouterr()
        assert main(["generate", *words]) == status
        out, err = capsys.readouterr()
        assert f"{OUTPUT.manifest} is not there: files are recognised" in err
    assert out == f"wrote {OUTPUT.manifest}\n"
    assert snapshot(project) == before


@pytest.mark.parametrize("words", [[], ["--check"], ["--diff"], ["--force"]])
def test_with_findings_nothing_changes(project: Path, capsys: Capture, words: list[str]) -> None:
    put(project, "spec/demo.yaml", changed("type: u32", "type: v33"))
    before = snapshot(project)
    assert main(["generate", *words]) == 1
    out, err = capsys.readouterr()
    assert "unknown-type" in out
    assert err == "1 finding in spec/demo.yaml: nothing was written\n"
    assert snapshot(project) == before


REFUSED = [
    (["--check", "--diff"], "not allowed with"),
    (["--check", "--force"], "not allowed with"),
    (["--runtime", "borrowed"], "argument --runtime: invalid choice: 'borrowed'"),
    (
        ["--target", "pyhton"],
        "error: there is no target 'pyhton'\n  hint: did you mean `python`?\n",
    ),
]


@in_turn("words, why", lambda: REFUSED)
def test_options_that_cannot_be_are_refused(
    project: Path, capsys: Capture, words: list[str], why: str
) -> None:
    before = snapshot(project)
    assert main(["generate", *words]) == 2
    assert why in capsys.readouterr().err
    assert snapshot(project) == before


# ------------------------------------------------------------------ one target


@pytest.mark.parametrize("name", [target.name for target in TARGETS])
def test_one_target_is_written_and_the_others_are_left(project: Path, name: str) -> None:
    target = [target for target in TARGETS if target.name == name]
    both = render(COMPILED, target), render_shared(COMPILED, target)
    (mine,) = [output for output in both if output.files]
    shutil.rmtree(project / "generated" / "greenhouse")
    (project / SCHEMA).unlink()
    before = snapshot(project)
    assert main(["generate", "--target", name]) == 0
    assert main(["generate", "--target", name, "--check"]) == 0
    new = {p for p, data in snapshot(project).items() if data is not None and p not in before}
    assert new <= set(mine.files)
    assert all((project / path).exists() for path in mine.files)
    assert main(["generate"]) == 0
    assert main(["generate", "--check"]) == 0


# ------------------------------------------------------------------ where the runtime is


def test_where_the_project_has_the_runtime_its_libraries_import_that(project: Path) -> None:
    (project / "runtime" / "framewire").mkdir(parents=True)
    assert main(["generate", "--check"]) == 1
    assert main(["generate"]) == 0
    assert not (project / RUNTIME).exists()
    assert b"from framewire.line." in (project / LIBRARY / "_library.py").read_bytes()
    assert main(["generate", "--check", "--target", "python"]) == 0
    # What counts is where the spec lies, not where its output goes.
    assert main(["generate", "--out", "elsewhere"]) == 0
    assert not (project / "elsewhere" / RUNTIME).exists()


@pytest.mark.parametrize("words", [[], ["--target", "python"]])
def test_the_runtime_goes_and_comes_back_as_it_is_said(
    project: Path, capsys: Capture, words: list[str]
) -> None:
    before = snapshot(project)
    shared = ["generate", "--runtime", "shared", *words]
    assert main([*shared, "--check"]) == 1
    assert f"orphaned: {RUNTIME}/line/link.py\n" in capsys.readouterr().err
    assert main([*shared, "--diff"]) == 0
    assert f"--- a/{RUNTIME}/line/link.py\n+++ /dev/null\n" in capsys.readouterr().out
    assert snapshot(project) == before
    capsys.readouterr()
    assert main(shared) == 0
    number = sum(data is not None for path, data in before.items() if path.startswith(RUNTIME))
    # Nobody wants to hear of each of them.
    said = capsys.readouterr().out
    assert f"removed {number} files of {RUNTIME}/\n" in said
    assert f"{RUNTIME}/l" not in said
    assert not (project / RUNTIME).exists()
    assert main([*shared, "--check"]) == 0
    assert main(["generate", "--check", *words]) == 1
    capsys.readouterr()
    assert main(["generate", "--runtime", "carried", *words]) == 0
    printed = capsys.readouterr()
    assert "left alone" not in printed.err
    assert f"wrote {number} files of {RUNTIME}/\n" in printed.out
    assert snapshot(project) == before


# ------------------------------------------------------------------ several specs


@pytest.fixture
def three(project: Path) -> Path:
    put(project, "spec/glasshouse.yaml", GLASSHOUSE)
    put(project, "spec/shed.yaml", changed("name: greenhouse", "name: shed"))
    assert main(["generate"]) == 0
    return project


def test_all_specs_of_a_root_are_written_side_by_side(three: Path, capsys: Capture) -> None:
    capsys.readouterr()
    assert main(["generate", "--check"]) == 0
    files = 3 * (len(OUTPUT.files) + 1) + len(SHARED.files) + 1
    assert capsys.readouterr().err == f"{files} files from 3 specs: none would change\n"
    for name in ("greenhouse", "glasshouse", "shed"):
        assert (three / "generated" / name / "_codec.py").exists()
        assert (three / "generated" / f"{name}.manifest").exists()
    assert main(["check"]) == 0
    capsys.readouterr()
    assert main(["conform", "--", "codec"]) == 2
    assert "demo.yaml, glasshouse.yaml, shed.yaml" in capsys.readouterr().err


def test_one_spec_of_several_is_written_alone(three: Path) -> None:
    before = snapshot(three)
    for name in ("glasshouse", "shed"):
        (three / "generated" / name / "_codec.py").unlink()
    assert main(["generate", "spec/shed.yaml"]) == 0
    del before["generated/glasshouse/_codec.py"]
    assert snapshot(three) == before


def test_a_spec_that_is_gone_takes_its_output_along(three: Path, capsys: Capture) -> None:
    (three / "spec" / "shed.yaml").unlink()
    capsys.readouterr()
    assert main(["generate", "spec/demo.yaml", "--check"]) == 0
    assert main(["generate", "--check"]) == 1
    assert "orphaned: generated/shed/_codec.py\n" in capsys.readouterr().err
    assert main(["generate"]) == 0
    assert [path for path in snapshot(three) if "shed" in path] == []
    assert main(["generate", "--check"]) == 0


def test_below_another_folder_no_output_of_other_projects_goes(
    three: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    out = tmp_path_factory.mktemp("out")
    assert main(["generate", "--out", str(out)]) == 0
    (three / "spec" / "shed.yaml").unlink()
    assert main(["generate", "--out", str(out)]) == 0
    assert (out / "generated" / "shed" / "_codec.py").exists()


def test_a_finding_in_one_spec_keeps_all_of_them_from_being_written(three: Path) -> None:
    put(three, "spec/shed.yaml", changed("type: u32", "type: v33"))
    put(three, "spec/demo.yaml", RENAMED)
    before = snapshot(three)
    assert main(["generate"]) == 1
    assert snapshot(three) == before


# ------------------------------------------------------------------ roots and specs in odd places


def test_out_names_another_root(project: Path) -> None:
    before = snapshot(project)
    assert main(["generate", "--out", "some/where else", "--check"]) == 1
    assert snapshot(project) == before
    assert main(["generate", "--out", "some/where else"]) == 0
    assert main(["generate", "--out", "some/where else", "--check"]) == 0
    out = snapshot(project / "some" / "where else")
    shutil.rmtree(project / "some")
    assert snapshot(project) == before
    del before["spec/demo.yaml"]
    assert out == before


def test_without_out_the_root_is_the_folder_of_a_lone_spec(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    lone = put(tmp_path, "lone.yaml", TEXT)
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert main(["generate", str(lone)]) == 0
    assert " below ..: " in capsys.readouterr().err
    assert (tmp_path / CODEC).exists()
    monkeypatch.chdir(tmp_path)
    assert main(["generate", "lone.yaml", "--check"]) == 0
    assert main(["generate"]) == 2
    assert "hint: name the spec, such as lone.yaml, which lies here" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["with blank", "ünïcode", "quote'd", "{{ 7 }}", "-dash"])
def test_a_root_of_any_name_will_do(tmp_path: Path, name: str) -> None:
    put(tmp_path, f"{name}/spec/demo.yaml", TEXT)
    assert main(["generate", f"{tmp_path}/{name}/spec/demo.yaml"]) == 0
    for path, text in FILES.items():
        assert (tmp_path / name / path).read_bytes() == text.encode()


def test_a_spec_behind_a_link_gives_the_same_bytes(project: Path) -> None:
    try:
        (project / "elsewhere").symlink_to(project / "spec", target_is_directory=True)
    except OSError:  # pragma: no cover - Windows without the privilege
        pytest.skip("this system makes no symbolic links")
    assert main(["generate", "elsewhere/demo.yaml", "--check"]) == 0


@pytest.mark.parametrize("obstacle", ["generated", LIBRARY])
def test_a_file_where_a_folder_should_be_is_reported(
    tmp_path: Path, capsys: Capture, obstacle: str
) -> None:
    put(tmp_path, obstacle, "mine\n")
    before = snapshot(tmp_path)
    for words in ([], ["--check"], ["--force"]):
        assert main(["generate", str(DEMO), "--out", str(tmp_path), *words]) == 2
        assert capsys.readouterr().err == (
            f"framegen: error: {obstacle} is no folder, but output goes there\n"
            "  hint: move it elsewhere; nothing was changed\n"
        )
    assert snapshot(tmp_path) == before


# ------------------------------------------------------------------ the reference as pages


def test_the_pages_replace_no_foreign_file(project: Path, capsys: Capture) -> None:
    (project / "README.md").write_text("mine\n", encoding="utf-8")
    assert main(["docs", "--out", "."]) == 0
    assert (project / "README.md").read_text(encoding="utf-8") == "mine\n"
    index = Path(capsys.readouterr().out.strip())
    before = snapshot(project)
    assert main(["docs", "--out", "."]) == 0
    assert snapshot(project) == before
    index.write_text("mine\n", encoding="utf-8")
    assert main(["docs", "--out", "."]) == 2
    assert f"edited by hand: {index.as_posix()}\n" in capsys.readouterr().err
    assert index.read_text(encoding="utf-8") == "mine\n"
    assert main(["docs", "--out", ".", "--force"]) == 0
    assert index.with_name("index.html.mine").read_text(encoding="utf-8") == "mine\n"


# ------------------------------------------------------------------ diffs


STALE = "--- a/a\n+++ b/a\n@@"
DIFFS = [
    (Change("a", "stale", "one\ntwo\n", "one\n2\n"), f"{STALE} -1,2 +1,2 @@\n one\n-two\n+2\n"),
    (Change("a", "missing", None, "x\n"), "--- /dev/null\n+++ b/a\n@@ -0,0 +1 @@\n+x\n"),
    (Change("a", "orphaned", "x\n", None), "--- a/a\n+++ /dev/null\n@@ -1 +0,0 @@\n-x\n"),
    # A last line without an end; and a form feed or a lone carriage return stands inside a line.
    (
        Change("a", "stale", "x", "x\n"),
        f"{STALE} -1 +1 @@\n-x\n\\ No newline at end of file\n+x\n",
    ),
    (Change("a", "stale", "x\x0cy\rz\n", "x\n"), f"{STALE} -1 +1 @@\n-x\x0cy\rz\n+x\n"),
    # A file that is empty.
    (Change("py.typed", "missing", None, ""), "--- /dev/null\n+++ b/py.typed\n"),
    (Change("py.typed", "orphaned", "", None), "--- a/py.typed\n+++ /dev/null\n"),
]


@in_turn("change, diff", lambda: DIFFS)
def test_a_diff_says_what_would_change_line_by_line(change: Change, diff: str) -> None:
    assert change.diff() == diff


# ------------------------------------------------------------------ git


@pytest.mark.skipif(GIT is None, reason="git is not installed")
@pytest.mark.parametrize("attributes", Rows([True], others=[False]))
def test_after_a_merge_with_conflicts_one_run_is_enough(project: Path, attributes: bool) -> None:
    """Whichever side of the spec is taken: conflicts and joined files are nobody's work."""

    def edition(branch: str, text: str) -> None:
        git(project, "checkout", "-q", "-b", branch, "main")
        put(project, "spec/demo.yaml", text)
        assert main(["generate"]) == 0
        commit(project, {}, message=branch)

    if attributes:
        shutil.copyfile(ROOT / ".gitattributes", project / ".gitattributes")
    start(project)
    commit(project, {})
    summary = "summary: Open vents by a number of degrees."
    edition("ours", RENAMED.replace(summary, "summary: Open vents a little."))
    theirs = changed(summary, "summary: Open vents wide.")
    edition("theirs", theirs.replace("a gateway, its stations", "a gateway, all stations"))
    for side in ("--ours", "--theirs"):
        git(project, "merge", "-q", "ours", status=1)
        git(project, "checkout", side, "spec/demo.yaml")
        assert main(["generate"]) == 0
        assert main(["generate", "--check"]) == 0
        found = snapshot(project)
        spec = (project / "spec" / "demo.yaml").read_text(encoding="utf-8")
        compiled = carrying(spec)
        with TemporaryDirectory() as fresh:
            write(Path(fresh), [render(compiled), render_shared(compiled)])
            made = snapshot(Path(fresh))
        for folder in ("generated", "docs"):
            assert below(folder, found) == below(folder, made)
        git(project, "reset", "-q", "--hard")
        git(project, "clean", "-q", "-d", "--force")


def below(folder: str, found: Snapshot) -> Snapshot:
    """Return what lies in a folder."""
    return {path: data for path, data in found.items() if path.startswith(f"{folder}/")}
