"""What forges add to Markdown becomes part of a page, and what is lost in it keeps its place."""

from framegen.reading.source import Span
from framegen.site.guides.guide import Guide
from framegen.site.guides.markdown import targets

# What is written, and the page that it becomes.
PAGES = [
    (
        "> [!NOTE]\n> Mind `this`.\n>\n> And that.",
        (
            '<div class="note">\n<p><strong>Note</strong></p>\n<p>Mind <code>this</code>.</p>\n'
            "<p>And that.</p>\n</div>"
        ),
    ),
    (
        "> [!caution]\n>\n> Hot.",
        '<div class="warning">\n<p><strong>Caution</strong></p>\n<p>Hot.</p>\n</div>',
    ),
    (
        "> [!TIP]\n> <b>",
        '<div class="note">\n<p><strong>Tip</strong></p>\n<p>&lt;b&gt;</p>\n</div>',
    ),
    # No alert: nothing in it, no kind that forges know, words beside the mark, one within another.
    ("> [!NOTE]", "<blockquote>\n<p>[!NOTE]</p>\n</blockquote>"),
    ("> [!DANGER]\n> x", "<blockquote>\n<p>[!DANGER]\nx</p>\n</blockquote>"),
    ("> [!NOTE] x", "<blockquote>\n<p>[!NOTE] x</p>\n</blockquote>"),
    (
        "> [!NOTE]\n> > [!TIP]\n> > x",
        (
            '<div class="note">\n<p><strong>Note</strong></p>\n<blockquote>\n<p>[!TIP]\nx</p>\n'
            "</blockquote>\n</div>"
        ),
    ),
    (
        "- [ ] open\n- [X] closed\n- not [ ] one",
        (
            '<ul>\n<li class="task"><span role="img" aria-label="to do">☐</span> open</li>\n'
            '<li class="task"><span role="img" aria-label="done">☑</span> closed</li>\n'
            "<li>not [ ] one</li>\n</ul>"
        ),
    ),
    ("~~gone~~ <s>here</s>", "<p><s>gone</s> &lt;s&gt;here&lt;/s&gt;</p>"),
]


def test_what_forges_add_is_shown() -> None:
    shown = [(text, str(Guide("a.md", text).body).strip()) for text, _ in PAGES]
    assert shown == PAGES


def test_what_leads_elsewhere_keeps_its_place() -> None:
    text = "> [!NOTE]\n> see [x](y.md) <img src=q>\n\n- [ ] go [z](w.md)"
    assert list(targets(text)) == [
        ("link_open", "y.md", Span(2, 7, 1)),
        ("html", "<img src=q>", Span(2, 17, 11)),
        ("link_open", "w.md", Span(4, 10, 1)),
    ]


def test_the_mark_of_an_alert_is_no_description_of_a_page() -> None:
    assert Guide("a.md", "# T\n\n> [!TIP]\n> Words.").about == "Words."
