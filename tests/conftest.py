"""What holds for every test: how long Hypothesis searches, and what is drawn of the slow tests.

What is slow, or needs the world outside this process, lies in tests/world. `pytest` leaves it out
(norecursedirs); `pytest tests/world` runs it, and with `--sample N` so many of each file.

The profiles of Hypothesis are `ci`, the same examples in every run; `quick`, fewer of them; `all`,
many of them; and `fuzz`, a long search for others. One is chosen by HYPOTHESIS_PROFILE or
--hypothesis-profile. No test sets max_examples of its own: that would hold the search back. What
each of many cases is held to is given a share of them: tests/few_each.py.
"""

import gc
import os
import random
import sys
from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from datetime import datetime, timezone
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace
from typing import Any

import pytest
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.reading.yamltree import Unusable
from framegen.witnesses import find_missing, read_witnesses
from hypothesis import HealthCheck, settings
from serial.urlhandler import protocol_socket

from tests.draws import draw_the_same

try:
    import resource
except ImportError:  # there is none on Windows
    resource = None  # type: ignore[assignment]

# How long something takes to draw says more about the machine than about the test.
TIMELESS = [HealthCheck.too_slow]
for profile, examples in {"quick": 10, "ci": 25, "all": 200}.items():
    settings.register_profile(
        profile,
        derandomize=True,
        deadline=None,
        max_examples=examples,
        suppress_health_check=TIMELESS,
    )
settings.register_profile(
    "fuzz",
    deadline=None,
    max_examples=5_000,
    print_blob=True,
    # What is rare is what is searched for here, and rare things are slow to draw.
    suppress_health_check=[*TIMELESS, HealthCheck.data_too_large],
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


# pyserial sleeps for 0.3 s behind each socket that it has closed, for servers that are slow to take
# the next caller. Our boards are not, so that no test waits for it.
_sockets: Any = protocol_socket
_sockets.time = SimpleNamespace(sleep=lambda _seconds: None)


ROOT = Path(__file__).parents[1]
_CACHED = type(cache(print))


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add what chooses a sample."""
    group = parser.getgroup("sample")
    group.addoption(
        "--sample",
        type=lambda text: text if text == "all" else int(text),
        metavar="N",
        help="run N tests of each file; with `all`, every change of a spec that a test knows",
    )
    group.addoption("--seed", type=int, help="which of them (default: others on each day)")
    group.addoption("--only", metavar="TEXT", help="of those changes, the ones that say TEXT")


def pytest_configure(config: pytest.Config) -> None:
    """Choose the seed and what is run, once for all processes that share the work."""
    if config.option.seed is None and config.option.sample is not None:
        config.option.seed = datetime.now(timezone.utc).date().toordinal()
    leave_out_settings(config)
    if config.args_source is not config.ArgsSource.ARGS and something_is_missing():
        config.args[:] = [
            f"{ROOT / 'tests' / 'unit' / 'commands' / 'test_missing.py'}::test_nothing_is_missing"
        ]


def leave_out_settings(config: pytest.Config) -> None:
    """Have no command read what whoever runs the tests has set for boards of their own."""
    here = [name for name in ("busservo.toml", "lxservo.toml") if (ROOT / name).exists()]
    if here:
        raise pytest.UsageError(f"the tests would read {', '.join(here)}: move that away")
    folder = TemporaryDirectory()
    config.add_cleanup(folder.cleanup)
    os.environ |= {"XDG_CONFIG_HOME": folder.name, "APPDATA": folder.name}
    for name in ("BUSSERVO_PORT", "LXSERVO_PORT"):
        os.environ.pop(name, None)


def something_is_missing() -> bool:
    """Tell whether `framegen missing` finds anything.

    A run of all tests then reports that and no more: whatever reads the files in which it is
    missing would fail as well, and say less.
    """
    # What is wrong with the spec or the declaration itself, the tests of those say.
    with suppress(Unusable):
        model = compile_spec(read_source(ROOT / "spec" / "busservo.yaml")).model
        return find_missing(model, read_witnesses(ROOT, "busservo") or [], ROOT) != []
    return False


def pytest_report_header(config: pytest.Config) -> list[str]:
    """Print what a sample can be repeated with."""
    many = config.option.sample
    return [] if many is None else [f"--sample {many} --seed {config.option.seed}"]


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """Take down what a worker has held at most."""
    _held.append(node.workeroutput.get("held", 0))


_held: list[int] = []


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Say what this process has held at most, in MB: macOS counts it in bytes."""
    if resource is not None:
        held = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        held //= 1_000_000 if sys.platform == "darwin" else 1_000
        getattr(session.config, "workeroutput", {})["held"] = held


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Print the seconds of each folder, as if the workers had run nothing else.

    A worker holds what it has compiled and rendered once, and the libraries of others that it has
    imported, for the most part those of tables.
    """
    workers = max(1, len(getattr(config.option, "tx", None) or [1]))
    taken: defaultdict[str, float] = defaultdict(float)
    for reports in terminalreporter.stats.values():
        for report in reports:
            if isinstance(report, pytest.TestReport):
                taken["/".join(Path(report.nodeid).parts[:2])] += report.duration / workers
    told = [f"{folder}: {seconds:.0f} s" for folder, seconds in sorted(taken.items())]
    told += [f"the largest worker: {max(_held)} MB"] if any(_held) else []
    terminalreporter.write_line(", ".join(told))


def pytest_sessionstart(session: pytest.Session) -> None:
    """Draw the same in each run, with the profile that has been chosen by now."""
    draw_the_same()


def pytest_collection(session: pytest.Session) -> None:
    """Look for garbage seldom while thousands of tests are made, none of which is garbage."""
    gc.set_threshold(100_000, 50, 100)


def pytest_collection_finish(session: pytest.Session) -> None:
    """Look for garbage a little more often again, but never among the tests.

    As often as ever would cost a tenth of the run: a model is many objects that live long.
    """
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Forget with a file of tests what it has worked out once: whole sites, for the most part.

    Kept to the end, that would be as much again as all else that a process holds.
    """
    if isinstance(item, pytest.Function) and (nextitem is None or nextitem.path != item.path):
        for each in vars(item.module).values():
            if isinstance(each, _CACHED) and each.__module__ == item.module.__name__:
                each.cache_clear()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out all but a sample, if one is asked for."""
    if isinstance(config.option.sample, int):
        kept = sample(items, config.option.sample, config.option.seed)
        config.hook.pytest_deselected(items=[item for item in items if item not in kept])
        items[:] = [item for item in items if item in kept]


def sample(items: Sequence[pytest.Item], many: int, seed: int) -> set[pytest.Item]:
    """Return so many tests of each file; the same for the same seed."""
    by_file: defaultdict[str, list[pytest.Item]] = defaultdict(list)
    for item in items:
        by_file[item.nodeid.partition("::")[0]].append(item)
    return {
        item
        for file, those in by_file.items()
        for item in random.Random(f"{seed} {file}").sample(those, min(many, len(those)))  # noqa: S311
    }
