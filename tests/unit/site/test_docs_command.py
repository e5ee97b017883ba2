"""`framegen docs`: a site in a folder to look at."""

import webbrowser
from functools import partial
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.render import snippets
from framegen.site.project import read_project
from framegen.site.site import render_site

from tests.commands import called
from tests.factories import compiled_file, write_files
from tests.in_turn import in_turn
from tests.mutations.spec_edits import edited
from tests.unit.site.reference import LAMP

SPEC = str(LAMP)
TEXT = LAMP.read_text("utf-8")
docs = partial(called, main, "docs")


def test_it_writes_the_pages_and_the_way_to_them(tmp_path: Path) -> None:
    folder = tmp_path / "site"
    assert docs(SPEC, "--out", str(folder))[:2] == (0, f"{folder / 'index.html'}\n")
    site = render_site(read_project({LAMP: compiled_file(LAMP)}), snippets())
    files = [path for path in folder.rglob("*") if path.is_file()]
    written = {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}
    assert written.pop("site.manifest")
    assert written == {path: text.encode() for path, text in site.items()}


def test_it_opens_the_index_or_reports_a_missing_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []

    def opening(url: str) -> bool:
        opened.append(url)
        return len(opened) == 1

    monkeypatch.setattr(webbrowser, "open", opening)
    out = ("--out", str(tmp_path / "a b"))
    status, _, err = docs(SPEC, "--open", *out)
    assert (status, opened) == (0, [(tmp_path / "a b" / "index.html").as_uri()])
    assert "no browser" not in err
    assert "no browser was found" in docs(SPEC, "--open", "--force", *out).err


def test_without_a_target_the_pages_go_into_a_folder_of_their_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    index = Path(docs(SPEC).out.strip())
    assert index.is_relative_to(tmp_path)
    assert index.exists()


def test_a_spec_with_findings_has_no_reference(tmp_path: Path) -> None:
    write_files({"broken.yaml": edited(TEXT, ("    id: 0x20\n", "    id: 300\n"))}, tmp_path)
    status, out, err = docs(str(tmp_path / "broken.yaml"), "--out", str(tmp_path / "site"))
    assert status == 1
    assert "id-range" in out
    assert "nothing was written" in err
    assert not (tmp_path / "site").exists()


RELEASED = "spec/released/stage_lamp-0.4.0.yaml"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with a spec, one release of it, and a guide."""
    files = {"spec/stage_lamp.yaml": TEXT, RELEASED: TEXT, "docs/README.md": "# Lamps\n"}
    write_files(files, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refused(*words: str) -> str:
    """Return what `framegen docs` says while it writes nothing."""
    status, out, err = docs("--out", "site", *words)
    assert (status, out, Path("site").exists()) == (2, "", False)
    return err


NAMED = f"{RELEASED} says that it is {{}}, and its name is stage_lamp-0.4.0"
# Rules of today are not held against a release, but a source that is nowhere cannot be shown.
SHOWN = f"{RELEASED} cannot be shown: it has 1 finding by today's rules"
# The text of a release, and what is said of it.
RELEASES = [
    ("", "stage_lamp-0.4.0.yaml"),
    ("a: [1", f"{RELEASED}:1:"),
    ("framegen: 2\n", f"{RELEASED} has "),
    ("framegen: 99\n", f"framegen: error: {RELEASED} has 1 finding"),
    ("x" * 1_000_001, f"{RELEASED} has 1.0 MB"),
    (edited(TEXT, ('version: "0.4.0"', 'version: "2.0.0"')), NAMED.format("stage_lamp-2.0.0")),
    (edited(TEXT, ("name: stage_lamp", "name: armservo")), NAMED.format("armservo-0.4.0")),
    (TEXT.replace("cite: notes, page 1\n", "cite: ntes, page 1\n", 1), SHOWN),
]


@in_turn("text, message", lambda: RELEASES)
def test_a_broken_release_is_named(project: Path, text: str, message: str) -> None:
    (project / RELEASED).write_text(text, encoding="utf-8")
    error = refused()
    assert message in error
    assert "Traceback" not in error
    assert "hint: " in error or not message.startswith(NAMED[:60])
    assert "ntes" in error or message != SHOWN


@in_turn("file, at", lambda: [(RELEASED, 0), ("docs/arms.md", 7)])
def test_what_is_no_text_is_named(project: Path, file: str, at: int) -> None:
    before = (project / file).read_bytes() if (project / file).exists() else b""
    (project / file).write_bytes(b"# Arms\n"[:at] + b"\xff\xfe")
    assert f"{file} is not UTF-8 text: byte {at}" in refused()
    (project / file).write_bytes(before)


def test_a_release_that_only_rules_dislike_is_shown(project: Path) -> None:
    other = edited(TEXT, ("hex: 7E 04 20 FF 00 00", "hex: 7E 04 20 FE 00 00"))
    (project / RELEASED).write_text(other, encoding="utf-8")
    # The project is found by the name of its spec, too.
    for words in ([], ["stage_lamp"]):
        assert docs(*words, "--out", "site").status == 0
        assert Path("site/reference/stage_lamp/0.4.0/messages/ColourShow.html").is_file()


def test_a_base_must_be_an_address(project: Path) -> None:
    assert "--base example.org: no address" in refused("--base", "example.org")


def test_it_says_which_guides_it_took(project: Path) -> None:
    assert docs("--out", "site").err == "guides: README.md, of docs/\n"
    write_files({f"docs/{name}.md": f"# {name}\n" for name in "abcdefgh"}, project)
    named = ", ".join(f"{name}.md" for name in ("README", *"abcde"))
    assert docs("--out", "site").err == f"guides: {named}, and 3 others, of docs/\n"


def test_it_says_that_it_took_none_and_how_to_give_some(project: Path) -> None:
    none = "guides: none of docs/, since a spec is named; leave"
    assert none in docs("stage_lamp", "--out", "site").err
    (project / "docs" / "README.md").unlink()
    for words in ([], ["stage_lamp"]):
        begin = "guides: none, since there is no docs/README.md; begin one"
        assert begin in docs(*words, "--out", "site").err
