"""`framegen docs`: a site in a folder to look at."""

import webbrowser
from pathlib import Path

import pytest
from framegen.cli import main

from tests.docs.reference import ROOT, reference

SPEC = str(ROOT / "spec" / "busservo.yaml")


def written(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_it_writes_the_pages_and_the_way_to_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "site"
    assert main(["docs", SPEC, "--out", str(folder)]) == 0
    assert capsys.readouterr().out.strip() == str(folder / "index.html")
    site = reference("busservo")
    assert written(folder) == {"site.manifest", *site.site}
    for path, page in site.site.items():
        assert (folder / path).read_bytes() == page.text.encode()


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
