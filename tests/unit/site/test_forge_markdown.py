"""What forges add to Markdown becomes part of a page, and what is lost in it keeps its place."""

from framegen.reading.source import Span
from framegen.site.guides.guide import Guide
from framegen.site.guides.markdown import targets
from hypothesis import given
from hypothesis import strategies as st

from tests.unit.site.reference import Page


def note(at: int, use: str = "") -> str:
    """Return what leads to a footnote."""
    said = f'id="fnref:{at}{use}" href="#fn:{at}" aria-label="Footnote {at}"'
    return f"<sup><a {said}>{at}</a></sup>"


def back(at: int, use: str = "") -> str:
    """Return what leads back from there."""
    return f' <a href="#fnref:{at}{use}" aria-label="Back to the text of footnote {at}">↩</a>'


def notes(*found: str) -> str:
    """Return the list of footnotes."""
    items = "\n".join(f'<li id="fn:{at}">\n{each}</li>' for at, each in enumerate(found, 1))
    return f'<section class="footnotes" aria-label="Footnotes">\n<ol>\n{items}\n</ol>\n</section>'


def alert(kind: str, name: str, inside: str) -> str:
    return f'<div class="{kind}">\n<p><strong>{name}</strong></p>\n{inside}\n</div>'


def quoted(inside: str) -> str:
    return f"<blockquote>\n<p>{inside}</p>\n</blockquote>"


def box(label: str, sign: str) -> str:
    return f'<li class="task"><span role="img" aria-label="{label}">{sign}</span>'


MORE = '<details class="more">\n<summary>'
# What is written, and the page that it becomes.
PAGES = {
    "> [!NOTE]\n> Mind `this`.\n>\n> And that.": alert(
        "note", "Note", "<p>Mind <code>this</code>.</p>\n<p>And that.</p>"
    ),
    "> [!caution]\n>\n> Hot.": alert("warning", "Caution", "<p>Hot.</p>"),
    "> [!TIP]\n> <b>": alert("note", "Tip", "<p>&lt;b&gt;</p>"),
    # No alert: nothing in it, no kind that forges know, words beside the mark, one within another.
    "> [!NOTE]": quoted("[!NOTE]"),
    "> [!DANGER]\n> x": quoted("[!DANGER]\nx"),
    "> [!NOTE] x": quoted("[!NOTE] x"),
    "> [!NOTE]\n> > [!TIP]\n> > x": alert("note", "Note", quoted("[!TIP]\nx")),
    "- [ ] open\n- [X] closed\n- not [ ] one": f"<ul>\n{box('to do', '☐')} open</li>\n"
    f"{box('done', '☑')} closed</li>\n<li>not [ ] one</li>\n</ul>",
    "a[^x] b[^y] c[^x] d[^z]\n\n[^y]: Why.\n[^x]: Words\n    go on.\n\n    - more": (
        f"<p>a{note(1)} b{note(2)} c{note(1, ':2')} d[^z]</p>\n"
        + notes(
            f"<p>Words\ngo on.</p>\n<ul>\n<li>more</li>\n</ul>\n{back(1)}{back(1, ':2')}",
            f"<p>Why.{back(2)}</p>\n",
        )
    ),
    "[^a]: [x](x.md) <i>\n\n> [^b]: y\n>\n> z\n\n[^b]": f"{quoted('z')}\n<p>{note(1)}</p>\n"
    + notes(f"<p>y{back(1)}</p>\n", "<p><span>x</span> &lt;i&gt;</p>\n"),
    "text\n<details open>\n<summary>**S** <b></summary>\n\n- a\n\n</details>\nafter": (
        '<p>text</p>\n<details class="more" open="">\n<summary><strong>S</strong> &lt;b&gt;'
        "</summary>\n<ul>\n<li>a</li>\n</ul>\n</details>\n<p>after</p>"
    ),
    "- a\n  <details><summary>S</summary>\n  <DETAILS>\n  b\n  </details>\n  </details>\n- c": (
        f"<ul>\n<li>a\n{MORE}S</summary>\n{MORE}Details</summary>\n<p>b</p>\n</details>\n"
        "</details>\n</li>\n<li>c</li>\n</ul>"
    ),
    "<details onclick=x>\n</details>": "<p>&lt;details onclick=x&gt;\n&lt;/details&gt;</p>",
    "<details>\nx": "<p>&lt;details&gt;\nx</p>",
    "<details>x</details>": "<p>&lt;details&gt;x&lt;/details&gt;</p>",
    "</details>": "<p>&lt;/details&gt;</p>",
    "~~gone~~ <s>here</s>": "<p><s>gone</s> &lt;s&gt;here&lt;/s&gt;</p>",
}


def test_what_forges_add_is_shown() -> None:
    assert {text: str(Guide("a.md", text).body).strip() for text in PAGES} == PAGES


def test_what_leads_elsewhere_keeps_its_place() -> None:
    text = "> [!NOTE]\n> see [x](y.md) <img src=q>\n\n- [ ] go [z](w.md)"
    assert list(targets(text)) == [
        ("link_open", "y.md", Span(2, 7, 1)),
        ("html", "<img src=q>", Span(2, 17, 11)),
        ("link_open", "w.md", Span(4, 10, 1)),
    ]


def test_the_mark_of_an_alert_is_no_description_of_a_page() -> None:
    assert Guide("a.md", "# T\n\n> [!TIP]\n> Words.").about == "Words."


def test_what_leads_elsewhere_from_footnotes_and_details_keeps_its_place() -> None:
    part = "<details>\n<summary>[s](t.md)</summary>\n\n[z](w.md)\n</details>"
    text = f"a[^b]\n\n[^b]: [x](y.md)\n\n{part}"
    found = [(target, span.line) for _, target, span in targets(text)]
    assert found == [("t.md", 6), ("w.md", 8), ("y.md", 3)]


def test_a_fence_may_show_what_closes_a_part() -> None:
    body = Guide("a.md", "<details>\n\n```\n</details>\n```\n\n</details>\nafter").body
    assert body.endswith("</details>\n<p>after</p>\n")
    assert body.count("&lt;/details&gt;") == 2


PIECES = [
    *("[^a]", "[^a]: b", "<details>", "<summary>s</summary>", "> ", "- ", "    ", "</details>"),
    *("```", "\n", "\n\n", "words ", "# h", "[x](y)", "1. ", "| a |\n|---|\n"),
]


@given(st.lists(st.sampled_from(PIECES)))
def test_whatever_is_written_the_elements_of_a_page_are_balanced(pieces: list[str]) -> None:
    page = Page("a.html", str(Guide("a.md", "".join(pieces)).body))
    assert len(page.ids) == len({*page.ids})
    known = {f"#{each}" for each in page.ids}
    assert {link for link in page.links if link.startswith("#fn")} <= known
