"""The search of the whole site: all that it finds, and that no other page carries the index."""

import json
import re
from functools import cache

from framegen.render import snippets
from framegen.site.site import render_site

from tests.unit.site.scripts import run_script
from tests.unit.site.test_search import RANKING, index, needs_node, project


@cache
def rendered() -> dict[str, str]:
    return render_site(project(), snippets())


@needs_node
def test_every_entry_is_found_by_its_title_and_by_each_of_its_names() -> None:
    entries = index()["entries"]
    queries = sorted({name for each in entries for name in (each["title"], *each.get("names", []))})
    program = """
    const search = makeSearch(asked.index);
    const numbers = (query) => search.find(query).hits.map(({ number }) => number);
    const answers = asked.queries.map(numbers);
    """
    answers = run_script(RANKING, program, {"index": index(), "queries": queries})
    hits = dict(zip(queries, map(set, answers), strict=True))
    for number, entry in enumerate(entries):
        for name in (entry["title"], *entry.get("names", [])):
            assert number in hits[name], (name, entry["where"])


def test_the_search_alone_has_the_index_and_keeps_within_its_bounds() -> None:
    pages = rendered()
    assert len(pages["search.html"].encode()) < 1_500_000
    holding = [path for path, text in pages.items() if 'id="search-index"' in text]
    assert holding == ["search.html"]
    for path, text in pages.items():
        if path.endswith(".html") and path != "search.html":
            assert f'data-address="{"../" * path.count("/")}search.html"' in text, path


def test_what_the_page_lists_is_what_can_be_found() -> None:
    text = rendered()["search.html"]
    data = json.loads(re.findall(r'id="search-index">(.*?)</script>', text, re.DOTALL)[0])
    listed = text.partition('id="search-letters"')[2]
    for entry in data["entries"]:
        if entry["kind"] != "frame":
            assert f'href="{entry["path"]}"' in listed, entry["title"]
