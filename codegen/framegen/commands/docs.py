"""`framegen docs`: builds the reference of a spec as HTML pages."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

from framegen.commands.output_arguments import add_force, add_spec

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from framegen.site.site import Site

SUMMARY = "Build the site of a project: its guides, and the reference of each spec, as HTML pages."
EXAMPLES = (
    ("framegen docs --open", "the guides and the reference of spec/*.yaml, in your browser"),
    ("framegen docs SPEC.yaml --open", "the reference of another spec"),
    ("framegen docs --out site", "build it in site/, ready to be served"),
    ("framegen docs --out site --base https://example.org/", "to be published there"),
    ("framegen docs --out site --strict", "the same in a build that fails if a link is dead"),
)


# More names of guides than these are counted.
_SHOWN = 6


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    add_spec(parser)
    parser.add_argument("--open", action="store_true", help="open the index in a browser")
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", help="write here instead of into a temporary folder"
    )
    parser.add_argument(
        "--base",
        default="",
        metavar="ADDRESS",
        help="where the site will be: adds whole addresses, a sitemap and a page for broken links",
    )
    parser.add_argument(
        "--strict",
        action="store_true",
        help="write nothing where a guide loses a picture, or a link of it leads nowhere",
    )
    add_force(parser)


def run(arguments: Namespace) -> int:
    """Build the pages, and print where their index is. 1 where a spec has findings.

    What gets lost of the guides is said on the error stream, and is a finding if that was asked.
    """
    from tempfile import mkdtemp  # noqa: PLC0415

    from framegen.commands.spec_argument import compiled, print_findings, spec_file  # noqa: PLC0415
    from framegen.output import Output  # noqa: PLC0415
    from framegen.project import all_specs, docs_folder, guides_folder  # noqa: PLC0415
    from framegen.render import snippets  # noqa: PLC0415
    from framegen.site.project import read_project  # noqa: PLC0415
    from framegen.site.publication import base_address  # noqa: PLC0415
    from framegen.site.site import Site, lost, rendered  # noqa: PLC0415
    from framegen.writing import write  # noqa: PLC0415

    base = base_address(arguments.base)
    files = [spec_file(arguments.spec)] if arguments.spec else all_specs()
    specs = {file: compiled(file) for file in files}
    if print_findings([*specs.values()]):
        return 1
    docs = guides_folder(files[0])
    guides = None if arguments.spec else docs
    site = Site(read_project(specs, guides, base, docs_folder(files[0])), snippets())
    pages = rendered(site)
    if _print_lost([*lost(site, pages)], strict=arguments.strict):
        return 1
    folder: Path = arguments.out or Path(mkdtemp(prefix="framegen-docs-"))
    # All pages are one output: which of the specs they come from, each of them says.
    output = Output("site.manifest", "", pages, data=site.project.files)
    for notice in write(folder, [output], force=arguments.force).notices:
        print(notice, file=sys.stderr)
    index = folder / "index.html"
    print(_taken(site, docs, arguments.spec), file=sys.stderr)
    print(index)
    if arguments.open:
        _open(index)
    return 0


def _taken(site: Site, docs: Path | None, spec: Path | None) -> str:
    """Return which guides became pages, or how to give some."""
    if docs is None:
        return (
            "guides: none, since there is no docs/README.md; begin one with a title, a sentence, "
            "and a list of links to the Markdown files beside it"
        )
    folder = visible(docs.as_posix())
    if spec is not None:
        return f"guides: none of {folder}/, since a spec is named; leave its name out to have them"
    names = [visible(path) for path in site.project.guides]
    more = f", and {len(names) - _SHOWN} others" if len(names) > _SHOWN + 1 else ""
    shown = names[:_SHOWN] if more else names
    return f"guides: {', '.join(shown)}{more}, of {folder}/"


def _print_lost(found: list[str], *, strict: bool) -> bool:
    """Print what gets lost of the guides, and return whether that is a reason to write nothing."""
    for each in found:
        print(f"{each}\n", file=sys.stderr)
    if found:
        what = "nothing was written" if strict else "`--strict` makes it an error"
        print(f"{pluralize(len(found), 'finding')} in the guides: {what}", file=sys.stderr)
    return strict and bool(found)


def _open(index: Path) -> None:
    from webbrowser import open as open_in_browser  # noqa: PLC0415

    if not open_in_browser(index.resolve().as_uri()):
        print("no browser was found; open the file yourself", file=sys.stderr)
