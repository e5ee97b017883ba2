"""`framegen docs`: a site in a folder to look at."""

import webbrowser
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.render import snippets
from framegen.site.project import read_project
from framegen.site.site import render_site

from tests.factories import compiled_file, write_files
from tests.in_turn import in_turn
from tests.mutations.spec_edits import edited
from tests.unit.site.reference import LAMP

SPEC = str(LAMP)
TEXT = LAMP.read_text("utf-8")


def written(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_it_writes_the_pages_and_the_way_to_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "site"
    assert main(["docs", SPEC, "--out", str(folder)]) == 0
    assert capsys.readouterr().out.strip() == str(folder / "index.html")
    project = read_project({LAMP: compiled_file(LAMP)})
    site = render_site(project, snippets())
    assert written(folder) == {"site.manifest", *site}
    for path, text in site.items():
        assert (folder / path).read_bytes() == text.encode()


def test_it_opens_the_index(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []

    def note(url: str) -> bool:
        opened.append(url)
        return True

    monkeypatch.setattr(webbrowser, "open", note)
    assert main(["docs", SPEC, "--open", "--out", str(tmp_path / "a b")]) == 0
    assert opened == [(tmp_path / "a b" / "index.html").as_uri()]


def test_a_missing_browser_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda _url: False)
    assert main(["docs", SPEC, "--open", "--out", str(tmp_path)]) == 0
    assert "no browser was found" in capsys.readouterr().err


def test_without_a_target_the_pages_go_into_a_folder_of_their_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert main(["docs", SPEC]) == 0
    index = Path(capsys.readouterr().out.strip())
    assert index.is_relative_to(tmp_path)
    assert index.exists()


def test_a_spec_with_findings_has_no_reference(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = tmp_path / "broken.yaml"
    broken.write_text(edited(TEXT, ("    id: 0x20\n", "    id: 300\n")))
    assert main(["docs", str(broken), "--out", str(tmp_path / "site")]) == 1
    said = capsys.readouterr()
    assert "id-range" in said.out
    assert "nothing was written" in said.err
    assert not (tmp_path / "site").exists()


# ------------------------------------------------------------------ what is wrong with the rest


RELEASED = "spec/released/stage_lamp-0.4.0.yaml"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with a spec, one release of it, and a guide."""
    write_files(
        {"spec/stage_lamp.yaml": TEXT, RELEASED: TEXT, "docs/README.md": "# Lamps\n"}, tmp_path
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """Return what `framegen docs` says while it writes nothing."""
    capsys.readouterr()
    assert main(["docs", "--out", "site", *words]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert not Path("site").exists()
    return said.err


@in_turn(
    "text, message",
    lambda: [
        ("", "stage_lamp-0.4.0.yaml"),
        ("a: [1", f"{RELEASED}:1:"),
        ("framegen: 2\n", f"{RELEASED} has "),
        ("framegen: 99\n", f"framegen: error: {RELEASED} has 1 finding"),
        ("x" * 1_000_001, f"{RELEASED} has 1.0 MB"),
    ],
)
def test_a_broken_release_is_named(
    project: Path, capsys: pytest.CaptureFixture[str], text: str, message: str
) -> None:
    (project / RELEASED).write_text(text, encoding="utf-8")
    assert message in refused(capsys)


def test_a_release_that_is_no_text_is_named(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / RELEASED).write_bytes(b"\xff\xfe")
    assert f"{RELEASED} is not UTF-8 text: byte 0" in refused(capsys)


@in_turn(
    "old, new, said",
    lambda: [
        ('version: "0.4.0"', 'version: "2.0.0"', "stage_lamp-2.0.0"),
        ("name: stage_lamp", "name: armservo", "armservo-0.4.0"),
    ],
)
def test_a_release_says_what_its_name_says(
    project: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str
) -> None:
    (project / RELEASED).write_text(edited(TEXT, (old, new)), encoding="utf-8")
    error = refused(capsys)
    assert f"{RELEASED} says that it is {said}, and its name is stage_lamp-0.4.0" in error
    assert "hint: " in error


def test_a_release_that_cannot_be_shown_is_named(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Rules of today are not held against it, but its source is nowhere."""
    text = TEXT.replace("cite: notes, page 1\n", "cite: ntes, page 1\n", 1)
    (project / RELEASED).write_text(text, encoding="utf-8")
    error = refused(capsys)
    assert f"{RELEASED} cannot be shown: it has 1 finding by today's rules" in error
    assert "ntes" in error
    assert "Traceback" not in error


def test_a_release_that_only_rules_dislike_is_shown(project: Path) -> None:
    other = edited(TEXT, ("hex: 7E 04 20 FF 00 00", "hex: 7E 04 20 FE 00 00"))
    (project / RELEASED).write_text(other, encoding="utf-8")
    assert main(["docs", "--out", "site"]) == 0
    assert Path("site/reference/stage_lamp/0.4.0/messages/ColourShow.html").is_file()


def test_a_base_must_be_an_address(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "--base example.org: no address" in refused(capsys, "--base", "example.org")


def test_a_guide_that_is_no_text_is_named(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / "docs" / "arms.md").write_bytes(b"# Arms\n\xff\n")
    assert "docs/arms.md is not UTF-8 text: byte 7" in refused(capsys)


def test_the_project_is_found_by_the_name_of_its_spec(project: Path) -> None:
    assert main(["docs", "stage_lamp", "--out", "site"]) == 0
    assert Path("site/reference/stage_lamp/0.4.0/index.html").is_file()


# ------------------------------------------------------------------ which guides it took


def test_it_says_which_guides_it_took(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs", "--out", "site"]) == 0
    assert capsys.readouterr().err == "guides: README.md, of docs/\n"
    for name in "abcdefgh":
        (project / "docs" / f"{name}.md").write_text(f"# {name}\n", encoding="utf-8")
    assert main(["docs", "--out", "site"]) == 0
    said = capsys.readouterr().err
    assert said.startswith("guides: README.md, a.md, b.md, c.md, d.md, e.md,")
    assert said.endswith(" e.md, and 3 others, of docs/\n")


def test_it_says_that_it_took_none_and_how_to_give_some(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["docs", "stage_lamp", "--out", "site"]) == 0
    assert "guides: none of docs/, since a spec is named; leave" in capsys.readouterr().err
    (project / "docs" / "README.md").unlink()
    for words in ([], ["stage_lamp"]):
        assert main(["docs", *words, "--out", "site"]) == 0
        assert (
            "guides: none, since there is no docs/README.md; begin one" in capsys.readouterr().err
        )
