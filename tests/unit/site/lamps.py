"""A small site of guides and one reference, with its pages parsed once for all tests."""

import html
import re
from functools import cache

from framegen.compile import Compiled
from framegen.render import snippets
from framegen.site.project import Project
from framegen.site.site import render_site

from tests.unit.site.reference import Page, pages_of, reference

BASE = "https://example.org/docs/"
README = """# Lamps

Lamps on a *line*.

```python
lamp()
```

```output
on
```

## Learn

How to begin.

- [First steps](first.md): from nothing
  to a lamp.
- [Second steps](second.md): `lamps` from a shell.

## Look up

- [The protocol](reference/greenhouse/README.md): each of its frames.

## Maintain

- [Changes](../CHANGELOG.md): what changed.

## About

See [the tests](../tests/README.md), and [the first steps](first.md#a-step).
"""
FIRST = """# The very first steps

## A `step`

Into [the second](second.md), [the frames](reference/greenhouse/README.md#frames),
[a message](reference/greenhouse/messages/VentsOpen.md), [the spec](../demo.yaml),
[the workbench](reference/greenhouse/README.md#workbench),
[changes](../CHANGELOG.md), [a file](../tests/x.py), [elsewhere](https://example.org/).

### A smaller "one"

`--a-long-option` and `a b`
"""
GUIDES = {
    "README.md": README,
    "first.md": FIRST,
    "second.md": "# Second\n\nIt goes on.\n",
    "third.md": "# Third\n\nNobody lists it.\n",
    "../CHANGELOG.md": "# Changelog\n\n## 1.0.0\n\nSee [the steps](docs/first.md#a-step).\n",
}


def greenhouse() -> Compiled:
    return reference("greenhouse").compiled


@cache
def lamps(base: str = "", preview: bool = False) -> dict[str, Page]:
    """Return a small site of guides and one reference, a page by its path."""
    return pages_of(rendered_lamps(base, preview))


@cache
def rendered_lamps(base: str = "", preview: bool = False) -> dict[str, str]:
    """Return all files of that site by path."""
    files = {"images/preview.png": b""} if preview else {}
    return render_site(Project([greenhouse()], GUIDES, files, base, "4.5.6"), snippets())


def metas(page: Page) -> dict[str, str]:
    """Return what the head of a page says, by name."""
    metas = page.having("content")
    return {each.get("name") or each.get("property", ""): each["content"] for each in metas}


def title(page: Page) -> str:
    (found,) = re.findall("<title>(.*?)</title>", page.text)
    return html.unescape(found)


def part(page: Page, name: str) -> str:
    """Return the navigation of a name, without what is around it."""
    return "".join(re.findall(rf'<nav[^>]* aria-label="{name}".*?</nav>', page.text, re.DOTALL))


def links(text: str) -> list[tuple[str, str]]:
    """Return the links in some HTML, each with its words."""
    found = re.findall(r'<a [^>]*?href="([^"]*)"[^>]*>(.*?)</a>', text, re.DOTALL)
    return [(link, " ".join(re.sub("<[^>]*>", " ", label).split())) for link, label in found]
