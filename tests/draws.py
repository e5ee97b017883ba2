"""What Hypothesis draws: the same in every run, and a digest of it for each test and for all.

    python -m pytest -p tests.draws tests/unit                 prints the digests
    python -m pytest -p tests.draws tests/unit --backwards     the last test first
    python -m pytest -p tests.draws tests/unit --shuffled 7    files in some order, and their tests

The digests are the same whatever ran before, in whichever process: also with `-n 4`, and with any
`--dist`. So is the one of all, in the last line, for the same tests.
"""

import hashlib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from random import Random
from typing import Any
from unittest import mock

import pytest
from hypothesis import core, settings
from hypothesis.internal.conjecture import data as conjecture
from hypothesis.internal.conjecture import engine

# For so long a failing example is made smaller, which the engine bounds to five minutes.
SHRINKING_SECONDS = 30


def draw_the_same() -> None:
    """Let draws that repeat depend on the test alone, and end soon where one fails.

    Hypothesis draws constants of the modules that a process has imported so far, wherever it
    repeats its draws as well. There is no setting for this; if what it is done by has another name
    one day, this fails. A search for other examples keeps both.
    """
    if find_spec("hypothesis.internal.constants_ast") is not None:
        _without_constants_of_modules()
    _digested_once()
    if settings().derandomize:
        engine.MAX_SHRINKING_SECONDS = SHRINKING_SECONDS


def _without_constants_of_modules() -> None:
    from hypothesis.internal.conjecture import providers  # noqa: PLC0415 - old ones have none

    found, none = providers._get_local_constants, providers._local_constants
    providers._get_local_constants = lambda: none if settings().derandomize else found()


def _digested_once() -> None:
    """Read the source of a test once for all rows of its table, which are searched one by one.

    What a search begins with follows from the source, and from which test it is of those that have
    the source.
    """
    engine_of: Any = core
    digest = engine_of.function_digest

    @lru_cache(maxsize=64)
    def digested(test: Any, _which: bytes | None) -> Any:
        return digest(test)

    def function_digest(test: Any) -> Any:
        return digested(test, getattr(test, "_hypothesis_internal_add_digest", None))

    engine_of.function_digest = function_digest


@contextmanager
def recorded() -> Iterator[list[str]]:
    """Record what is drawn: each example, in turn."""
    drawn: list[str] = []
    freeze: Any = conjecture.ConjectureData.freeze

    def frozen(self: Any) -> None:
        if not self.frozen:
            drawn.append(repr(self.choices if hasattr(self, "choices") else bytes(self.buffer)))
        freeze(self)

    with mock.patch.object(conjecture.ConjectureData, "freeze", frozen):
        yield drawn


# As a plugin of pytest.


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--backwards", action="store_true", help="begin with the last test")
    parser.addoption("--shuffled", type=int, metavar="SEED", help="in another order")


def pytest_configure(config: pytest.Config) -> None:
    config.pluginmanager.register(_Digests())


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if config.option.shuffled is not None:
        items[:] = _shuffled(items, config.option.shuffled)
    if config.option.backwards:
        items.reverse()


def _shuffled(items: Iterable[pytest.Item], seed: int) -> Iterator[pytest.Item]:
    """Yield the tests of each file together, in an order of which all workers have the same."""
    files = defaultdict[Path, list[pytest.Item]](list)
    for item in items:
        files[item.path].append(item)
    dice = Random(seed)  # noqa: S311 - nothing is secret here
    for file in dice.sample([*files], len(files)):
        yield from dice.sample(files[file], len(files[file]))


class _Digests:
    """The digests of what the tests draw; with several workers, they come with the reports."""

    def __init__(self) -> None:
        self._found: dict[str, str] = {}

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self, item: pytest.Item) -> Iterator[None]:
        with recorded() as drawn:
            yield
        if drawn:
            item.user_properties.append(("draws", _digest(drawn)))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        for name, digest in report.user_properties:
            if name == "draws":
                self._found[report.nodeid] = str(digest)

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        found = [f"{digest} {name}" for name, digest in sorted(self._found.items())]
        for line in found:
            terminalreporter.write_line(f"drawn: {line}")
        whole = _digest(found)
        terminalreporter.write_line(f"drawn: {whole} by all {len(found)} of them")


def _digest(lines: list[str]) -> str:
    data = "\n".join(lines).encode("utf-8", "surrogatepass")
    return hashlib.sha256(data).hexdigest()[:16]
