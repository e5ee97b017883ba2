"""`framegen docs`: the reference of a spec as pages."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.wording import counted

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

SUMMARY = "Build the reference of a spec as pages, with a search, a decoder and a cheat sheet."
EXAMPLES = (
    ("framegen docs --open", "the reference of spec/*.yaml, in your browser"),
    ("framegen docs SPEC.yaml --open", "that of another spec"),
    ("framegen docs --out site", "build it in site/NAME, ready to be served"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("spec", nargs="?", type=Path, metavar="SPEC", help="a spec file")
    parser.add_argument("--open", action="store_true", help="open the index in a browser")
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", help="write here, and not into a temporary folder"
    )


def run(arguments: Namespace) -> int:
    """Build the pages, and print where their index is. 1 where the spec has findings."""
    from tempfile import mkdtemp  # noqa: PLC0415
    from webbrowser import open as open_in_browser  # noqa: PLC0415

    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.render import snippets  # noqa: PLC0415
    from framegen.targets.docs.pages import render_site  # noqa: PLC0415

    spec = compiled(arguments.spec)
    if spec.findings:
        for finding in spec.findings:
            print(finding.render(spec.source) + "\n")
        found = counted(len(spec.findings), "finding")
        print(f"{found} in {spec.source.name}: nothing was written", file=sys.stderr)
        return 1
    files = render_site([spec], snippets())
    folder: Path = arguments.out or Path(mkdtemp(prefix="framegen-docs-"))
    for path, text in files.items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text.encode())
    index = folder / spec.model.spec.protocol.name / "index.html"
    print(index)
    if arguments.open and not open_in_browser(index.resolve().as_uri()):
        print("no browser was found; open the file yourself", file=sys.stderr)
    return 0
