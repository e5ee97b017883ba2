"""What changed from version to version, as a page: the author's words, and what was found out."""

import re
from html import unescape

from framegen.comparison.changes import CHANGE_RULES
from framegen.comparison.comparison import Comparison
from framegen.comparison.listing import edition_of
from framegen.comparison.report.view import View
from framegen.reading.source import Source

from tests.in_turn import in_turn
from tests.unit.site.editions import FIRST, SECOND, THIRD, Editions, three
from tests.unit.site.reference import Page

ROOT = "reference/lamps/"
RULES = "".join(f"### {rule.id}\n\nWhy.\n\n" for rule in CHANGE_RULES)


def sections(page: Page) -> dict[str, str]:
    """Return the HTML below the heading of each version, by its anchor, in order."""
    parts = re.split(r'<h2 id="([^"]*)">', page.text.partition("</main>")[0])
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def words(html: str) -> str:
    return " ".join(unescape(re.sub(r"<[^>]*>", "", html)).split())


def view(old: str, new: str) -> View:
    before, after = (edition_of(Source(f"{at}.yaml", text)) for at, text in enumerate((old, new)))
    return View(Comparison(before, after))


def test_the_newest_version_comes_first() -> None:
    for folder, count in (("", 3), ("2.0.0/", 2), ("1.0.0/", 1)):
        found = list(sections(three().page(f"{folder}changelog.html")))
        assert found == ["v3.0.0", "v2.0.0", "v1.0.0"][-count:]
    text = three().rendered[f"{ROOT}downloads/changelog.md"]
    assert re.findall(r"^## (.*)$", text, re.MULTILINE) == ["3.0.0", "2.0.0", "1.0.0"]


def test_the_words_of_the_author_come_first() -> None:
    said = ["Lamps are numbered up to 65535.", "LampState is called LampLevel.", "The first one."]
    found = sections(three().page("changelog.html"))
    for text, (version, html) in zip(said, found.items(), strict=True):
        assert text in words(html), version
        assert "<li>" in html.partition("<table")[0], version


@in_turn("version, old, new", lambda: [("v3.0.0", SECOND, THIRD), ("v2.0.0", FIRST, SECOND)])
def test_each_change_and_effect_of_the_comparison_is_told(version: str, old: str, new: str) -> None:
    told = words(sections(three().page("changelog.html"))[version]).replace(" → ", " -> ")
    expected = view(old, new)
    assert expected.effects
    due = [change.text for change in expected.documentation]
    due += [str(each) for each in expected.verdicts if each.effects]
    for first, *_ in expected.groups:
        due += [change.text for change in first.changes]
        due += [each.text.removeprefix(f"{first.title}: ") for each in first.effects]
        frames = [each.witness.data for each in first.effects if each.witness is not None]
        due += [frame.hex(" ").upper() for frame in frames]
    assert [text for text in due if text.replace("`", "") not in told] == []


def test_accepted_breaks_have_their_reasons() -> None:
    found = sections(three().page("changelog.html"))["v2.0.0"]
    assert "Accepted: Nobody reads &lt;states&gt;." in found
    assert '<span class="badge accepted">on purpose</span>' in found
    assert '<span class="badge breaks">breaks</span>' not in found


def test_what_changed_leads_to_the_messages() -> None:
    """To the page of the edition that has it; of what is gone, to that of the edition before."""
    page = three().page("changelog.html")
    found = sections(page)
    for version, message, path in (
        ("v3.0.0", "LampsSet", "2.0.0/messages/LampsSet.html"),
        ("v3.0.0", "LampRead", "messages/LampRead.html"),
        ("v2.0.0", "LampLevel", "2.0.0/messages/LampLevel.html"),
    ):
        (link,) = set(re.findall(rf'<h3><a href="([^"]*)">{message}</a>', found[version]))
        assert page.leads_to(link)[0] == f"{ROOT}{path}"
    link = f'<a href="../../../{ROOT}1.0.0/messages/LampState.html">LampState</a>'
    assert link in three().page("2.0.0/changelog.html").text


def test_changes_lead_to_the_spec_and_to_the_guide_that_explains_them() -> None:
    guides = (("README.md", "# Lamps\n"), ("breaks.md", f"# What breaks\n\n{RULES}"))
    site = Editions(THIRD, (SECOND, FIRST), guides)
    page = site.page("changelog.html")
    assert {
        *(("breaks.html", "message-removed"), ("breaks.html", "field-type")),
        (f"{ROOT}spec.html", "messages.LampRead.fields.lamp_id.type"),
        (f"{ROOT}2.0.0/spec.html", "messages.LampsSet"),
    } <= {*map(page.leads_to, page.links)}
    assert site.broken_links == []


def test_without_such_a_guide_the_rules_are_named_and_told() -> None:
    guides = (("README.md", "# Lamps\n"), ("words.md", "# Words\n\n### words\n\nMany.\n"))
    page = Editions(THIRD, (SECOND,), guides).page("changelog.html")
    assert "<code>message-removed</code>" in page.text
    assert ("words.html", "words") not in map(page.leads_to, page.links)
    rule = next(rule for rule in CHANGE_RULES if rule.id == "message-removed")
    assert rule.do.replace("`", "") in words(page.text)


def test_the_upgrade_order_is_that_of_the_comparison() -> None:
    expected = view(SECOND, THIRD).order
    assert expected
    assert f"Upgrade {expected}." in words(sections(three().page("changelog.html"))["v3.0.0"])


def test_what_waits_for_its_release_comes_first() -> None:
    """A version that is still that of the last release has no words of its own yet."""
    changed = SECOND.replace("summary: Ask for", "summary: Please ask for")
    found = sections(Editions(changed, (SECOND, FIRST)).page("changelog.html"))
    assert list(found) == ["unreleased", "v2.0.0", "v1.0.0"]
    assert "LampRead: summary in other words" in words(found["unreleased"])
    assert "LampState is called LampLevel." not in words(found["unreleased"])
    found = sections(Editions(THIRD, (SECOND,)).page("changelog.html"))
    assert list(found) == ["v3.0.0", "v2.0.0", "v1.0.0"]


def test_a_version_that_was_not_kept_has_the_words_alone() -> None:
    found = sections(Editions(THIRD, (THIRD, FIRST)).page("changelog.html"))
    assert list(found) == ["v3.0.0", "v2.0.0", "v1.0.0"]
    assert "nothing can be compared" in found["v2.0.0"]
    assert "What users of 1.0.0 notice" in found["v3.0.0"]
