"""The tables at the end of a run, in Markdown."""

from __future__ import annotations

import platform
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks import captures, streams
from benchmarks.checksummed.rows import PROTOCOLS, ROWS, SPEAKERS
from benchmarks.peers import MODULES, NOT_INSTALLED
from benchmarks.results import (
    AS_COLUMNS,
    AS_TABLES,
    CLIENT,
    DECODED,
    DICTS,
    EVERY_FIELD,
    FLOOR,
    GENERATED,
    GENERATED_READ,
    IN_USE,
    OURS,
    Results,
)
from benchmarks.targets import TARGETS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from benchmarks.checksummed.peers.interface import Peer as CheckingPeer
    from benchmarks.peers import Absent
    from benchmarks.peers.interface import Peer

PAGE = Path(__file__).with_name("README.md")
"""The page that shows the tables of one run."""

_BEGIN = "<!-- The tables of `python -m benchmarks --write` -->\n"
_END = "<!-- end of tables -->\n"

_NOTHING = "-"


@dataclass(frozen=True)
class Table:
    """Contenders down, rows of the benchmark across."""

    title: str
    columns: Mapping[str, str]
    """Row of the benchmark, and the head of its column."""

    candidates: Sequence[str] = (OURS, *MODULES.values())
    """Who is named when absent."""


TABLES = (
    Table(
        "One message, ratio to the floor",
        {
            "encode-1": "encode MOVE, 1",
            "encode-6": "6",
            "encode-32": "32 servos",
            "decode-6": "decode 6 servos",
            "decode-battery": "battery",
        },
    ),
    *(
        Table(
            f"Stream, {kind}, ratio to the floor",
            {
                row: f"chunks of {chunk}" if chunk == streams.CHUNKS[0] else str(chunk)
                for row, (of_kind, chunk) in streams.ROWS.items()
                if of_kind == kind
            },
        )
        for kind in captures.KINDS
    ),
    Table(
        "Noise, chunks of 64, ratio to one's own clean stream",
        {"noise-garbage": "garbage", "noise-flipped": "flipped"},
        (OURS,),
    ),
    *(
        Table(
            f"{title}, ratio to the floor",
            {name: row.head for name, row in ROWS.items() if row.protocol == protocol},
            SPEAKERS[protocol],
        )
        for protocol, title in PROTOCOLS.items()
    ),
    Table("Import, milliseconds over a bare Python", {"import": "ms"}),
    Table(
        "`busservo decode`, CPU seconds for a capture of a megabyte, both ways",
        {"command-text": "text", "command-json": "JSON", "command-csv": "CSV"},
        (OURS,),
    ),
    Table(
        "A capture of both directions, CPU milliseconds a megabyte",
        {
            "columns-clean": "clean",
            "columns-noise-1": "1 % noise",
            "columns-noise-10": "10 % noise",
            "columns-parquet": "to Parquet",
            "columns-arrow": "to an Arrow file",
        },
        (OURS,),
    ),
    Table(
        "`busservo.tables` against these, ratio of CPU time",
        {
            "columns-clean-share": "clean",
            "columns-noise-1-share": "1 % noise",
            "columns-noise-10-share": "10 % noise",
        },
        (OURS,),
    ),
    Table(
        "An archive as Parquet, milliseconds a megabyte",
        {
            "columns-archive-1": "CPU, one process",
            "columns-archive-2": "two",
            "columns-archive-1-clock": "clock, one process",
            "columns-archive-2-clock": "two",
        },
        (OURS,),
    ),
    Table("Generate, CPU seconds of a fresh process", {"generate": "s"}, (OURS, "Kaitai Struct")),
)


def everything(
    results: Results,
    with_ours: bool,
    present: Sequence[Peer],
    checking: Sequence[CheckingPeer],
    absent: Sequence[Absent],
    rounds: int,
) -> str:
    """Return the whole report."""
    titles = {FLOOR: "floor (struct by hand)"}
    titles |= {name: name for name in (OURS, EVERY_FIELD, AS_COLUMNS, IN_USE, CLIENT)}
    titles |= {name: name for name in (GENERATED, GENERATED_READ, DECODED, DICTS, AS_TABLES)}
    titles |= {peer.name: peer.title for peer in present}
    titles |= {peer.name: peer.title for peer in checking}
    missing = [*([] if with_ours else [OURS]), *(one.name for one in absent)]
    rounds_text = "1 round" if rounds == 1 else f"{rounds} rounds"
    python = f"{platform.python_implementation()} {platform.python_version()}"
    parts = [
        f"{python}, CPU time, median of {rounds_text}, collector on, floor = 1.00; lower is better."
    ]
    for table in TABLES:
        columns = {row: head for row, head in table.columns.items() if _any(results, row)}
        if columns:
            candidates = [name for name in missing if name in table.candidates]
            parts += [f"### {table.title}", _comparison(results, columns, titles, candidates)]
    parts += _notes(results, present, absent)
    parts += _remarks(results, checking)
    ours = _against_targets(results)
    if ours:
        parts += ["### Ours against bar and goal", ours]
    return "\n\n".join(parts)


def write(tables: str) -> None:
    """Replace the tables of the page."""
    before, _, rest = PAGE.read_text("utf-8").partition(_BEGIN)
    _, _, after = rest.partition(_END)
    PAGE.write_text(f"{before}{_BEGIN}\n{tables}\n\n{_END}{after}", "utf-8", newline="\n")


def _comparison(
    results: Results,
    columns: Mapping[str, str],
    titles: Mapping[str, str],
    missing: Sequence[str],
) -> str:
    """Return a table with contenders down, rows of the benchmark across, medians in the cells."""
    lines = []
    for contender, title in titles.items():
        cells = [_cell(results, row, contender) for row in columns]
        if any(cell != _NOTHING for cell in cells):
            lines.append([title, *cells])
    nothing = [_NOTHING] * (len(columns) - 1)
    lines += [[name, NOT_INSTALLED, *nothing] for name in missing]
    return _table(["", *columns.values()], lines)


def _any(results: Results, row: str) -> bool:
    return any(measured == row for measured, _ in results.measurements)


def _cell(results: Results, row: str, contender: str) -> str:
    is_ratio_to_floor = row in ROWS or row.startswith(("encode", "decode", "stream"))
    if contender == FLOOR and is_ratio_to_floor:
        return "1.00"
    measured = results.measurements.get((row, contender), _NOTHING)
    return measured if isinstance(measured, str) else _figure(measured.median)


def _notes(results: Results, present: Sequence[Peer], absent: Sequence[Absent]) -> Iterator[str]:
    """Yield remarks on single contenders, for readers of the tables."""
    for peer in present:
        for kind, reason in peer.lacks.items():
            if any(row.startswith(kind) for row, _ in results.measurements):
                yield f"{peer.name}: {reason}."
    for one in absent:
        if one.reason != NOT_INSTALLED:
            yield f"{one.name}: {one.reason}."
    if results.sizes:
        sizes = ", ".join(f"{name} {size >> 10} KiB" for name, size in results.sizes.items())
        yield f"Smallest stretch of a stream in one sample: {sizes}."
    for sentence in results.wrong:
        yield f"NOT TIMED: {sentence}"


def _remarks(results: Results, checking: Sequence[CheckingPeer]) -> Iterator[str]:
    """Yield remarks on those that check what they read."""
    for peer in checking:
        if peer.remark and any(row in peer.works for row, _ in results.measurements):
            yield f"{peer.name}, frames with checksums: {peer.remark}."


def _against_targets(results: Results) -> str:
    """Return our rows beside bar and goal; quartiles show how far a median can be trusted."""
    lines = []
    for target in TARGETS:
        spread = results.spread(target.row, target.contender)
        if spread is not None:
            lines.append(
                [
                    target.text,
                    _figure(spread.median),
                    f"{_figure(spread.low)}..{_figure(spread.high)}",
                    _NOTHING if target.bar is None else f"{target.bar:g}",
                    _NOTHING if target.goal is None else f"{target.goal:g}",
                    target.verdict(spread.median) or _NOTHING,
                ]
            )
    return _table(["", "median", "quartiles", "bar", "goal", "verdict"], lines) if lines else ""


def _figure(value: float) -> str:
    """Return a number with about three significant digits."""
    if abs(value) < 9.995:
        return f"{value:.2f}"
    return f"{value:.1f}" if abs(value) < 99.95 else f"{value:.0f}"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table: the first column aligned to the left, the others to the right."""
    lines = [list(head), *map(list, rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]

    def text(line: Sequence[str]) -> str:
        others = [cell.rjust(width) for cell, width in zip(line[1:], widths[1:], strict=True)]
        return f"| {' | '.join([line[0].ljust(widths[0]), *others])} |"

    rule = ["-" * widths[0], *("-" * (width - 1) + ":" for width in widths[1:])]
    return "\n".join([text(lines[0]), text(rule), *map(text, lines[1:])])
