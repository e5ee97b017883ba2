"""`framegen release`: gives a spec its next version, and keeps that edition."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from framegen.comparison.comparison import Comparison
    from framegen.comparison.release import Release

SUMMARY = "Give a spec the version that is due, say in it what changed, and keep that edition."
EXAMPLES = (
    ("framegen release busservo", "the version that its changes since the last release ask for"),
    ("framegen release busservo --dry-run", "show what would be written"),
    ("framegen release busservo --version 2.0.0", "this version, if it is high enough"),
    (
        'framegen release busservo --accept "No board has it."',
        "break what breaks, for this reason",
    ),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("spec", nargs="?", type=Path, metavar="SPEC", help="a spec file")
    parser.add_argument("--version", metavar="VERSION", help="release this version")
    parser.add_argument(
        "--accept",
        metavar="REASON",
        help="why it breaks what it breaks; written under `breaks` in the history",
    )
    parser.add_argument("--dry-run", action="store_true", help="write nothing; show what would be")


def run(arguments: Namespace) -> int:
    """Write the spec and its released edition. 1 for findings. Raises Unusable."""
    from framegen.checks.breaks import missing  # noqa: PLC0415
    from framegen.commands.spec_argument import compiled, print_findings  # noqa: PLC0415
    from framegen.comparison.comparison import Comparison  # noqa: PLC0415
    from framegen.comparison.listing import (  # noqa: PLC0415
        RELEASED,
        edition_of,
        kept_before,
        released,
    )
    from framegen.comparison.release import release  # noqa: PLC0415
    from framegen.compile import compile_leniently  # noqa: PLC0415
    from framegen.language.load import read_source  # noqa: PLC0415
    from framegen.project import default_spec, named_spec, project_root  # noqa: PLC0415

    given: Path = arguments.spec or default_spec()
    file = given if given.exists() else named_spec(str(given)) or given
    spec = compiled(file)
    lenient = compile_leniently(spec.source)
    if lenient.derived is None and print_findings([spec]):
        return 1
    name = lenient.spec.protocol.name
    editions = {each.stem.removeprefix(f"{name}-"): each for each in released(file.parent, name)}
    older = _newest(editions)
    before = None if older is None else edition_of(read_source(older))
    if before is not None:
        # A release reserves the names of messages that are gone.
        names = {missing(each) for each in before.spec.messages}
        left = [each for each in spec.findings if each.message not in names]
        spec = replace(lenient, findings=left)
    if print_findings([spec]):
        return 1
    kept = [] if before is None else kept_before(file.parent, before)
    comparison = None if before is None else Comparison(before, edition_of(spec.source), kept)
    made = release(spec, comparison, editions, arguments.version, arguments.accept)
    root = project_root(file)
    folder = file.parent.resolve().relative_to(root).as_posix()
    below = "" if folder == "." else f"{folder}/"
    paths = f"{below}{file.name}", f"{below}{RELEASED}/{name}-{made.version}.yaml"
    if arguments.dry_run:
        _show(paths, spec.source.text, made.text)
    else:
        _write(root, paths, file, (spec.source.text, made.text))
    _tell(made, comparison)
    return 0


def _newest(editions: dict[str, Path]) -> Path | None:
    """Return the newest edition that is final: what leads up to a version promises nothing."""
    from framegen.language.version import Version  # noqa: PLC0415

    versions = {name: Version.parse_or_none(name) for name in editions}
    final = [name for name, version in versions.items() if version is not None and version.is_final]
    return next((editions[name] for name in [*final, *editions]), None)


def _show(paths: tuple[str, str], old: str, new: str) -> None:
    from framegen.writing import Change  # noqa: PLC0415

    spec, edition = paths
    if old != new:
        print(Change(spec, "stale", old, new).diff(), end="")
    sys.stdout.flush()
    print(f"{visible(edition)} would be a copy of that; nothing was written", file=sys.stderr)


def _write(root: Path, paths: tuple[str, str], file: Path, texts: tuple[str, str]) -> None:
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415
    from framegen.writing import replace  # noqa: PLC0415

    spec, edition = paths
    old = file.read_bytes()
    if old.decode("utf-8-sig", "replace").replace("\r\n", "\n") != texts[0]:
        raise Unusable(f"{visible(spec)} was changed meanwhile", hint="run this again")
    new = _as_before(old, texts[1])
    # The spec comes first: where only that is written, another run adds the edition.
    for path in replace(root, {spec: new, edition: new}, {spec: old, edition: None}):
        print(f"wrote {visible(path)}")
    sys.stdout.flush()


def _as_before(old: bytes, text: str) -> bytes:
    """Return text with the line ends, and the mark in front, that the file has."""
    mark = b"\xef\xbb\xbf"
    data = text.encode()
    if b"\r\n" in old:
        data = data.replace(b"\n", b"\r\n")
    return mark + data if old.startswith(mark) else data


def _tell(made: Release, comparison: Comparison | None) -> None:
    after = "the first one" if comparison is None else f"after {comparison.old.version}"
    for why in () if comparison is None else comparison.found_in_kept.unread:
        print(f"not compared: {why}", file=sys.stderr)
    parts = [f"version {made.version}, {after}"]
    if made.breaks:
        parts.append(f"{pluralize(len(made.breaks), 'break')} accepted")
    if made.reserved:
        parts.append(f"{pluralize(len(made.reserved), 'message')} reserved")
    print(f"{'; '.join(parts)}; next: framegen generate", file=sys.stderr)
