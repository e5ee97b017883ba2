"""`framegen docs`: builds the reference of a spec as HTML pages."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.commands.output_arguments import add_force, add_spec

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

SUMMARY = "Build the site of a project: its guides, and the reference of each spec, as HTML pages."
EXAMPLES = (
    ("framegen docs --open", "the guides and the reference of spec/*.yaml, in your browser"),
    ("framegen docs SPEC.yaml --open", "the reference of another spec"),
    ("framegen docs --out site", "build it in site/, ready to be served"),
    ("framegen docs --out site --base https://example.org/", "to be published there"),
)


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
    add_force(parser)


def run(arguments: Namespace) -> int:
    """Build the pages, and print where their index is. 1 where a spec has findings."""
    from tempfile import mkdtemp  # noqa: PLC0415
    from webbrowser import open as open_in_browser  # noqa: PLC0415

    from framegen.commands.spec_argument import compiled, print_findings, spec_file  # noqa: PLC0415
    from framegen.output import Output  # noqa: PLC0415
    from framegen.project import all_specs, guides_folder  # noqa: PLC0415
    from framegen.render import snippets  # noqa: PLC0415
    from framegen.site.project import read_project  # noqa: PLC0415
    from framegen.site.publication import base_address  # noqa: PLC0415
    from framegen.site.site import render_site  # noqa: PLC0415
    from framegen.writing import write  # noqa: PLC0415

    base = base_address(arguments.base)
    files = [spec_file(arguments.spec)] if arguments.spec else all_specs()
    specs = {file: compiled(file) for file in files}
    if print_findings([*specs.values()]):
        return 1
    folder: Path = arguments.out or Path(mkdtemp(prefix="framegen-docs-"))
    docs = None if arguments.spec else guides_folder(files[0])
    project = read_project(specs, docs, base)
    # All pages are one output: which of the specs they come from, each of them says.
    pages = render_site(project, snippets())
    site = Output("site.manifest", "", pages, data=project.files)
    for notice in write(folder, [site], force=arguments.force).notices:
        print(notice, file=sys.stderr)
    index = folder / "index.html"
    print(index)
    if arguments.open and not open_in_browser(index.resolve().as_uri()):
        print("no browser was found; open the file yourself", file=sys.stderr)
    return 0
