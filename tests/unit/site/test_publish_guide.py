"""The guide to publishing: its commands, files and settings lead to the site that it describes."""

import re
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.language.site_settings import SiteSettings
from framegen.skeleton import skeleton

from tests.commands import called
from tests.unit.site.reference import ROOT

GUIDE = (ROOT / "docs" / "publish.md").read_text(encoding="utf-8")


def test_every_setting_is_told() -> None:
    table = GUIDE.partition("| Key |")[2].partition("\n\n")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == [*SiteSettings.model_fields]


def test_the_colour_that_is_refused_is_refused_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    [shown] = re.findall(r"```text\n(.*?)```", GUIDE, re.DOTALL)
    [wrong] = re.findall(r"^1 \| (.*)$", shown, re.MULTILINE)
    monkeypatch.chdir(tmp_path)
    assert main(["new", "kiln", "--into", "."]) == 0
    Path("docs/site.yaml").write_text(f"{wrong}\n", encoding="utf-8")
    status, _, err = called(main, "docs", "--out", "site")
    assert (status, err.endswith(shown)) == (2, True)


def test_the_workflow_that_the_guide_names_is_written() -> None:
    [folder] = re.findall(r"`pages\.yml` that `framegen new` writes into `([^`]+)`", GUIDE)
    text = skeleton("kiln")[f"{folder.rstrip('/')}/pages.yml"]
    for words in ("hashFiles('tools/framegen-*.whl')", "branches: [main]", "workflow_dispatch"):
        assert words in text
