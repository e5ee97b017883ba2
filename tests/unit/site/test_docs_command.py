"""`framegen docs`: a site in a folder to look at."""

import shutil
import webbrowser
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.render import snippets
from framegen.site.project import read_project
from framegen.site.site import render_site

from tests.in_turn import in_turn
from tests.unit.site.reference import ROOT, SPECS, reference

# The first edition, so that it stays what it is.
SPEC_FILE = ROOT / "spec" / "released" / "busservo-1.0.0.yaml"
SPEC = str(SPECS["greenhouse"])


def written(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_it_writes_the_pages_and_the_way_to_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "site"
    assert main(["docs", SPEC, "--out", str(folder)]) == 0
    assert capsys.readouterr().out.strip() == str(folder / "index.html")
    project = read_project({Path(SPEC): reference("greenhouse").compiled})
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
    broken.write_text(reference("busservo").source.text.replace("    id: 3\n", "    id: 300\n"))
    assert main(["docs", str(broken), "--out", str(tmp_path / "site")]) == 1
    said = capsys.readouterr()
    assert "id-range" in said.out
    assert "nothing was written" in said.err
    assert not (tmp_path / "site").exists()


# ------------------------------------------------------------------ what is wrong with the rest


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with a spec, one release of it, and a guide."""
    folder = tmp_path / "project"
    (folder / "spec" / "released").mkdir(parents=True)
    shutil.copy(SPEC_FILE, folder / "spec" / "busservo.yaml")
    shutil.copy(SPEC_FILE, folder / "spec" / "released" / "busservo-1.0.0.yaml")
    (folder / "docs").mkdir()
    (folder / "docs" / "README.md").write_text("# Servos\n", encoding="utf-8")
    monkeypatch.chdir(folder)
    return folder


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """Return what `framegen docs` says while it writes nothing."""
    capsys.readouterr()
    assert main(["docs", "--out", "site", *words]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert not Path("site").exists()
    return said.err


RELEASED = "spec/released/busservo-1.0.0.yaml"


@in_turn(
    "text, message",
    lambda: [
        ("", "busservo-1.0.0.yaml"),
        ("a: [1", f"{RELEASED}:1:"),
        ("framegen: 2\n", f"{RELEASED} has "),
        ("framegen: 99\n", "framegen: error: spec/released/busservo-1.0.0.yaml has 1 finding"),
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
        ('version: "1.0.0"\n  authority', 'version: "2.0.0"\n  authority', "busservo-2.0.0"),
        ("name: busservo", "name: armservo", "armservo-1.0.0"),
    ],
)
def test_a_release_says_what_its_name_says(
    project: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str
) -> None:
    text = SPEC_FILE.read_text(encoding="utf-8")
    assert text.count(old) == 1
    (project / RELEASED).write_text(text.replace(old, new), encoding="utf-8")
    error = refused(capsys)
    assert f"{RELEASED} says that it is {said}, and its name is busservo-1.0.0" in error
    assert "hint: " in error


def test_a_release_that_cannot_be_shown_is_named(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Rules of today are not held against it, but its source is nowhere."""
    text = SPEC_FILE.read_text(encoding="utf-8")
    text = text.replace("cite: vendor, section 1.6\n", "cite: vendr, section 1.6\n", 1)
    (project / RELEASED).write_text(text, encoding="utf-8")
    error = refused(capsys)
    assert f"{RELEASED} cannot be shown: it has 1 finding by today's rules" in error
    assert "vendr" in error
    assert "Traceback" not in error


def test_a_release_that_only_rules_dislike_is_shown(project: Path) -> None:
    text = SPEC_FILE.read_text(encoding="utf-8")
    (project / RELEASED).write_text(text.replace("Turn one", "  Turn one", 1), encoding="utf-8")
    other = text.replace("hex: 55 55 06 14 03 01 02 03", "hex: 55 55 06 14 03 01 02 04")
    (project / RELEASED).write_text(other, encoding="utf-8")
    assert main(["docs", "--out", "site"]) == 0
    assert Path("site/reference/busservo/1.0.0/messages/ServoUnload.html").is_file()


def test_a_base_must_be_an_address(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "--base example.org: no address" in refused(capsys, "--base", "example.org")


def test_a_guide_that_is_no_text_is_named(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / "docs" / "arms.md").write_bytes(b"# Arms\n\xff\n")
    assert "docs/arms.md is not UTF-8 text: byte 7" in refused(capsys)


def test_the_project_is_found_by_the_name_of_its_spec(project: Path) -> None:
    assert main(["docs", "busservo", "--out", "site"]) == 0
    assert Path("site/reference/busservo/1.0.0/index.html").is_file()


# ------------------------------------------------------------------ which guides it took


def test_it_says_which_guides_it_took(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs", "--out", "site"]) == 0
    assert capsys.readouterr().err == "guides: README.md, of docs/\n"
    for name in "abcdefgh":
        (project / "docs" / f"{name}.md").write_text(f"# {name}\n", encoding="utf-8")
    assert main(["docs", "--out", "site"]) == 0
    assert capsys.readouterr().err.startswith("guides: README.md, a.md, b.md, c.md, d.md, e.md,")
    assert main(["docs", "--out", "site"]) == 0
    assert capsys.readouterr().err.endswith(" e.md, and 3 others, of docs/\n")


def test_it_says_that_it_took_none_and_how_to_give_some(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["docs", "busservo", "--out", "site"]) == 0
    assert "guides: none of docs/, since a spec is named; leave" in capsys.readouterr().err
    (project / "docs" / "README.md").unlink()
    for words in ([], ["busservo"]):
        assert main(["docs", *words, "--out", "site"]) == 0
        assert (
            "guides: none, since there is no docs/README.md; begin one" in capsys.readouterr().err
        )
