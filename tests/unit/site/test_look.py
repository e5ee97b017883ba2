"""What a site wears: docs/site.yaml, from its keys to the pages."""

from functools import cache
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.language.site_settings import SiteSettings, load_settings
from framegen.reading.source import Source
from framegen.render import snippets
from framegen.site import shades
from framegen.site.look import Look
from framegen.site.project import Project
from framegen.site.shades import BOUND, Theme, contrast, readable, worst_contrast
from framegen.site.site import render_site
from hypothesis import given
from hypothesis import strategies as st

from tests.commands import called
from tests.factories import write_files
from tests.in_turn import in_turn
from tests.unit.site.lamps import BASE, GUIDES, greenhouse, lamps, metas, rendered_lamps, title
from tests.unit.site.reference import LAMP, Page, pages_of

OWN = """title: "<b>Lamps</b> & more"
logo: images/our logo.svg
accent: "#b3001b"
repository: https://example.org/lamps?a=1&b=2
edit: https://example.org/edit/{path}?branch=main
footer: "<script>alert(1)</script> & friends"
"""
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path d="M0 0h8v8z"/></svg>'
THEMES: tuple[Theme, ...] = ("light", "dark")
COLOURS = st.integers(0, 0xFFFFFF).map("#{:06x}".format)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with a spec, two guides, a logo, and pictures that are none of its own."""
    folder = tmp_path / "project"
    write_files({f"docs/{name}": GUIDES[name] for name in ("README.md", "first.md")}, folder)
    write_files({"spec/lamp.yaml": LAMP.read_text("utf-8"), "../outside.png": ""}, folder)
    pictures = {"images/our logo.svg": SVG, "mark.png": "\x89PNG", "huge.png": "\0" * 1_100_000}
    write_files({f"docs/{name}": text for name, text in pictures.items()}, folder)
    (folder / "docs" / "linked.png").symlink_to(tmp_path / "outside.png")
    monkeypatch.chdir(folder)
    return folder


def settings(text: str) -> SiteSettings:
    """Return what a file of settings says."""
    return load_settings(Source("docs/site.yaml", text))[0]


@cache
def site(text: str, base: str = BASE) -> dict[str, Page]:
    """Return the pages of a small site that looks as a file of settings says."""
    look = Look(settings(text))
    return pages_of(render_site(Project([greenhouse()], GUIDES, base=base, look=look), snippets()))


def test_every_page_wears_what_the_settings_say() -> None:
    pages = {path: page for path, page in site(OWN).items() if path != "404.html"}
    assert title(pages["index.html"]) == "<b>Lamps</b> & more"
    for path, page in pages.items():
        above = "../" * path.count("/")
        assert page.tags.count(("img", {"src": f"{above}images/our%20logo.svg", "alt": ""})) == 1
        icon = {"rel": "icon", "href": f"{above}images/our%20logo.svg"}
        assert ("link", icon) in page.tags
        assert "--accent: #b3001b;" in page.styles[0]
        assert "<script>alert(1)</script> & friends" in page.words
        assert page.links.count("https://example.org/lamps?a=1&b=2") == 2
        assert metas(page)["og:site_name"] == "<b>Lamps</b> & more"


@in_turn(
    "page, words, path",
    lambda: [
        ("index.html", "Edit this page", "docs/README.md"),
        ("first.html", "Edit this page", "docs/first.md"),
        ("project/changelog.html", "Edit this page", "CHANGELOG.md"),
        ("reference/greenhouse/messages/VentsOpen.html", "Edit the spec", "demo.yaml"),
        ("search.html", "", ""),
        ("404.html", "", ""),
    ],
)
def test_a_page_leads_to_where_its_file_is_edited(page: str, words: str, path: str) -> None:
    shown = site(OWN)[page]
    edits = [link for link in shown.links if link.startswith("https://example.org/edit/")]
    assert edits == ([f"https://example.org/edit/{path}?branch=main"] if path else [])
    assert words in shown.words
    assert ("Edit" in shown.words) == bool(words)


def test_nothing_is_worn_that_is_not_set() -> None:
    project = Project([greenhouse()], GUIDES, version="4.5.6", look=Look(settings("")))
    assert render_site(project, snippets()) == rendered_lamps()
    assert not [page.path for page in lamps().values() if ("img", {}) in page.tags]


def test_the_logo_of_all_sites_has_their_accent() -> None:
    page = site('accent: "#B3001B"\n')["index.html"]
    assert "#b3001b" in page.text.partition("<header>")[2].partition("</svg>")[0]


def test_an_icon_stands_for_a_logo_and_a_logo_for_an_icon() -> None:
    for key in ("logo", "icon"):
        look = Look(settings(f"{key}: mark.png\n"))
        assert (look.logo, look.icon) == ("files/docs/mark.png",) * 2
    both = Look(settings("logo: images/a.svg\nicon: images/b.svg\n"))
    assert (both.logo, both.icon) == ("images/a.svg", "images/b.svg")


@in_turn("named", lambda: [["spec/lamp.yaml"], []])
def test_a_reference_alone_wears_it_too(project: Path, named: list[str]) -> None:
    (project / "docs" / "site.yaml").write_text(OWN, encoding="utf-8")
    (project / "docs" / "README.md").unlink(missing_ok=True)
    assert main(["docs", *named, "--out", "built", "--force"]) == 0
    page = Page("index.html", Path("built/index.html").read_text(encoding="utf-8"))
    assert title(page) == "<b>Lamps</b> & more"
    assert "<script>alert(1)</script> & friends" in page.words
    assert "--accent: #b3001b;" in page.styles[0]
    assert Path("built/images/our logo.svg").read_text("utf-8") == SVG


REFUSED = [
    ("title: 2026", "1:8: wrong-value: a text is written as text", 'in quotes: "2026"'),
    ('title: " "', "1:8: wrong-value: there are no words here", ""),
    (f"footer: {'x' * 501}", "1:9: wrong-value: 501 characters are too many: 500 at most", ""),
    ("footer: [a]", "1:9: wrong-value: a text is written as text", ""),
    ("\ncolour: red", "2:1: unknown-key: there is no key `colour` here", "choose one of `title`"),
    ("acent: red", "1:1: unknown-key: there is no key `acent` here", "did you mean `accent`?"),
    ("accent: red", "1:9: wrong-value: `red` is no colour: write # and six", ""),
    ("accent: #b3001b", "1:8: wrong-value: a colour is written as text", '"#b3001b"'),
    (
        'accent: "#ff7a00"',
        "1:9: site-contrast: `#ff7a00` has a contrast of 2.26 with the backgrounds",
        'the nearest darker shade that can be read is "#ad5300"',
    ),
    (
        'accent_dark: "#333333"',
        "1:14: site-contrast: `#333333` has a contrast of 1.08 with the backgrounds of the dark",
        'the nearest lighter shade that can be read is "#b0b0b0"',
    ),
    ("logo: images/none.svg", "1:7: site-picture: there is no file docs/images/none.svg", ""),
    ("logo: first.md", "1:7: site-picture: `first.md` is no picture that browsers show", ".svg"),
    ("icon: ../mark.png", "1:7: site-picture: `../mark.png` is no path below docs/", ""),
    ("icon: /mark.png", "1:7: site-picture: `/mark.png` is no path below docs/", ""),
    ("icon: C:/mark.png", "1:7: site-picture: `C:/mark.png` is no path below docs/", ""),
    ("logo: huge.png", "1:7: site-picture: docs/huge.png has 1.1 MB", "at most 1 MB"),
    ("logo: linked.png", "1:7: site-picture: there is no file docs/linked.png", ""),
    ("repository: javascript:alert(1)", "1:13: wrong-value: `javascript:alert(1)`: no addr", ""),
    ("repository: https://a@b.c/", "1:13: wrong-value: `https://a@b.c/`: a name or a pass", ""),
    ("edit: https://b.c/", "1:7: wrong-value: `{path}` stands here 0 times instead of once", ""),
    ("edit: ftp://b.c/{path}", "1:7: wrong-value: `ftp://b.c/docs/README.md`: no address", ""),
    ("title: a\ntitle: b", "2:1: yaml-duplicate-key: the key `title` is given twice", ""),
    ("title: [", "docs/site.yaml:2:1: yaml-syntax", ""),
    ("- title", "docs/site.yaml is no mapping of keys", "its keys are title, logo"),
]


@in_turn("text, why, hint", lambda: REFUSED)
def test_what_is_wrong_is_told_at_its_place(text: str, why: str, hint: str, project: Path) -> None:
    err = refused(project, f"{text}\n")
    assert f"framegen: error: {Path('docs')}/site.yaml " in err
    assert why in err
    assert hint in err.partition("hint: ")[2]


def refused(project: Path, text: str) -> str:
    """Return what is said of settings with which nothing is built."""
    (project / "docs" / "site.yaml").write_text(text, encoding="utf-8")
    status, out, err = called(main, "docs", "--out", "site")
    assert (status, out, Path("site").exists()) == (2, "", False)
    return err


def test_all_that_is_wrong_is_told_at_once(project: Path) -> None:
    said = refused(project, "title: 1\nx: 2\nfooter: 3\n")
    assert "docs/site.yaml has 3 findings\n" in said


def test_every_key_may_be_left_out() -> None:
    for text in ("", "# title: x\n", "---\n"):
        assert settings(text) == SiteSettings()
    assert settings("title: x\n") == SiteSettings(title="x")


def test_contrast_is_that_of_the_guidelines() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#767676", "#ffffff") == pytest.approx(4.54, abs=0.005)
    assert contrast("#777777", "#ffffff") == contrast("#ffffff", "#777777") < BOUND


@given(COLOURS, st.sampled_from(THEMES))
def test_the_shade_that_is_offered_can_be_read_and_a_readable_colour_is_kept(
    colour: str, theme: Theme
) -> None:
    shade = readable(colour, theme)
    assert worst_contrast(shade, theme) >= BOUND
    # On its own tint, and under the words of a button.
    tint = shades._accent(shade, theme).partition("-tint: ")[2][:7]
    assert contrast(shade, tint) >= BOUND
    assert contrast(shade, shades._tokens()[theme]["on-accent"]) >= BOUND
    assert (shade == colour) == (worst_contrast(colour, theme) >= BOUND)
