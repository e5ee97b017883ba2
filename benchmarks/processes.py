"""Rows of whole processes: import a library, decode a capture, generate from a description."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks import sampling

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.results import Results

_ROOT = Path(__file__).resolve().parent.parent
_BARE = "pass"


class FailedError(Exception):
    """A measured process ended with an error."""


def cpu_seconds(
    command: Sequence[str], path: str | None = None, folder: Path | None = None
) -> float:
    """Return the CPU seconds of a fresh process, system calls included."""
    environment = dict(os.environ)
    # Without a cache of bytecode every import would be a compilation.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    if path is not None:
        environment["PYTHONPATH"] = os.pathsep.join(
            [path, *filter(None, [environment.get("PYTHONPATH")])]
        )
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        command, env=environment, cwd=folder, capture_output=True, text=True, check=False
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        reason = done.stderr.strip().rpartition("\n")[2]
        raise FailedError(reason or f"exit status {done.returncode}")
    return (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)


def measure_import(
    contender: str, statement: str, path: str | None, rounds: int, into: Results
) -> None:
    """Measure the milliseconds that an import adds to a bare Python, sampled around it."""

    def process(code: str) -> float:
        return cpu_seconds([sys.executable, "-c", code], path)

    try:
        process(statement)
        pairs = sampling.between(lambda _: process(_BARE), lambda _: process(statement), rounds)
    except FailedError as error:
        into.refuse("import", contender, error)
        return
    into.measurements["import", contender] = sampling.spread(
        [1000 * (own - bare) for own, bare in pairs]
    )


def measure_command(
    row: str, contender: str, command: Sequence[str], rounds: int, into: Results
) -> None:
    """Measure the CPU seconds of a fresh process that does the whole work."""
    sample = partial(cpu_seconds, command, folder=_ROOT)
    try:
        sample()
        taken = [sample() for _ in range(rounds)]
    except FailedError as error:
        into.refuse(row, contender, error)
        return
    into.measurements[row, contender] = sampling.spread(taken)
