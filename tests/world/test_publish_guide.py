"""The guide to publishing, followed: it leads to the site that it describes."""

import re
import shlex
import sys
import webbrowser
from pathlib import Path
from zipfile import ZipFile

import pytest
from framegen.cli import main

from tests.programs import ran
from tests.unit.site.test_publish_guide import GUIDE

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path d="M0 0h8v8z"/></svg>\n'
# A block of commands, or of a file that the paragraph above it names last.
BLOCK = re.compile(r"^```(sh|markdown|yaml)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"`([\w-]+\.(?:md|yaml))`")


def run(line: str, opened: list[str]) -> None:
    """Do what a line of the guide has a shell do."""
    program, *words = shlex.split(line)
    if program == "cd":
        # The test goes back by itself.
        pytest.MonkeyPatch().chdir(*words)
    elif program == "framegen":
        before = len(opened)
        assert main(words) == 0, line
        assert len(opened) - before == words.count("--open")
    elif words[:2] == ["-m", "http.server"]:
        # It would serve forever.
        assert (Path(words[words.index("--directory") + 1]) / "index.html").is_file()
    else:
        assert program == "python"
        ran(sys.executable, *words)


def test_the_guide_leads_to_a_site_of_ones_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []

    def note(url: str) -> bool:
        opened.append(url)
        return True

    monkeypatch.setattr(webbrowser, "open", note)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    written = []
    for block in BLOCK.finditer(GUIDE):
        kind, text = block.groups()
        if kind == "sh":
            for line in text.splitlines():
                run(line, opened)
            continue
        name = NAMED.findall(GUIDE[: block.start()])[-1 if kind == "markdown" else -2]
        Path("docs", name).write_text(text, encoding="utf-8")
        written.append(name)
        Path("docs", "images").mkdir(exist_ok=True)
        Path("docs", "images", "logo.svg").write_text(SVG, encoding="utf-8")
    assert written == ["firing.md", "README.md", "site.yaml"]
    home = Path("build/site/index.html").read_text(encoding="utf-8")
    for shown in ("Kilnworks</h1>", "images/logo.svg", "--accent: #9a3412", "Firing</a>"):
        assert shown in home
    assert "https://github.com/ME/kiln/edit/main/docs/firing.md" in Path(
        "build/site/firing.html"
    ).read_text(encoding="utf-8")
    with ZipFile("kiln-docs.zip") as packed:
        assert {"offline/index.html", "offline/search.html"} <= {*packed.namelist()}
    assert [*Path("spec", "released").glob("kiln-*.yaml")]
