"""A protocol in three editions, told apart by what each changed: the site of all of them."""

from dataclasses import dataclass
from functools import cache, cached_property

from framegen.comparison.listing import edition_of
from framegen.compile import compile_spec
from framegen.reading.source import Source
from framegen.render import snippets
from framegen.site.project import Project
from framegen.site.site import Site, render_site

from tests.mutations.spec_edits import edited
from tests.unit.site.reference import ROOT, Page, broken_links, page_of, pages_of

LAMPS = (ROOT / "tests" / "specs" / "bad" / "base" / "lamps.yaml").read_text(encoding="utf-8")
HISTORY = """
history:
  - version: "1.0.0"
    changes: [The first one.]
"""
FIRST = LAMPS.rstrip() + HISTORY

# The second: LampState is called LampLevel, which is accepted, and LampRead stays.
SECOND = edited(
    FIRST.replace("LampState", "LampLevel"),
    ("  LampLevel:\n", "  LampLevel:\n    was: LampState\n"),
    {"under": "protocol", "replace": '"1.0.0"', "with": '"2.0.0"'},
    {
        "before": '- version: "1.0.0"',
        "add": '- version: "2.0.0"\n  changes: [LampState is called LampLevel.]\n'
        "  breaks: {messages.LampLevel: Nobody reads <states>.}",
    },
)
# The third: LampsSet is gone, and the number of a lamp may be larger.
THIRD = edited(
    SECOND,
    {"remove": "LampsSet:"},
    {"under": "protocol", "replace": '"2.0.0"', "with": '"3.0.0"'},
    {
        "before": '- version: "2.0.0"',
        "add": '- version: "3.0.0"\n  changes: [Lamps are numbered up to 65535.]',
    },
    ("AA 55 02 08 01", "AA 55 03 08 01 00"),
    ("    length: 2\n", "    length: 3\n"),
    ("lamp_id: {type: u8, about: The lamp.}", "lamp_id: {type: u16, about: The lamp.}"),
)


@dataclass(frozen=True)
class Editions:
    """A site of a spec and its released editions, the newest of these first."""

    spec: str
    released: tuple[str, ...]
    guides: tuple[tuple[str, str], ...] = ()
    files: tuple[tuple[str, bytes], ...] = ()

    @cached_property
    def project(self) -> Project:
        """The project that the site is made of."""
        spec = compile_spec(Source("spec/lamps.yaml", self.spec))
        assert [finding.message for finding in spec.findings] == []
        texts = {f"spec/released/{at}.yaml": text for at, text in enumerate(self.released)}
        released = {spec.spec.protocol.name: [edition_of(Source(*each)) for each in texts.items()]}
        return Project([spec], dict(self.guides), dict(self.files), released=released)

    @cached_property
    def rendered(self) -> dict[str, str]:
        """Every file, by path below the root of the site."""
        return render_site(self.project, snippets())

    @cached_property
    def pages(self) -> dict[str, Page]:
        """Every page, by path below the root of the site."""
        return pages_of(self.rendered)

    @cached_property
    def site(self) -> Site:
        """The site, of which nothing is rendered yet."""
        return Site(self.project, snippets())

    def page(self, path: str) -> Page:
        """Return a page by its path below the root of the reference, rendered alone."""
        return page_of(self.site, f"reference/lamps/{path}")

    @property
    def broken_links(self) -> list[tuple[str, str]]:
        """The links that lead nowhere."""
        return broken_links(self.pages, {*self.rendered, *dict(self.files)})


@cache
def three() -> Editions:
    """Return the site of the third edition, which is released as well, as it is."""
    return Editions(THIRD, (THIRD, SECOND, FIRST))
