"""`python -m benchmarks`: measure the library and its peers against the floor."""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks import captures, column_rows, messages, peers, processes, report, streams
from benchmarks.checksummed import measure as checksummed
from benchmarks.checksummed import peers as checking_peers
from benchmarks.checksummed.rows import ROWS as CHECKSUMMED_ROWS
from benchmarks.results import AS_TABLES, FLOOR, OURS, Results

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

    from benchmarks.checksummed.peers.interface import Peer as CheckingPeer
    from benchmarks.peers.interface import Peer

COMMAND_ROWS = {"command-text": [], "command-json": ["--json"], "command-csv": ["--csv"]}
"""`busservo decode`, by the form of what it prints."""

ROWS = (
    *messages.ROWS,
    *streams.ROWS,
    *streams.NOISE_ROWS,
    *CHECKSUMMED_ROWS,
    "import",
    *COMMAND_ROWS,
    *column_rows.ROWS,
    "generate",
)

ROUNDS = 10
SECONDS = 0.01
STREAM_SECONDS = 0.04

QUICK_ROUNDS = 5
QUICK_SECONDS = 0.005
QUICK_STREAM_SECONDS = 0.01
QUICK_STRETCH = captures.PIECE // 8

_GENERATE = [sys.executable, "-m", "framegen", "generate", "spec/busservo.yaml", "--out"]
_DECODE = [sys.executable, "-m", "busservo", "decode"]


def options(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks",
        description="Measure the generated library and its peers against hand-written struct code.",
        epilog=f"Rows: {', '.join(ROWS)}.",
    )
    parser.add_argument(
        "--rounds",
        type=int,
        metavar="N",
        help=f"samples for each contender and row (default {ROUNDS}; quick: {QUICK_ROUNDS})",
    )
    parser.add_argument(
        "--only",
        action="append",
        metavar="ROW",
        help="only this row, or the rows whose names begin like this; may be repeated",
    )
    parser.add_argument(
        "--no-peers", action="store_true", help="only the library itself against the floor"
    )
    parser.add_argument("--quick", action="store_true", help="shorter samples, fewer rounds")
    parser.add_argument(
        "--write", action="store_true", help=f"also write the tables into {report.PAGE.name}"
    )
    chosen = parser.parse_args(arguments)
    if chosen.write and (chosen.only or chosen.no_peers or chosen.quick):
        parser.error("--write takes a whole run, without --only, --no-peers and --quick")
    if chosen.rounds is None:
        chosen.rounds = QUICK_ROUNDS if chosen.quick else ROUNDS
    if chosen.rounds < 1:
        parser.error("--rounds: at least 1")
    begins = tuple(chosen.only or [""])
    unknown = [begin for begin in begins if not any(row.startswith(begin) for row in ROWS)]
    if unknown:
        parser.error(f"no row begins with {', '.join(unknown)}; there are {', '.join(ROWS)}")
    chosen.rows = [row for row in ROWS if row.startswith(begins)]
    return chosen


def load_ours() -> ModuleType | None:
    """Return the module with our rows; None if the library cannot be imported."""
    try:
        return importlib.import_module("benchmarks.ours")
    except ModuleNotFoundError as error:
        if error.name != "busservo":
            raise
        return None


def measure(
    chosen: argparse.Namespace,
    ours: ModuleType | None,
    present: Sequence[Peer],
    checking: Sequence[CheckingPeer],
) -> Results:
    """Measure all chosen rows; those with checksums with peers of their own."""
    results = Results()
    seconds = QUICK_SECONDS if chosen.quick else SECONDS
    stream_seconds = QUICK_STREAM_SECONDS if chosen.quick else STREAM_SECONDS
    stretch = QUICK_STRETCH if chosen.quick else captures.PIECE
    for row in chosen.rows:
        print(f"measuring {row}", file=sys.stderr, flush=True)
        if row in CHECKSUMMED_ROWS:
            sample = stream_seconds if row.endswith("stream") else seconds
            checksummed.measure(row, checking, chosen.rounds, sample, results)
            continue
        kind = row.split("-")[0]
        able = [peer for peer in present if kind not in peer.lacks]
        for peer in present:
            if peer not in able:
                results.measurements[row, peer.name] = "no"
        if row in messages.ROWS:
            cases = ours.message_cases(row) if ours else []
            cases += [messages.peer_case(row, peer) for peer in able]
            messages.measure(row, messages.floor_case(row), cases, chosen.rounds, seconds, results)
        elif row in streams.ROWS:
            cases = ours.stream_cases() if ours else []
            cases += [streams.peer_case(peer) for peer in able]
            streams.measure(row, cases, chosen.rounds, stream_seconds, stretch, results)
        elif row in streams.NOISE_ROWS:
            cases = [streams.floor_case(), *(ours.stream_cases() if ours else [])]
            streams.measure_noise(row, cases, chosen.rounds, stretch, results)
        elif row in column_rows.ROWS:
            measure_columns(row, chosen, results)
        elif row == "import":
            measure_imports(ours, present, chosen.rounds, results)
        else:
            measure_commands(row, present, chosen.rounds, results)
    return results


def measure_columns(row: str, chosen: argparse.Namespace, results: Results) -> None:
    """Make columns of captures, which needs what only the extra `tables` brings."""
    try:
        columns = importlib.import_module("benchmarks.columns")
    except ImportError as error:
        results.refuse(row, AS_TABLES, error)
    else:
        columns.measure(row, chosen.rounds, results, quick=chosen.quick)


def measure_commands(row: str, present: Sequence[Peer], rounds: int, results: Results) -> None:
    """Run a command from start to end."""
    if row in COMMAND_ROWS:
        measure_decoding(row, rounds, results)
    else:
        measure_generators(present, rounds, results)


def measure_imports(
    ours: ModuleType | None, present: Sequence[Peer], rounds: int, results: Results
) -> None:
    """Import everything that can be imported, and `struct`, which the floor needs."""
    processes.measure_import(FLOOR, "import struct", None, rounds, results)
    if ours:
        for contender, statement in ours.IMPORTS.items():
            processes.measure_import(contender, statement, None, rounds, results)
    for peer in present:
        processes.measure_import(
            peer.name, peer.import_statement, peer.import_path, rounds, results
        )


def measure_decoding(row: str, rounds: int, results: Results) -> None:
    """Decode a capture with the command that comes with the library."""
    with tempfile.TemporaryDirectory() as folder:
        capture = Path(folder, "capture.bin")
        capture.write_bytes(captures.conversation())
        command = [*_DECODE, *COMMAND_ROWS[row], str(capture)]
        processes.measure_command(row, OURS, command, rounds, results)


def measure_generators(present: Sequence[Peer], rounds: int, results: Results) -> None:
    """Run every generator that there is."""
    if importlib.util.find_spec("framegen"):
        with tempfile.TemporaryDirectory() as folder:
            command = [*_GENERATE, folder]
            processes.measure_command("generate", OURS, command, rounds, results)
    for peer in present:
        if peer.generate_command:
            processes.measure_command("generate", peer.name, peer.generate_command, rounds, results)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and print; return 1 if a contender gave a wrong result."""
    chosen = options(arguments)
    ours = load_ours()
    present, absent = ([], []) if chosen.no_peers else peers.load()
    checking, not_checking = ([], []) if chosen.no_peers else checking_peers.load()
    results = measure(chosen, ours, present, checking)
    missing = list(dict.fromkeys([*absent, *not_checking]))
    tables = report.everything(results, ours is not None, present, checking, missing, chosen.rounds)
    print(tables)
    if chosen.write:
        report.write(tables)
    return 1 if results.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
